use argmin::core::{Error, KV, Problem, Solver};

use super::executor::{ArgminObjective, Iterate, IterationLimits, LARGEST_SHARE, dot, evaluated, run};
use super::{MinimiseError, Minimiser, Minimum, StopRule};
use crate::energy::Curvature;
use crate::problem::nonlinear::{HessianAssembly, Objective};
use crate::solver::{Observer, Phase};
use crate::sparse::{Analysis, Cholesky, Columns};

/// Damped Newton steps `(B + λ M) p = −g` by sparse Cholesky, with the pattern analysed once.
///
/// B is the Gauss–Newton Hessian if the minimum of the energy is 0, and the exact one otherwise.
/// Gauss–Newton steps are corrected by the second derivatives of the residuals (geodesic
/// acceleration; Transtrum, Sethna 2012). M measures steps by their Dirichlet energy
/// ([`Objective::norm`]).
///
/// # Rationale
/// M lets a map move as a whole. With the diagonal of B instead, which is the usual choice, the
/// number of iterations grows with the mesh.
pub struct LevenbergMarquardt {
    /// The choice of B; `None` begins with Gauss–Newton and changes when steps become slow.
    pub curvature: Option<Curvature>,
}

impl LevenbergMarquardt {
    /// Chooses B automatically, Gauss–Newton first.
    pub const AUTO: LevenbergMarquardt = LevenbergMarquardt { curvature: None };
}

impl Minimiser for LevenbergMarquardt {
    fn name(&self) -> &'static str {
        "levenberg-marquardt"
    }

    fn description(&self) -> &'static str {
        "damped Newton steps by sparse Cholesky, Gauss–Newton or exact Hessian, pattern analysed once"
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
        let unknowns = start.len();
        let analysis = assembly.analysis().map_err(MinimiseError::factorisation(self, unknowns))?;
        watch.phase(Phase::Solve);
        let overdetermined = objective.is_overdetermined();
        let solver = Damped {
            objective,
            overdetermined,
            diagonal_share: if overdetermined {
                DIAGONAL_SHARE.min(DIAGONAL_SUM / unknowns as f64)
            } else {
                DIAGONAL_SHARE
            },
            norm: assembly.norm_values(&start),
            assembly: &assembly,
            analysis: &analysis,
            may_change: self.curvature.is_none(),
            curvature: self.curvature.unwrap_or(Curvature::GaussNewton),
            crawling: 0,
            lambda: if overdetermined { CAUTIOUS } else { BOLD },
            shrink: if overdetermined { SHRINK } else { NIELSEN },
            growth: 2.0,
            factor: None,
        };
        let limits = IterationLimits { max_iterations: self.default_max_iterations(), stalled: 3 };
        run(self.name(), solver, objective, start, rule, limits, watch)
    }
}

/// Adds `t` times a matrix's diagonal to it. Negligible diagonal entries are replaced by the
/// largest one.
pub(super) fn add_damping(columns: &Columns, values: &mut [f64], t: f64) {
    let largest = columns.diagonal(values).fold(0.0, f64::max);
    for k in 0..columns.size() {
        let entry = &mut values[columns.offsets[k] as usize];
        *entry += t * if *entry > 1e-12 * largest { *entry } else { largest };
    }
}

/// The largest damping before a step counts as lost to rounding.
const LARGEST_DAMPING: f64 = 1e14;

/// Initial values of λ. If the energy can vanish, a small λ saves iterations; if it cannot, large
/// steps may skip the nearest minimum and end in one with a much higher energy.
const BOLD: f64 = 1e-3;
const CAUTIOUS: f64 = 0.1;

/// Factor of λ if the model was right: Nielsen's value, and a smaller one for metric energies,
/// whose models are accurate from the start, until a step fails.
const NIELSEN: f64 = 1.0 / 3.0;
const SHRINK: f64 = 0.1;

/// Share of the diagonal of B in M, which is needed because rotations of one colour relative to the
/// other have no Dirichlet energy. If a map has to move as a whole, the sum of these terms is
/// limited to `DIAGONAL_SUM` of one entry; with more, a large map distorts at the pinned vertex.
const DIAGONAL_SHARE: f64 = 1e-6;
const DIAGONAL_SUM: f64 = 4e-3;

/// Factor of λ after steps at the end, where only the gradient shows progress; λ → 0 gives Newton's
/// method.
const LAST_STEPS: f64 = 0.01;

/// Largest geodesic acceleration, relative to the length of the step, that is accepted.
const LARGEST_BEND: f64 = 1.0;

/// A step is slow if more than this share of the energy is left.
const CRAWL: f64 = 0.9;

/// Number of consecutive slow steps after which the other Hessian is tried. The exact Hessian is
/// needed at the end if the energy does not vanish; but in the curved valleys of an energy that
/// does, it can be slow where Gauss–Newton steps are fast.
const GAUSS_NEWTON_PATIENCE: usize = 3;
const EXACT_PATIENCE: usize = 15;

