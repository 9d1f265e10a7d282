//! Energies of maps without flipped faces: sums over triangles that are +∞ if a triangle is
//! flipped.

use num_complex::Complex64;

use super::affine::{Derivatives, Local, Triangles};
use super::{Block, Curvature, Energy, EnergyError, Polynomial, Rest};
use crate::sparse::Stencils;

/// A density f of distortion that depends on the affine map `z ↦ a z + b z̄` of a triangle only
/// through `A = |a|²` and `B = |b|²`; J = A − B > 0 is the ratio of the areas.
pub trait Density: Sync {
    /// The name in expressions.
    const NAME: &'static str;

    /// Returns f.
    fn value(a: f64, b: f64, j: f64) -> f64;

    /// Returns the derivatives of f.
    fn derivatives(a: f64, b: f64, j: f64) -> Derivatives;
}

/// The sum `Σ w f(a, b)` over the triangles of a mesh or of the corners of its quads; +∞ if one of
/// them is not positively oriented, by the exact predicate.
///
/// Unit weights: w = 1 for each face. Integral weights: w is the area at rest.
pub struct TriangleSum<D> {
    pub(super) triangles: Triangles,
    density: std::marker::PhantomData<D>,
}

impl<D: Density> TriangleSum<D> {
    /// Makes the sum over the triangles of the rest metric.
    ///
    /// # Errors
    /// A triangle without area at rest.
    pub fn new(rest: Rest) -> Result<Self, EnergyError> {
        Ok(TriangleSum { triangles: Triangles::new(rest, D::NAME)?, density: std::marker::PhantomData })
    }
}

impl<D: Density> Energy for TriangleSum<D> {
    fn name(&self) -> &'static str {
        D::NAME
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        let mut sum = 0.0;
        for (piece, corners) in self.triangles.at(z) {
            let Some(Local { a, b, j }) = piece.map(corners) else { return f64::INFINITY };
            sum += piece.weight * D::value(a.norm_sqr(), b.norm_sqr(), j);
        }
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    /// The gradient is NaN at the vertices of flipped triangles.
    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        let of_corners = self.triangles.at(z).map(|(piece, corners)| match piece.map(corners) {
            Some(at) => piece.gradient(t, &at, &D::derivatives(at.a.norm_sqr(), at.b.norm_sqr(), at.j)),
            None => [Complex64::from(f64::NAN); 3],
        });
        self.triangles.scatter(of_corners, gradient);
    }

    fn add_bending(&self, _t: f64, _z: &[Complex64], _d: &[Complex64], _gradient: &mut [Complex64]) {}

    fn stencils(&self) -> Stencils {
        self.triangles.stencils()
    }

    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        for (e, (piece, corners)) in self.triangles.at(z).enumerate() {
            match piece.map(corners) {
                Some(at) => {
                    let d = D::derivatives(at.a.norm_sqr(), at.b.norm_sqr(), at.j);
                    add(e, &piece.block(&at, &d, curvature));
                }
                None => add(e, &[[f64::NAN; 8]; 8]),
            }
        }
    }

    fn residual_count(&self) -> usize {
        0
    }

    fn along(&self, _z: &[Complex64], _d: &[Complex64]) -> Option<Polynomial> {
        None
    }

    /// The smallest positive root of the triangles' areas `|e1 + t d1, e2 + t d2|`.
    fn largest_step(&self, z: &[Complex64], d: &[Complex64]) -> f64 {
        let edges = |[x0, x1, x2]: [Complex64; 3]| (x1 - x0, x2 - x0);
        let roots = self.triangles.at(z).zip(self.triangles.at(d)).map(|((_, z), (_, d))| {
            let ((e1, e2), (d1, d2)) = (edges(z), edges(d));
            let cross = |a: Complex64, b: Complex64| (a.conj() * b).im;
            smallest_positive_root(cross(e1, e2), cross(e1, d2) + cross(d1, e2), cross(d1, d2))
        });
        roots.fold(f64::INFINITY, f64::min)
    }
}

/// Returns the smallest positive root of `c + b t + a t²`, where c > 0, or +∞.
fn smallest_positive_root(c: f64, b: f64, a: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 || (b >= 0.0 && a >= 0.0) {
        return f64::INFINITY;
    }
    // 2c/(−b ± √…), the root that is reached first, without cancellation if b < 0.
    let root = discriminant.sqrt();
    let t = if b < 0.0 { 2.0 * c / (root - b) } else { (-b - root) / (2.0 * a) };
    if t > 0.0 { t } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_ahead_is_found() {
        // (1 − t)(1 − t/3), (1 − t)(1 + t), (1 + t)², 1 + t², 1 − 2t.
        for (c, b, a, root) in [
            (1.0, -4.0 / 3.0, 1.0 / 3.0, 1.0),
            (1.0, 0.0, -1.0, 1.0),
            (1.0, 2.0, 1.0, f64::INFINITY),
            (1.0, 0.0, 1.0, f64::INFINITY),
            (1.0, -2.0, 0.0, 0.5),
            (1.0, 1.0, -2.0, 1.0),
        ] {
            assert_eq!(smallest_positive_root(c, b, a), root, "{c} + {b} t + {a} t²");
        }
    }
}
