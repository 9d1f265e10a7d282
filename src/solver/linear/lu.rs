use faer::linalg::solvers::Solve;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::solvers::{Lu as SparseLu, SymbolicLu};
use faer::{Col, ColRef};
use num_complex::Complex64;

use super::{LinearSolver, SolveError, Unsuitable};
use crate::problem::linear::LinearProblem;
use crate::solver::{Observer, Phase};
use crate::sparse::interop::faer_view;

/// Solves the square system (2) by sparse LU with partial pivoting, for any sign of Re ρ.
pub(super) struct Lu;

impl LinearSolver for Lu {
    fn name(&self) -> &'static str {
        "lu"
    }

    fn description(&self) -> &'static str {
        "the square complex system (2), sparse LU: mesh boundary and one dual vertex held, any ρ"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        match (problem.graph.quads.len(), problem.elimination.unknowns()) {
            (equations, unknowns) if equations != unknowns => Err(Unsuitable::NotSquare { equations, unknowns }),
            _ => Ok(()),
        }
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        watch.phase(Phase::Assemble);
        let (matrix, right) = problem.reduced_system();
        let matrix = faer_view(&matrix);
        let size = right.len();
        watch.phase(Phase::Factor);
        let too_large = SolveError::TooLarge { backend: self.name(), size };
        let symbolic = SymbolicLu::try_new(matrix.symbolic()).map_err(|_| too_large.clone())?;
        let factor = SparseLu::try_new_with_symbolic(symbolic, matrix).map_err(|error| match error {
            LuError::SymbolicSingular { .. } => SolveError::Singular { backend: self.name(), size },
            LuError::Generic(_) => too_large,
        })?;
        watch.phase(Phase::Solve);
        let mut y = factor.solve(ColRef::from_slice(&right));
        // One step of iterative refinement: y += (A Z)⁻¹ (b − A Z y).
        let defect: Col<Complex64> = ColRef::from_slice(&right) - matrix * &y;
        y += factor.solve(&defect);
        Ok(problem.elimination.expand(&y.iter().copied().collect::<Vec<_>>()))
    }
}
