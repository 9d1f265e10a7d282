use std::f64::consts::TAU;

/// `−t Σ log (θ_{k+1} − θ_k)` over the boundary edges: keeps the angles in order.
pub(super) struct Barrier {
    /// t.
    pub strength: f64,
}

impl Barrier {
    /// The strengths of the stages for `n` angles, in units in which an even gap bends as stiffly as H at its stiffest.
    pub fn stages(n: usize) -> Vec<f64> {
        let even = TAU / n as f64;
        [1e-1, 1e-3, 1e-5].iter().map(|share| share * even * even).collect()
    }

    /// The value; +∞ out of order.
    pub fn value(&self, theta: &[f64]) -> f64 {
        let logs = gaps(theta).map(|gap| if gap > 0.0 { gap.ln() } else { f64::NEG_INFINITY });
        -self.strength * logs.sum::<f64>()
    }

    /// Adds the gradient.
    pub fn add_gradient(&self, theta: &[f64], gradient: &mut [f64]) {
        let n = theta.len();
        for (k, gap) in gaps(theta).enumerate() {
            gradient[k] += self.strength / gap;
            gradient[(k + 1) % n] -= self.strength / gap;
        }
    }

    /// The Hessian's coupling of each angle with the next.
    pub fn couplings(&self, theta: &[f64]) -> Vec<f64> {
        gaps(theta).map(|gap| self.strength / (gap * gap)).collect()
    }

    /// Adds the product of the Hessian with `d`.
    pub fn add_product(couplings: &[f64], d: &[f64], product: &mut [f64]) {
        let n = d.len();
        for (k, coupling) in couplings.iter().enumerate() {
            let pull = coupling * (d[(k + 1) % n] - d[k]);
            product[k] -= pull;
            product[(k + 1) % n] += pull;
        }
    }

    /// The largest part of the step `d` that keeps a twentieth of every gap, 1 at most.
    pub fn longest(theta: &[f64], d: &[f64]) -> f64 {
        let n = d.len();
        let limits = gaps(theta).enumerate().map(|(k, gap)| {
            let closing = d[k] - d[(k + 1) % n];
            if closing > 0.0 { 0.95 * gap / closing } else { 1.0 }
        });
        limits.fold(1.0, f64::min)
    }
}

fn gaps(theta: &[f64]) -> impl Iterator<Item = f64> + '_ {
    let n = theta.len();
    (0..n).map(move |k| if k + 1 < n { theta[k + 1] - theta[k] } else { theta[0] + TAU - theta[k] })
}

/// Solves `(½ + B) x = r`, B the barrier's Hessian with the pins cut out: chains between the pins, which end at 0.
pub(super) fn solve_chains(couplings: &[f64], pins: &[usize], r: &[f64]) -> Vec<f64> {
    let n = r.len();
    let mut x = vec![0.0; n];
    let (mut above, mut right) = (vec![0.0; n], vec![0.0; n]);
    for (i, &first) in pins.iter().enumerate() {
        let last = pins.get(i + 1).copied().unwrap_or(pins[0] + n);
        // Thomas' algorithm on first + 1 .. last.
        let (mut previous_above, mut previous_right) = (0.0, 0.0);
        for k in first + 1..last {
            let (here, below) = (k % n, couplings[(k - 1) % n]);
            let pivot = 0.5 + below + couplings[here] - below * previous_above;
            above[here] = couplings[here] / pivot;
            right[here] = (r[here] + below * previous_right) / pivot;
            (previous_above, previous_right) = (above[here], right[here]);
        }
        let mut next = 0.0;
        for k in (first + 1..last).rev() {
            let here = k % n;
            next = right[here] + above[here] * next;
            x[here] = next;
        }
    }
    x
}
