//! The normal equations `Zᴴ Aᴴ W A Z y = −Zᴴ Aᴴ W A z0`, solved by sparse Cholesky.
//!
//! With integral weights `Aᴴ W A = D + iK`, where D is real and K involves only boundary vertices.
//! If the whole boundary is pinned, the matrix is real, which takes half the memory and a quarter
//! of the work.

use num_complex::Complex64;

use super::{LinearSolver, SolveError, Unsuitable};
use crate::constraint::Elimination;
use crate::energy::conformal::{self, Weight};
use crate::problem::linear::LinearProblem;
use crate::quad_graph::QuadGraph;
use crate::solver::{Observer, Phase};
use crate::sparse::{Analysis, Pattern, Stencils, pairs_of};

/// Returns the pattern of the normal equations, in which the free vertices of each quad are
/// coupled.
pub(crate) fn pattern(graph: &QuadGraph, elimination: &Elimination) -> Pattern {
    Pattern::new(&[&Stencils::new(&graph.quads)], &elimination.unknown, elimination.unknowns())
}

/// Returns the sum of the quads' 4 × 4 blocks, each symmetric or Hermitian, on the pattern.
pub(crate) fn assemble<T: Copy + std::ops::AddAssign>(
    pattern: &Pattern,
    graph: &QuadGraph,
    elimination: &Elimination,
    zero: T,
    block: impl Fn(usize) -> [[T; 4]; 4],
) -> Vec<T> {
    let mut values = vec![zero; pattern.columns.rows.len()];
    for (q, quad) in graph.quads.iter().enumerate() {
        let block = block(q);
        let unknowns = quad.map(|v| elimination.unknown[v as usize]);
        for (&slot, (i, j)) in pattern.slots(0, q, 4).iter().zip(pairs_of(4)) {
            if slot != Pattern::NONE {
                let (row, column) = if unknowns[i] >= unknowns[j] { (i, j) } else { (j, i) };
                values[slot as usize] += block[row][column];
            }
        }
    }
    values
}

/// Returns the values of D on the pattern.
pub(crate) fn real_values(
    pattern: &Pattern,
    graph: &QuadGraph,
    elimination: &Elimination,
    weights: &[f64],
) -> Vec<f64> {
    assemble(pattern, graph, elimination, 0.0, |q| {
        conformal::block(graph.rho[q], weights[q]).map(|row| row.map(|entry| entry.re))
    })
}

/// Solves from y = 0 with the negative residual of the normal equations, then once more as
/// iterative refinement. `product` computes `Aᴴ W A z`; `correct` overwrites a right-hand side with
/// the solution.
pub(crate) fn solve_and_refine(
    elimination: &Elimination,
    product: impl Fn(&[Complex64]) -> Vec<Complex64>,
    mut correct: impl FnMut(&mut [Complex64]),
) -> Vec<Complex64> {
    let mut z = elimination.z0.clone();
    for _ in 0..2 {
        let product = product(&z);
        let mut y: Vec<Complex64> = elimination.free.iter().map(|&v| product[v as usize]).collect();
        drop(product);
        correct(&mut y);
        for (&v, y) in elimination.free.iter().zip(&y) {
            z[v as usize] -= y;
        }
    }
    z
}

/// Splits complex values into two real columns, lets `solve` overwrite them, and merges them again.
pub(crate) fn in_real_columns(y: &mut [Complex64], solve: impl FnOnce(&mut [f64])) {
    let size = y.len();
    let mut columns = vec![0.0; 2 * size];
    for (k, y) in y.iter().enumerate() {
        (columns[k], columns[size + k]) = (y.re, y.im);
    }
    solve(&mut columns);
    for (k, y) in y.iter_mut().enumerate() {
        *y = Complex64::new(columns[k], columns[size + k]);
    }
}

/// Checks whether the normal equations of `problem` are real.
pub(super) fn real_normal_equations(problem: &LinearProblem) -> Result<(), Unsuitable> {
    if problem.weight != Weight::Integral {
        return Err(Unsuitable::UnitWeights);
    }
    problem.weights()?;
    match problem.graph.boundary.iter().find(|&&v| problem.elimination.is_free(v)) {
        Some(&vertex) => Err(Unsuitable::FreeBoundary { vertex }),
        None => Ok(()),
    }
}

/// Solves `D_II z_I = −D_IB z_B` by one real factorisation.
pub(super) struct RealCholesky;

impl LinearSolver for RealCholesky {
    fn name(&self) -> &'static str {
        "cholesky-real"
    }

    fn description(&self) -> &'static str {
        "real normal equations, sparse Cholesky: integral weights, whole boundary held"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        real_normal_equations(problem)
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        let weights = usable_weights(self, problem)?;
        watch.phase(Phase::Assemble);
        let pattern = pattern(problem.graph, &problem.elimination);
        let values = real_values(&pattern, problem.graph, &problem.elimination, &weights);
        watch.phase(Phase::Factor);
        let broken = |reason| SolveError::broken(self, problem, reason);
        let analysis = Analysis::ordered(&pattern.columns, problem.elimination.order).map_err(broken)?;
        let factor = analysis.factorise(&values, None).map_err(broken)?;
        watch.phase(Phase::Solve);
        let product = |z: &[Complex64]| conformal::normal_product(problem.graph, &weights, z);
        Ok(solve_and_refine(&problem.elimination, product, |y| in_real_columns(y, |c| factor.solve_in_place(c))))
    }
}

/// Solves with the complex Hermitian matrix `Aᴴ W A`, for unit weights or free boundary vertices.
pub(super) struct HermitianCholesky;

impl LinearSolver for HermitianCholesky {
    fn name(&self) -> &'static str {
        "cholesky"
    }

    fn description(&self) -> &'static str {
        "complex Hermitian normal equations, sparse Cholesky: either weight, any vertices held"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        problem.weights()?;
        Ok(())
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        let weights = usable_weights(self, problem)?;
        watch.phase(Phase::Assemble);
        let LinearProblem { graph, elimination, .. } = problem;
        let pattern = pattern(graph, elimination);
        let values =
            assemble(&pattern, graph, elimination, Complex64::ZERO, |q| conformal::block(graph.rho[q], weights[q]));
        watch.phase(Phase::Factor);
        let broken = |reason| SolveError::broken(self, problem, reason);
        let analysis = Analysis::ordered(&pattern.columns, problem.elimination.order).map_err(broken)?;
        let factor = analysis.factorise(&values, None).map_err(broken)?;
        watch.phase(Phase::Solve);
        let product = |z: &[Complex64]| conformal::normal_product(graph, &weights, z);
        Ok(solve_and_refine(elimination, product, |y| factor.solve_in_place(y)))
    }
}

/// Returns the weights, or the error of the solver `backend`.
pub(super) fn usable_weights(backend: &dyn LinearSolver, problem: &LinearProblem) -> Result<Vec<f64>, SolveError> {
    problem.weights().map_err(|reason| SolveError::Unsuitable { backend: backend.name(), reason: reason.into() })
}
