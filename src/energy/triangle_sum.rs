//! Energies of maps without folds: sums over the triangles of the mesh that are +∞ where one of them is turned over.

use num_complex::Complex64;

use super::conformal::Weight;
use super::{Block, Curvature, Energy, EnergyError, Polynomial, Rest};
use crate::predicate::orientation;
use crate::sparse::Stencils;

/// A density f(a, b) of distortion, of the affine map `z ↦ a z + b z̄` of a triangle through `A = |a|²` and `B = |b|²` alone, J = A − B > 0
/// being the ratio of the areas.
pub trait Density: Sync {
    /// Name in expressions.
    const NAME: &'static str;

    /// f.
    fn value(a: f64, b: f64, j: f64) -> f64;

    /// Its derivatives.
    fn derivatives(a: f64, b: f64, j: f64) -> Derivatives;
}

/// The derivatives of a density with respect to A and B; those of second order times what makes them ones along a and b.
#[derive(Clone, Copy, Debug)]
pub struct Derivatives {
    /// ∂f/∂A.
    pub a: f64,
    /// ∂f/∂B.
    pub b: f64,
    /// A ∂²f/∂A².
    pub aa: f64,
    /// √(AB) ∂²f/∂A∂B.
    pub ab: f64,
    /// B ∂²f/∂B².
    pub bb: f64,
}

/// `Σ w f(a, b)` over the triangles of a mesh or of the corners of its quads, +∞ where one is not positively oriented by the exact
/// predicate.
///
/// Unit weights: w = 1 for each face. Integral: w is the area at rest.
pub struct TriangleSum<D> {
    triangles: Stencils,
    pieces: Vec<Piece>,
    density: std::marker::PhantomData<D>,
}

/// With the edge v0 → v1 as 0 → ℓ and v2 at wℓ: `b = c (w e1 − e2)`, `a = c (e2 − w̄ e1)`, e1 = z1 − z0, e2 = z2 − z0.
#[derive(Clone, Copy)]
struct Piece {
    w: Complex64,
    /// 1/(2i ℓ Im w).
    c: Complex64,
    /// 1/(ℓ² Im w).
    per_area: f64,
    weight: f64,
}

/// The affine map of a triangle.
struct Local {
    a: Complex64,
    b: Complex64,
    j: f64,
}

impl Piece {
    /// `None` where the triangle is not positively oriented.
    fn map(&self, [z0, z1, z2]: [Complex64; 3]) -> Option<Local> {
        let (e1, e2) = (z1 - z0, z2 - z0);
        let cross = (e1.conj() * e2).im;
        // A triangle so flat that its area is lost in rounding has no derivatives, whatever its sign.
        if !(cross > 0.0 && orientation(z0, z1, z2) > 0.0) {
            return None;
        }
        Some(Local { a: self.c * (e2 - self.w.conj() * e1), b: self.c * (self.w * e1 - e2), j: cross * self.per_area })
    }

    /// ∂a/∂z and ∂b/∂z of the three vertices.
    fn coefficients(&self) -> ([Complex64; 3], [Complex64; 3]) {
        let (w, c) = (self.w, self.c);
        ([c * (w.conj() - 1.0), -w.conj() * c, c], [c * (1.0 - w), w * c, -c])
    }
}

impl<D: Density> TriangleSum<D> {
    /// Over the triangles of the rest metric.
    ///
    /// # Errors
    /// A triangle without area at rest.
    pub fn new(rest: Rest) -> Result<Self, EnergyError> {
        let triangles = &rest.metric.triangles;
        if let Some(flat) = triangles.iter().find(|t| !t.is_proper()) {
            let count = triangles.iter().filter(|t| !t.is_proper()).count();
            return Err(EnergyError::NoArea { energy: D::NAME, face: flat.face, count });
        }
        let pieces = triangles.iter().map(|t| Piece {
            w: t.w,
            c: Complex64::new(0.0, -0.5 / (t.length * t.w.im)),
            per_area: 1.0 / (t.length * t.length * t.w.im),
            weight: match rest.weight {
                Weight::Integral => t.area,
                Weight::Unit => t.share,
            },
        });
        Ok(TriangleSum {
            pieces: pieces.collect(),
            triangles: Stencils::new(&triangles.iter().map(|t| t.vertices).collect::<Vec<_>>()),
            density: std::marker::PhantomData,
        })
    }

    fn corners(&self, e: usize, z: &[Complex64]) -> [Complex64; 3] {
        let v = self.triangles.get(e);
        [v[0], v[1], v[2]].map(|v| z[v as usize])
    }
}

