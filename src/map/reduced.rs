//! Maps by the boundary reduction: which requests it takes, and what it makes of them.

use num_complex::Complex64;
use std::f64::consts::TAU;

use super::nonlinear::Anchors;
use super::options::{Start, hold_pins};
use super::{Boundary, Domain, Exactly, Map, MapError, MapOptions, Outcome};
use crate::constraint::{Fixed, hold_gauge};
use crate::energy::Expression;
use crate::energy::conformal::{self, Weight};
use crate::geometry::polygon::out_of_order;
use crate::quad_graph::{QuadGraph, curvature};
use crate::solver::boundary::{self, CircleProblem, FreeProblem, Reduction, Unreduced, circle_map, free_map};
use crate::solver::{Observer, Phase, StopRule};
use crate::surface::oriented_mesh::OrientedMesh;

/// Boundary lengths of free maps are kept to ten times the tolerance, and never worse than this.
const COARSEST_LENGTHS: f64 = 1e-6;

/// How well boundary lengths are kept where the free map is a start.
const START_LENGTHS: f64 = 1e-3;

/// The other backend's name where the reduction stalled.
const AFTER_STALL: &str = "levenberg-marquardt (reduced stalled)";

/// Its name where the reduction put boundary points out of order: staircases do that, and H + C, which draws them towards the
/// circle but not onto it, shears the faces there far less (inspired_mesh: 298 to 1 against 1.13 to 1).
const AFTER_DISORDER: &str = "levenberg-marquardt (reduced out of order)";

/// Larger quad graphs are left as the reduction has them, unless the order is to be kept: the factor of the other backend takes eight times the memory.
const MOST_FOR_SOFT: usize = 300_000;

/// What came of it.
pub(super) enum Attempt {
    /// The map.
    Done(Box<Map>),
    /// Another backend must do it, if possible from this start.
    Elsewhere {
        /// The name of that backend where the reduction was tried first, with the reason.
        after: Option<&'static str>,
        /// A map to start from.
        start: Option<Vec<Complex64>>,
        /// The map of the reduction, with boundary points out of order, where it may be put right.
        disordered: Option<Box<Map>>,
    },
}

