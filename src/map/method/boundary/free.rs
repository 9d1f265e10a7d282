//! The free map of a quad mesh: the boundary edges exactly of given lengths, H the lowest.

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{reduction, total};
use crate::constraint::{Fixed, hold_gauge};
use crate::energy::conformal::{self, Weight};
use crate::map::boundary_energy::length_energy;
use crate::map::method::{Attempt, Unsuitable};
use crate::map::setup::Setup;
use crate::map::{Domain, Ending, Exactly, Map, MapError};
use crate::quad_graph::{QuadGraph, curvature};
use crate::solver::Observer;
use crate::solver::boundary::{self, FreeMap, FreeProblem, FreeStalled, Reduction, free_map};

/// Boundary lengths are kept to ten times the tolerance, and never worse than this.
const COARSEST_LENGTHS: f64 = 1e-6;

/// How well boundary lengths are kept where the free map is a start.
const START_LENGTHS: f64 = 1e-3;

/// Minimises H with the boundary edges of their lengths.
///
/// # Errors
/// Integral weights that are undefined.
pub(super) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, .. } = setup;
    let Domain { graph, .. } = domain;
    let reduction = match reduction(setup, watch) {
        Ok(reduction) => reduction,
        Err(reason) => return Ok(Attempt::Unsuitable(Unsuitable::Matrix(reason))),
    };
    let tolerance = (10.0 * options.tolerance).min(COARSEST_LENGTHS);
    let found = match map_of_lengths(domain, &reduction, tolerance, options.max_iterations, watch) {
        Ok(found) => found,
        Err(stalled) => {
            let start = place(graph, &stalled.start);
            let is_usable = start.iter().all(|z| z.is_finite());
            let start = is_usable.then(|| reduction.extend(&start));
            return Ok(Attempt::failed(stalled.reason, start));
        }
    };
    let z = reduction.extend(&place(graph, &found.boundary));
    drop(reduction);
    let h = conformal::value(graph, &conformal::weights(graph, Weight::Integral)?, &z);
    let energies = vec![("H", h), ("Lb", length_energy(graph, &z))];
    let mut fixed = Fixed::default();
    hold_gauge(&mut fixed, expression, graph, &z);
    Ok(Attempt::solved(Map {
        total: Some(total(expression, &energies)),
        energies,
        ending: Ending::Minimised(found.status),
        iterations: found.iterations,
        residual: Some(found.residual),
        // On triangle meshes these are the half edges, from vertex to dual vertex.
        exactly: (!domain.is_of_triangles()).then_some(Exactly::Lengths),
        ..Map::solved(boundary::NAME, z, fixed, None)
    }))
}

/// The free map as a start for other energies: conformal, of the right size, corners as they are on the surface. `None` where it is
/// not found. `watch` is not told of its iterations.
pub(super) fn start(setup: &Setup, watch: &mut dyn Observer) -> Option<Vec<Complex64>> {
    let reduction = reduction(setup, watch).ok()?;
    let found = map_of_lengths(setup.domain, &reduction, START_LENGTHS, None, &mut StopOnly(watch)).ok()?;
    Some(reduction.extend(&place(&setup.domain.graph, &found.boundary)))
}

fn map_of_lengths(
    domain: &Domain,
    reduction: &Reduction,
    tolerance: f64,
    max_iterations: Option<usize>,
    watch: &mut dyn Observer,
) -> Result<FreeMap, FreeStalled> {
    let Domain { disc, graph, planes, prescribed } = domain;
    let curvature = curvature(disc, graph, planes.as_ref().map(|planes| planes.normals.as_slice()));
    let problem = FreeProblem {
        reduction,
        curvature: &curvature,
        lengths: &graph.boundary_length,
        log_factors: prescribed.as_ref().map(|prescribed| prescribed.log_factors.as_slice()),
        tolerance,
        max_iterations,
    };
    free_map(&problem, watch)
}

/// Passes on the request to stop, and no iterations.
pub(super) struct StopOnly<'a>(pub &'a mut dyn Observer);

impl Observer for StopOnly<'_> {
    fn phase(&mut self, _phase: crate::solver::Phase) {}

    fn stop_requested(&self) -> bool {
        self.0.stop_requested()
    }
}

/// Boundary values moved to where the gauge of the minimisers has them: the first vertex, and the direction of the first edge, as on
/// the circle of the perimeter.
fn place(graph: &QuadGraph, z: &[Complex64]) -> Vec<Complex64> {
    let radius = graph.perimeter() / TAU;
    let ahead = Complex64::cis(graph.boundary_length[0] / radius) - 1.0;
    let turn = ahead / (z[1] - z[0]);
    let turn = turn / turn.norm();
    z.iter().map(|place| radius + turn * (place - z[0])).collect()
}
