use std::collections::VecDeque;

use argmin::core::{Error, KV, Problem, Solver};

use super::cg_exact::step_length;
use super::executor::{ArgminObjective, Iterate, IterationLimits, dot, evaluated, run, start_gradient_norm};
use super::levenberg_marquardt::add_damping;
use super::{MinimiseError, Minimiser, Minimum, StopRule};
use crate::energy::Curvature;
use crate::problem::nonlinear::{HessianAssembly, Objective};
use crate::solver::{Observer, Phase};
use crate::sparse::Cholesky;

/// L-BFGS whose initial matrix is the Gauss–Newton Hessian at the start, factorised once; an
/// iteration costs one solve.
pub(super) struct LbfgsPreconditioned;

/// Number of stored pairs.
const PAIRS: usize = 20;

/// Damping of the preconditioner relative to its diagonal; it must be definite but need not be
/// accurate.
const DAMPING: f64 = 1e-8;

impl Minimiser for LbfgsPreconditioned {
    fn name(&self) -> &'static str {
        "lbfgs-preconditioned"
    }

    fn description(&self) -> &'static str {
        "L-BFGS preconditioned by one Cholesky factor of the Gauss–Newton Hessian at the start, exact line search"
    }

    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError> {
        // Before a start that is not finite makes the factorisation fail.
        start_gradient_norm(objective, &start)?;
        watch.phase(Phase::Assemble);
        let assembly = HessianAssembly::new(objective);
        let mut values = assembly.values(&start, Curvature::GaussNewton);
        add_damping(assembly.columns(), &mut values, DAMPING);
        watch.phase(Phase::Factor);
        let failed = MinimiseError::factorisation(self, start.len());
        let analysis = assembly.analysis().map_err(&failed)?;
        let factor = analysis.factorise(&values, None).map_err(&failed)?;
        watch.phase(Phase::Solve);
        let solver = Preconditioned { factor, pairs: VecDeque::new() };
        run(self.name(), solver, objective, start, rule, IterationLimits::FIRST_ORDER, watch)
    }
}

/// A step s, the change q of the gradient over it, and 1/(s·q).
struct CurvaturePair {
    s: Vec<f64>,
    q: Vec<f64>,
    inverse: f64,
}

struct Preconditioned<'f> {
    factor: Cholesky<'f, f64>,
    pairs: VecDeque<CurvaturePair>,
}

impl Preconditioned<'_> {
    /// The two-loop recursion: −B⁻¹ g.
    fn direction(&self, g: &[f64]) -> Vec<f64> {
        let mut d: Vec<f64> = g.iter().map(|g| -g).collect();
        let mut alphas = Vec::with_capacity(self.pairs.len());
        for pair in self.pairs.iter().rev() {
            let alpha = pair.inverse * dot(&pair.s, &d);
            add(&mut d, -alpha, &pair.q);
            alphas.push(alpha);
        }
        self.factor.solve_in_place(&mut d);
        for (pair, alpha) in self.pairs.iter().zip(alphas.iter().rev()) {
            let beta = pair.inverse * dot(&pair.q, &d);
            add(&mut d, alpha - beta, &pair.s);
        }
        d
    }
}

/// a += t b
fn add(a: &mut [f64], t: f64, b: &[f64]) {
    for (a, b) in a.iter_mut().zip(b) {
        *a += t * b;
    }
}

impl<'a> Solver<ArgminObjective<'a>, Iterate> for Preconditioned<'_> {
    fn name(&self) -> &str {
        "lbfgs-preconditioned"
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
        let objective = problem.problem.as_ref().map(|target| target.objective);
        let mut y = state.take_param().unwrap_or_default();
        let old = state.take_gradient().unwrap_or_default();
        let mut d = self.direction(&old);
        if dot(&d, &old) >= 0.0 {
            self.pairs.clear();
            d = self.direction(&old);
        }
        let t = objective.and_then(|objective| step_length(objective, &y, &d)).unwrap_or(0.0);
        add(&mut y, t, &d);
        let (cost, new) = (problem.cost(&y)?, problem.gradient(&y)?);
        let s: Vec<f64> = d.iter().map(|d| t * d).collect();
        let q: Vec<f64> = new.iter().zip(&old).map(|(a, b)| a - b).collect();
        let curvature = dot(&s, &q);
        if curvature > 0.0 {
            if self.pairs.len() == PAIRS {
                self.pairs.pop_front();
            }
            self.pairs.push_back(CurvaturePair { s, q, inverse: 1.0 / curvature });
        }
        Ok((state.param(y).cost(cost).gradient(new), None))
    }
}
