//! argmin's first-order solvers, for comparison: nonlinear conjugate gradients, as in the paper,
//! and L-BFGS.

use argmin::core::Error;
use argmin::solver::conjugategradient::NonlinearConjugateGradient;
use argmin::solver::conjugategradient::beta::{FletcherReeves as BetaFr, PolakRibierePlus as BetaPr};
use argmin::solver::linesearch::MoreThuenteLineSearch;
use argmin::solver::quasinewton::LBFGS;

use super::executor::{IterationLimits, run};
use super::{MinimiseError, Minimiser, Minimum, StopRule};
use crate::problem::nonlinear::Objective;
use crate::solver::Observer;

/// Number of iterations after which directions are reset: without resets Fletcher–Reeves jams, with
/// much more frequent ones conjugacy is lost.
const RESTART: u64 = 1_000;

/// A line search that is accurate enough for conjugacy (c₂ = 0.1).
fn line_search() -> Result<MoreThuenteLineSearch<Vec<f64>, Vec<f64>, f64>, Error> {
    MoreThuenteLineSearch::new().with_c(1e-4, 0.1)
}

/// One of argmin's solvers.
pub(super) struct FirstOrder {
    name: &'static str,
    description: &'static str,
    method: Method,
}

enum Method {
    FletcherReeves,
    PolakRibiere,
    Lbfgs,
}

/// Conjugate gradients by Fletcher and Reeves.
pub(super) static FLETCHER_REEVES: FirstOrder = FirstOrder {
    name: "fletcher-reeves",
    description: "conjugate gradients after Fletcher and Reeves, Moré–Thuente line search (argmin): the paper's",
    method: Method::FletcherReeves,
};

/// Conjugate gradients by Polak and Ribière, β ≥ 0.
pub(super) static POLAK_RIBIERE: FirstOrder = FirstOrder {
    name: "polak-ribiere",
    description: "conjugate gradients after Polak and Ribière (β ≥ 0), Moré–Thuente line search (argmin)",
    method: Method::PolakRibiere,
};

/// Limited-memory BFGS.
pub(super) static LBFGS_ROW: FirstOrder = FirstOrder {
    name: "lbfgs",
    description: "L-BFGS with 20 pairs, Moré–Thuente line search (argmin)",
    method: Method::Lbfgs,
};

impl Minimiser for FirstOrder {
    fn name(&self) -> &'static str {
        self.name
    }

    fn description(&self) -> &'static str {
        self.description
    }

    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError> {
        let failed = |error: Error| MinimiseError::Solver { backend: self.name, message: error.to_string() };
        let limits = IterationLimits::FIRST_ORDER;
        match self.method {
            Method::FletcherReeves => {
                let solver = NonlinearConjugateGradient::new(line_search().map_err(failed)?, BetaFr::new());
                run(self.name, solver.restart_iters(RESTART), objective, start, rule, limits, watch)
            }
            Method::PolakRibiere => {
                let solver = NonlinearConjugateGradient::new(line_search().map_err(failed)?, BetaPr::new());
                run(self.name, solver.restart_iters(RESTART), objective, start, rule, limits, watch)
            }
            Method::Lbfgs => {
                // Its own criteria are disabled; the common rule decides.
                let solver = LBFGS::new(MoreThuenteLineSearch::new(), 20).with_tolerance_grad(0.0);
                let solver = solver.and_then(|solver| solver.with_tolerance_cost(0.0)).map_err(failed)?;
                run(self.name, solver, objective, start, rule, limits, watch)
            }
        }
    }
}
