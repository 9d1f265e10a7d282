//! Iterative minimisers of an [`Objective`], all run by argmin's executor with one stopping rule. A
//! new minimiser is one file and one row of [`MINIMISERS`].

mod cg_exact;
mod executor;
mod first_order;
mod lbfgs_preconditioned;
mod levenberg_marquardt;
mod newton;
mod spectrum;

pub use levenberg_marquardt::LevenbergMarquardt;
pub use newton::Newton;
pub use spectrum::smallest_singular_value;

use super::Observer;
use crate::problem::nonlinear::Objective;
use crate::sparse::Breakdown;

/// A solver of nonlinear problems.
pub trait Minimiser: Send + Sync {
    /// The name, as used in options and in the report.
    fn name(&self) -> &'static str;

    /// A description of one line.
    fn description(&self) -> &'static str;

    /// Default for the largest number of iterations.
    fn default_max_iterations(&self) -> usize {
        executor::IterationLimits::FIRST_ORDER.max_iterations
    }

    /// Finds a local minimum of `objective` near `start` (`m`).
    ///
    /// # Errors
    /// The energy is not finite at the start, or a matrix cannot be factorised.
    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError>;
}

/// The table of all minimisers; `auto` uses the first.
pub static MINIMISERS: &[&dyn Minimiser] = &[
    &LevenbergMarquardt::AUTO,
    &Newton::ROW,
    &lbfgs_preconditioned::LbfgsPreconditioned,
    &cg_exact::CgExact,
    &first_order::FLETCHER_REEVES,
    &first_order::POLAK_RIBIERE,
    &first_order::LBFGS_ROW,
];

/// Returns the minimiser with this name.
pub fn minimiser(name: &str) -> Option<&'static dyn Minimiser> {
    MINIMISERS.iter().copied().find(|m| m.name() == name)
}

/// The stopping rule, common to all minimisers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopRule {
    /// A minimisation has converged if |∇E| ≤ tolerance × reference.
    pub tolerance: f64,
    /// The reference for |∇E|; `None` for its value at the start.
    pub reference: Option<f64>,
    /// Largest number of iterations; `None` for the minimiser's default.
    pub max_iterations: Option<usize>,
}

impl Default for StopRule {
    fn default() -> Self {
        StopRule { tolerance: 1e-10, reference: None, max_iterations: None }
    }
}

/// The way in which a minimisation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// ∇E| is below the tolerance, or the predicted decrease is below the limit of the solver.
    Converged,
    /// Rounding prevents a further decrease before the tolerance is reached.
    Precision,
    /// The largest number of iterations was reached.
    MaxIterations,
    /// A stop was requested.
    Interrupted,
}

impl Status {
    /// The name used in reports.
    pub fn name(self) -> &'static str {
        match self {
            Status::Converged => "converged",
            Status::Precision => "precision",
            Status::MaxIterations => "max-iterations",
            Status::Interrupted => "interrupted",
        }
    }
}

/// The result of a minimisation; check `status` before use.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// The unknowns (`m`).
    pub y: Vec<f64>,
    /// E(y).
    pub value: f64,
    /// |∇E(y)|, Euclidean.
    pub gradient_norm: f64,
    /// The reference for |∇E|.
    pub reference: f64,
    /// Number of iterations.
    pub iterations: usize,
    /// The reason for stopping.
    pub status: Status,
}

impl Minimum {
    /// |∇E| relative to the reference.
    pub fn reduction(&self) -> f64 {
        if self.gradient_norm == 0.0 { 0.0 } else { self.gradient_norm / self.reference }
    }
}

impl MinimiseError {
    /// Returns a function that makes the error of `backend` for a Hessian that cannot be
    /// factorised.
    fn factorisation(backend: &dyn Minimiser, unknowns: usize) -> impl Fn(Breakdown) -> MinimiseError + use<> {
        let backend = backend.name();
        move |reason| MinimiseError::Factorisation { backend, unknowns, reason }
    }
}

/// A minimisation is not possible.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MinimiseError {
    /// Energy or gradient are not finite at the start.
    #[error(
        "the energy of the initial map is not finite: coordinates or coefficients are beyond the range of double precision"
    )]
    StartNotFinite,
    /// The factorisation failed.
    #[error("backend `{backend}`: the Hessian of {unknowns} unknowns cannot be factorised: {reason}")]
    Factorisation {
        /// Name of the solver.
        backend: &'static str,
        /// Number of real unknowns.
        unknowns: usize,
        /// The reason.
        reason: Breakdown,
    },
    /// An error of argmin.
    #[error("backend `{backend}` failed: {message}")]
    Solver {
        /// Name of the solver.
        backend: &'static str,
        /// argmin's message.
        message: String,
    },
}
