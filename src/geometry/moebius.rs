//! Möbius maps, in particular those of the disc to itself.

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

/// Longest step of the fit; |c| < 1 keeps the disc invariant.
const LONGEST_STEP: f64 = 0.5;

/// Largest number of halvings of a step.
const HALVINGS: i32 = 30;

/// A Möbius map `z ↦ (a z + b)/(c z + d)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moebius([Complex64; 4]);

/// A Möbius map is not determined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MoebiusError {
    /// Two of three points coincide.
    #[error("a Möbius map through three points needs three different points and three different images")]
    Coincident,
    /// There are too few different points to fit the three parameters.
    #[error("no Möbius map of the disc can be fitted to {points} points")]
    Undetermined {
        /// Number of points.
        points: usize,
    },
}

impl Moebius {
    /// The identity.
    pub const IDENTITY: Moebius =
        Moebius([Complex64::new(1.0, 0.0), Complex64::ZERO, Complex64::ZERO, Complex64::new(1.0, 0.0)]);

    /// Returns the map that takes z_k to w_k. It maps the disc to itself if both triples lie on the
    /// circle in the same order.
    ///
    /// # Errors
    /// [`MoebiusError::Coincident`].
    pub fn through(z: [Complex64; 3], w: [Complex64; 3]) -> Result<Self, MoebiusError> {
        let apart = |p: [Complex64; 3]| p[0] != p[1] && p[1] != p[2] && p[2] != p[0];
        if !(apart(z) && apart(w)) {
            return Err(MoebiusError::Coincident);
        }
        // Takes z0, z1, z2 to 0, 1, ∞.
        let standard = |[p, q, r]: [Complex64; 3]| Moebius([q - r, -p * (q - r), q - p, -r * (q - p)]);
        let Moebius([a, b, c, d]) = standard(w);
        Ok(Moebius([d, -b, -c, a]).after(&standard(z)))
    }

    /// Fits the map of the disc to itself that minimises `Σ |M(z_k) − w_k|²`.
    ///
    /// Gauss–Newton iteration from `self` over the parameters of `z ↦ e^{iα}(z + c)/(1 + c̄ z)`,
    /// until the sum no longer decreases.
    ///
    /// # Errors
    /// [`MoebiusError::Undetermined`].
    pub fn fitted(self, z: &[Complex64], w: &[Complex64]) -> Result<Self, MoebiusError> {
        let undetermined = MoebiusError::Undetermined { points: z.len().min(w.len()) };
        let sum = |map: &Moebius| z.iter().zip(w).map(|(&z, &w)| (map.at(z) - w).norm_sqr()).sum::<f64>();
        let (mut best, mut least) = (self, sum(&self));
        // Convergence is quadratic near w = M(z); from far away the iteration may have to follow a
        // valley.
        for _ in 0..1000 {
            let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
            for (&z, &w) in z.iter().zip(w) {
                let z = best.at(z);
                // M(z) ≈ z + iα z + c − c̄ z².
                let columns = [Complex64::I * z, 1.0 - z * z, Complex64::I * (1.0 + z * z)];
                let real = [columns.map(|c| c.re), columns.map(|c| c.im)].map(Vector3::from);
                for (row, r) in real.iter().zip([(w - z).re, (w - z).im]) {
                    matrix += row * row.transpose();
                    right += row * r;
                }
            }
            let step = matrix.cholesky().ok_or(undetermined)?.solve(&right);
            let size = step.norm();
            if !size.is_finite() {
                return Err(undetermined);
            }
            let step = step * (LONGEST_STEP / size).min(1.0);
            // From far away the full step can increase the sum.
            let shorter = (0..HALVINGS).map(|k| step * 0.5f64.powi(k)).find_map(|step| {
                let next = Moebius::of_disc(step[0], Complex64::new(step[1], step[2])).after(&best);
                let value = sum(&next);
                (value < least).then_some((next, value))
            });
            // At the minimum only rounding is left.
            let Some(lower) = shorter else { break };
            (best, least) = lower;
        }
        Ok(best)
    }

