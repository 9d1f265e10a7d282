//! argmin's executor with one stopping rule and one observer for all minimisers.

use std::cell::Cell;

use argmin::core::{
    CostFunction, Error, Executor, Gradient, IterState, KV, Problem, Solver, State, TerminationReason,
    TerminationStatus,
};

use super::{MinimiseError, Minimum, Status, StopRule};
use crate::problem::nonlinear::Objective;
use crate::solver::{Iteration, Observer, Phase};

/// An objective in the interface of argmin.
#[derive(Clone, Copy)]
pub(super) struct ArgminObjective<'a> {
    pub objective: &'a Objective,
    /// Number of evaluations of the energy in this iteration.
    evaluations: &'a Cell<usize>,
}

/// Largest step, as a share of the distance to where the energy becomes infinite.
pub(super) const LARGEST_SHARE: f64 = 0.9;

/// Number of evaluations after which a step is abandoned: at the level of rounding a line search
/// may not end.
const EVALUATIONS: usize = 200;

/// Parameters, cost and gradient of an iteration.
pub(super) type Iterate = IterState<Vec<f64>, Vec<f64>, (), (), (), f64>;

impl CostFunction for ArgminObjective<'_> {
    type Param = Vec<f64>;
    type Output = f64;

    fn cost(&self, y: &Vec<f64>) -> Result<f64, Error> {
        self.evaluations.set(self.evaluations.get() + 1);
        if self.evaluations.get() > EVALUATIONS {
            return Err(Error::msg("no step was found that lowers the energy"));
        }
        Ok(self.objective.value(y))
    }
}

impl Gradient for ArgminObjective<'_> {
    type Param = Vec<f64>;
    type Gradient = Vec<f64>;

    fn gradient(&self, y: &Vec<f64>) -> Result<Vec<f64>, Error> {
        Ok(self.objective.gradient(y))
    }
}

/// The limits of a minimiser.
#[derive(Clone, Copy)]
pub(super) struct IterationLimits {
    /// Default for the largest number of iterations.
    pub max_iterations: usize,
    /// Number of consecutive steps without a decrease of energy or gradient after which rounding
    /// counts as the limit.
    pub stalled: usize,
}

impl IterationLimits {
    /// Limits for methods that take many small steps.
    pub const FIRST_ORDER: IterationLimits = IterationLimits { max_iterations: 50_000, stalled: 100 };
}

/// A solver with the common stopping rule.
struct Watched<'a, S> {
    inner: S,
    objective: &'a Objective,
    evaluations: &'a Cell<usize>,
    tolerance: f64,
    watch: &'a mut dyn Observer,
    /// The state of lowest energy.
    best: Minimum,
    previous: Vec<f64>,
    stalled: usize,
    stalled_limit: usize,
}

impl<'a, S: Solver<ArgminObjective<'a>, Iterate>> Watched<'a, S> {
    /// Records an iterate.
    fn see(&mut self, state: &Iterate, number: usize) {
        let Some(y) = state.get_param() else { return };
        let value = state.get_cost();
        let gradient_norm = norm(state.get_gradient().map_or(&[], Vec::as_slice));
        let step = y.iter().zip(&self.previous).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
        let terms = if self.watch.wants_terms() { self.objective.values(y) } else { Vec::new() };
        self.watch.iteration(&Iteration { number, total: value, terms, gradient_norm, step });
        // At the level of rounding the energy may fluctuate while the gradient still decreases.
        let falls = value < self.best.value
            || (value <= self.best.value * (1.0 + 1e-14) && gradient_norm < self.best.gradient_norm);
        let clearly = value < self.best.value * (1.0 - 1e-15) || gradient_norm < 0.5 * self.best.gradient_norm;
        self.stalled = if falls && clearly { 0 } else { self.stalled + 1 };
        if falls {
            self.best.y.clone_from(y);
            (self.best.value, self.best.gradient_norm) = (value, gradient_norm);
        }
        self.previous.clone_from(y);
        self.best.iterations = number;
    }
}

impl<'a, S: Solver<ArgminObjective<'a>, Iterate>> Solver<ArgminObjective<'a>, Iterate> for Watched<'a, S> {
    fn name(&self) -> &str {
        self.inner.name()
    }

    fn init(
        &mut self,
        problem: &mut Problem<ArgminObjective<'a>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let (state, kv) = self.inner.init(problem, state)?;
        self.best.value = f64::INFINITY;
        self.see(&state, 0);
        self.stalled = 0;
        Ok((state, kv))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<ArgminObjective<'a>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let number = state.get_iter() as usize + 1;
        self.evaluations.set(0);
        match self.inner.next_iter(problem, state) {
            Ok((state, kv)) => {
                self.see(&state, number);
                Ok((state, kv))
            }
            // A line search that finds no decrease has reached rounding; the best state is kept.
            Err(error) => {
                let state = Iterate::new().param(self.best.y.clone()).cost(self.best.value);
                Ok((state.terminate_with(TerminationReason::SolverExit(error.to_string())), None))
            }
        }
    }

