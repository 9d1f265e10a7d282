//! The Riemann map: boundary exactly on the unit circle, H the lowest.

use num_complex::Complex64;

use super::angles::{Anchor, is_ascending};
use super::barrier::{Barrier, solve_chains};
use super::cg::{conjugate_gradients, dot, norm};
use super::precondition::Preconditioner;
use super::spectrum::smallest_eigenvalue;
use super::start::start;
use super::{Reduction, Unreduced};
use crate::solver::{Iteration, Observer, Status, StopRule};

/// A gradient that cannot be brought down further counts as rounding below this.
const ROUNDING: f64 = 1e-8;

/// Longest change of an angle in one step.
const LONGEST: f64 = 0.5;

/// Newton steps; the barrier's stages have as many each.
const MAX_ITERATIONS: usize = 50;
const MAX_CG: usize = 300;

/// What is asked.
pub struct CircleProblem<'a> {
    /// The reduced energy.
    pub reduction: &'a Reduction<'a>,
    /// Boundary positions that are held, ascending, at places of ascending angle next to the circle; at least one.
    pub pins: &'a [(usize, Complex64)],
    /// Whether a barrier keeps the boundary in order.
    pub keep_order: bool,
    /// `tolerance`: of |∇H| itself, over the free angles; there is no reference.
    pub rule: StopRule,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct CircleMap {
    /// Boundary values (`nb`).
    pub boundary: Vec<Complex64>,
    /// H.
    pub energy: f64,
    /// |∂H/∂θ| over the free angles, Euclidean; with the barrier's where order is kept.
    pub gradient_norm: f64,
    /// Newton steps.
    pub iterations: usize,
    /// How it ended.
    pub status: Status,
    /// The root of the smallest eigenvalue of half the Hessian, an estimate from above.
    pub smallest_singular_value: Option<f64>,
}

/// Minimises `H = z_Bᴴ M z_B` over `z_b = e^{iθ_b}` by Newton's method, each step by preconditioned conjugate gradients:
///
/// ```text
/// g = 2 Re(conj(iz) ∘ Mz)     Hess = 2 Re(diag(z̄) M diag(z)) − diag(2 Re(z̄ ∘ Mz))
/// ```
///
/// # Errors
/// [`Unreduced::Unsuitable`] without pins; [`Unreduced::Stalled`] short of the tolerance and of rounding.
pub fn circle_map(problem: &CircleProblem, watch: &mut dyn Observer) -> Result<CircleMap, Unreduced> {
    if problem.pins.is_empty() {
        return Err(Unreduced::Unsuitable { reason: "no boundary point is held" });
    }
    let anchors = anchors(problem.pins);
    let theta = start(problem.reduction, &anchors);
    let pins: Vec<usize> = anchors.iter().map(|&(k, _)| k).collect();
    let mut newton = Newton {
        problem,
        preconditioner: Preconditioner::new(theta.len(), pins.clone()),
        pins,
        barrier: None,
        iterations: 0,
    };
    let mut state = newton.at(theta);
    newton.announce(&state, 0.0, watch);
    let mut status = Status::Converged;
    if problem.keep_order {
        let stages = Barrier::stages(problem.reduction.len());
        for (stage, &strength) in stages.iter().enumerate() {
            newton.barrier = Some(Barrier { strength });
            state = newton.at(state.theta);
            let last = stage + 1 == stages.len();
            let tolerance = if last { problem.rule.tolerance } else { problem.rule.tolerance.max(1e-3 * strength) };
            (state, status) = newton.descend(state, tolerance, watch);
            if status != Status::Converged && !last {
                break;
            }
        }
    } else {
        (state, status) = newton.descend(state, problem.rule.tolerance, watch);
    }
    let gave_up = status == Status::MaxIterations && problem.rule.max_iterations.is_none();
    if gave_up || status == Status::Precision && state.gradient_norm() > ROUNDING.max(problem.rule.tolerance) {
        return Err(Unreduced::Stalled { iterations: newton.iterations, residual: state.gradient_norm() });
    }
    newton.barrier = None;
    newton.preconditioner.update(&state.theta);
    let half_hessian = |d: &[f64]| newton.product(&state, d).iter().map(|h| 0.5 * h).collect::<Vec<f64>>();
    let smallest = (status == Status::Converged || status == Status::Precision)
        .then(|| smallest_eigenvalue(half_hessian, |r| newton.preconditioner.apply(r), &newton.pins, &state.theta))
        .flatten();
    Ok(CircleMap {
        gradient_norm: state.gradient_norm(),
        energy: state.energy,
        iterations: newton.iterations,
        status,
        smallest_singular_value: smallest.map(|eigenvalue| eigenvalue.max(0.0).sqrt()),
        boundary: state.z,
    })
}

/// The pins' angles, each larger than the one before.
fn anchors(pins: &[(usize, Complex64)]) -> Vec<Anchor> {
    let mut anchors: Vec<Anchor> = Vec::with_capacity(pins.len());
    for &(k, place) in pins {
        let angle = match anchors.first() {
            None => place.arg(),
            Some(&(_, first)) => first + (place / Complex64::cis(first)).arg().rem_euclid(std::f64::consts::TAU),
        };
        anchors.push((k, angle));
    }
    anchors
}

/// Angles and what follows from them.
struct State {
    theta: Vec<f64>,
    z: Vec<Complex64>,
    /// M z.
    mz: Vec<Complex64>,
    /// H.
    energy: f64,
    /// H and the barrier.
    total: f64,
    gradient: Vec<f64>,
}

