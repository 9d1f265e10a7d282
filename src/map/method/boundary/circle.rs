//! The circle map: H = 0 exactly, black and white boundary points on two concentric circles.

use num_complex::Complex64;

use super::{is_asked, total};
use crate::constraint::Fixed;
use crate::energy::conformal::{self, Weight};
use crate::laplacian::ConformalLaplacian;
use crate::map::boundary_energy::circle_energy;
use crate::map::method::{Attempt, Unsuitable};
use crate::map::setup::Setup;
use crate::map::{Domain, Ending, Exactly, Map, MapError};
use crate::quad_graph::QuadGraph;
use crate::solver::boundary::{
    self, CirclePin, Linearised, TwoCircleMap, TwoCirclesError, centred_pins, singular_values, two_circle_map,
};
use crate::solver::{Observer, Phase, StopRule};

/// Singular values are computed densely up to this many black boundary vertices.
const MOST_FOR_SINGULAR_VALUES: usize = 100;

/// Computes the map with H = 0 whose black and white boundary points lie on two circles.
///
/// # Errors
/// Pins that are not in use.
pub(super) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, normalisation, .. } = setup;
    let graph = &domain.graph;
    let Some(pins) = pins(setup)? else {
        return Ok(Attempt::Unsuitable(Unsuitable::Request("a vertex inside is held")));
    };
    if !(1..=3).contains(&pins.len()) {
        return Ok(Attempt::Unsuitable(Unsuitable::Request("more than three boundary points are held")));
    }
    if is_asked(options) && options.is_ordered() {
        return Ok(Attempt::Unsuitable(Unsuitable::Request("it does not keep the boundary in order")));
    }
    let laplacian = match setup.laplacian(watch) {
        Ok(laplacian) => laplacian,
        Err(error) => return Ok(Attempt::Unsuitable(Unsuitable::Matrix(error.into()))),
    };
    watch.phase(Phase::Solve);
    let rule = StopRule { tolerance: options.tolerance, reference: None, max_iterations: options.max_iterations };
    let mut found = two_circle_map(&laplacian, graph, &pins, rule, watch);
    let mut anchored = normalisation.exact;
    // Points at the angles of arc length may crowd long parts of the surface into short arcs. Where nobody asked for these points,
    // others spread the map as evenly as it can be.
    if let Err(TwoCirclesError::Stalled { .. }) = found
        && !options.holds_more()
        && let Some(centred) = centred_pins(&laplacian, graph)
    {
        found = two_circle_map(&laplacian, graph, &centred, rule, watch);
        anchored = false;
    }
    let found = match found {
        Ok(found) => found,
        Err(reason) => return Ok(Attempt::failed(reason.into(), None)),
    };
    let smallest =
        (laplacian.len() <= MOST_FOR_SINGULAR_VALUES).then(|| smallest_singular_value(setup, &laplacian, &found));
    let z = image(&laplacian, graph, &found);
    drop(laplacian);
    let mut fixed = Fixed::default();
    for pin in &pins {
        let vertex = graph.boundary[pin.position];
        fixed.hold(vertex, z[vertex as usize]);
    }
    // H of a map that obeys (2) is rounding, with any weights; they are undefined where some Re ρ ≤ 0.
    let h = conformal::weights(graph, Weight::Integral).map_or(0.0, |weights| conformal::value(graph, &weights, &z));
    let energies = vec![("H", h), ("C", circle_energy(graph, &fixed, &z))];
    let map = Map {
        total: Some(total(expression, &energies)),
        energies,
        residual: Some(found.residual),
        ending: Ending::Minimised(found.status),
        iterations: found.iterations,
        smallest_singular_value: smallest.flatten(),
        on_circle: true,
        anchored,
        exactly: Some(Exactly::Conformal),
        epsilon: Some(found.epsilon),
        ..Map::solved(boundary::NAME, z, fixed, None)
    };
    // Pins are met to rounding: on quad meshes the two circles would put them beside their places.
    Ok(Attempt::solved(if !options.holds_more() { map } else { on_circle(setup, map) }))
}

/// On quad meshes, the map with its boundary points, of both colours, moved radially onto the unit circle: (2) is then off by O(ε) at the
/// boundary, where the two circles would make corners reflex that the boundary's turn is smaller at. Other maps are returned as they are.
pub(in crate::map) fn on_circle(setup: &Setup, map: Map) -> Map {
    let graph = &setup.domain.graph;
    if graph.primal < graph.vertices || map.exactly != Some(Exactly::Conformal) {
        return map;
    }
    let Map { mut z, mut fixed, .. } = map;
    for &v in &graph.boundary {
        let place = z[v as usize] / z[v as usize].norm();
        z[v as usize] = place;
        if fixed.holds(v) {
            fixed.hold(v, place);
        }
    }
    let h = conformal::weights(graph, Weight::Integral).map(|weights| conformal::value(graph, &weights, &z)).ok();
    let energies: Vec<(&'static str, f64)> = h.map(|h| ("H", h)).into_iter().chain([("C", 0.0)]).collect();
    Map {
        total: h.map(|_| total(&setup.expression, &energies)),
        energies,
        residual: None,
        gradient_norm: None,
        exactly: Some(Exactly::Circle),
        z,
        fixed,
        ..map
    }
}

/// The map of all vertices. On triangle meshes it is divided by √(1 + ε), so that the boundary vertices of the mesh, which are black,
/// are on the unit circle. On quad meshes both colours are vertices of the mesh, and neither is preferred.
fn image(laplacian: &ConformalLaplacian, graph: &QuadGraph, found: &TwoCircleMap) -> Vec<Complex64> {
    let mut z = laplacian.extend(graph, &found.b, found.w_0, &mut laplacian.work());
    if graph.primal < graph.vertices {
        let scale = 1.0 / (1.0 + found.epsilon).sqrt();
        z.iter_mut().for_each(|z| *z *= scale);
    }
    z
}

/// The smallest singular value of the equations that determine the map: with ε and all three points, or of the original's with the two
/// points that were asked for and without ε.
fn smallest_singular_value(setup: &Setup, laplacian: &ConformalLaplacian, found: &TwoCircleMap) -> Option<f64> {
    let two: Vec<CirclePin>;
    let linearised = if setup.normalisation.points.len() == 2 {
        two = setup.normalisation.points.iter().map(|&(position, angle)| CirclePin { position, angle }).collect();
        Linearised { b: &found.b, w_0: found.w_0, pins: &two, with_epsilon: false }
    } else {
        Linearised { b: &found.b, w_0: found.w_0, pins: &found.pins, with_epsilon: true }
    };
    singular_values(laplacian, &setup.domain.graph, linearised).last().copied()
}

/// Boundary positions that are held, ascending, with their angles; `None` if a vertex inside is held.
fn pins(setup: &Setup) -> Result<Option<Vec<CirclePin>>, MapError> {
    let Domain { disc, graph, .. } = setup.domain;
    let points = setup.normalisation.points.iter();
    let on_circle: Vec<CirclePin> = points.map(|&(position, angle)| CirclePin { position, angle }).collect();
    if !setup.options.holds_more() {
        return Ok(Some(on_circle));
    }
    let mut fixed = Fixed::default();
    setup.options.hold(&mut fixed, disc, graph)?;
    let on_boundary = graph.boundary.iter().filter(|&&v| fixed.holds(v)).count();
    Ok((on_boundary == fixed.len()).then_some(on_circle))
}
