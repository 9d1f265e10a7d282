//! Angles along the boundary: ascending from the first position, less than a turn in all.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

/// A place on the boundary and its angle.
pub(super) type Anchor = (usize, f64);

/// Angles (`n`) that take the values of the anchors (ascending) and go in between as the ascending numbers `t` do, which
/// gain `turn` around the boundary.
pub(super) fn through_anchors(t: &[f64], turn: f64, anchors: &[Anchor]) -> Vec<f64> {
    let n = t.len();
    let at = |k: usize| if k < n { t[k] } else { t[k - n] + turn };
    let mut theta = vec![0.0; n];
    for (i, &(first, angle)) in anchors.iter().enumerate() {
        let (last, last_angle) = anchors.get(i + 1).copied().unwrap_or((anchors[0].0 + n, anchors[0].1 + TAU));
        let slope = (last_angle - angle) / (at(last) - at(first));
        for k in first..last {
            // Unwound, so that the angles ascend from position 0.
            theta[k % n] = angle + slope * (at(k) - at(first)) - if k < n { 0.0 } else { TAU };
        }
    }
    theta
}

/// The angles moved by the Möbius map of the disc that takes those at three positions to the angles of the anchors. `None`
/// where rounding spoils it.
pub(super) fn moebius(theta: &[f64], anchors: &[Anchor]) -> Option<Vec<f64>> {
    let &[a, b, c] = anchors else { return None };
    let here = [a, b, c].map(|(k, _)| Complex64::cis(theta[k]));
    let there = [a, b, c].map(|(_, angle)| Complex64::cis(angle));
    // Both triples to 0, 1, ∞: z ↦ (z − p)(q − r) / ((z − r)(q − p)).
    let normal = |[p, q, r]: [Complex64; 3]| [[q - r, -p * (q - r)], [q - p, -r * (q - p)]];
    let ([[a, b], [c, d]], [[e, f], [g, h]]) = (normal(here), normal(there));
    // The inverse of the second, after the first.
    let matrix = [[h * a - f * c, h * b - f * d], [e * c - g * a, e * d - g * b]];
    let determinant = matrix[0][0] * matrix[1][1] - matrix[0][1] * matrix[1][0];
    // |derivative|^½
    let stretch = |z: Complex64| determinant.norm().sqrt() / (matrix[1][0] * z + matrix[1][1]).norm();
    let image = |z: Complex64| (matrix[0][0] * z + matrix[0][1]) / (matrix[1][0] * z + matrix[1][1]);
    let n = theta.len();
    let mut moved = Vec::with_capacity(n);
    let mut angle = image(Complex64::cis(theta[0])).arg();
    for k in 0..n {
        moved.push(angle);
        let ahead = if k + 1 < n { theta[k + 1] } else { theta[0] + TAU };
        let (z, w) = (Complex64::cis(theta[k]), Complex64::cis(ahead));
        // Chords go over into chords times both stretches, small ones without loss of digits.
        let half_chord = (0.5 * (ahead - theta[k])).sin().abs() * stretch(z) * stretch(w);
        let wide = (image(w) / image(z)).arg();
        let turn =
            if half_chord < 0.1 && wide.abs() < 0.5 * PI { 2.0 * half_chord.asin() } else { wide.rem_euclid(TAU) };
        angle += turn;
    }
    let closes = (angle - moved[0] - TAU).abs() < 1e-6;
    (closes && is_ascending(&moved)).then_some(moved)
}

/// Whether the angles ascend, less than a turn in all.
pub(super) fn is_ascending(theta: &[f64]) -> bool {
    theta.windows(2).all(|pair| pair[0] < pair[1]) && theta[theta.len() - 1] < theta[0] + TAU
}
