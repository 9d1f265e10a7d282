//! Maps that minimise more than H: the initial map of §3.2 and §3.3 of the paper, what is held, and the stages of the
//! minimisation.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::flip_free::{self, hold_unseen, is_flip_free};
use super::options::hold_pins;
use super::reduced::{self, Attempt};
use super::{Boundary, Domain, Map, MapError, MapOptions, Outcome, bijective};
use crate::constraint::{Fixed, Freedoms, float_white_back, hold_gauge, on_circle, spread_points, turn_back};
use crate::energy::conformal::{Dirichlet, Weight};
use crate::energy::{Expression, Order, Rest, energy};
use crate::problem::linear::LinearProblem;
use crate::problem::nonlinear::{Objective, Terms};
use crate::quad_graph::QuadGraph;
use crate::quad_graph::metric::RestMetric;
use crate::solver::minimise::smallest_singular_value;
use crate::solver::{MINIMISERS, Minimiser, Minimum, Observer, Status, StopRule, minimiser, solve_linear};
use crate::surface::oriented_mesh::OrientedMesh;

/// A minimisation that ends at rounding counts as converged when it has brought the gradient down to this.
const ACCEPTED_REDUCTION: f64 = 1e-5;

/// L' is first weakened by this factor: with integral weights it is stiff, and far from a solution the energy has long
/// narrow valleys. A solution with H = L' = 0 is one for every coefficient.
const SOFTENED: f64 = 0.01;

/// How far from the unit circle the pin of a boundary vertex may be: places are often typed with three digits.
const PIN_ON_CIRCLE: f64 = 1e-3;

/// Coefficients of the barrier that keeps the boundary in order, stage after stage.
const BARRIER: [f64; 4] = [1e-2, 1e-4, 1e-6, 1e-8];

/// Minimises `expression`.
pub(super) fn minimise(
    options: &MapOptions,
    expression: &Expression,
    domain: &Domain,
    exact: Option<&[[f64; 2]]>,
    watch: &mut dyn Observer,
) -> Result<Map, MapError> {
    if !(options.tolerance > 0.0 && options.tolerance < 1.0) {
        return Err(MapError::Tolerance { tolerance: options.tolerance });
    }
    let Domain { disc, graph, .. } = domain;
    let circle = expression.has("C") && options.boundary != Boundary::Fixed;
    let anchors = if circle { anchors(options, expression, domain, exact)? } else { Anchors::default() };
    let (after, start) = match reduced::attempt(options, expression, domain, &anchors, watch)? {
        Attempt::Done(map) => return Ok(*map),
        Attempt::Elsewhere { after, start, disordered } => {
            if let Some(plain) = disordered
                && let Some(map) = bijective::unfolded(options, domain, &plain, watch)?.0
            {
                return Ok(map);
            }
            (after, start)
        }
    };
    let backend = choose(&options.solver)?;
    let metric = domain.rest_metric(options)?;
    let flip_free = is_flip_free(expression);
    let first = match start {
        Some(z) => z,
        None if flip_free => flip_free::start(options, expression, domain, &metric, &anchors.points, watch)?,
        None => match reduced::free_start(options, expression, domain, watch) {
            Some(z) => z,
            None => initial(options, expression, disc, graph, &anchors)?,
        },
    };
    let mut fixed = held(options, expression, disc, graph, &anchors, &first)?;
    let unit = if flip_free { flip_free::unit_of_shapes(options, expression, graph, &metric, &first) } else { 1.0 };
    let mut problem = Problem { options, expression, graph, metric: &metric, fixed: fixed.clone(), unit };
    let mut unseen = Vec::new();
    if flip_free {
        let terms = problem.terms()?;
        unseen = hold_unseen(&mut problem.fixed, &terms, &first);
    }
    let objective = problem.objective()?;
    let start = objective.freedoms.restrict(&first);
    let rule = StopRule { tolerance: options.tolerance, reference: None, max_iterations: options.max_iterations };
    let run = |rule: StopRule, watch: &mut dyn Observer| {
        let start = start.clone();
        if options.keep_order && circle {
            problem.in_order(backend, start, rule, watch)
        } else if problem.is_stiff() && backend.name() == MINIMISERS[0].name() {
            problem.softened_first(backend, &objective, start, rule, watch)
        } else {
            let minimum = backend.minimise(&objective, start, rule, watch)?;
            let iterations = minimum.iterations;
            Ok((minimum, iterations))
        }
    };
    // Where the reduction has failed and another map takes the place of one that folds, it is not worth while to wait for that.
    let (minimum, iterations) = match after.is_some() && options.promises_valid() {
        true => bijective::unless_hopeless(domain, &objective, rule, watch, run)?,
        false => run(rule, watch)?,
    };
    accept(backend, &minimum, options)?;

    let mut z = objective.freedoms.expand(&minimum.y);
    let is_metric = ["A", "L", "Lb"].iter().any(|name| expression.has(name));
    let has_gauge = is_metric && options.boundary != Boundary::Fixed && options.pins.is_empty() && !expression.has("C");
    if has_gauge {
        turn_back(expression, graph, &first, &mut z);
    }
    let only_diagonals = expression.has("A") && !["L", "Lb", "C"].iter().any(|name| expression.has(name));
    if only_diagonals && has_gauge {
        float_white_back(graph, &metric, &mut z);
    }
    if !unseen.is_empty() {
        let placed = domain.with_dual_vertices(z[..graph.primal].to_vec(), &fixed);
        unseen.iter().for_each(|&v| z[v as usize] = placed[v as usize]);
    }
    let energies = objective.values(&minimum.y);
    let total = objective.terms.iter().zip(&energies).map(|((t, _), (_, e))| t * e).sum();
    if has_gauge {
        fixed = Fixed::default();
        hold_gauge(&mut fixed, expression, graph, &z);
    }
    let smallest_singular_value = if circle { smallest_singular_value(&objective, &minimum.y) } else { None };
    Ok(Map {
        total: Some(total),
        energies,
        gradient_norm: Some(minimum.gradient_norm),
        outcome: Outcome::Minimised(minimum.status),
        iterations,
        smallest_singular_value,
        on_circle: circle || (options.boundary == Boundary::Fixed && options.fixed_on_circle()),
        anchored: anchors.exact,
        ..Map::solved(after.unwrap_or(backend.name()), z, fixed, None)
    })
}

