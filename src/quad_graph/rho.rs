//! The complex number ρ of a quad from its geometry, equation (1). A conformal map depends on a
//! quad only through ρ.

use crate::geometry::vector::{cross, dot, norm};
use num_complex::Complex64;

/// The diagonals of a quad up to rotation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Diagonals {
    /// ρ with `d13 = iρ d02` in the quad's plane. Re ρ > 0 if the diagonals have the right
    /// orientation.
    pub rho: Complex64,
    /// |d02|, the rest length of the first diagonal, in the unit of the positions.
    pub length: f64,
}

/// Equation (1), `ρ = (|d02 × d13| − i d02 · d13) / |d02|²`, for diagonals in R³ that need not
/// intersect.
///
/// `None` if a diagonal has no length, or if they are parallel, up to rounding or overflow.
pub fn extrinsic(d02: [f64; 3], d13: [f64; 3]) -> Option<Diagonals> {
    checked(norm(cross(d02, d13)), dot(d02, d13), dot(d02, d02))
}

/// Equation (1) for the diagonals projected to the plane perpendicular to the unit normal `n`: `c =
/// n · (d02 × d13)`, `p = d02 · d13 − (d02 · n)(d13 · n)`.
///
/// `None` if the projected diagonals do not span a positive area.
pub fn with_normal(d02: [f64; 3], d13: [f64; 3], n: [f64; 3]) -> Option<Diagonals> {
    let (a, b) = (dot(d02, n), dot(d13, n));
    checked(dot(n, cross(d02, d13)), dot(d02, d13) - a * b, dot(d02, d02) - a * a)
}

/// Evaluates (1) from `c`, `p` and the squared length of d02.
fn checked(c: f64, p: f64, length_squared: f64) -> Option<Diagonals> {
    let rho = Complex64::new(c, -p) / length_squared;
    let length = length_squared.sqrt();
    (rho.re > 0.0 && rho.is_finite() && length > 0.0).then_some(Diagonals { rho, length })
}
