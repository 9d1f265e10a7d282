use nalgebra::DMatrix;
use nalgebra_sparse::factorization::CscCholesky;
use nalgebra_sparse::{CooMatrix, CscMatrix};
use num_complex::Complex64;

use super::normal::{in_real_columns, pattern, real_normal_equations, real_values, solve_and_refine, usable_weights};
use super::{LinearSolver, SolveError, Unsuitable};
use crate::energy::conformal;
use crate::problem::linear::LinearProblem;
use crate::solver::{Observer, Phase};

/// Solves the real normal equations by the Cholesky factorisation of nalgebra-sparse, for
/// comparison; it has no fill-reducing ordering.
pub(super) struct NalgebraCholesky;

impl LinearSolver for NalgebraCholesky {
    fn name(&self) -> &'static str {
        "nalgebra-cholesky"
    }

    fn description(&self) -> &'static str {
        "as cholesky-real, by nalgebra-sparse without fill-reducing ordering: to compare with"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        real_normal_equations(problem)
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        let weights = usable_weights(self, problem)?;
        watch.phase(Phase::Assemble);
        let pattern = pattern(problem.graph, &problem.elimination);
        let size = pattern.size();
        let values = real_values(&pattern, problem.graph, &problem.elimination, &weights);
        // Its analysis needs both triangles.
        let mut both = CooMatrix::new(size, size);
        for column in 0..size {
            for k in pattern.columns.entries(column) {
                let row = pattern.columns.rows[k] as usize;
                both.push(row, column, values[k]);
                if row != column {
                    both.push(column, row, values[k]);
                }
            }
        }
        watch.phase(Phase::Factor);
        let factor = CscCholesky::factor(&CscMatrix::from(&both))
            .map_err(|_| SolveError::NotPositiveDefinite { backend: self.name(), size })?;
        watch.phase(Phase::Solve);
        let product = |z: &[Complex64]| conformal::normal_product(problem.graph, &weights, z);
        Ok(solve_and_refine(&problem.elimination, product, |y| {
            in_real_columns(y, |columns| {
                let mut right = DMatrix::from_column_slice(size, 2, columns);
                factor.solve_mut(&mut right);
                columns.copy_from_slice(right.as_slice());
            });
        }))
    }
}
