//! Direct solvers. A new one is one file and one row of [`LINEAR_SOLVERS`].

mod cotan;
mod laplacian;
mod lu;
mod nalgebra_cholesky;
pub(super) mod normal;
pub mod periodic;
mod qr;

use num_complex::Complex64;

use super::Observer;
use crate::energy::conformal::NonPositiveRho;
use crate::problem::linear::LinearProblem;
use crate::sparse::Breakdown;

/// A direct solver of [`LinearProblem`]s.
pub trait LinearSolver: Sync {
    /// Name for `--solver` and the report.
    fn name(&self) -> &'static str;

    /// One line for `riemap list`.
    fn description(&self) -> &'static str;

    /// Whether the backend solves this problem exactly.
    ///
    /// # Errors
    /// Why it does not.
    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable>;

    /// The map z (`nv`), held vertices included, to rounding. `watch` is told when a phase begins.
    ///
    /// # Errors
    /// A problem that does not suit, or a factorisation that broke down.
    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError>;
}

/// All direct backends by name.
pub static LINEAR_SOLVERS: &[&dyn LinearSolver] = &[
    &cotan::Cotan,
    &laplacian::Laplacian,
    &normal::RealCholesky,
    &normal::HermitianCholesky,
    &lu::Lu,
    &qr::Qr,
    &nalgebra_cholesky::NalgebraCholesky,
];

/// The direct backend of that name.
pub fn linear_solver(name: &str) -> Option<&'static dyn LinearSolver> {
    LINEAR_SOLVERS.iter().copied().find(|b| b.name() == name)
}

/// A linear solution and how good it is.
#[derive(Clone, Debug)]
pub struct LinearSolution {
    /// The map (`nv`).
    pub z: Vec<Complex64>,
    /// The backend that found it.
    pub backend: &'static str,
    /// [`LinearProblem::residual`] of z, or with no usable weights that of (2).
    pub residual: f64,
}

/// Why a backend does not take a problem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unsuitable {
    /// The system has more equations than unknowns, or fewer.
    #[error(
        "system (2) has {equations} equations for {unknowns} unknowns and this backend needs as many: those of the mesh's \
         boundary and one dual vertex held"
    )]
    NotSquare {
        /// Quads.
        equations: usize,
        /// Free vertices.
        unknowns: usize,
    },
    /// Boundary vertices are free.
    #[error("boundary vertex {vertex} is free, and the normal equations are real only where all are held")]
    FreeBoundary {
        /// The first such vertex of the quad graph.
        vertex: u32,
    },
    /// Unit weights where integral ones are needed.
    #[error("the normal equations are real with integral weights alone")]
    UnitWeights,
    /// No usable weights.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// A ρ that is not real.
    #[error(
        "quad {quad} has Im ρ = {im_rho:e}, and the cotan Laplacian needs diagonals at right angles, those of circumcentres"
    )]
    NotOrthogonal {
        /// The first such quad.
        quad: usize,
        /// Its Im ρ.
        im_rho: f64,
    },
    /// The held vertices are not all black boundary vertices and one white vertex.
    #[error("the conformal Laplacian needs all boundary vertices of the mesh held, no other, and one dual vertex")]
    NotPrimal,
}

/// A linear problem was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The backend does not take this problem.
    #[error("backend `{backend}`: {reason}")]
    Unsuitable {
        /// Its name.
        backend: &'static str,
        /// Why.
        reason: Unsuitable,
    },
    /// No such backend.
    #[error("`{name}` does not solve linear problems; those that do: auto, {known}")]
    Unknown {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A pivot of a Cholesky factorisation is not positive.
    #[error(
        "backend `{backend}`: the matrix is not positive definite to rounding ({size} unknowns); the mesh has \
         nearly degenerate faces, or too little is held"
    )]
    NotPositiveDefinite {
        /// Its name.
        backend: &'static str,
        /// Unknowns.
        size: usize,
    },
    /// The matrix has no inverse.
    #[error("backend `{backend}`: the matrix of {size} unknowns is singular: other vertices must be held")]
    Singular {
        /// Its name.
        backend: &'static str,
        /// Unknowns.
        size: usize,
    },
    /// The factor does not fit.
    #[error("backend `{backend}`: the factor of {size} unknowns does not fit into memory or its indices")]
    TooLarge {
        /// Its name.
        backend: &'static str,
        /// Unknowns.
        size: usize,
    },
    /// The solution is not one.
    #[error(
        "backend `{backend}` left a relative residual of {residual:e}, above {limit:e}: the problem is too badly \
         conditioned for it"
    )]
    Inaccurate {
        /// Its name.
        backend: &'static str,
        /// What it reached.
        residual: f64,
        /// What is accepted.
        limit: f64,
    },
}

impl SolveError {
    /// Whether rounding alone stands against the solution: a matrix too near to one without inverse.
    pub fn is_of_rounding(&self) -> bool {
        matches!(
            self,
            SolveError::NotPositiveDefinite { .. } | SolveError::Singular { .. } | SolveError::Inaccurate { .. }
        )
    }

    /// What a failed Cholesky factorisation means to the user.
    fn broken(backend: &dyn LinearSolver, problem: &LinearProblem, reason: Breakdown) -> Self {
        let (backend, size) = (backend.name(), problem.elimination.unknowns());
        match reason {
            Breakdown::NotPositiveDefinite => SolveError::NotPositiveDefinite { backend, size },
            Breakdown::Singular => SolveError::Singular { backend, size },
            Breakdown::TooLarge => SolveError::TooLarge { backend, size },
        }
    }
}

/// The largest relative residual that passes for a solution.
pub(super) const ACCEPTED_RESIDUAL: f64 = 1e-8;

/// Solves `problem` by the backend of that name, and checks the solution; `auto`: see [`automatic`].
///
/// # Errors
/// An unknown or unsuitable backend, a breakdown, a residual above 1e-8.
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
            // A breakdown of the fast one is no answer yet; an unsuitable problem is.
            Err(unsuitable @ SolveError::Unsuitable { .. }) => return Err(last.unwrap_or(unsuitable)),
            Err(error) => last = Some(error),
        }
    }
    Err(last.unwrap_or(SolveError::Singular { backend: "auto", size: problem.elimination.unknowns() }))
}

/// The backends that are exact for `problem`, the fastest first; each later one is for where those before break down.
///
/// Square: the conformal Laplacian where the mesh's boundary is held, real where ρ is; else LU. Least squares: Cholesky of
/// the normal equations, real where they are, else Hermitian; QR, which does not square the condition number, last.
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

/// Solves `problem` by this backend, and checks the solution.
///
/// # Errors
/// A problem that does not suit, a breakdown, a residual above 1e-8.
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
