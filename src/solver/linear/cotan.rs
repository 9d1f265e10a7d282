use num_complex::Complex64;

use super::laplacian::{Laplacian, solve};
use super::{LinearSolver, SolveError, Unsuitable};
use crate::problem::linear::LinearProblem;
use crate::solver::Observer;

/// The [conformal Laplacian](Laplacian) if every ρ is real: the black vertices carry a harmonic map
/// for the Laplacian with edge weights ρ (for circumcentres the cotan weights), the white ones its
/// conjugate.
///
/// Re ρ can have any sign: the Laplacian of a triangle mesh is positive definite for all signs of
/// its weights.
pub(super) struct Cotan;

impl LinearSolver for Cotan {
    fn name(&self) -> &'static str {
        "cotan"
    }

    fn description(&self) -> &'static str {
        "real cotan Laplacian, sparse Cholesky: circumcentres, mesh boundary and one dual vertex held"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        let graph = problem.graph;
        if let Some(quad) = graph.rho.iter().position(|rho| rho.im != 0.0) {
            return Err(Unsuitable::NotOrthogonal { quad, im_rho: graph.rho[quad].im });
        }
        Laplacian.suits(problem)
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        solve(self, problem, watch)
    }
}