fn choose(name: &str) -> Result<&'static dyn Minimiser, MapError> {
    if name == "auto" {
        return Ok(MINIMISERS[0]);
    }
    minimiser(name).ok_or_else(|| MapError::NotAMinimiser {
        name: name.to_owned(),
        known: [crate::solver::boundary::NAME]
            .into_iter()
            .chain(MINIMISERS.iter().map(|m| m.name()))
            .collect::<Vec<_>>()
            .join(", "),
    })
}

/// Fails where the minimisation did not converge, unless the user set its end.
fn accept(backend: &dyn Minimiser, minimum: &Minimum, options: &MapOptions) -> Result<(), MapError> {
    let good = match minimum.status {
        Status::Converged | Status::Interrupted => true,
        Status::Precision => minimum.reduction() <= ACCEPTED_REDUCTION.max(options.tolerance),
        Status::MaxIterations => options.max_iterations.is_some(),
    };
    if good {
        return Ok(());
    }
    Err(MapError::NotConverged {
        backend: backend.name(),
        status: minimum.status.name(),
        iterations: minimum.iterations,
        reduction: minimum.reduction(),
        tolerance: options.tolerance,
    })
}

/// Points of a circle map that are held: positions on the boundary with their angles, ascending.
#[derive(Default)]
pub(super) struct Anchors {
    pub points: Vec<(usize, f64)>,
    /// Whether the angles are those of the exact map.
    pub exact: bool,
}