impl<D: Density> Energy for TriangleSum<D> {
    fn name(&self) -> &'static str {
        D::NAME
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        let mut sum = 0.0;
        for (e, piece) in self.pieces.iter().enumerate() {
            let Some(Local { a, b, j }) = piece.map(self.corners(e, z)) else { return f64::INFINITY };
            sum += piece.weight * D::value(a.norm_sqr(), b.norm_sqr(), j);
        }
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    /// NaN at the vertices of triangles that are turned over.
    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        for (e, piece) in self.pieces.iter().enumerate() {
            let (alpha, beta) = piece.coefficients();
            let (along_a, along_b) = match piece.map(self.corners(e, z)) {
                Some(Local { a, b, j }) => {
                    let d = D::derivatives(a.norm_sqr(), b.norm_sqr(), j);
                    (2.0 * t * piece.weight * d.a * a, 2.0 * t * piece.weight * d.b * b)
                }
                None => (Complex64::from(f64::NAN), Complex64::from(f64::NAN)),
            };
            for (k, &v) in self.triangles.get(e).iter().enumerate() {
                gradient[v as usize] += alpha[k].conj() * along_a + beta[k].conj() * along_b;
            }
        }
    }

    fn add_bending(&self, _t: f64, _z: &[Complex64], _d: &[Complex64], _gradient: &mut [Complex64]) {}

    fn stencils(&self) -> Stencils {
        self.triangles.clone()
    }

    /// In directions along a, across a, along b and across b the second derivatives are
    ///
    /// ```text
    /// ⎡ 2 f_A + 4 A f_AA     ·       4 √(AB) f_AB       ·   ⎤
    /// ⎢         ·          2 f_A           ·            ·   ⎥
    /// ⎢   4 √(AB) f_AB       ·     2 f_B + 4 B f_BB     ·   ⎥
    /// ⎣         ·            ·             ·          2 f_B ⎦
    /// ```
    ///
    /// so that their positive part is known in closed form.
    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        for (e, piece) in self.pieces.iter().enumerate() {
            let Some(Local { a, b, j }) = piece.map(self.corners(e, z)) else {
                add(e, &[[f64::NAN; 8]; 8]);
                continue;
            };
            let d = D::derivatives(a.norm_sqr(), b.norm_sqr(), j);
            let mut along = [2.0 * d.a + 4.0 * d.aa, 4.0 * d.ab, 2.0 * d.b + 4.0 * d.bb];
            let mut across = [2.0 * d.a, 2.0 * d.b];
            if curvature == Curvature::GaussNewton {
                along = positive_part(along);
                across = across.map(|x| x.max(0.0));
            }
            let (alpha, beta) = piece.coefficients();
            let (turn_a, turn_b) = (direction(a).conj(), direction(b).conj());
            // The derivatives of the parts of a and b along and across themselves.
            let (mut rows, p, q) = ([[0.0; 6]; 4], alpha.map(|x| turn_a * x), beta.map(|x| turn_b * x));
            for k in 0..3 {
                (rows[0][2 * k], rows[0][2 * k + 1]) = (p[k].re, -p[k].im);
                (rows[1][2 * k], rows[1][2 * k + 1]) = (p[k].im, p[k].re);
                (rows[2][2 * k], rows[2][2 * k + 1]) = (q[k].re, -q[k].im);
                (rows[3][2 * k], rows[3][2 * k + 1]) = (q[k].im, q[k].re);
            }
            let mut block = [[0.0; 8]; 8];
            for i in 0..6 {
                let [a, s, b, t] = rows.map(|row| piece.weight * row[i]);
                let (to_a, to_b) = (along[0] * a + along[1] * b, along[1] * a + along[2] * b);
                for k in 0..6 {
                    block[i][k] =
                        to_a * rows[0][k] + across[0] * s * rows[1][k] + to_b * rows[2][k] + across[1] * t * rows[3][k];
                }
            }
            add(e, &block);
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
        let roots = (0..self.pieces.len()).map(|e| {
            let edges = |x: &[Complex64]| {
                let [x0, x1, x2] = self.corners(e, x);
                (x1 - x0, x2 - x0)
            };
            let ((e1, e2), (d1, d2)) = (edges(z), edges(d));
            let cross = |a: Complex64, b: Complex64| (a.conj() * b).im;
            smallest_positive_root(cross(e1, e2), cross(e1, d2) + cross(d1, e2), cross(d1, d2))
        });
        roots.fold(f64::INFINITY, f64::min)
    }
}

/// z/|z|; 1 where there is no direction.
fn direction(z: Complex64) -> Complex64 {
    let length = z.norm();
    if length > 0.0 && length.is_finite() { z / length } else { Complex64::ONE }
}

/// The symmetric matrix `[p, q; q, s]`, given as p, q, s, without its negative eigenvalues.
fn positive_part([p, q, s]: [f64; 3]) -> [f64; 3] {
    let (middle, radius) = (0.5 * (p + s), (0.5 * (p - s)).hypot(q));
    let (low, high) = (middle - radius, middle + radius);
    match () {
        () if low >= 0.0 => [p, q, s],
        () if high <= 0.0 => [0.0; 3],
        // high × the projector (M − low)/(high − low).
        () => [p - low, q, s - low].map(|x| high / (2.0 * radius) * x),
    }
}

/// The smallest positive root of `c + b t + a t²`, c > 0; +∞ where there is none.
fn smallest_positive_root(c: f64, b: f64, a: f64) -> f64 {
    let discriminant = b * b - 4.0 * a * c;
    if discriminant < 0.0 || (b >= 0.0 && a >= 0.0) {
        return f64::INFINITY;
    }
    // 2c/(−b ± √…): of the two roots the one that is reached first, without cancellation where b < 0.
    let root = discriminant.sqrt();
    let t = if b < 0.0 { 2.0 * c / (root - b) } else { (-b - root) / (2.0 * a) };
    if t > 0.0 { t } else { f64::INFINITY }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_root_ahead_is_found() {
        // (1 − t)(1 − t/3), (1 − t)(1 + t), (1 + t)², 1 + t², 1 − 2t
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

    #[test]
    fn the_positive_part_of_a_matrix_keeps_positive_eigenvalues_alone() {
        assert_eq!(positive_part([3.0, 0.0, -1.0]), [3.0, 0.0, 0.0]);
        assert_eq!(positive_part([2.0, 1.0, 2.0]), [2.0, 1.0, 2.0]);
        assert_eq!(positive_part([-2.0, 1.0, -2.0]), [0.0; 3]);
        // Eigenvalues ±1 along (1, 1) and (1, −1).
        assert_eq!(positive_part([0.0, 1.0, 0.0]), [0.5, 0.5, 0.5]);
    }
}
