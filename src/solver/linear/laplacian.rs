use std::sync::Arc;

use num_complex::Complex64;

use super::{LinearSolver, SolveError, Unsuitable};
use crate::laplacian::{Colouring, ConformalLaplacian, LaplacianError, Ordered};
use crate::problem::linear::LinearProblem;
use crate::quad_graph::QuadGraph;
use crate::solver::{Observer, Phase};
use crate::sparse::Breakdown;

/// Solves the square system (2) on half of the vertices.
///
/// The black vertices, whose boundary vertices are pinned, satisfy `L_II z_I = −L_IB z_B`. The
/// white ones follow by summing `z_f − z_g = iρ (z_j − z_i)` from the pinned one.
pub(super) struct Laplacian;

impl LinearSolver for Laplacian {
    fn name(&self) -> &'static str {
        "laplacian"
    }

    fn description(&self) -> &'static str {
        "conformal Laplacian, complex symmetric, on half of the vertices: mesh boundary and one dual vertex held, any ρ"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        match problem.is_square() && problem.graph.loops.len() == 1 && held(problem).is_some() {
            true => Ok(()),
            false => Err(Unsuitable::NotPrimal),
        }
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        solve(self, problem, watch)
    }
}

/// Solves (2) by the conformal Laplacian, on behalf of the solver `backend`.
pub(super) fn solve(
    backend: &dyn LinearSolver,
    problem: &LinearProblem,
    watch: &mut dyn Observer,
) -> Result<Vec<Complex64>, SolveError> {
    watch.phase(Phase::Assemble);
    let unsuitable = SolveError::Unsuitable { backend: backend.name(), reason: Unsuitable::NotPrimal };
    let Some((colouring, white)) = held(problem) else { return Err(unsuitable) };
    let (graph, z0) = (problem.graph, &problem.elimination.z0);
    watch.phase(Phase::Order);
    let ordered = Ordered::new(graph, colouring);
    watch.phase(Phase::Assemble);
    let laplacian = ordered.and_then(|ordered| ordered.factorise(graph, 0, || watch.phase(Phase::Factor)));
    let laplacian = laplacian.map_err(|error| match error {
        LaplacianError::Factorisation { unknowns, reason: Breakdown::TooLarge } => {
            SolveError::TooLarge { backend: backend.name(), size: unknowns }
        }
        LaplacianError::Factorisation { unknowns, .. } => {
            SolveError::Singular { backend: backend.name(), size: unknowns }
        }
        LaplacianError::NotTwoColoured { .. } | LaplacianError::NotAlternating { .. } => unsuitable,
    })?;
    watch.phase(Phase::Solve);
    Ok(extension(&laplacian, graph, z0, white))
}

/// The map with the black boundary values, and the value of one white vertex, that `z0` has.
fn extension(laplacian: &ConformalLaplacian, graph: &QuadGraph, z0: &[Complex64], white: u32) -> Vec<Complex64> {
    let b: Vec<Complex64> = laplacian.black_boundary().iter().map(|&v| z0[v as usize]).collect();
    let mut z = laplacian.extend_black(graph, &b, &mut laplacian.work());
    z[white as usize] = z0[white as usize];
    laplacian.add_up(graph, white, &mut z);
    z
}

/// As [`Laplacian`], by a factor that is there already.
pub(crate) struct Factored(pub Arc<ConformalLaplacian>);

impl LinearSolver for Factored {
    fn name(&self) -> &'static str {
        Laplacian.name()
    }

    fn description(&self) -> &'static str {
        Laplacian.description()
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        Laplacian.suits(problem)?;
        match held(problem) {
            Some((colouring, _)) if colouring == *self.0.colouring() => Ok(()),
            _ => Err(Unsuitable::NotPrimal),
        }
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        let Some((_, white)) = held(problem) else {
            return Err(SolveError::Unsuitable { backend: self.name(), reason: Unsuitable::NotPrimal });
        };
        watch.phase(Phase::Solve);
        Ok(extension(&self.0, problem.graph, &problem.elimination.z0, white))
    }
}

/// Returns colours for which all black boundary vertices are pinned, and the only pinned white
/// vertex; `None` if the constraints have a different form.
fn held(problem: &LinearProblem) -> Option<(Colouring, u32)> {
    let (graph, elimination) = (problem.graph, &problem.elimination);
    let colouring = Colouring::new(graph).ok()?;
    [colouring.clone(), colouring.exchanged()].into_iter().find_map(|colouring| {
        let mut on_boundary = graph.boundary.iter().filter(|&&v| colouring.is_black(v));
        let is_held = on_boundary.all(|&v| !elimination.is_free(v));
        let mut white = (0..graph.vertices as u32).filter(|&v| !elimination.is_free(v) && !colouring.is_black(v));
        let first = white.next()?;
        (is_held && white.next().is_none()).then_some((colouring, first))
    })
}
