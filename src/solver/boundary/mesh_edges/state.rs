//! Closed boundary loops of given lengths.

use std::ops::Range;

use num_complex::Complex64;

use super::{Keep, Layout};

/// Edges `e_k = l_k exp(s_k + iθ_k)` of which every loop closes.
#[derive(Clone, Debug)]
pub(super) struct State {
    /// `s_k + iθ_k` (n); s = 0 where lengths are kept exactly.
    pub logs: Vec<Complex64>,
    /// e (n).
    pub edges: Vec<Complex64>,
}

/// A loop counts as closed where its ends are this near, relative to its length.
const CLOSED: f64 = 1e-15;
/// Newton steps to close a loop, and what one may turn an edge by.
const CLOSING: usize = 60;
const LARGEST_TURN: f64 = 0.3;

impl State {
    /// The nearest closed loops; `None` where they are not found.
    pub fn new(layout: &Layout, loops: &[Range<usize>], keep: &[Keep], mut logs: Vec<Complex64>) -> Option<Self> {
        let mut edges = edges(layout, &logs);
        for (range, keep) in loops.iter().zip(keep) {
            close(&layout.length[range.clone()], *keep, &mut logs[range.clone()], &mut edges[range.clone()])?;
        }
        Some(State { logs, edges })
    }

    /// The state at `logs + t change`, closed again.
    pub fn moved(
        &self,
        layout: &Layout,
        loops: &[Range<usize>],
        keep: &[Keep],
        change: &[Complex64],
        t: f64,
    ) -> Option<Self> {
        State::new(layout, loops, keep, self.logs.iter().zip(change).map(|(l, u)| l + t * u).collect())
    }

    /// s (n).
    pub fn log_scales(&self) -> impl Iterator<Item = f64> {
        self.logs.iter().map(|l| l.re)
    }
}

fn edges(layout: &Layout, logs: &[Complex64]) -> Vec<Complex64> {
    layout.length.iter().zip(logs).map(|(l, log)| l * log.exp()).collect()
}

/// Closes one loop by Newton's method, each step the least in its square sum.
fn close(length: &[f64], keep: Keep, logs: &mut [Complex64], edges: &mut [Complex64]) -> Option<()> {
    let whole: f64 = length.iter().sum();
    // No sum of so many numbers is nearer to 0.
    let near = whole * CLOSED.max(f64::EPSILON * (length.len() as f64).sqrt());
    let mut last = f64::INFINITY;
    for _ in 0..CLOSING {
        let gap: Complex64 = edges.iter().sum();
        if gap.norm() <= near || (gap.norm() < 1e-12 * whole && gap.norm() >= last) {
            return Some(());
        }
        last = gap.norm();
        let mut change = vec![Complex64::ZERO; edges.len()];
        take_from(&mut change, edges, keep, gap);
        let largest = change.iter().map(|u| u.norm()).fold(0.0, f64::max);
        let t = (LARGEST_TURN / largest).min(1.0);
        for ((log, edge), (u, l)) in logs.iter_mut().zip(edges.iter_mut()).zip(change.iter().zip(length)) {
            *log += t * u;
            *edge = l * log.exp();
        }
    }
    None
}

/// The orthogonal projection of changes u of the logarithms to those that leave a loop closed, `Σ e u = 0`.
pub(super) fn keep_closed(u: &mut [Complex64], edges: &[Complex64], keep: Keep) {
    if keep == Keep::Exactly {
        u.iter_mut().for_each(|u| u.re = 0.0);
    }
    let opened = edges.iter().zip(u.iter()).map(|(e, u)| e * u).sum();
    take_from(u, edges, keep, opened);
}

/// Adds to u the change of least square sum that makes `Σ e u` less by `gap`.
fn take_from(u: &mut [Complex64], edges: &[Complex64], keep: Keep, gap: Complex64) {
    match keep {
        Keep::Drawn(_) => {
            let squares: f64 = edges.iter().map(|e| e.norm_sqr()).sum();
            u.iter_mut().zip(edges).for_each(|(u, e)| *u -= e.conj() * gap / squares);
        }
        Keep::Exactly => {
            // Σ i e θ = gap in two reals, θ = Re(p̄ i e) for one complex p.
            let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
            for e in edges {
                (xx, xy, yy) = (xx + e.im * e.im, xy - e.im * e.re, yy + e.re * e.re);
            }
            let determinant = xx * yy - xy * xy;
            let p = Complex64::new(yy * gap.re - xy * gap.im, xx * gap.im - xy * gap.re) / determinant;
            if p.is_finite() {
                u.iter_mut().zip(edges).for_each(|(u, e)| u.im -= -p.re * e.im + p.im * e.re);
            }
        }
    }
}