    fn terminate(&mut self, state: &Iterate) -> TerminationStatus {
        let stop = |reason, status: Status, best: &mut Minimum| {
            best.status = status;
            TerminationStatus::Terminated(reason)
        };
        if self.best.reduction() <= self.tolerance {
            return stop(TerminationReason::SolverConverged, Status::Converged, &mut self.best);
        }
        if self.watch.stop_requested() {
            return stop(TerminationReason::Interrupt, Status::Interrupted, &mut self.best);
        }
        if self.stalled >= self.stalled_limit {
            return stop(TerminationReason::SolverConverged, Status::Precision, &mut self.best);
        }
        match self.inner.terminate(state) {
            // The solver's own criterion.
            TerminationStatus::Terminated(reason @ TerminationReason::SolverConverged) => {
                stop(reason, Status::Converged, &mut self.best)
            }
            status => status,
        }
    }
}

/// Returns the state with cost and gradient at its parameters, with which our own solvers begin.
pub(super) fn evaluated(problem: &mut Problem<ArgminObjective>, state: Iterate) -> Result<Iterate, Error> {
    let y = state.get_param().cloned().unwrap_or_default();
    let (cost, gradient) = (problem.cost(&y)?, problem.gradient(&y)?);
    Ok(state.cost(cost).gradient(gradient))
}

/// The Euclidean norm, without underflow of squares where parts of a map have size 1e-160.
pub(super) fn norm(v: &[f64]) -> f64 {
    let squared = dot(v, v);
    if (1e-280..=1e280).contains(&squared) || squared == 0.0 && v.iter().all(|x| *x == 0.0) {
        return squared.sqrt();
    }
    let unit = v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    if !unit.is_finite() || squared.is_nan() {
        return squared.sqrt();
    }
    unit * v.iter().map(|x| (x / unit).powi(2)).sum::<f64>().sqrt()
}

/// a · b
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns |∇E| at the start.
///
/// # Errors
/// [`MinimiseError::StartNotFinite`].
pub(super) fn start_gradient_norm(objective: &Objective, start: &[f64]) -> Result<f64, MinimiseError> {
    let gradient_norm = norm(&objective.gradient(start));
    if objective.value(start).is_finite() && gradient_norm.is_finite() {
        Ok(gradient_norm)
    } else {
        Err(MinimiseError::StartNotFinite)
    }
}

/// Estimates the gradient of a start far from the minimum, times 10⁻⁶.
///
/// The gradient at the start itself is not a suitable reference if the start is the minimum, where
/// it is only rounding. The probes are the start with the unknowns, or with the whole map, scaled
/// by 1.1; the larger gradient counts. The energy can be infinite at the first probe and constant
/// at the second. The result is 0 if it is finite at neither.
fn gradient_of_a_start(objective: &Objective, start: &[f64]) -> f64 {
    let unknowns: Vec<f64> = start.iter().map(|y| 1.1 * y).collect();
    let alone = if objective.value(&unknowns).is_finite() { norm(&objective.gradient(&unknowns)) } else { 0.0 };
    let map: Vec<_> = objective.freedoms.expand(start).iter().map(|z| 1.1 * z).collect();
    let whole = norm(&objective.gradient_of_map(start, &map));
    1e-6 * [alone, whole].into_iter().filter(|norm| norm.is_finite()).fold(0.0, f64::max)
}

/// Runs `solver` from `start` until the stopping rule applies.
pub(super) fn run<S: for<'t> Solver<ArgminObjective<'t>, Iterate>>(
    backend: &'static str,
    solver: S,
    objective: &Objective,
    start: Vec<f64>,
    rule: StopRule,
    limits: IterationLimits,
    watch: &mut dyn Observer,
) -> Result<Minimum, MinimiseError> {
    watch.phase(Phase::Solve);
    let first_gradient_norm = start_gradient_norm(objective, &start)?;
    let best = Minimum {
        y: start.clone(),
        value: f64::INFINITY,
        gradient_norm: f64::INFINITY,
        reference: rule.reference.unwrap_or_else(|| first_gradient_norm.max(gradient_of_a_start(objective, &start))),
        iterations: 0,
        status: Status::MaxIterations,
    };
    let previous = start.clone();
    let evaluations = Cell::new(0);
    let watched = Watched {
        inner: solver,
        objective,
        evaluations: &evaluations,
        tolerance: rule.tolerance,
        watch,
        best,
        previous,
        stalled: 0,
        stalled_limit: limits.stalled,
    };
    let max_iterations = rule.max_iterations.unwrap_or(limits.max_iterations) as u64;
    let result = Executor::new(ArgminObjective { objective, evaluations: &evaluations }, watched)
        .configure(|state: Iterate| state.param(start).max_iters(max_iterations))
        .ctrlc(false)
        .timer(false)
        .run()
        .map_err(|error| MinimiseError::Solver { backend, message: error.to_string() })?;
    // A solver that stopped by itself has found no better point.
    let used_up = result.state.get_termination_reason() == Some(&TerminationReason::MaxItersReached);
    let mut best = result.solver.best;
    if best.status == Status::MaxIterations && !used_up {
        best.status = Status::Precision;
    }
    // The gradient that argmin stores can be that of the last iterate.
    best.gradient_norm = norm(&objective.gradient(&best.y));
    if best.reduction() <= rule.tolerance {
        best.status = Status::Converged;
    }
    Ok(best)
}
