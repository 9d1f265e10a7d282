//! The free map: H the lowest among the maps whose boundary edges have given lengths.

use num_complex::Complex64;

use super::conjugate::{hil, project};
use super::gmres::gmres;
use super::norm::norm;
use super::turning::start;
use super::{BoundaryError, Reduction};
use crate::solver::{Iteration, Observer, Status};

/// Products at most in one linear solve; more means that it does not converge.
const LONGEST: usize = 30;
const MAX_ITERATIONS: usize = 40;
/// Largest relative change of an edge that is added; larger ones multiply.
const ADDED: f64 = 0.05;
/// Log lengths that cannot be brought nearer count as rounding below this.
const ROUNDING: f64 = 1e-9;

/// What is asked.
pub struct FreeProblem<'a> {
    /// The reduced energy.
    pub reduction: &'a Reduction<'a>,
    /// What the angles around each vertex lack of 2π, on the boundary of π (`nv`); dual vertices 0. Its sum is 2π.
    pub curvature: &'a [f64],
    /// The length of the edge from each boundary vertex to the next (`nb`).
    pub lengths: &'a [f64],
    /// Where these are not the lengths at rest: ln (length / length at rest) (`nb`).
    pub log_factors: Option<&'a [f64]>,
    /// Largest |log (l / |e|)| of a boundary edge.
    pub tolerance: f64,
    /// Newton steps at most.
    pub max_iterations: Option<usize>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct FreeMap {
    /// Boundary values (`nb`), up to a rigid motion.
    pub boundary: Vec<Complex64>,
    /// Largest |log (l / |e|)| of the boundary edges.
    pub residual: f64,
    /// Newton steps.
    pub iterations: usize,
    /// How it ended.
    pub status: Status,
}

/// The free map was not found: why, and the start, which is discrete holomorphic.
#[derive(Debug)]
pub struct FreeStalled {
    /// Why.
    pub reason: BoundaryError,
    /// Boundary values (`nb`) of the start.
    pub start: Vec<Complex64>,
}

/// Finds `z = zk + iε(−1)^v (zk − mean zk)` with zk in ker M and |z_{k+1} − z_k| = l_k for all k, by Newton's method on
/// `s_k = log (l_k / |e_k|)`, each step by GMRES, preconditioned by the Riemann–Hilbert solution of the smooth limit.
///
/// ε turns black against white: it takes up `Σ (−1)^k l_k²`, which no map with H = 0 can change.
///
/// # Errors
/// [`FreeStalled`], with the start.
pub fn free_map(problem: &FreeProblem, watch: &mut dyn Observer) -> Result<FreeMap, FreeStalled> {
    let begin = start(problem);
    let stalled = |iterations, residual| FreeStalled {
        reason: BoundaryError::Stalled { iterations, residual },
        start: begin.clone(),
    };
    let mut state = State::new(problem, begin.clone(), 0.0);
    let (mut forcing, mut iterations, mut poor) = (0.1, 0, 0);
    announce(&state, iterations, 0.0, watch);
    let status = loop {
        if !state.size.is_finite() {
            return Err(stalled(iterations, state.largest));
        }
        if state.largest <= problem.tolerance {
            break Status::Converged;
        }
        if watch.stop_requested() {
            break Status::Interrupted;
        }
        if iterations >= problem.max_iterations.unwrap_or(MAX_ITERATIONS) {
            match problem.max_iterations {
                Some(_) => break Status::MaxIterations,
                None => return Err(stalled(iterations, state.largest)),
            }
        }
        let (q, left, _) = gmres(|q| state.change_of_logs(&state.precondition(q)), &state.s, forcing, LONGEST);
        let step = state.precondition(&q);
        let Some((next, t)) = search(problem, &state, &step) else {
            if state.largest < ROUNDING {
                break Status::Precision;
            }
            return Err(stalled(iterations, state.largest));
        };
        // Half-solved systems and short steps may be passing; a row of them is not.
        poor = if left > forcing || next.size > 0.7 * state.size { poor + 1 } else { 0 };
        if poor >= 4 {
            return Err(stalled(iterations, state.largest));
        }
        iterations += 1;
        forcing = (0.5 * (next.size / state.size).powf(1.5)).clamp(1e-3, 0.1);
        let moved = step.dk.iter().map(Complex64::norm_sqr).sum::<f64>().sqrt() * t;
        state = next;
        announce(&state, iterations, moved, watch);
    };
    Ok(FreeMap { residual: state.largest, boundary: state.z, iterations, status })
}

