//! ρ from geometry, equation (1): everything that a conformal map sees of a quad.

use crate::geometry::vector::{cross, dot, norm};
use num_complex::Complex64;

/// The diagonals of a quad as a conformal map sees them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonals {
    /// ρ with `d13 = iρ d02` in the quad's plane. Re ρ > 0 when the diagonals cross properly.
    pub rho: Complex64,
    /// |d02|, the rest length of the first diagonal, in the unit of the positions.
    pub length: f64,
}

/// `ρ = (|d02 × d13| − i d02 · d13) / |d02|²` (1), for diagonals in R³ that need not meet.
///
/// `None` where a diagonal has no length or both are parallel, to rounding or overflow.
pub fn extrinsic(d02: [f64; 3], d13: [f64; 3]) -> Option<Diagonals> {
    checked(norm(cross(d02, d13)), dot(d02, d13), dot(d02, d02))
}

/// The same with the diagonals projected on the plane ⟂ `n`, a unit normal: `c = n · (d02 × d13)`,
/// `p = d02 · d13 − (d02 · n)(d13 · n)`.
///
/// `None` where the projected diagonals do not span a positive area.
pub fn with_normal(d02: [f64; 3], d13: [f64; 3], n: [f64; 3]) -> Option<Diagonals> {
    let (a, b) = (dot(d02, n), dot(d13, n));
    checked(dot(n, cross(d02, d13)), dot(d02, d13) - a * b, dot(d02, d02) - a * a)
}

/// (1) from `c`, `p` and the squared length of d02.
fn checked(c: f64, p: f64, length_squared: f64) -> Option<Diagonals> {
    let rho = Complex64::new(c, -p) / length_squared;
    let length = length_squared.sqrt();
    (rho.re > 0.0 && rho.is_finite() && length > 0.0).then_some(Diagonals { rho, length })
}
