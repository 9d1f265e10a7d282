use num_complex::Complex64;

/// A ratio of periods in the fundamental domain of SL(2, Z), and the basis that has it.
///
/// The domain is `|Re τ| ≤ ½, |τ| ≥ 1`. Of two of its boundary points that mean the same torus the one with Re τ > 0 is
/// taken: `−½ < Re τ`, and `Re τ ≥ 0` where |τ| = 1. What is within 1e-9 of the boundary counts as on it, so that rounding does
/// not choose; τ may therefore be outside by as much.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Reduced {
    /// ω2'/ω1'
    pub tau: Complex64,
    /// [[a, b], [c, d]] of determinant 1 with `ω2' = a ω2 + b ω1`, `ω1' = c ω2 + d ω1`.
    pub matrix: [[i64; 2]; 2],
}

/// A ratio of periods that is none, or that no basis of 64-bit integers reduces.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the ratio of the periods, {} + {} i, cannot be brought to the fundamental domain: Im τ must be positive, and neither part \
     beyond the range of 64-bit integers", tau.re, tau.im
)]
pub struct NotReducible {
    /// The ratio.
    pub tau: Complex64,
}

const ON_BOUNDARY: f64 = 1e-9;

/// Every inversion of a τ that doubles hold at least doubles Im τ but for the last few.
const INVERSIONS: usize = 2500;

/// Brings τ, Im τ > 0, to the fundamental domain.
///
/// # Errors
/// [`NotReducible`].
pub fn reduce(tau: Complex64) -> Result<Reduced, NotReducible> {
    let none = NotReducible { tau };
    if !(tau.is_finite() && tau.im > 0.0) {
        return Err(none);
    }
    let mut matrix = [[1i64, 0], [0, 1]];
    for _ in 0..INVERSIONS {
        let shift = apply(matrix, tau).re.round();
        // Beyond 2⁶² the rows of the matrix would not fit in any case.
        if shift.abs() >= (1u64 << 62) as f64 {
            return Err(none);
        }
        matrix = shifted(matrix, -(shift as i64)).ok_or(none)?;
        if apply(matrix, tau).norm_sqr() >= 1.0 - ON_BOUNDARY {
            return on_the_right(matrix, tau).ok_or(none);
        }
        matrix = inverted(matrix).ok_or(none)?;
    }
    Err(none)
}

/// The boundary's half with Re τ > 0.
fn on_the_right(mut matrix: [[i64; 2]; 2], tau: Complex64) -> Option<Reduced> {
    if apply(matrix, tau).re < -0.5 + ON_BOUNDARY {
        matrix = shifted(matrix, 1)?;
    }
    let there = apply(matrix, tau);
    if there.norm_sqr() < 1.0 + ON_BOUNDARY && there.re < -ON_BOUNDARY {
        matrix = inverted(matrix)?;
    }
    let tau = apply(matrix, tau);
    (tau.is_finite() && tau.im > 0.0).then_some(Reduced { tau, matrix })
}

/// `(aτ + b) / (cτ + d)`
pub fn apply([[a, b], [c, d]]: [[i64; 2]; 2], tau: Complex64) -> Complex64 {
    let (top, bottom) = (a as f64 * tau + b as f64, c as f64 * tau + d as f64);
    // The determinant is 1: no cancellation in the imaginary part.
    Complex64::new((top * bottom.conj()).re, tau.im) / bottom.norm_sqr()
}

/// τ + n after `matrix`.
fn shifted([[a, b], [c, d]]: [[i64; 2]; 2], n: i64) -> Option<[[i64; 2]; 2]> {
    let add = |x: i64, y: i64| x.checked_add(n.checked_mul(y)?);
    Some([[add(a, c)?, add(b, d)?], [c, d]])
}

/// −1/τ after `matrix`.
fn inverted([[a, b], [c, d]]: [[i64; 2]; 2]) -> Option<[[i64; 2]; 2]> {
    Some([[c.checked_neg()?, d.checked_neg()?], [a, b]])
}

/// How far the torus of ratio τ is from that of ratio `exact`: the least `|Mτ − exact'| / |exact'|`, exact' being `exact`
/// reduced, over the bases M next to the reduced one of τ, so that nothing jumps where they lie on either side of the
/// boundary of the fundamental domain.
///
/// # Errors
/// [`NotReducible`], of either.
pub fn relative_error(tau: Complex64, exact: Complex64) -> Result<f64, NotReducible> {
    let (found, exact) = (reduce(tau)?.tau, reduce(exact)?.tau);
    // The neighbours of the fundamental domain, those at the corners e^{iπ/3}, e^{2πi/3} among them.
    let mut neighbours = Vec::with_capacity(16);
    for t in [found, found - 1.0, found + 1.0] {
        let inverse = -t.inv();
        neighbours.extend([t, inverse, inverse - 1.0, inverse + 1.0]);
    }
    Ok(neighbours.iter().map(|t| (t - exact).norm() / exact.norm()).fold(f64::INFINITY, f64::min))
}
