use argmin::core::{Error, KV, Problem, Solver, TerminationReason, TerminationStatus};

use super::executor::{ArgminObjective, Iterate, IterationLimits, LARGEST_SHARE, dot, evaluated, run};
use super::levenberg_marquardt::add_damping;
use super::{MinimiseError, Minimiser, Minimum, StopRule};
use crate::energy::Curvature;
use crate::problem::nonlinear::{HessianAssembly, Objective};
use crate::solver::{Observer, Phase};
use crate::sparse::{Analysis, Breakdown, Cholesky};

/// Newton's method with a line search: `∇²E p = −∇E` by sparse Cholesky, with the pattern analysed
/// once.
///
/// The Hessian is the exact one if it is positive definite; otherwise a share of the difference to
/// its positive semi-definite model is added, until it is. Steps end before the energy becomes
/// infinite, and are shortened until the energy decreases: if it is +∞ for maps with flipped faces,
/// no iterate has any. Steps are lengthened while the energy keeps decreasing.
///
/// # Rationale
/// With the full model, hundreds of steps are needed where the exact Hessian needs ten. Near a
/// barrier at which E behaves like x⁻², a Newton step takes x only to 4x/3.
pub struct Newton {
    /// The iteration has also converged if the next step is predicted to reduce E by less than this
    /// share, whatever the gradient is; 0 disables this. Unlike the gradient, this criterion does
    /// not depend on the sizes of the parts of a map.
    pub smallest_gain: f64,
}

impl Newton {
    /// The entry of the table, for which only the gradient decides.
    pub const ROW: Newton = Newton { smallest_gain: 0.0 };
}

/// A step must achieve this share of the decrease predicted by the slope.
const SUFFICIENT: f64 = 1e-4;

/// Largest number of halvings of a step.
const HALVINGS: i32 = 60;

/// Shares of the difference between the Hessian and its definite model that are added, in turn,
/// until the matrix is definite. Near a minimum a small share suffices, and the full difference
/// overestimates the curvature. A step begins with the share before the one that the last step
/// needed.
const TOWARDS_MODEL: [f64; 4] = [0.0, 0.1, 0.3, 1.0];

/// A full step is lengthened if this share of the slope is left at its end; for quadratic E none
/// would be.
const STEEP: f64 = 0.25;

/// Shares of the diagonal that are added to the model, in turn, until it is definite despite
/// rounding.
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
            factor: analysis.unfactorised(),
            share: 0,
            exact: Vec::new(),
            model: Vec::new(),
            blend: Vec::new(),
        };
        let limits = IterationLimits { max_iterations: self.default_max_iterations(), stalled: 3 };
        run(self.name(), solver, objective, start, rule, limits, watch)
    }
}

struct Backtracking<'a> {
    objective: &'a Objective,
    assembly: &'a HessianAssembly<'a>,
    analysis: &'a Analysis<'a>,
    smallest_gain: f64,
    has_gained_all: bool,
    factor: Cholesky<'a, f64>,
    /// The index in [`TOWARDS_MODEL`] of the share that the last step needed.
    share: usize,
    /// Values of the Hessian, of its model, and of the blend of both.
    exact: Vec<f64>,
    model: Vec<f64>,
    blend: Vec<f64>,
}

/// The end of a step of t times the direction.
struct StepEnd {
    t: f64,
    y: Vec<f64>,
    energy: f64,
    gradient: Vec<f64>,
}

impl Backtracking<'_> {
    /// −B⁻¹ g, where B is the Hessian or its model.
    fn direction(&mut self, y: &[f64], g: &[f64]) -> Result<Vec<f64>, Breakdown> {
        self.factorise(y)?;
        let mut p: Vec<f64> = g.iter().map(|g| -g).collect();
        self.factor.solve_in_place(&mut p);
        Ok(p)
    }

    fn factorise(&mut self, y: &[f64]) -> Result<(), Breakdown> {
        let Backtracking { assembly, analysis, factor, exact, model, blend, .. } = self;
        assembly.write_values(y, Curvature::Exact, exact);
        let first = self.share.saturating_sub(1);
        for (k, share) in TOWARDS_MODEL.into_iter().enumerate().skip(first) {
            if k == first.max(1) {
                assembly.write_values(y, Curvature::GaussNewton, model);
            }
            let values = if k == 0 {
                &*exact
            } else {
                blend.clear();
                blend.extend(exact.iter().zip(&*model).map(|(e, m)| e + share * (m - e)));
                &*blend
            };
            match analysis.refactorise(values, factor) {
                Err(Breakdown::NotPositiveDefinite) => {}
                done => {
                    self.share = k;
                    return done;
                }
            }
        }
        for share in DAMPING {
            blend.clone_from(model);
            add_damping(assembly.columns(), blend, share);
            match analysis.refactorise(blend, factor) {
                Err(Breakdown::NotPositiveDefinite) => {}
                done => return done,
            }
        }
        Err(Breakdown::NotPositiveDefinite)
    }
}

impl<'a> Solver<ArgminObjective<'a>, Iterate> for Backtracking<'_> {
    fn name(&self) -> &str {
        "newton"
    }

    fn init(
        &mut self,
        problem: &mut Problem<ArgminObjective<'a>>,
        state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        Ok((evaluated(problem, state)?, None))
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<ArgminObjective<'a>>,
        mut state: Iterate,
    ) -> Result<(Iterate, Option<KV>), Error> {
        let y = state.take_param().unwrap_or_default();
        let g = state.take_gradient().unwrap_or_default();
        let here = state.get_cost();
        let p = self.direction(&y, &g)?;
        let slope = dot(&g, &p);
        // The model predicts half of this.
        self.has_gained_all = -0.5 * slope <= self.smallest_gain * here.abs();
        let longest = LARGEST_SHARE * self.objective.largest_step(&y, &p);
        // The rounding error of a sum of so many terms.
        let rounding = f64::EPSILON * (y.len() as f64).sqrt() * here.abs();
        let along = |t: f64| -> Vec<f64> { y.iter().zip(&p).map(|(y, p)| y + t * p).collect() };
        for t in (0..HALVINGS).map(|k| longest.min(1.0) * 0.5f64.powi(k)) {
            let next = along(t);
            let there = problem.cost(&next)?;
            if -t * slope <= rounding {
                // The energies are equal up to rounding; the gradients decide.
                let gradient = problem.gradient(&next)?;
                if there.is_finite() && dot(&gradient, &gradient) < dot(&g, &g) {
                    return Ok((state.param(next).cost(there).gradient(gradient), None));
                }
            }
            if -t * slope <= f64::EPSILON * here.abs() {
                break;
            }
            if there <= here + SUFFICIENT * t * slope {
                let gradient = problem.gradient(&next)?;
                let mut end = StepEnd { t, y: next, energy: there, gradient };
                while t >= 1.0 && 2.0 * end.t <= longest && dot(&end.gradient, &p) <= STEEP * slope {
                    let farther = along(2.0 * end.t);
                    let energy = problem.cost(&farther)?;
                    if energy >= end.energy {
                        break;
                    }
                    let gradient = problem.gradient(&farther)?;
                    end = StepEnd { t: 2.0 * end.t, y: farther, energy, gradient };
                }
                return Ok((state.param(end.y).cost(end.energy).gradient(end.gradient), None));
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
