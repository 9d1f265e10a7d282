//! The linearised problem and its solution by conjugate gradients on the normal equations.

use std::ops::Range;

use num_complex::Complex64;

use super::mismatch::Mismatch;
use super::precondition::Preconditioner;
use super::state::{State, keep_closed};
use super::{Keep, Layout};

/// Products with the matrix in one solution at most.
const LONGEST: usize = 200;

/// The residuals `(λ √(l/Σl) s, mismatch)` as a function of the edges' logarithms, linearised at a state, in the coordinates y of the
/// [`Preconditioner`].
pub(super) struct Linearised<'a, 'b> {
    mismatch: &'b mut Mismatch<'a>,
    preconditioner: Preconditioner,
    loops: &'a [Range<usize>],
    keep: &'b [Keep],
    /// λ √(l_k / Σ l); 0 where lengths are kept exactly.
    weight: Vec<f64>,
    edges: Vec<Complex64>,
}

impl<'a, 'b> Linearised<'a, 'b> {
    pub fn new(mismatch: &'b mut Mismatch<'a>, layout: &Layout, loops: &'a [Range<usize>], keep: &'b [Keep]) -> Self {
        let whole: f64 = layout.length.iter().sum();
        let mut weight = vec![0.0; layout.length.len()];
        for (range, keep) in loops.iter().zip(keep) {
            if let Keep::Drawn(lambda) = keep {
                range.clone().for_each(|k| weight[k] = lambda * (layout.length[k] / whole).sqrt());
            }
        }
        let preconditioner = Preconditioner::new(layout, loops, keep);
        Linearised { mismatch, preconditioner, loops, keep, weight, edges: Vec::new() }
    }

    /// Moves to a state.
    pub fn at(&mut self, state: &State) {
        self.edges.clone_from(&state.edges);
    }

    /// The residuals of a state: real and imaginary parts of the mismatch, and the log scales (3n).
    pub fn residual(&mut self, state: &State) -> Vec<f64> {
        let scales: Vec<f64> = state.log_scales().zip(&self.weight).map(|(s, w)| s * w).collect();
        stacked(&self.mismatch.of(&state.edges), scales)
    }

    /// The change u of the edges' logarithms for coordinates y; loops stay closed.
    fn change(&self, y: &[f64]) -> Vec<Complex64> {
        let mut u = self.preconditioner.apply(y);
        self.keep_closed(&mut u);
        u
    }

    fn keep_closed(&self, u: &mut [Complex64]) {
        for (range, keep) in self.loops.iter().zip(self.keep) {
            keep_closed(&mut u[range.clone()], &self.edges[range.clone()], *keep);
        }
    }

    /// J y, given the change u that y makes.
    fn image(&mut self, u: &[Complex64]) -> Vec<f64> {
        let edges: Vec<Complex64> = self.edges.iter().zip(u).map(|(e, u)| e * u).collect();
        let scales = u.iter().zip(&self.weight).map(|(u, w)| u.re * w).collect();
        stacked(&self.mismatch.of(&edges), scales)
    }

    /// Jᵀ r
    pub fn transposed(&mut self, r: &[f64]) -> Vec<f64> {
        let n = self.edges.len();
        let complex: Vec<Complex64> = (0..n).map(|k| Complex64::new(r[k], r[n + k])).collect();
        let mut u = self.mismatch.adjoint(&complex);
        for (k, u) in u.iter_mut().enumerate() {
            *u = self.edges[k].conj() * *u + self.weight[k] * r[2 * n + k];
        }
        self.keep_closed(&mut u);
        self.preconditioner.transposed(&u)
    }

    /// The change that makes |r + J y| least, to `|Jᵀ (r + J y)| ≤ tolerance |Jᵀ r|`, or as far as the iterates change no edge by more
    /// than `radius`; `gradient` is `Jᵀ r`.
    pub fn solve(&mut self, r: &[f64], gradient: &[f64], tolerance: f64, radius: f64) -> Step {
        let mut step = Step {
            change: vec![Complex64::ZERO; self.edges.len()],
            largest: 0.0,
            gain: 0.0,
            products: 0,
            is_cut: false,
        };
        let mut rest: Vec<f64> = r.iter().map(|r| -r).collect();
        let mut p: Vec<f64> = gradient.iter().map(|g| -g).collect();
        let mut square = dot(&p, &p);
        let target = square * tolerance * tolerance;
        for _ in 0..LONGEST {
            let u = self.change(&p);
            let q = self.image(&u);
            step.products += 1;
            let alpha = square / dot(&q, &q);
            if !alpha.is_finite() {
                break;
            }
            let part = step.part_within(radius, &u, alpha);
            step.change.iter_mut().zip(&u).for_each(|(c, u)| *c += part * alpha * u);
            step.gain += part * (2.0 - part) * alpha * square;
            if part < 1.0 {
                step.is_cut = true;
                break;
            }
            rest.iter_mut().zip(&q).for_each(|(r, q)| *r -= alpha * q);
            let s = self.transposed(&rest);
            let next = dot(&s, &s);
            if next <= target {
                break;
            }
            let beta = next / square;
            square = next;
            p.iter_mut().zip(&s).for_each(|(p, s)| *p = s + beta * *p);
        }
        step.largest = step.change.iter().map(|u| u.norm()).fold(0.0, f64::max);
        step
    }
}

/// A step of Gauss and Newton.
pub(super) struct Step {
    /// The change of the edges' logarithms (n).
    pub change: Vec<Complex64>,
    /// The largest of them.
    pub largest: f64,
    /// What it takes from |r|² in the linear model.
    pub gain: f64,
    /// Products with J that it took.
    pub products: usize,
    /// Whether it ends where an edge would change by more than is allowed.
    pub is_cut: bool,
}

impl Step {
    /// The largest part t ≤ 1 of `alpha u` that can be added with no change beyond `radius`.
    fn part_within(&self, radius: f64, u: &[Complex64], alpha: f64) -> f64 {
        // |c + t a u| = radius
        let of_edge = |(c, u): (&Complex64, &Complex64)| {
            let a = alpha * u;
            let (square, mixed) = (a.norm_sqr(), (c.conj() * a).re);
            let left = (radius * radius - c.norm_sqr()).max(0.0);
            match square > 0.0 {
                true => ((mixed * mixed + square * left).sqrt() - mixed) / square,
                false => 1.0,
            }
        };
        self.change.iter().zip(u).map(of_edge).fold(1.0, f64::min)
    }
}

/// Real parts, imaginary parts, scales.
fn stacked(mismatch: &[Complex64], scales: Vec<f64>) -> Vec<f64> {
    let parts = mismatch.iter().map(|r| r.re).chain(mismatch.iter().map(|r| r.im));
    parts.chain(scales).collect()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Euclidean norm.
pub(super) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}