/// Maps by the reduction where `options` ask for it, or leave the choice and the problem suits.
pub(super) fn attempt(
    options: &MapOptions,
    expression: &Expression,
    domain: &Domain,
    anchors: &Anchors,
    watch: &mut dyn Observer,
) -> Result<Attempt, MapError> {
    let Domain { disc, graph, planes, prescribed } = domain;
    let by_name = options.solver == boundary::NAME;
    if !by_name && options.solver != "auto" {
        return Ok(Attempt::Elsewhere { after: None, start: None, disordered: None });
    }
    let elsewhere = |after, start, error: Unreduced| match by_name {
        true => Err(error.into()),
        false => Ok(Attempt::Elsewhere { after, start, disordered: None }),
    };
    let problem = match Kind::of(options, expression) {
        Ok(problem) => problem,
        Err(reason) => return elsewhere(None, None, Unreduced::Unsuitable { reason }),
    };
    let pins = match pins(options, disc, graph, anchors)? {
        Some(pins) => pins,
        None => return elsewhere(None, None, Unreduced::Unsuitable { reason: "a vertex inside is held" }),
    };
    watch.phase(Phase::Assemble);
    let reduction = match Reduction::new(graph, || watch.phase(Phase::Factor)) {
        Ok(reduction) => reduction,
        Err(error) => return elsewhere(None, None, error),
    };
    watch.phase(Phase::Solve);
    let rule = StopRule { tolerance: options.tolerance, reference: None, max_iterations: options.max_iterations };
    match problem {
        Kind::Circle => {
            // Left to itself it does not enforce the order: the other backend does that with far less shear.
            let keep_order = by_name && options.keep_order;
            let problem = CircleProblem { reduction: &reduction, pins: &pins, keep_order, rule };
            let found = match circle_map(&problem, watch) {
                Ok(found) => found,
                Err(error) => return elsewhere(Some(AFTER_STALL), None, error),
            };
            let mut fixed = Fixed::default();
            for &(k, place) in &pins {
                fixed.hold(graph.boundary[k], place);
            }
            let may_go_on = !by_name && (options.keep_order || graph.vertices <= MOST_FOR_SOFT);
            let goes_on = may_go_on && out_of_order(&mesh_part(graph, &found.boundary)) > 0;
            // A valid map that is as near to conformal spares the other backend.
            if goes_on && (options.keep_order || !options.promises_valid()) {
                return Ok(Attempt::Elsewhere { after: Some(AFTER_DISORDER), start: None, disordered: None });
            }
            let z = reduction.extend(&found.boundary);
            drop(reduction);
            let h = conformal::value(graph, &conformal::weights(graph, Weight::Integral)?, &z);
            let energies = vec![("H", h), ("C", circle_energy(graph, &fixed, &z))];
            let map = Box::new(Map {
                total: Some(total(expression, &energies)),
                energies,
                gradient_norm: Some(found.gradient_norm),
                outcome: Outcome::Minimised(found.status),
                iterations: found.iterations,
                smallest_singular_value: found.smallest_singular_value,
                on_circle: true,
                anchored: anchors.exact,
                exactly: Some(Exactly::Circle),
                ..Map::solved(boundary::NAME, z, fixed, None)
            });
            Ok(match goes_on {
                true => Attempt::Elsewhere { after: Some(AFTER_DISORDER), start: None, disordered: Some(map) },
                false => Attempt::Done(map),
            })
        }
        Kind::Free => {
            let curvature = curvature(disc, graph, planes.as_ref().map(|planes| planes.normals.as_slice()));
            let problem = FreeProblem {
                reduction: &reduction,
                curvature: &curvature,
                lengths: &graph.boundary_length,
                log_factors: prescribed.as_ref().map(|prescribed| prescribed.log_factors.as_slice()),
                tolerance: (10.0 * options.tolerance).min(COARSEST_LENGTHS),
                max_iterations: options.max_iterations,
            };
            let found = match free_map(&problem, watch) {
                Ok(found) => found,
                Err(stalled) => {
                    let start = place(graph, &stalled.start);
                    let usable = start.iter().all(|z| z.is_finite());
                    let start = usable.then(|| reduction.extend(&start));
                    return elsewhere(Some(AFTER_STALL), start, stalled.reason);
                }
            };
            let z = reduction.extend(&place(graph, &found.boundary));
            drop(reduction);
            let h = conformal::value(graph, &conformal::weights(graph, Weight::Integral)?, &z);
            let energies = vec![("H", h), ("Lb", length_energy(graph, &z))];
            let mut fixed = Fixed::default();
            hold_gauge(&mut fixed, expression, graph, &z);
            Ok(Attempt::Done(Box::new(Map {
                total: Some(total(expression, &energies)),
                energies,
                outcome: Outcome::Minimised(found.status),
                iterations: found.iterations,
                residual: Some(found.residual),
                exactly: Some(Exactly::Lengths),
                ..Map::solved(boundary::NAME, z, fixed, None)
            })))
        }
    }
}

/// The free map as a start for energies that see lengths or areas: conformal, of the right size, corners as they are on the
/// surface. `None` where it is not suited or not found.
pub(super) fn free_start(
    options: &MapOptions,
    expression: &Expression,
    domain: &Domain,
    watch: &mut dyn Observer,
) -> Option<Vec<Complex64>> {
    let Domain { disc, graph, planes, prescribed } = domain;
    let suits = options.start == Start::Auto
        && options.boundary != Boundary::Fixed
        && options.pins.is_empty()
        && !expression.has("C")
        && (expression.has("A") || expression.has("L"));
    if !suits {
        return None;
    }
    watch.phase(Phase::Assemble);
    let reduction = Reduction::new(graph, || watch.phase(Phase::Factor)).ok()?;
    watch.phase(Phase::Solve);
    let curvature = curvature(disc, graph, planes.as_ref().map(|planes| planes.normals.as_slice()));
    let problem = FreeProblem {
        reduction: &reduction,
        curvature: &curvature,
        lengths: &graph.boundary_length,
        log_factors: prescribed.as_ref().map(|prescribed| prescribed.log_factors.as_slice()),
        tolerance: START_LENGTHS,
        max_iterations: None,
    };
    let found = free_map(&problem, &mut Unheard(watch)).ok()?;
    Some(reduction.extend(&place(graph, &found.boundary)))
}

/// Passes on a wish to stop, and is silent about iterations.
struct Unheard<'a>(&'a mut dyn Observer);

impl Observer for Unheard<'_> {
    fn phase(&mut self, _phase: Phase) {}

    fn stop_requested(&self) -> bool {
        self.0.stop_requested()
    }
}

