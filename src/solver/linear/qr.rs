use faer::Mat;
use faer::linalg::solvers::SolveLstsq;
use faer::sparse::linalg::solvers::{Qr as SparseQr, SymbolicQr};
use num_complex::Complex64;

use super::normal::usable_weights;
use super::{LinearSolver, SolveError, Unsuitable};
use crate::problem::linear::LinearProblem;
use crate::solver::{Observer, Phase};
use crate::sparse::interop::faer_view;

/// Solves `W^½ A Z y = −W^½ A z0` in least squares by sparse QR, which does not square the
/// condition number.
pub(super) struct Qr;

impl LinearSolver for Qr {
    fn name(&self) -> &'static str {
        "qr"
    }

    fn description(&self) -> &'static str {
        "system (2) in least squares, sparse QR: either weight, any vertices held; slow and robust"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        problem.weights()?;
        Ok(())
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        watch.phase(Phase::Assemble);
        let (mut matrix, mut right) = problem.reduced_system();
        let root: Vec<f64> = usable_weights(self, problem)?.into_iter().map(f64::sqrt).collect();
        for (q, _, entry) in matrix.triplet_iter_mut() {
            *entry *= root[q];
        }
        for (right, root) in right.iter_mut().zip(&root) {
            *right *= root;
        }
        let matrix = faer_view(&matrix);
        let size = problem.elimination.unknowns();
        watch.phase(Phase::Factor);
        let too_large = SolveError::TooLarge { backend: self.name(), size };
        let symbolic = SymbolicQr::try_new(matrix.symbolic()).map_err(|_| too_large.clone())?;
        let factor = SparseQr::try_new_with_symbolic(symbolic, matrix).map_err(|_| too_large)?;
        watch.phase(Phase::Solve);
        let right = Mat::from_fn(right.len(), 1, |q, _| right[q]);
        let y = factor.solve_lstsq(&right);
        Ok(problem.elimination.expand(&(0..size).map(|k| y[(k, 0)]).collect::<Vec<_>>()))
    }
}
