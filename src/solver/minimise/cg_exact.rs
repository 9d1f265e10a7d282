use argmin::core::{Error, KV, Problem, Solver};

use super::executor::{ArgminObjective, Iterate, IterationLimits, LARGEST_SHARE, dot, evaluated, run};
use super::{MinimiseError, Minimiser, Minimum, StopRule};
use crate::problem::nonlinear::Objective;
use crate::solver::Observer;

/// Conjugate gradients with an exact line search: along a line the energy is a polynomial, whose
/// lowest minimum ahead is computed from its coefficients.
pub(super) struct CgExact;

impl Minimiser for CgExact {
    fn name(&self) -> &'static str {
        "cg-exact"
    }

    fn description(&self) -> &'static str {
        "conjugate gradients after Polak and Ribière (β ≥ 0), exact line search on the polynomial along the line"
    }

    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError> {
        run(self.name(), ExactCg::default(), objective, start, rule, IterationLimits::FIRST_ORDER, watch)
    }
}

/// The direction of the last step.
#[derive(Default)]
struct ExactCg {
    direction: Vec<f64>,
}

/// Returns the step length along p from y: the exact minimum if the energy is a polynomial;
/// otherwise by backtracking from 1, or from just before the energy becomes infinite.
pub(super) fn step_length(objective: &Objective, y: &[f64], p: &[f64]) -> Option<f64> {
    let at = |t: f64| y.iter().zip(p).map(|(y, p)| y + t * p).collect::<Vec<_>>();
    match objective.along(y, p) {
        Some(polynomial) => polynomial.minimum_ahead(),
        None => {
            let (here, slope) = (objective.value(y), dot(&objective.gradient(y), p));
            let longest = (LARGEST_SHARE * objective.largest_step(y, p)).min(1.0);
            let halvings = (0..60).map(|k| longest * 0.5f64.powi(k));
            halvings.into_iter().find(|&t| objective.value(&at(t)) <= here + 1e-4 * t * slope)
        }
    }
}

impl<'a> Solver<ArgminObjective<'a>, Iterate> for ExactCg {
    fn name(&self) -> &str {
        "cg-exact"
    }

    fn init(
        &mut self,
        problem: &mut Problem<ArgminObjective<'a>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let state = evaluated(problem, state)?;
        self.direction = state.get_gradient().map_or(&[][..], Vec::as_slice).iter().map(|g| -g).collect();
        Ok((state, None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<ArgminObjective<'a>>,
        mut state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let objective = problem.problem.as_ref().map(|target| target.objective);
        let mut y = state.take_param().unwrap_or_default();
        let old = state.take_gradient().unwrap_or_default();
        if dot(&self.direction, &old) >= 0.0 {
            self.direction = old.iter().map(|g| -g).collect();
        }
        let t = objective.and_then(|objective| step_length(objective, &y, &self.direction)).unwrap_or(0.0);
        for (y, p) in y.iter_mut().zip(&self.direction) {
            *y += t * p;
        }
        let (cost, new) = (problem.cost(&y)?, problem.gradient(&y)?);
        let change: Vec<f64> = new.iter().zip(&old).map(|(a, b)| a - b).collect();
        let beta = (dot(&new, &change) / dot(&old, &old)).max(0.0);
        for (p, g) in self.direction.iter_mut().zip(&new) {
            *p = beta * *p - g;
        }
        Ok((state.param(y).cost(cost).gradient(new), None))
    }
}