struct Damped<'a> {
    objective: &'a Objective,
    assembly: &'a HessianAssembly<'a>,
    analysis: &'a Analysis<'a>,
    norm: Vec<f64>,
    overdetermined: bool,
    diagonal_share: f64,
    may_change: bool,
    curvature: Curvature,
    crawling: usize,
    /// λ, in units in which M has the trace of the Gauss–Newton Hessian.
    lambda: f64,
    /// Smallest factor of λ after a success.
    shrink: f64,
    /// Factor of λ at the next failure (Nielsen).
    growth: f64,
    factor: Option<Cholesky<'a, f64>>,
}

impl Damped<'_> {
    /// M at a point with the given Gauss–Newton Hessian.
    fn damping(&self, gauss: &[f64]) -> Vec<f64> {
        let columns = self.assembly.columns();
        let scale = columns.diagonal(gauss).sum::<f64>() / columns.diagonal(&self.norm).sum::<f64>();
        let mut damping: Vec<f64> = self.norm.iter().map(|m| scale * m).collect();
        for k in 0..columns.size() {
            let at = columns.offsets[k] as usize;
            damping[at] += self.diagonal_share * gauss[at];
        }
        damping
    }

    /// Returns the step with the current λ, with geodesic acceleration if accepted, and the
    /// predicted decrease; `None` if B + λM is not positive definite.
    fn step(&mut self, model: &[f64], damping: &[f64], y: &[f64], g: &[f64]) -> Option<(Vec<f64>, f64)> {
        let columns = self.assembly.columns();
        let damped: Vec<f64> = model.iter().zip(damping).map(|(b, m)| b + self.lambda * m).collect();
        let factor = self.analysis.factorise(&damped, self.factor.take()).ok()?;
        let mut p: Vec<f64> = g.iter().map(|g| -g).collect();
        factor.solve_in_place(&mut p);
        let size = |v: &[f64]| dot(v, &columns.multiply(damping, v));
        // −(g·p + ½ p·B p) with (B + λM) p = −g.
        let length = size(&p);
        let mut predicted = 0.5 * (self.lambda * length - dot(g, &p));
        let share = LARGEST_SHARE * self.objective.largest_step(y, &p);
        if share < 1.0 {
            // −(t g·p + ½ t² p·B p)
            let along = dot(g, &p);
            predicted = -share * along + 0.5 * share * share * (along + self.lambda * length);
            p.iter_mut().for_each(|p| *p *= share);
            self.factor = Some(factor);
            return Some((p, predicted));
        }
        if self.curvature == Curvature::GaussNewton {
            let mut bend: Vec<f64> = self.objective.bending(y, &p).iter().map(|b| -0.5 * b).collect();
            factor.solve_in_place(&mut bend);
            if 4.0 * size(&bend) <= LARGEST_BEND * LARGEST_BEND * length {
                p.iter_mut().zip(&bend).for_each(|(p, b)| *p += b);
            }
        }
        self.factor = Some(factor);
        Some((p, predicted))
    }

    fn fail(&mut self) {
        self.lambda *= self.growth;
        self.growth *= 2.0;
        self.shrink = NIELSEN;
    }

    fn succeed(&mut self, ratio: f64, left: f64) {
        self.lambda = (self.lambda * (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(self.shrink, 2.0)).max(1e-15);
        self.growth = 2.0;
        self.crawling = if left > CRAWL { self.crawling + 1 } else { 0 };
        let (patience, other) = match self.curvature {
            Curvature::GaussNewton => (GAUSS_NEWTON_PATIENCE, Curvature::Exact),
            Curvature::Exact => (EXACT_PATIENCE, Curvature::GaussNewton),
        };
        if self.may_change && self.crawling >= patience {
            (self.curvature, self.crawling) = (other, 0);
        }
    }
}

impl<'a> Solver<ArgminObjective<'a>, Iterate> for Damped<'_> {
    fn name(&self) -> &str {
        "levenberg-marquardt"
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
        let gauss = self.assembly.values(&y, Curvature::GaussNewton);
        let damping = self.damping(&gauss);
        let model = match self.curvature {
            Curvature::GaussNewton => gauss,
            Curvature::Exact => self.assembly.values(&y, Curvature::Exact),
        };
        while self.lambda < LARGEST_DAMPING {
            let Some((p, predicted)) = self.step(&model, &damping, &y, &g) else {
                self.fail();
                continue;
            };
            let next: Vec<f64> = y.iter().zip(&p).map(|(y, p)| y + p).collect();
            let there = problem.cost(&next)?;
            if predicted <= f64::EPSILON * here {
                // The energies are equal up to rounding; the gradients decide.
                let gradient = problem.gradient(&next)?;
                let better = there.is_finite() && dot(&gradient, &gradient) < dot(&g, &g);
                if better && self.overdetermined {
                    self.lambda *= LAST_STEPS;
                }
                let (y, cost, g) = if better { (next, there, gradient) } else { (y, here, g) };
                return Ok((state.param(y).cost(cost).gradient(g), None));
            }
            let ratio = (here - there) / predicted;
            if there <= here && ratio > 1e-4 {
                self.succeed(ratio, there / here);
                let gradient = problem.gradient(&next)?;
                return Ok((state.param(next).cost(there).gradient(gradient), None));
            }
            self.fail();
        }
        (self.lambda, self.growth) = (1.0, 2.0);
        Ok((state.param(y).cost(here).gradient(g), None))
    }
}
