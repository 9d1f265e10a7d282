//! Coordinates in which the linearised problem is near to an isometry.

use std::ops::Range;
use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};

use super::{Keep, Layout};

/// The change `u = P y` of the logarithms of the edges: loop by loop
///
/// ```text
/// u = i F y           lengths kept exactly (n reals y)
/// u = (x + i Hil x) / λ + i F y     lengths drawn (n reals x, then n reals y)
/// ```
///
/// # Rationale
/// In the smooth limit a change θ of directions makes a mismatch of the antiholomorphic part of the integral of `e iθ`: F, of symbol
/// `2 |sin πm/n|`, undoes the integration. Where lengths are free too, `1 + i Hil` makes holomorphic changes, which lengths alone see.
pub(super) struct Preconditioner {
    loops: Vec<Loop>,
    /// √(Σ l / l_k)
    scale: Vec<f64>,
}

struct Loop {
    range: Range<usize>,
    lambda: Option<f64>,
    /// Where its unknowns begin.
    first: usize,
    forward: Arc<dyn RealToComplex<f64>>,
    backward: Arc<dyn ComplexToReal<f64>>,
    /// F's symbol with the factor that transforms leave.
    symbol: Vec<f64>,
}

impl Preconditioner {
    pub fn new(layout: &Layout, loops: &[Range<usize>], keep: &[Keep]) -> Self {
        let whole: f64 = layout.length.iter().sum();
        let scale = layout.length.iter().map(|l| (whole / l).sqrt()).collect();
        let mut planner = RealFftPlanner::new();
        let mut first = 0;
        let one = |(c, (range, keep)): (usize, (&Range<usize>, &Keep))| {
            let n = range.len();
            let lambda = match *keep {
                Keep::Exactly => None,
                Keep::Drawn(lambda) => Some(lambda),
            };
            let sine = |m: usize| 2.0 * (std::f64::consts::PI * m as f64 / n as f64).sin();
            // A rotation of the whole is no change; one of a hole against the rest is.
            let symbol = |m: usize| if m == 0 && c > 0 { sine(1) } else { sine(m) };
            let begin = first;
            first += if lambda.is_some() { 2 * n } else { n };
            Loop {
                range: range.clone(),
                lambda,
                first: begin,
                forward: planner.plan_fft_forward(n),
                backward: planner.plan_fft_inverse(n),
                symbol: (0..n / 2 + 1).map(|m| symbol(m) / n as f64).collect(),
            }
        };
        let loops = loops.iter().zip(keep).enumerate().map(one).collect();
        Preconditioner { loops, scale }
    }

    /// P y
    pub fn apply(&self, y: &[f64]) -> Vec<Complex64> {
        let mut u = vec![Complex64::ZERO; self.scale.len()];
        for part in &self.loops {
            let n = part.range.len();
            let scaled = |at: usize| {
                let of_loop = y[at..at + n].iter().zip(&self.scale[part.range.clone()]);
                of_loop.map(|(y, s)| y * s).collect::<Vec<f64>>()
            };
            let mut at = part.first;
            if let Some(lambda) = part.lambda {
                let x = scaled(at);
                for ((u, x), y) in u[part.range.clone()].iter_mut().zip(&x).zip(part.conjugate(&x)) {
                    *u += Complex64::new(*x, y) / lambda;
                }
                at += n;
            }
            for (u, y) in u[part.range.clone()].iter_mut().zip(part.differentiate(&scaled(at))) {
                u.im += y;
            }
        }
        u
    }

    /// Pᵀ g, the inner product of u being that of real and imaginary parts.
    pub fn transposed(&self, g: &[Complex64]) -> Vec<f64> {
        let mut y = Vec::with_capacity(2 * g.len());
        for part in &self.loops {
            let g = &g[part.range.clone()];
            let scale = &self.scale[part.range.clone()];
            let turned: Vec<f64> = g.iter().map(|g| g.im).collect();
            if let Some(lambda) = part.lambda {
                let conjugate = part.conjugate(&turned);
                y.extend(g.iter().zip(conjugate).zip(scale).map(|((g, h), s)| (g.re - h) * s / lambda));
            }
            y.extend(part.differentiate(&turned).iter().zip(scale).map(|(y, s)| y * s));
        }
        y
    }
}

impl Loop {
    /// F y
    fn differentiate(&self, y: &[f64]) -> Vec<f64> {
        self.convolve(y, |m, z| z * self.symbol[m])
    }

    /// Hil x, the boundary values of the conjugate function.
    fn conjugate(&self, x: &[f64]) -> Vec<f64> {
        let n = x.len();
        let turn = |m: usize, z: Complex64| match m {
            0 => Complex64::ZERO,
            m if 2 * m == n => Complex64::ZERO,
            _ => -Complex64::I * z / n as f64,
        };
        self.convolve(x, turn)
    }

    fn convolve(&self, x: &[f64], symbol: impl Fn(usize, Complex64) -> Complex64) -> Vec<f64> {
        let mut input = x.to_vec();
        let mut spectrum = self.forward.make_output_vec();
        let mut output = vec![0.0; x.len()];
        // Lengths are those planned for, and the ends of the spectrum stay real.
        let forward = self.forward.process(&mut input, &mut spectrum);
        for (m, z) in spectrum.iter_mut().enumerate() {
            *z = symbol(m, *z);
        }
        if forward.and_then(|()| self.backward.process(&mut spectrum, &mut output)).is_err() {
            output.fill(0.0);
        }
        output
    }
}
