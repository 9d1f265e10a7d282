//! The linearised problem of the two circles, solved as in the smooth limit.

use std::sync::Arc;

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::{Step, sign};

/// An approximate inverse of the Jacobian of the two circles at z, as a right preconditioner.
///
/// Residuals r/|z| are split into a smooth part `(r_{v−1} + 2 r_v + r_{v+1})/4` and an alternating one. With u = z/|z|, and
/// `h = a + i Hil a` the boundary values of a holomorphic function of real part a, the first is met by `u h` and the second by
/// the antiholomorphic `± u h̄`, its mean by ε. The Möbius fields `iu, 1 − u², i(1 + u²)` then meet the pins.
pub(super) struct RiemannHilbert<'a> {
    z: &'a [Complex64],
    u: Vec<Complex64>,
    anchors: &'a [(usize, f64)],
    /// The inverse of the Möbius fields' part across the pins' rays.
    at_pins: Matrix3<f64>,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
}

/// The Möbius fields of the disc at a point of the circle.
pub(super) fn moebius_fields(u: Complex64) -> [Complex64; 3] {
    [Complex64::I * u, 1.0 - u * u, Complex64::I * (1.0 + u * u)]
}

impl<'a> RiemannHilbert<'a> {
    /// `None` where two pins coincide to rounding.
    pub fn new(z: &'a [Complex64], anchors: &'a [(usize, f64)]) -> Option<Self> {
        let u: Vec<Complex64> = z.iter().map(|z| z / z.norm()).collect();
        let entry = |p: usize, field: usize| {
            let (v, angle) = anchors[p];
            (Complex64::cis(-angle) * moebius_fields(u[v])[field]).im
        };
        let at_pins = Matrix3::from_fn(entry).try_inverse()?;
        let mut planner = RealFftPlanner::new();
        let (forward, backward) = (planner.plan_fft_forward(z.len()), planner.plan_fft_inverse(z.len()));
        Some(RiemannHilbert { z, u, anchors, at_pins, forward, backward })
    }

    /// A step whose derivative is nearly q (2n + 3). Its white values are those of the smooth limit.
    pub fn solve(&self, q: &[f64]) -> Step {
        let m = self.z.len();
        let r: Vec<f64> = q[..m].iter().zip(self.z).map(|(q, z)| q / z.norm()).collect();
        let around = |v: usize| r[(v + m - 1) % m] + r[(v + 1) % m];
        let smooth: Vec<f64> = (0..m).map(|v| 0.25 * (2.0 * r[v] + around(v))).collect();
        let mut alternating: Vec<f64> = (0..m).map(|v| 0.25 * sign(v) * (2.0 * r[v] - around(v))).collect();
        let mean = alternating.iter().sum::<f64>() / m as f64;
        alternating.iter_mut().for_each(|r| *r -= mean);
        let (conjugate, other) = (self.conjugate(&smooth), self.conjugate(&alternating));
        let point = |v: usize| {
            let holomorphic = Complex64::new(smooth[v], conjugate[v]);
            let antiholomorphic = Complex64::new(alternating[v], -other[v]);
            self.u[v] * (holomorphic + sign(v) * antiholomorphic)
        };
        let mut z: Vec<Complex64> = (0..m).map(point).collect();
        let missing = |p: usize| {
            let (v, angle) = self.anchors[p];
            q[m + p] - (Complex64::cis(-angle) * z[v]).im
        };
        let shares = self.at_pins * Vector3::from_fn(|p, _| missing(p));
        for (z, &u) in z.iter_mut().zip(&self.u) {
            *z += moebius_fields(u).iter().zip(shares.iter()).map(|(field, share)| share * field).sum::<Complex64>();
        }
        Step { z, epsilon: -2.0 * mean }
    }

    /// Hil a: the imaginary part, of mean 0, of the holomorphic function with real part a.
    fn conjugate(&self, a: &[f64]) -> Vec<f64> {
        let mut a = a.to_vec();
        let mut spectrum = self.forward.make_output_vec();
        // The lengths are those of the plans: neither transform can fail.
        let _ = self.forward.process(&mut a, &mut spectrum);
        let scale = 1.0 / a.len() as f64;
        spectrum.iter_mut().for_each(|c| *c = Complex64::new(scale * c.im, -scale * c.re));
        spectrum[0] = Complex64::ZERO;
        if let Some(last) = spectrum.last_mut() {
            *last = Complex64::ZERO;
        }
        let _ = self.backward.process(&mut spectrum, &mut a);
        a
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;

    fn even(n: usize) -> impl Iterator<Item = f64> {
        (0..n).map(move |k| TAU * k as f64 / n as f64)
    }

    #[test]
    fn the_step_of_the_identity_has_the_derivative_that_is_asked_for() {
        // On the circle itself the smooth limit is exact: both parts are met to rounding, and the pins.
        let m = 48;
        let z: Vec<Complex64> = even(m).map(Complex64::cis).collect();
        let anchors = [0, m / 3, 2 * (m / 3)].map(|v| (v, TAU * v as f64 / m as f64));
        let hilbert = RiemannHilbert::new(&z, &anchors).unwrap_or_else(|| panic!("the pins differ"));
        let asked = [0.1, -0.2, 0.3];
        let waves = even(m).enumerate().map(|(v, t)| t.cos() + sign(v) * (0.3 + (2.0 * t).sin()));
        let q: Vec<f64> = waves.chain(asked).collect();
        let step = hilbert.solve(&q);
        for v in 0..m {
            let got = (z[v].conj() * step.z[v]).re - 0.5 * sign(v) * step.epsilon;
            assert!((got - q[v]).abs() < 1e-14, "{v}: {got} in place of {}", q[v]);
        }
        for (&(v, angle), asked) in anchors.iter().zip(asked) {
            assert!(((Complex64::cis(-angle) * step.z[v]).im - asked).abs() < 1e-14, "{v}");
        }
    }
}
