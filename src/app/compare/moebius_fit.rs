//! The Möbius map of the disc that brings one map nearest to another.

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use crate::geometry::moebius::Moebius;

/// Longest step of the fit; |c| < 1 keeps the disc invariant.
const LONGEST_STEP: f64 = 0.5;

/// Largest number of halvings of a step.
const HALVINGS: i32 = 30;

/// There are too few different points to fit the three parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no Möbius map of the disc can be fitted to {points} points")]
pub struct Undetermined {
    /// Number of points.
    pub points: usize,
}

/// Fits the map of the disc to itself that minimises `Σ |M(z_k) − w_k|²`.
///
/// Gauss–Newton iteration from `start` over the parameters of `z ↦ e^{iα}(z + c)/(1 + c̄ z)`,
/// until the sum no longer decreases.
///
/// # Errors
/// [`Undetermined`].
pub fn fitted(start: Moebius, z: &[Complex64], w: &[Complex64]) -> Result<Moebius, Undetermined> {
    let undetermined = Undetermined { points: z.len().min(w.len()) };
    let sum = |map: &Moebius| z.iter().zip(w).map(|(&z, &w)| (map.at(z) - w).norm_sqr()).sum::<f64>();
    let (mut best, mut least) = (start, sum(&start));
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
            let next = of_disc(step[0], Complex64::new(step[1], step[2])).after(&best);
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
fn of_disc(alpha: f64, c: Complex64) -> Moebius {
    let turn = Complex64::cis(alpha);
    Moebius([turn, turn * c, c.conj(), Complex64::new(1.0, 0.0)])
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn points() -> Vec<Complex64> {
        (0..40).map(|k| Complex64::from_polar(((k as f64 * 0.618).fract()).sqrt(), k as f64 * 2.4)).collect()
    }

    #[test]
    fn a_moebius_map_is_found_from_far_away() {
        let z = points();
        let wanted = of_disc(2.0, Complex64::new(0.6, -0.5));
        let w: Vec<Complex64> = z.iter().map(|&z| wanted.at(z)).collect();
        let found = fitted(of_disc(0.0, Complex64::ZERO), &z, &w).unwrap();
        // Quadratic convergence to rounding; the derivative is at most (1 + |c|)/(1 − |c|) = 8.
        assert!(z.iter().zip(&w).all(|(&z, w)| (found.at(z) - w).norm() < 1e-12));
    }

    #[test]
    fn what_is_fitted_is_no_worse_than_its_neighbours_or_its_start() {
        let z = points();
        // Not a Möbius map.
        let w: Vec<Complex64> = z.iter().map(|&z| z + 0.1 * z * z.conj()).collect();
        let sum = |map: &Moebius| z.iter().zip(&w).map(|(&z, w)| (map.at(z) - w).norm_sqr()).sum::<f64>();
        let best = fitted(of_disc(0.0, Complex64::ZERO), &z, &w).unwrap();
        assert!(sum(&best) < sum(&of_disc(0.0, Complex64::ZERO)));
        for (alpha, x, y) in
            [(1e-3, 0.0, 0.0), (-1e-3, 0.0, 0.0), (0.0, 1e-3, 0.0), (0.0, -1e-3, 0.0), (0.0, 0.0, 1e-3)]
        {
            assert!(sum(&of_disc(alpha, Complex64::new(x, y)).after(&best)) > sum(&best));
        }
        assert_eq!(fitted(of_disc(0.0, Complex64::ZERO), &[], &[]), Err(Undetermined { points: 0 }));
    }
}