/// ‖s‖ stands in the place of a gradient.
fn announce(state: &State, number: usize, step: f64, watch: &mut dyn Observer) {
    let (h, lb) = (state.h(), state.lb());
    let terms = if watch.wants_terms() { vec![("H", h), ("Lb", lb)] } else { Vec::new() };
    watch.iteration(&Iteration { number, total: h + lb, terms, gradient_norm: state.size, step });
}

/// A change of zk in ker M, and of ε.
struct Step {
    dk: Vec<Complex64>,
    depsilon: f64,
}

/// A boundary and what follows from it.
struct State<'a> {
    reduction: &'a Reduction<'a>,
    zk: Vec<Complex64>,
    epsilon: f64,
    z: Vec<Complex64>,
    /// Edges e_k = z_{k+1} − z_k.
    e: Vec<Complex64>,
    /// (−1)^v i (zk − mean zk), the change with ε, and of the log lengths with it.
    d: Vec<Complex64>,
    sd: Vec<f64>,
    /// log (l / |e|)
    s: Vec<f64>,
    /// ‖s‖₂ and max |s|.
    size: f64,
    largest: f64,
}

impl<'a> State<'a> {
    fn new(problem: &FreeProblem<'a>, zk: Vec<Complex64>, epsilon: f64) -> Self {
        let d = alternating(&zk);
        let z: Vec<Complex64> = zk.iter().zip(&d).map(|(z, d)| z + epsilon * d).collect();
        let e = differences(&z);
        let s: Vec<f64> = problem.lengths.iter().zip(&e).map(|(l, e)| (l / e.norm()).ln()).collect();
        let sd = differences(&d).iter().zip(&e).map(|(d, e)| (d / e).re).collect();
        let size = norm(&s);
        let largest = s.iter().fold(0.0f64, |m, s| m.max(s.abs()));
        State { reduction: problem.reduction, zk, epsilon, z, e, d, sd, s, size, largest }
    }

    /// H, of which ε d has all.
    fn h(&self) -> f64 {
        if self.epsilon == 0.0 {
            return 0.0;
        }
        let m = self.reduction.m(&self.d);
        self.epsilon.powi(2) * self.d.iter().zip(&m).map(|(d, m)| (d.conj() * m).re).sum::<f64>().max(0.0)
    }

    /// L'.
    fn lb(&self) -> f64 {
        let lengths = self.e.iter().zip(&self.s).map(|(e, s)| e.norm() * s.exp());
        let (mut sum, mut perimeter) = (0.0, 0.0);
        for (l, s) in lengths.zip(&self.s) {
            sum += l * ((-2.0 * s).exp_m1()).powi(2);
            perimeter += l;
        }
        sum * perimeter / std::f64::consts::TAU
    }

    /// How the logarithms of the lengths change.
    fn change_of_logs(&self, step: &Step) -> Vec<f64> {
        let turned = alternating(&step.dk);
        let dz: Vec<Complex64> =
            (0..self.z.len()).map(|v| step.dk[v] + step.depsilon * self.d[v] + self.epsilon * turned[v]).collect();
        differences(&dz).iter().zip(&self.e).map(|(d, e)| (d / e).re).collect()
    }