impl State {
    fn gradient_norm(&self) -> f64 {
        norm(&self.gradient)
    }
}

struct Newton<'a> {
    problem: &'a CircleProblem<'a>,
    pins: Vec<usize>,
    preconditioner: Preconditioner,
    barrier: Option<Barrier>,
    iterations: usize,
}

impl Newton<'_> {
    fn at(&self, theta: Vec<f64>) -> State {
        let mut z: Vec<Complex64> = theta.iter().map(|&t| Complex64::cis(t)).collect();
        for &(k, place) in self.problem.pins {
            z[k] = place;
        }
        let mz = self.problem.reduction.m(&z);
        let energy = z.iter().zip(&mz).map(|(z, m)| (z.conj() * m).re).sum();
        let mut gradient: Vec<f64> = z.iter().zip(&mz).map(|(z, m)| 2.0 * ((Complex64::I * z).conj() * m).re).collect();
        let mut total = energy;
        if let Some(barrier) = &self.barrier {
            total += barrier.value(&theta);
            barrier.add_gradient(&theta, &mut gradient);
        }
        self.let_go(&mut gradient);
        State { theta, z, mz, energy, total, gradient }
    }

    /// Sets the pins' entries to 0.
    fn let_go(&self, x: &mut [f64]) {
        for &pin in &self.pins {
            x[pin] = 0.0;
        }
    }

    /// The Hessian's product with d, which is 0 at the pins.
    fn product(&self, state: &State, d: &[f64]) -> Vec<f64> {
        let moved: Vec<Complex64> = state.z.iter().zip(d).map(|(z, d)| Complex64::I * z * *d).collect();
        let m = self.problem.reduction.m(&moved);
        let mut product: Vec<f64> = (0..d.len())
            .map(|k| {
                let z = state.z[k];
                2.0 * ((Complex64::I * z).conj() * m[k]).re - 2.0 * (z.conj() * state.mz[k]).re * d[k]
            })
            .collect();
        if let Some(barrier) = &self.barrier {
            Barrier::add_product(&barrier.couplings(&state.theta), d, &mut product);
        }
        self.let_go(&mut product);
        product
    }

    fn announce(&self, state: &State, step: f64, watch: &mut dyn Observer) {
        let terms = if watch.wants_terms() { vec![("H", state.energy), ("C", 0.0)] } else { Vec::new() };
        let (number, gradient_norm) = (self.iterations, state.gradient_norm());
        watch.iteration(&Iteration { number, total: state.energy, terms, gradient_norm, step });
    }

    /// Newton steps until |g| is below the tolerance or does not fall.
    fn descend(&mut self, mut state: State, tolerance: f64, watch: &mut dyn Observer) -> (State, Status) {
        let max_iterations = self.problem.rule.max_iterations.unwrap_or(self.iterations + MAX_ITERATIONS);
        loop {
            let before = state.gradient_norm();
            if before <= tolerance {
                return (state, Status::Converged);
            }
            if watch.stop_requested() {
                return (state, Status::Interrupted);
            }
            if self.iterations >= max_iterations {
                return (state, Status::MaxIterations);
            }
            self.preconditioner.update(&state.theta);
            let direction = self.direction(&state, tolerance);
            let Some((next, step)) = self.search(&state, &direction) else { return (state, Status::Precision) };
            self.iterations += 1;
            self.announce(&next, step, watch);
            state = next;
        }
    }

    /// The Newton direction, to a precision that squares |g|.
    fn direction(&self, state: &State, tolerance: f64) -> Vec<f64> {
        let b: Vec<f64> = state.gradient.iter().map(|g| -g).collect();
        let size = norm(&b);
        let forcing = size.min(0.1).max(0.3 * tolerance / size).min(0.1);
        let couplings = self.barrier.as_ref().map(|barrier| barrier.couplings(&state.theta));
        let precondition = |r: &[f64]| match &couplings {
            Some(couplings) => solve_chains(couplings, &self.pins, r),
            None => self.preconditioner.apply(r),
        };
        let cg = conjugate_gradients(|d| self.product(state, d), precondition, &b, forcing, MAX_CG);
        let mut d = cg.x;
        let largest = d.iter().fold(0.0f64, |m, d| m.max(d.abs()));
        // A direction of negative curvature has no length of its own.
        if largest > LONGEST || (cg.indefinite && largest < 1e-12) {
            d.iter_mut().for_each(|d| *d *= LONGEST / largest.max(f64::MIN_POSITIVE));
        }
        d
    }

    /// The longest of the halved steps that lowers H clearly, or |g| where H is rounding.
    fn search(&self, state: &State, d: &[f64]) -> Option<(State, f64)> {
        let slope = dot(&state.gradient, d);
        let length = norm(d);
        let before = state.gradient_norm();
        let ordered = self.barrier.is_some();
        let mut t = if ordered { Barrier::longest(&state.theta, d) } else { 1.0 };
        for _ in 0..30 {
            let theta: Vec<f64> = state.theta.iter().zip(d).map(|(theta, d)| theta + t * d).collect();
            if !ordered || is_ascending(&theta) {
                let next = self.at(theta);
                let lower = next.total <= state.total + 1e-4 * t * slope && -t * slope > 1e-13;
                let flatter = next.gradient_norm() <= (1.0 - 1e-4 * t) * before && next.total <= state.total + 1e-12;
                if lower || flatter {
                    return Some((next, t * length));
                }
            }
            t *= 0.5;
        }
        None
    }
}
