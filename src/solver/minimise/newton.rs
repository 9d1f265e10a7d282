use argmin::core::{Error, KV, Problem, Solver, TerminationReason, TerminationStatus};

use super::executor::{Iterate, LARGEST_SHARE, Limits, Target, dot, evaluated, run};
use super::levenberg_marquardt::add_damping;
use super::{MinimiseError, Minimiser, Minimum, StopRule};
use crate::energy::Curvature;
use crate::problem::nonlinear::{HessianAssembly, Objective};
use crate::solver::{Observer, Phase};
use crate::sparse::{Analysis, Breakdown, Cholesky};

/// Newton's method with backtracking, `∇²E p = −∇E` by sparse Cholesky, the pattern analysed once.
///
/// The Hessian is the exact one wherever that is positive definite; elsewhere it is drawn towards its positive semi-definite model until
/// it is: with the model all the way it takes hundreds of steps where the true one takes ten. A step ends short of where the energy is no longer finite, and is
/// shortened until the energy falls: where it is +∞ on maps that fold, every iterate is one without folds.
pub struct Newton {
    /// Converged too when the next step promises to gain less than this share of E, whatever the gradient; 0: never. Unlike the
    /// gradient it does not depend on how large the parts of a map are.
    pub smallest_gain: f64,
}

impl Newton {
    /// The row of the table: the gradient alone decides.
    pub const ROW: Newton = Newton { smallest_gain: 0.0 };
}

/// Of the decrease that the slope promises a step must bring this.
const SUFFICIENT: f64 = 1e-4;

/// How often a step is halved.
const HALVINGS: i32 = 60;

/// How much of what the Hessian lacks to its definite model is added, in turn, until the matrix is definite: a little of it is enough near a
/// minimum, and all of it overstates the curvature.
const TOWARDS_MODEL: [f64; 3] = [0.1, 0.3, 1.0];

/// Shares of its diagonal that are added to the model, in turn, until it is definite to rounding.
const DAMPING: [f64; 3] = [1e-12, 1e-9, 1e-6];

impl Minimiser for Newton {
    fn name(&self) -> &'static str {
        "newton"
    }

    fn description(&self) -> &'static str {
        "Newton with backtracking by sparse Cholesky, exact Hessian where it is definite; keeps maps without folds so"
    }

    fn default_max_iterations(&self) -> usize {
        500
    }

    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError> {
        watch.phase(Phase::Assemble);
        let assembly = HessianAssembly::new(objective);
        watch.phase(Phase::Factor);
        let analysis = assembly.analysis().map_err(MinimiseError::factorisation(self, start.len()))?;
        watch.phase(Phase::Solve);
        let solver = Backtracking {
            objective,
            assembly: &assembly,
            analysis: &analysis,
            smallest_gain: self.smallest_gain,
            has_gained_all: false,
            factor: None,
        };
        let limits = Limits { max_iterations: self.default_max_iterations(), stalled: 3 };
        run(self.name(), solver, objective, start, rule, limits, watch)
    }
}

struct Backtracking<'a> {
    objective: &'a Objective,
    assembly: &'a HessianAssembly<'a>,
    analysis: &'a Analysis<'a>,
    smallest_gain: f64,
    has_gained_all: bool,
    factor: Option<Cholesky<'a, f64>>,
}

impl<'a> Backtracking<'a> {
    /// −B⁻¹ g, B the Hessian or its model.
    fn direction(&mut self, y: &[f64], g: &[f64]) -> Result<Vec<f64>, Breakdown> {
        let factor = self.factorise(y)?;
        let mut p: Vec<f64> = g.iter().map(|g| -g).collect();
        factor.solve_in_place(&mut p);
        self.factor = Some(factor);
        Ok(p)
    }

    fn factorise(&mut self, y: &[f64]) -> Result<Cholesky<'a, f64>, Breakdown> {
        let exact = self.assembly.values(y, Curvature::Exact);
        match self.analysis.factorise(&exact, self.factor.take()) {
            Err(Breakdown::NotPositiveDefinite) => {}
            factor => return factor,
        }
        let model = self.assembly.values(y, Curvature::GaussNewton);
        for share in TOWARDS_MODEL {
            let blend: Vec<f64> = exact.iter().zip(&model).map(|(e, m)| e + share * (m - e)).collect();
            match self.analysis.factorise(&blend, None) {
                Err(Breakdown::NotPositiveDefinite) => {}
                factor => return factor,
            }
        }
        for share in DAMPING {
            let mut damped = model.clone();
            add_damping(self.assembly.columns(), &mut damped, share);
            match self.analysis.factorise(&damped, None) {
                Err(Breakdown::NotPositiveDefinite) => {}
                factor => return factor,
            }
        }
        Err(Breakdown::NotPositiveDefinite)
    }
}

impl<'a> Solver<Target<'a>, Iterate> for Backtracking<'_> {
    fn name(&self) -> &str {
        "newton"
    }

    fn init(&mut self, problem: &mut Problem<Target<'a>>, state: Iterate) -> Result<(Iterate, Option<KV>), Error> {
        Ok((evaluated(problem, state)?, None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<Target<'a>>,
        mut state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let y = state.take_param().unwrap_or_default();
        let g = state.take_gradient().unwrap_or_default();
        let here = state.get_cost();
        let p = self.direction(&y, &g)?;
        let slope = dot(&g, &p);
        // Half of it is what the model gains.
        self.has_gained_all = -0.5 * slope <= self.smallest_gain * here.abs();
        let longest = (LARGEST_SHARE * self.objective.largest_step(&y, &p)).min(1.0);
        for t in (0..HALVINGS).map(|k| longest * 0.5f64.powi(k)) {
            let next: Vec<f64> = y.iter().zip(&p).map(|(y, p)| y + t * p).collect();
            let there = problem.cost(&next)?;
            if -t * slope <= f64::EPSILON * here.abs() {
                // The energy can no longer tell which of the two is lower; the gradient can.
                let gradient = problem.gradient(&next)?;
                let better = there.is_finite() && dot(&gradient, &gradient) < dot(&g, &g);
                let (y, cost, g) = if better { (next, there, gradient) } else { (y, here, g) };
                return Ok((state.param(y).cost(cost).gradient(g), None));
            }
            if there <= here + SUFFICIENT * t * slope {
                let gradient = problem.gradient(&next)?;
                return Ok((state.param(next).cost(there).gradient(gradient), None));
            }
        }
        Ok((state.param(y).cost(here).gradient(g), None))
    }

    fn terminate(&mut self, _state: &Iterate) -> TerminationStatus {
        match self.has_gained_all {
            true => TerminationStatus::Terminated(TerminationReason::SolverConverged),
            false => TerminationStatus::NotTerminated,
        }
    }
}
