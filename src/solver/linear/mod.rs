//! Direct solvers. A new one is one file and one row of [`LINEAR_SOLVERS`].

mod cotan;
mod laplacian;
mod lu;
mod nalgebra_cholesky;
pub(super) mod normal;
pub mod periodic;
mod qr;

pub(crate) use laplacian::Factored;

use num_complex::Complex64;

use super::Observer;
use crate::energy::conformal::NonPositiveRho;
use crate::problem::linear::LinearProblem;
use crate::sparse::Breakdown;

/// A direct solver of [`LinearProblem`]s.
pub trait LinearSolver: Send + Sync {
    /// The name, as used in options and in the report.
    fn name(&self) -> &'static str;

    /// A description of one line.
    fn description(&self) -> &'static str;

    /// Checks whether the solver solves this problem exactly.
    ///
    /// # Errors
    /// The reason why it does not.
    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable>;

    /// Computes the map z (`nv`), including pinned vertices, up to rounding. `watch` is notified of
    /// each phase.
    ///
    /// # Errors
    /// The problem is unsuitable, or the factorisation broke down.
    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError>;
}

/// The table of all direct solvers.
pub static LINEAR_SOLVERS: &[&dyn LinearSolver] = &[
    &cotan::Cotan,
    &laplacian::Laplacian,
    &normal::RealCholesky,
    &normal::HermitianCholesky,
    &lu::Lu,
    &qr::Qr,
    &nalgebra_cholesky::NalgebraCholesky,
];

/// Returns the direct solver with this name.
pub fn linear_solver(name: &str) -> Option<&'static dyn LinearSolver> {
    LINEAR_SOLVERS.iter().copied().find(|b| b.name() == name)
}

/// The solution of a linear problem and its residual.
#[derive(Clone, Debug)]
pub struct LinearSolution {
    /// The map (`nv`).
    pub z: Vec<Complex64>,
    /// Name of the solver that found it.
    pub backend: &'static str,
    /// [`LinearProblem::residual`] of z; without usable weights, that of (2).
    pub residual: f64,
}

/// A solver is not suitable for a problem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unsuitable {
    /// The system does not have as many equations as unknowns.
    #[error(
        "system (2) has {equations} equations for {unknowns} unknowns and this backend needs as many: those of the mesh's \
         boundary and one dual vertex held"
    )]
    NotSquare {
        /// Number of quads.
        equations: usize,
        /// Number of free vertices.
        unknowns: usize,
    },
    /// A boundary vertex is free.
    #[error("boundary vertex {vertex} is free, and the normal equations are real only where all are held")]
    FreeBoundary {
        /// The first such vertex of the quad graph.
        vertex: u32,
    },
    /// The weights are unit weights, and integral ones are needed.
    #[error("the normal equations are real only with integral weights")]
    UnitWeights,
    /// The weights are not defined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// Some ρ is not real.
    #[error(
        "quad {quad} has Im ρ = {im_rho:e}, and the cotan Laplacian needs diagonals at right angles, those of circumcentres"
    )]
    NotOrthogonal {
        /// The first such quad.
        quad: usize,
        /// Its Im ρ.
        im_rho: f64,
    },
    /// The pinned vertices are not all black boundary vertices and one white vertex.
    #[error("the conformal Laplacian needs all boundary vertices of the mesh held, no other, and one dual vertex")]
    NotPrimal,
}

/// A linear problem was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The solver is not suitable for this problem.
    #[error("backend `{backend}`: {reason}")]
    Unsuitable {
        /// Name of the solver.
        backend: &'static str,
        /// The reason.
        reason: Unsuitable,
    },
    /// No solver has this name.
    #[error("`{name}` does not solve linear problems; those that do: auto, {known}")]
    Unknown {
        /// The requested name.
        name: String,
        /// The known names.
        known: String,
    },
    /// A pivot of a Cholesky factorisation is not positive.
    #[error(
        "backend `{backend}`: the matrix is not positive definite to rounding ({size} unknowns); the mesh has \
         nearly degenerate faces, or too little is held"
    )]
    NotPositiveDefinite {
        /// Name of the solver.
        backend: &'static str,
        /// Number of unknowns.
        size: usize,
    },
    /// The matrix is singular.
    #[error("backend `{backend}`: the matrix of {size} unknowns is singular: other vertices must be held")]
    Singular {
        /// Name of the solver.
        backend: &'static str,
        /// Number of unknowns.
        size: usize,
    },
    /// The factor does not fit into memory or its indices.
    #[error("backend `{backend}`: the factor of {size} unknowns does not fit into memory or its indices")]
    TooLarge {
        /// Name of the solver.
        backend: &'static str,
        /// Number of unknowns.
        size: usize,
    },
    /// The residual of the solution is too large.
    #[error(
        "backend `{backend}` left a relative residual of {residual:e}, above {limit:e}: the problem is too badly \
         conditioned for it"
    )]
    Inaccurate {
        /// Name of the solver.
        backend: &'static str,
        /// The relative residual.
        residual: f64,
        /// The largest accepted residual.
        limit: f64,
    },
}

