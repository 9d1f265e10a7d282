//! The free map of a triangle mesh: H = 0, the boundary edges of the mesh exactly of given lengths.

use std::f64::consts::TAU;
use std::sync::Arc;

use num_complex::Complex64;

use super::free::StopOnly;
use super::total;
use crate::constraint::{Fixed, hold_gauge};
use crate::energy::conformal::{self, Weight};
use crate::laplacian::ConformalLaplacian;
use crate::map::boundary_energy::length_energy;
use crate::map::method::{Attempt, Unsuitable};
use crate::map::setup::Setup;
use crate::map::{Domain, Ending, Exactly, Map, MapError};
use crate::quad_graph::{QuadGraph, curvature};
use crate::solver::boundary::{self, BoundaryError, Keep, Layout, MeshEdgeMap, MeshEdgeProblem, mesh_edge_map};
use crate::solver::{Observer, Phase, Status};

/// λ = 1/μ if lengths are drawn to the prescribed ones; they are met to about μ².
const DRAWN: f64 = 10.0;

/// λ of holes without prescribed lengths; prescribing them costs conformality.
const HOLE: f64 = 0.1;

/// Computes the free map that keeps the lengths exactly. If it flips faces, the map whose lengths are drawn to them is
/// returned instead, provided that it flips fewer.
///
/// # Errors
/// Those of the request.
pub(super) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, .. } = setup;
    let graph = &domain.graph;
    let free = match Free::new(setup, watch) {
        Ok(free) => free,
        Err(reason) => return Ok(Attempt::Unsuitable(Unsuitable::Matrix(reason))),
    };
    let exact = match free.map(Keep::Exactly, None, options.max_iterations, watch) {
        Ok(found) => found,
        Err(reason) => return Ok(Attempt::failed(reason, None)),
    };
    let z = free.extend(&exact);
    if exact.status == Status::MaxIterations && options.max_iterations.is_none() {
        let reason = BoundaryError::Stalled { iterations: exact.iterations, residual: exact.mismatch };
        return Ok(Attempt::failed(reason, Some(z)));
    }
    let flipped = domain.folded(&z).len();
    let drawn = (flipped > 0 && exact.status == Status::Converged)
        .then(|| free.map(Keep::Drawn(DRAWN), Some(&exact), options.max_iterations, watch).ok())
        .flatten()
        .map(|found| (free.extend(&found), found));
    let (z, found, exactly) = match drawn {
        Some((other, found)) if domain.folded(&other).len() < flipped => (other, found, Exactly::Conformal),
        _ => (z, exact, Exactly::Lengths),
    };
    drop(free);
    let h = conformal::weights(graph, Weight::Integral).ok().map(|weights| conformal::value(graph, &weights, &z));
    let energies: Vec<_> = h.map(|h| ("H", h)).into_iter().chain([("Lb", length_energy(graph, &z))]).collect();
    let mut fixed = Fixed::default();
    hold_gauge(&mut fixed, expression, graph, &z);
    Ok(Attempt::solved(Map {
        total: h.map(|_| total(expression, &energies)),
        energies,
        ending: Ending::Minimised(found.status),
        iterations: found.iterations,
        residual: Some(found.mismatch),
        exactly: Some(exactly),
        ..Map::solved(boundary::NAME, z, fixed, None)
    }))
}

/// Computes the free map as a start for other energies; `None` if that fails. `watch` is not told of its iterations.
pub(super) fn start(setup: &Setup, watch: &mut dyn Observer) -> Option<Vec<Complex64>> {
    let free = Free::new(setup, watch).ok()?;
    let found = free.map(Keep::Exactly, None, None, &mut StopOnly(watch)).ok()?;
    Some(free.extend(&found))
}

/// The data common to all free maps of one domain.
struct Free<'a> {
    domain: &'a Domain,
    laplacian: Arc<ConformalLaplacian>,
    curvature: Vec<f64>,
    layout: Layout,
}

impl<'a> Free<'a> {
    fn new(setup: &Setup<'a>, watch: &mut dyn Observer) -> Result<Self, BoundaryError> {
        let domain = setup.domain;
        let Domain { disc, graph, planes, .. } = domain;
        watch.phase(Phase::Assemble);
        let curvature = curvature(disc, graph, planes.as_ref().map(|planes| planes.normals.as_slice()));
        let laplacian = setup.laplacian(watch)?;
        watch.phase(Phase::Solve);
        let layout = Layout::new(graph, &laplacian, &curvature);
        Ok(Free { domain, laplacian, curvature, layout })
    }

    fn map(
        &self,
        outer: Keep,
        from: Option<&MeshEdgeMap>,
        max_iterations: Option<usize>,
        watch: &mut dyn Observer,
    ) -> Result<MeshEdgeMap, BoundaryError> {
        let prescribed = self.domain.prescribed.as_ref();
        let hole = if prescribed.is_some() { outer } else { Keep::Drawn(HOLE) };
        let keep: Vec<Keep> = (0..self.laplacian.loops().len()).map(|c| if c == 0 { outer } else { hole }).collect();
        let problem = MeshEdgeProblem {
            laplacian: &self.laplacian,
            curvature: &self.curvature,
            layout: &self.layout,
            log_factors: prescribed.map(|prescribed| prescribed.log_factors.as_slice()),
            keep: &keep,
            max_iterations,
        };
        mesh_edge_map(&problem, from, watch)
    }

    fn extend(&self, found: &MeshEdgeMap) -> Vec<Complex64> {
        let graph = &self.domain.graph;
        let z = self.laplacian.extend(graph, &found.b, found.w_0, &mut self.laplacian.work());
        place(graph, z)
    }
}

/// Moves a map to the gauge of the minimisers: the first boundary vertex and the direction of the first edge are those on
/// the circle of the perimeter.
fn place(graph: &QuadGraph, mut z: Vec<Complex64>) -> Vec<Complex64> {
    let radius = graph.perimeter() / TAU;
    let ahead = Complex64::cis(graph.boundary_length[0] / radius) - 1.0;
    let [first, second] = [0, 1].map(|k| z[graph.boundary[k] as usize]);
    let turn = ahead / (second - first);
    let turn = turn / turn.norm();
    z.iter_mut().for_each(|z| *z = radius + turn * (*z - first));
    z
}