/// Which points of a circle map are held, and where.
pub(super) fn anchors(
    options: &MapOptions,
    expression: &Expression,
    domain: &Domain,
    exact: Option<&[[f64; 2]]>,
) -> Result<Anchors, MapError> {
    let Domain { disc, graph, .. } = domain;
    if !(2..=3).contains(&options.fix) {
        return Err(MapError::FixedPoints { fix: options.fix });
    }
    if !options.pins.is_empty() {
        return pinned_anchors(options, disc, graph);
    }
    // With lengths or areas in the energy nothing is free but the rotation, which one point's direction takes.
    if expression.rows().any(|row| row.metric) {
        return Ok(Anchors { points: vec![(0, 0.0)], exact: false });
    }
    let positions = spread_points(graph, options.fix);
    let arc = on_circle(graph, 1.0, &[(0, 0.0)])?;
    let place = |k: usize| match exact.and_then(|w| w.get(disc.source_vertex[graph.boundary[k] as usize] as usize)) {
        Some(&[x, y]) => Complex64::new(x, y),
        None => arc.place(graph.boundary[k]).unwrap_or_default(),
    };
    let places = positions.iter().map(|&k| (k, place(k)));
    Ok(Anchors { points: increasing_angles(places).unwrap_or_else(|_| vec![(0, 0.0)]), exact: exact.is_some() })
}

/// The pins that are on the boundary as anchors of the initial circle.
fn pinned_anchors(options: &MapOptions, disc: &OrientedMesh, graph: &QuadGraph) -> Result<Anchors, MapError> {
    let mut fixed = Fixed::default();
    hold_pins(&mut fixed, disc, &options.pins)?;
    let mut is_boundary = vec![false; graph.vertices];
    for &v in &graph.boundary {
        is_boundary[v as usize] = true;
    }
    for (v, place) in fixed.iter() {
        let (vertex, radius) = (disc.source_vertex[v as usize], place.norm());
        match is_boundary[v as usize] {
            true if (radius - 1.0).abs() > PIN_ON_CIRCLE => return Err(MapError::PinOffCircle { vertex, radius }),
            false if radius >= 1.0 - PIN_ON_CIRCLE => return Err(MapError::PinOutside { vertex, radius }),
            _ => {}
        }
    }
    let on_boundary = (0..graph.boundary.len()).filter_map(|k| Some((k, fixed.place(graph.boundary[k])?)));
    let points = increasing_angles(on_boundary.filter(|(_, place)| place.norm() > 0.0))
        .map_err(|k| MapError::PinsOutOfOrder { vertex: disc.source_vertex[graph.boundary[k] as usize] })?;
    Ok(Anchors { points: if points.is_empty() { vec![(0, 0.0)] } else { points }, exact: false })
}

/// The angles of places along the boundary, each larger than the one before, less than 2π in all; else the position of
/// the first place that is out of order.
fn increasing_angles(places: impl Iterator<Item = (usize, Complex64)>) -> Result<Vec<(usize, f64)>, usize> {
    let mut points: Vec<(usize, f64)> = Vec::new();
    for (k, place) in places {
        let angle = match points.first() {
            None => place.arg(),
            Some(&(_, first)) => first + (place / Complex64::cis(first)).arg().rem_euclid(TAU),
        };
        if points.last().is_some_and(|&(_, last)| angle <= last) {
            return Err(k);
        }
        points.push((k, angle));
    }
    Ok(points)
}

/// The boundary on a circle by arc length, of the perimeter's radius where lengths count, the interior from H.
fn initial(
    options: &MapOptions,
    expression: &Expression,
    disc: &OrientedMesh,
    graph: &QuadGraph,
    anchors: &Anchors,
) -> Result<Vec<Complex64>, MapError> {
    let fixed = if options.boundary == Boundary::Fixed {
        options.fixed(disc, graph)?
    } else {
        let lengths_count = expression.rows().any(|row| row.metric) && !expression.has("C");
        let radius = if lengths_count { graph.perimeter() / TAU } else { 1.0 };
        let points = if anchors.points.is_empty() { vec![(0, 0.0)] } else { anchors.points.clone() };
        on_circle(graph, radius, &points)?
    };
    let problem = LinearProblem::new(graph, options.weight, &fixed)?;
    Ok(solve_linear(&problem, "auto", &mut crate::solver::Silent)?.z)
}