impl SolveError {
    /// Whether rounding is the cause of the failure: the matrix is numerically close to singular.
    pub fn is_of_rounding(&self) -> bool {
        matches!(
            self,
            SolveError::NotPositiveDefinite { .. } | SolveError::Singular { .. } | SolveError::Inaccurate { .. }
        )
    }

    /// Converts the failure of a factorisation.
    fn broken(backend: &dyn LinearSolver, problem: &LinearProblem, reason: Breakdown) -> Self {
        let (backend, size) = (backend.name(), problem.elimination.unknowns());
        match reason {
            Breakdown::NotPositiveDefinite => SolveError::NotPositiveDefinite { backend, size },
            Breakdown::Singular => SolveError::Singular { backend, size },
            Breakdown::TooLarge => SolveError::TooLarge { backend, size },
        }
    }
}

/// The largest accepted relative residual of a solution.
pub(super) const ACCEPTED_RESIDUAL: f64 = 1e-8;

/// Solves `problem` by the solver with this name and checks the solution; for `auto` see
/// [`automatic`].
///
/// # Errors
/// An unknown or unsuitable solver, a breakdown, or a residual above 1e-8.
pub fn solve_linear(
    problem: &LinearProblem,
    solver: &str,
    watch: &mut dyn Observer,
) -> Result<LinearSolution, SolveError> {
    if solver != "auto" {
        let backend = linear_solver(solver).ok_or_else(|| SolveError::Unknown {
            name: solver.to_owned(),
            known: LINEAR_SOLVERS.iter().map(|b| b.name()).collect::<Vec<_>>().join(", "),
        })?;
        return solve_with(backend, problem, watch);
    }
    let mut last = None;
    for &backend in automatic(problem) {
        match solve_with(backend, problem, watch) {
            Ok(solution) => return Ok(solution),
            // After a breakdown the next solver is tried; an unsuitable problem is an error.
            Err(unsuitable @ SolveError::Unsuitable { .. }) => return Err(last.unwrap_or(unsuitable)),
            Err(error) => last = Some(error),
        }
    }
    Err(last.unwrap_or(SolveError::Singular { backend: "auto", size: problem.elimination.unknowns() }))
}

/// The solvers that are exact for `problem`, the fastest first; later ones are used if earlier ones
/// break down.
///
/// If (2) is square, this is the conformal Laplacian if the mesh's boundary is pinned (real if ρ
/// is), otherwise LU. For least squares it is Cholesky of the normal equations, real if they are,
/// otherwise Hermitian, and finally QR, which does not square the condition number.
pub fn automatic(problem: &LinearProblem) -> &'static [&'static dyn LinearSolver] {
    if cotan::Cotan.suits(problem).is_ok() {
        &[&cotan::Cotan, &lu::Lu]
    } else if laplacian::Laplacian.suits(problem).is_ok() {
        &[&laplacian::Laplacian, &lu::Lu, &qr::Qr]
    } else if problem.is_square() {
        &[&lu::Lu, &qr::Qr]
    } else if normal::RealCholesky.suits(problem).is_ok() {
        &[&normal::RealCholesky, &qr::Qr]
    } else {
        &[&normal::HermitianCholesky, &qr::Qr]
    }
}

/// Solves `problem` by the given solver and checks the solution.
///
/// # Errors
/// An unsuitable problem, a breakdown, or a residual above 1e-8.
pub fn solve_with(
    backend: &dyn LinearSolver,
    problem: &LinearProblem,
    watch: &mut dyn Observer,
) -> Result<LinearSolution, SolveError> {
    let unsuitable = |reason| SolveError::Unsuitable { backend: backend.name(), reason };
    backend.suits(problem).map_err(unsuitable)?;
    let z = backend.solve(problem, watch)?;
    let residual = problem.residual(&z).map_err(|e| unsuitable(e.into()))?;
    if residual.is_nan() || residual > ACCEPTED_RESIDUAL {
        return Err(SolveError::Inaccurate { backend: backend.name(), residual, limit: ACCEPTED_RESIDUAL });
    }
    Ok(LinearSolution { z, backend: backend.name(), residual })
}