    /// The step that changes the log lengths by about q: in the smooth limit, e times a holomorphic function whose real part
    /// is q; what alternates from edge to edge, by a holomorphic function Ψ of the black against the white.
    fn precondition(&self, q: &[f64]) -> Step {
        let n = q.len();
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let squares = |k: usize| sign(k) * self.e[k].norm_sqr();
        let of_q: f64 = (0..n).map(|k| squares(k) * q[k]).sum();
        let of_sd: f64 = (0..n).map(|k| squares(k) * self.sd[k]).sum();
        let depsilon = if of_sd != 0.0 { of_q / of_sd } else { 0.0 };
        let q: Vec<f64> = q.iter().zip(&self.sd).map(|(q, sd)| q - depsilon * sd).collect();
        // a and R as one complex function: one product for both.
        let mut r = vec![0.0; n];
        for k in 0..n - 1 {
            r[k + 1] = r[k] - 0.5 * squares(k) * q[k];
        }
        let mean = r.iter().sum::<f64>() / n as f64;
        let both: Vec<Complex64> =
            (0..n).map(|v| Complex64::new(0.5 * (q[(v + n - 1) % n] + q[v]), r[v] - mean)).collect();
        let conjugate = hil(self.reduction, &both);
        let h: Vec<Complex64> = (0..n).map(|v| Complex64::new(both[v].re, conjugate[v].re)).collect();
        let psi: Vec<Complex64> = (0..n).map(|v| Complex64::new(both[v].im, conjugate[v].im)).collect();
        let edges: Vec<Complex64> = (0..n).map(|k| 0.5 * self.e[k] * (h[k] + h[(k + 1) % n])).collect();
        let mut dz = integrated(&edges, &self.e);
        for (v, dz) in dz.iter_mut().enumerate() {
            let (next, previous) = ((v + 1) % n, (v + n - 1) % n);
            *dz += sign(v) * ((psi[next] - psi[previous]) / (self.z[next] - self.z[previous])).conj();
        }
        Step { dk: project(self.reduction, &dz), depsilon }
    }
}

/// The longest of the halved steps that lowers ‖s‖, and its length.
fn search<'a>(problem: &FreeProblem<'a>, state: &State<'a>, step: &Step) -> Option<(State<'a>, f64)> {
    let (edges, changes) = (differences(&state.zk), differences(&step.dk));
    let relative: Vec<Complex64> = changes.iter().zip(&edges).map(|(d, e)| d / e).collect();
    let largest = relative.iter().fold(0.0f64, |m, r| m.max(r.norm()));
    let mut t = 1.0;
    for _ in 0..12 {
        let zk = if t * largest > ADDED {
            let edges: Vec<Complex64> = edges.iter().zip(&relative).map(|(e, r)| e * (t * r).exp()).collect();
            let moved = integrated(&edges, &edges);
            let shift = state.zk[0];
            project(problem.reduction, &moved.iter().map(|z| z + shift).collect::<Vec<_>>())
        } else {
            state.zk.iter().zip(&step.dk).map(|(z, d)| z + t * d).collect()
        };
        let next = State::new(problem, zk, state.epsilon + t * step.depsilon);
        if next.size < (1.0 - 1e-4 * t) * state.size {
            return Some((next, t));
        }
        t *= 0.5;
    }
    None
}

/// z_{k+1} − z_k around the boundary.
fn differences(z: &[Complex64]) -> Vec<Complex64> {
    (0..z.len()).map(|k| z[(k + 1) % z.len()] - z[k]).collect()
}

/// i(−1)^v (z − mean z)
fn alternating(z: &[Complex64]) -> Vec<Complex64> {
    let mean = z.iter().sum::<Complex64>() / z.len() as f64;
    let turned = |(v, z): (usize, &Complex64)| if v % 2 == 0 { Complex64::I } else { -Complex64::I } * (z - mean);
    z.iter().enumerate().map(turned).collect()
}

/// The sums of the edges from 0 on; what does not close up is spread over them like `weights`' lengths.
fn integrated(edges: &[Complex64], weights: &[Complex64]) -> Vec<Complex64> {
    let gap = edges.iter().sum::<Complex64>() / weights.iter().map(|e| e.norm()).sum::<f64>();
    let mut place = Complex64::ZERO;
    let step = |(e, w): (&Complex64, &Complex64)| {
        let here = place;
        place += e - gap * w.norm();
        here
    };
    edges.iter().zip(weights).map(step).collect()
}