/// What is held while the energy is minimised (design: the table of §3).
fn held(
    options: &MapOptions,
    expression: &Expression,
    disc: &OrientedMesh,
    graph: &QuadGraph,
    anchors: &Anchors,
    z: &[Complex64],
) -> Result<Fixed, MapError> {
    if options.boundary == Boundary::Fixed {
        return options.fixed(disc, graph);
    }
    let mut fixed = Fixed::default();
    hold_pins(&mut fixed, disc, &options.pins)?;
    let metric = expression.rows().any(|row| row.metric);
    if !fixed.is_empty() {
        return Ok(fixed);
    }
    match (expression.has("C"), metric) {
        (true, false) => {
            for &(k, angle) in &anchors.points {
                fixed.hold(graph.boundary[k], Complex64::cis(angle));
            }
        }
        (true, true) => {
            let first = graph.boundary[0];
            fixed.hold_on_line(first, Complex64::ZERO, z[first as usize]);
        }
        (false, _) if is_flip_free(expression) && !["A", "L", "Lb"].iter().any(|name| expression.has(name)) => {
            flip_free::hold_gauge(&mut fixed, expression, graph, z);
        }
        (false, _) => hold_gauge(&mut fixed, expression, graph, z),
    }
    Ok(fixed)
}

/// What objectives are made of.
struct Problem<'a> {
    options: &'a MapOptions,
    expression: &'a Expression,
    graph: &'a QuadGraph,
    metric: &'a RestMetric,
    fixed: Fixed,
    /// The factor on energies of shapes alone.
    unit: f64,
}

impl Problem<'_> {
    /// The energies with their coefficients.
    fn terms(&self) -> Result<Terms, MapError> {
        let Problem { options, graph, metric, .. } = *self;
        let held: Vec<bool> = (0..graph.vertices as u32).map(|v| self.fixed.holds(v)).collect();
        let rest = Rest { graph, metric, weight: options.weight, held: &held };
        let mut terms = Terms::new();
        for term in self.expression.terms.iter().filter(|term| term.coefficient > 0.0) {
            if let Some(row) = energy(term.name) {
                let unit = if row.flip_free && !row.metric { self.unit } else { 1.0 };
                terms.push((unit * term.coefficient, (row.make)(rest)?));
            }
        }
        Ok(terms)
    }

    fn objective(&self) -> Result<Objective, MapError> {
        let Problem { options, graph, .. } = *self;
        let freedoms = Freedoms::for_factor(graph, &self.fixed);
        Ok(Objective { terms: self.terms()?, freedoms, norm: Dirichlet::new(graph, options.weight) })
    }

    /// Whether L' is stiff beside H.
    fn is_stiff(&self) -> bool {
        self.options.weight == Weight::Integral && self.expression.has("H") && self.expression.has("Lb")
    }

    /// Minimises with a weakened L' first.
    fn softened_first(
        &self,
        backend: &dyn Minimiser,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<(Minimum, usize), MapError> {
        let mut soft = self.objective()?;
        for (coefficient, _) in soft.terms.iter_mut().filter(|(_, energy)| energy.name() == "Lb") {
            *coefficient *= SOFTENED;
        }
        let first = backend.minimise(&soft, start, rule, watch)?;
        if first.status == Status::Interrupted {
            let iterations = first.iterations;
            return Ok((first, iterations));
        }
        // The second start is next to the end: its own gradient would be no measure.
        let left = rule.max_iterations.map(|n| n.saturating_sub(first.iterations));
        let rule = StopRule { max_iterations: left, reference: Some(first.reference), ..rule };
        let minimum = backend.minimise(objective, first.y, rule, watch)?;
        let iterations = first.iterations + minimum.iterations;
        Ok((minimum, iterations))
    }

    /// Minimises with a barrier between neighbours on the boundary, weaker at each stage.
    fn in_order(
        &self,
        backend: &dyn Minimiser,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<(Minimum, usize), MapError> {
        let mut objective = self.objective()?;
        objective.terms.push((BARRIER[0], Box::new(Order::new(self.graph))));
        let barrier = objective.terms.len() - 1;
        let mut iterations = 0;
        let mut y = start;
        let mut rule = rule;
        let mut last = None;
        for coefficient in BARRIER {
            objective.terms[barrier].0 = coefficient;
            let minimum = backend.minimise(&objective, y, rule, watch)?;
            iterations += minimum.iterations;
            y = minimum.y.clone();
            rule.reference = Some(minimum.reference);
            let stop = minimum.status == Status::Interrupted;
            last = Some(minimum);
            if stop {
                break;
            }
        }
        last.map(|minimum| (minimum, iterations)).ok_or(MapError::FreeBoundary)
    }
}