    /// Returns the map `z ↦ e^{iα}(z + c)/(1 + c̄ z)` of the disc to itself, |c| < 1.
    pub fn of_disc(alpha: f64, c: Complex64) -> Self {
        let turn = Complex64::cis(alpha);
        Moebius([turn, turn * c, c.conj(), Complex64::new(1.0, 0.0)])
    }

    /// Returns M(z); not finite at the pole.
    pub fn at(&self, z: Complex64) -> Complex64 {
        let Moebius([a, b, c, d]) = self;
        (a * z + b) / (c * z + d)
    }

    /// Returns the composition `z ↦ self(first(z))`, with a determinant of absolute value 1.
    #[must_use]
    pub fn after(&self, first: &Moebius) -> Self {
        let (Moebius([a, b, c, d]), Moebius([e, f, g, h])) = (self, first);
        let product = [a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h];
        let scale = (product[0] * product[3] - product[1] * product[2]).norm().sqrt();
        Moebius(product.map(|x| x / scale))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn points() -> Vec<Complex64> {
        (0..40).map(|k| Complex64::from_polar(((k as f64 * 0.618).fract()).sqrt(), k as f64 * 2.4)).collect()
    }

    #[test]
    fn three_points_are_met_and_the_disc_stays_the_disc() {
        let z = [0.1, 2.0, 4.5].map(Complex64::cis);
        let w = [1.0, 1.3, 6.0].map(Complex64::cis);
        let map = Moebius::through(z, w).unwrap();
        for (z, w) in z.into_iter().zip(w) {
            // Rounding, and a few derivatives of about 10.
            assert!((map.at(z) - w).norm() < 1e-13);
        }
        assert!((0..20).all(|k| (map.at(Complex64::cis(k as f64)).norm() - 1.0).abs() < 1e-13));
        assert!(points().iter().all(|&z| map.at(z).norm() < 1.0));
        assert_eq!(Moebius::through([z[0], z[0], z[2]], w), Err(MoebiusError::Coincident));
    }

    #[test]
    fn a_moebius_map_is_found_from_far_away() {
        let z = points();
        let wanted = Moebius::of_disc(2.0, Complex64::new(0.6, -0.5));
        let w: Vec<Complex64> = z.iter().map(|&z| wanted.at(z)).collect();
        let found = Moebius::IDENTITY.fitted(&z, &w).unwrap();
        // Quadratic convergence to rounding; the derivative is at most (1 + |c|)/(1 − |c|) = 8.
        assert!(z.iter().zip(&w).all(|(&z, w)| (found.at(z) - w).norm() < 1e-12));
    }

    #[test]
    fn what_is_fitted_is_no_worse_than_its_neighbours_or_its_start() {
        let z = points();
        // Not a Möbius map.
        let w: Vec<Complex64> = z.iter().map(|&z| z + 0.1 * z * z.conj()).collect();
        let sum = |map: &Moebius| z.iter().zip(&w).map(|(&z, w)| (map.at(z) - w).norm_sqr()).sum::<f64>();
        let fitted = Moebius::IDENTITY.fitted(&z, &w).unwrap();
        assert!(sum(&fitted) < sum(&Moebius::IDENTITY));
        for (alpha, x, y) in
            [(1e-3, 0.0, 0.0), (-1e-3, 0.0, 0.0), (0.0, 1e-3, 0.0), (0.0, -1e-3, 0.0), (0.0, 0.0, 1e-3)]
        {
            assert!(sum(&Moebius::of_disc(alpha, Complex64::new(x, y)).after(&fitted)) > sum(&fitted));
        }
        assert_eq!(Moebius::IDENTITY.fitted(&[], &[]), Err(MoebiusError::Undetermined { points: 0 }));
    }
}
