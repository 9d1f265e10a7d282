//! Iterative minimisers of an [`Objective`], all run by argmin's executor under one stopping rule. A new one is one file
//! and one row of [`MINIMISERS`].

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
pub trait Minimiser: Sync {
    /// Name for `--solver` and the report.
    fn name(&self) -> &'static str;

    /// One line for `riemap list`.
    fn description(&self) -> &'static str;

    /// Iterations after which it gives up, unless told otherwise.
    fn default_max_iterations(&self) -> usize {
        executor::Limits::FIRST_ORDER.max_iterations
    }

    /// A local minimum of `objective` near `start` (`m`).
    ///
    /// # Errors
    /// A start at which the energy is not finite; a matrix that cannot be factorised.
    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError>;
}

/// All iterative backends by name; `auto` takes the first.
pub static MINIMISERS: &[&dyn Minimiser] = &[
    &LevenbergMarquardt::AUTO,
    &Newton::ROW,
    &lbfgs_preconditioned::LbfgsPreconditioned,
    &cg_exact::CgExact,
    &first_order::FLETCHER_REEVES,
    &first_order::POLAK_RIBIERE,
    &first_order::LBFGS_ROW,
];

/// The iterative backend of that name.
pub fn minimiser(name: &str) -> Option<&'static dyn Minimiser> {
    MINIMISERS.iter().copied().find(|m| m.name() == name)
}

/// When to stop; means the same to all minimisers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StopRule {
    /// Converged when |∇E| ≤ tolerance × reference.
    pub tolerance: f64,
    /// What |∇E| is compared with; `None`: its value at the start.
    pub reference: Option<f64>,
    /// Iterations at most; `None`: the minimiser's own default.
    pub max_iterations: Option<usize>,
}

impl Default for StopRule {
    fn default() -> Self {
        StopRule { tolerance: 1e-10, reference: None, max_iterations: None }
    }
}

/// How a minimisation ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// |∇E| is below the tolerance, or what a step may still gain below the one that a solver has for that.
    Converged,
    /// Rounding keeps the energy from falling further, short of the tolerance.
    Precision,
    /// The iterations are used up.
    MaxIterations,
    /// A stop was requested.
    Interrupted,
}

impl Status {
    /// As in reports.
    pub fn name(self) -> &'static str {
        match self {
            Status::Converged => "converged",
            Status::Precision => "precision",
            Status::MaxIterations => "max-iterations",
            Status::Interrupted => "interrupted",
        }
    }
}

/// Where a minimisation ended: the caller must look at `status`.
#[derive(Clone, Debug, PartialEq)]
pub struct Minimum {
    /// The unknowns (`m`).
    pub y: Vec<f64>,
    /// E(y).
    pub value: f64,
    /// |∇E(y)|, Euclidean.
    pub gradient_norm: f64,
    /// What |∇E| was compared with.
    pub reference: f64,
    /// Iterations made.
    pub iterations: usize,
    /// Why it stopped.
    pub status: Status,
}

impl Minimum {
    /// |∇E| relative to the reference.
    pub fn reduction(&self) -> f64 {
        if self.gradient_norm == 0.0 { 0.0 } else { self.gradient_norm / self.reference }
    }
}

impl MinimiseError {
    /// What `backend` says of a Hessian of so many unknowns that has no factor.
    fn factorisation(backend: &dyn Minimiser, unknowns: usize) -> impl Fn(Breakdown) -> MinimiseError + use<> {
        let backend = backend.name();
        move |reason| MinimiseError::Factorisation { backend, unknowns, reason }
    }
}

/// A minimisation could not be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MinimiseError {
    /// Energy or gradient of the start are not finite.
    #[error("the energy of the initial map is not finite: coordinates or coefficients are beyond the range of doubles")]
    StartNotFinite,
    /// The factor does not fit.
    #[error("backend `{backend}`: the Hessian of {unknowns} unknowns cannot be factorised: {reason}")]
    Factorisation {
        /// Its name.
        backend: &'static str,
        /// Real unknowns.
        unknowns: usize,
        /// Why.
        reason: Breakdown,
    },
    /// An error of argmin's own.
    #[error("backend `{backend}` failed: {message}")]
    Solver {
        /// Its name.
        backend: &'static str,
        /// What it said.
        message: String,
    },
}