/// Boundary values of a free map moved to where the gauge of the other backends has them: the first vertex, and the
/// direction of the first edge, as on the circle of the perimeter.
fn place(graph: &QuadGraph, z: &[Complex64]) -> Vec<Complex64> {
    let radius = graph.perimeter() / TAU;
    let ahead = Complex64::cis(graph.boundary_length[0] / radius) - 1.0;
    let turn = ahead / (z[1] - z[0]);
    let turn = turn / turn.norm();
    z.iter().map(|place| radius + turn * (place - z[0])).collect()
}

/// The boundary values at vertices of the mesh.
fn mesh_part(graph: &QuadGraph, boundary: &[Complex64]) -> Vec<Complex64> {
    graph.boundary.iter().zip(boundary).filter(|(v, _)| !graph.is_dual(**v)).map(|(_, z)| *z).collect()
}

/// L'; of maps by the reduction it is rounding.
pub(super) fn length_energy(graph: &QuadGraph, z: &[Complex64]) -> f64 {
    let n = graph.boundary.len();
    let at = |k: usize| z[graph.boundary[k % n] as usize];
    let terms = graph.boundary_length.iter().enumerate();
    let sum: f64 = terms.map(|(k, l)| l * ((at(k + 1) - at(k)).norm_sqr() / (l * l) - 1.0).powi(2)).sum();
    sum * graph.perimeter() / TAU
}

/// The problems that reduce to the boundary.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// H with the boundary on the unit circle, the limit of H + βC.
    Circle,
    /// H with the boundary edges of their rest lengths, the limit of H + γ'L'.
    Free,
}

impl Kind {
    /// The problem that is asked, or why it is none of these.
    fn of(options: &MapOptions, expression: &Expression) -> Result<Self, &'static str> {
        if options.weight != Weight::Integral {
            return Err("it needs integral weights");
        }
        if options.boundary == Boundary::Fixed {
            return Err("the whole boundary is held");
        }
        let is =
            |names: &[&str]| expression.rows().count() == names.len() && names.iter().all(|name| expression.has(name));
        // Other coefficients ask for a compromise between the terms, which this is not.
        let by_name = options.solver == boundary::NAME;
        let even = expression.terms.iter().all(|term| term.coefficient == 1.0);
        match () {
            () if !even && !by_name => Err("the coefficients are not 1"),
            () if is(&["H", "C"]) => Ok(Kind::Circle),
            () if is(&["H", "Lb"]) && options.pins.is_empty() => Ok(Kind::Free),
            () if is(&["H", "Lb"]) => Err("vertices of a free map are held"),
            () => Err("the energy is neither H + C nor H + Lb"),
        }
    }
}

/// Boundary positions that are held, ascending, and where; `None` if a vertex inside is held.
fn pins(
    options: &MapOptions,
    disc: &OrientedMesh,
    graph: &QuadGraph,
    anchors: &Anchors,
) -> Result<Option<Vec<(usize, Complex64)>>, MapError> {
    if options.pins.is_empty() {
        return Ok(Some(anchors.points.iter().map(|&(k, angle)| (k, Complex64::cis(angle))).collect()));
    }
    let mut fixed = Fixed::default();
    hold_pins(&mut fixed, disc, &options.pins)?;
    let held: Vec<_> = graph.boundary.iter().enumerate().filter_map(|(k, &v)| Some((k, fixed.place(v)?))).collect();
    Ok((held.len() == fixed.len()).then_some(held))
}

/// C; where the boundary is on the circle it is rounding.
pub(super) fn circle_energy(graph: &QuadGraph, fixed: &Fixed, z: &[Complex64]) -> f64 {
    let n = graph.boundary.len();
    let free = (0..n).filter(|&k| !fixed.holds(graph.boundary[k]));
    let terms = free.map(|k| {
        let length = 0.5 * (graph.boundary_length[k] + graph.boundary_length[(k + n - 1) % n]);
        length * (z[graph.boundary[k] as usize].norm_sqr() - 1.0).powi(2)
    });
    terms.sum::<f64>() * TAU / graph.perimeter()
}

/// The energies with their coefficients.
fn total(expression: &Expression, energies: &[(&'static str, f64)]) -> f64 {
    let value = |name: &str| energies.iter().find(|(n, _)| *n == name).map_or(0.0, |(_, value)| *value);
    expression.terms.iter().map(|term| term.coefficient * value(term.name)).sum()
}
