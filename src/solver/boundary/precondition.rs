use std::f64::consts::TAU;
use std::sync::Arc;

use nalgebra::{DMatrix, DVector};
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

/// An approximate inverse of the Hessian of H for boundary angles, those at the pins held.
///
/// In the smooth limit the Hessian is a convolution along the boundary with symbol `∝ |sin 2πk/n|` (0 at k = n/2 too: black
/// against white) but for its kernel, the Möbius group: V = span{1, cos θ, sin θ}. With T the convolution with the
/// inverse symbol, and Q the projection along V on angles that vanish at the pins, it is `Q T Qᵀ`.
pub(super) struct Preconditioner {
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    /// Of T, with the factor that the transforms leave.
    multiplier: Vec<f64>,
    pins: Vec<usize>,
    /// V (columns) and the pseudo-inverse of its rows at the pins.
    kernel: Vec<Vec<f64>>,
    at_pins: DMatrix<f64>,
}

impl Preconditioner {
    /// For `n` boundary angles with these pins.
    pub fn new(n: usize, pins: Vec<usize>) -> Self {
        let mut planner = RealFftPlanner::new();
        let lowest = (TAU / n as f64).sin().abs().max(f64::EPSILON);
        let symbol = |k: usize| (TAU * k as f64 / n as f64).sin().abs().max(lowest);
        Preconditioner {
            forward: planner.plan_fft_forward(n),
            backward: planner.plan_fft_inverse(n),
            multiplier: (0..n / 2 + 1).map(|k| 1.0 / (n as f64 * symbol(k))).collect(),
            pins,
            kernel: Vec::new(),
            at_pins: DMatrix::zeros(0, 0),
        }
    }

    /// Adapts V to the angles.
    pub fn update(&mut self, theta: &[f64]) {
        let Some(&first) = self.pins.first() else { return };
        let functions: [fn(f64) -> f64; 3] = [|_| 1.0, f64::cos, f64::sin];
        let count = self.pins.len().min(3);
        self.kernel = functions[..count].iter().map(|f| theta.iter().map(|t| f(t - theta[first])).collect()).collect();
        let rows = DMatrix::from_fn(self.pins.len(), count, |i, j| self.kernel[j][self.pins[i]]);
        self.at_pins = rows.clone().pseudo_inverse(1e-12).unwrap_or_else(|_| DMatrix::zeros(count, rows.nrows()));
    }

    /// Q T Qᵀ r; r is 0 at the pins.
    pub fn apply(&self, r: &[f64]) -> Vec<f64> {
        let mut x = r.to_vec();
        if !self.kernel.is_empty() {
            let dots = DVector::from_iterator(self.kernel.len(), self.kernel.iter().map(|v| super::cg::dot(v, r)));
            let loads = self.at_pins.transpose() * dots;
            for (&pin, load) in self.pins.iter().zip(loads.iter()) {
                x[pin] -= load;
            }
        }
        self.convolve(&mut x);
        if !self.kernel.is_empty() {
            let values = DVector::from_iterator(self.pins.len(), self.pins.iter().map(|&pin| x[pin]));
            let shares = &self.at_pins * values;
            for (v, share) in self.kernel.iter().zip(shares.iter()) {
                x.iter_mut().zip(v).for_each(|(x, v)| *x -= share * v);
            }
            for &pin in &self.pins {
                x[pin] = 0.0;
            }
        }
        x
    }

    fn convolve(&self, x: &mut [f64]) {
        let mut spectrum = self.forward.make_output_vec();
        // The lengths are those of the plan: neither transform can fail.
        if self.forward.process(x, &mut spectrum).is_ok() {
            spectrum.iter_mut().zip(&self.multiplier).for_each(|(s, m)| *s *= m);
            if let Some(last) = spectrum.last_mut().filter(|_| x.len().is_multiple_of(2)) {
                last.im = 0.0;
            }
            spectrum[0].im = 0.0;
            let _ = self.backward.process(&mut spectrum, x);
        }
    }
}
