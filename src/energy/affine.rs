//! The affine maps of triangles and functions of them.

use num_complex::Complex64;

use super::conformal::Weight;
use super::{Block, Curvature, EnergyError, Rest};
use crate::geometry::predicate::orientation;
use crate::quad_graph::RestTriangle;
use crate::sparse::Stencils;

/// The derivatives of a density f with respect to A = |a|² and B = |b|².
///
/// Those of second order are multiplied by the factors that make them second derivatives with
/// respect to
/// a| and |b|.
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

/// The triangles of a mesh, or of the corners of its quads, prepared for the evaluation of
/// densities.
pub struct Triangles {
    vertices: Stencils,
    pieces: Vec<TrianglePiece>,
}

impl Triangles {
    /// Makes the triangles of the rest metric for the energy with the given name.
    ///
    /// # Errors
    /// A triangle without area at rest.
    pub(super) fn new(rest: Rest, energy: &'static str) -> Result<Self, EnergyError> {
        let triangles = &rest.metric.triangles;
        if let Some(flat) = triangles.iter().find(|t| !t.is_proper()) {
            let count = triangles.iter().filter(|t| !t.is_proper()).count();
            return Err(EnergyError::NoArea { energy, face: flat.face, count });
        }
        Ok(Triangles {
            pieces: triangles.iter().map(|t| TrianglePiece::new(t, rest.weight)).collect(),
            vertices: Stencils::new(&triangles.iter().map(|t| t.vertices).collect::<Vec<_>>()),
        })
    }

    /// Iterates over the triangles with the positions of their corners.
    pub(super) fn at<'a>(
        &'a self,
        z: &'a [Complex64],
    ) -> impl Iterator<Item = (&'a TrianglePiece, [Complex64; 3])> + 'a {
        self.pieces.iter().enumerate().map(move |(e, piece)| {
            let v = self.vertices.get(e);
            (piece, [v[0], v[1], v[2]].map(|v| z[v as usize]))
        })
    }

    /// Adds values at the corners of each triangle to their vertices.
    pub(super) fn scatter(&self, of_corners: impl Iterator<Item = [Complex64; 3]>, to: &mut [Complex64]) {
        for (e, corners) in of_corners.enumerate() {
            for (&v, g) in self.vertices.get(e).iter().zip(corners) {
                to[v as usize] += g;
            }
        }
    }

    /// The vertices of each triangle.
    pub(super) fn stencils(&self) -> Stencils {
        self.vertices.clone()
    }

    /// a|² + |b|² of each triangle, twice the ratio of its Dirichlet energy to its area at rest.
    pub fn stretch(&self, z: &[Complex64]) -> Vec<f64> {
        self.at(z).map(|(piece, corners)| piece.map_of_any(corners).stretch()).collect()
    }

    /// J = |a|² − |b|² of each triangle, the ratio of its signed area to its area at rest.
    pub fn area_ratios(&self, z: &[Complex64]) -> Vec<f64> {
        self.at(z).map(|(piece, corners)| piece.map_of_any(corners).j).collect()
    }
}

/// A triangle at rest.
///
/// In coordinates in which the edge v0 → v1 is 0 → ℓ and v2 is wℓ, `b = c (w e1 − e2)` and `a = c
/// (e2 − w̄ e1)` with e1 = z1 − z0, e2 = z2 − z0.
#[derive(Clone, Copy)]
pub(super) struct TrianglePiece {
    w: Complex64,
    /// 1/(2i ℓ Im w).
    c: Complex64,
    /// 1/(ℓ² Im w).
    per_area: f64,
    pub weight: f64,
}

/// The affine map `z ↦ a z + b z̄` of a triangle and J = |a|² − |b|².
pub(super) struct Local {
    pub a: Complex64,
    pub b: Complex64,
    pub j: f64,
}

impl Local {
    /// |a|² + |b|².
    pub fn stretch(&self) -> f64 {
        self.a.norm_sqr() + self.b.norm_sqr()
    }
}

impl TrianglePiece {
    pub fn new(t: &RestTriangle, weight: Weight) -> Self {
        TrianglePiece {
            w: t.w,
            c: Complex64::new(0.0, -0.5 / (t.length * t.w.im)),
            per_area: 1.0 / (t.length * t.length * t.w.im),
            weight: match weight {
                Weight::Integral => t.area,
                Weight::Unit => t.share,
            },
        }
    }

    /// Returns the affine map, or `None` if the triangle is not positively oriented.
    pub fn map(&self, corners: [Complex64; 3]) -> Option<Local> {
        let local = self.map_of_any(corners);
        let [z0, z1, z2] = corners;
        // If the area is lost in rounding, there are no derivatives, whatever the exact sign is.
        (local.j > 0.0 && orientation(z0, z1, z2) > 0.0).then_some(local)
    }

    /// Returns the affine map, whatever its orientation.
    pub fn map_of_any(&self, [z0, z1, z2]: [Complex64; 3]) -> Local {
        let (e1, e2) = (z1 - z0, z2 - z0);
        let j = (e1.conj() * e2).im * self.per_area;
        Local { a: self.c * (e2 - self.w.conj() * e1), b: self.c * (self.w * e1 - e2), j }
    }

    /// ∂a/∂z and ∂b/∂z for the three vertices.
    fn coefficients(&self) -> ([Complex64; 3], [Complex64; 3]) {
        let (w, c) = (self.w, self.c);
        ([c * (w.conj() - 1.0), -w.conj() * c, c], [c * (1.0 - w), w * c, -c])
    }

    /// The gradient ∂/∂x + i ∂/∂y of `t × weight × f` for the three vertices.
    pub fn gradient(&self, t: f64, at: &Local, d: &Derivatives) -> [Complex64; 3] {
        let (alpha, beta) = self.coefficients();
        let (along_a, along_b) = (2.0 * t * self.weight * d.a * at.a, 2.0 * t * self.weight * d.b * at.b);
        [0, 1, 2].map(|k| alpha[k].conj() * along_a + beta[k].conj() * along_b)
    }

    /// The second derivatives of `weight × f`.
    ///
    /// In directions along a, across a, along b and across b the second derivatives of f are
    ///
    /// ```text
    /// ⎡ 2 f_A + 4 A f_AA     ·       4 √(AB) f_AB       ·   ⎤
    /// ⎢         ·          2 f_A           ·            ·   ⎥
    /// ⎢   4 √(AB) f_AB       ·     2 f_B + 4 B f_BB     ·   ⎥
    /// ⎣         ·            ·             ·          2 f_B ⎦
    /// ```
    ///
    /// so their positive part is known in closed form.
    pub fn block(&self, at: &Local, d: &Derivatives, curvature: Curvature) -> Block {
        let mut along = [2.0 * d.a + 4.0 * d.aa, 4.0 * d.ab, 2.0 * d.b + 4.0 * d.bb];
        let mut across = [2.0 * d.a, 2.0 * d.b];
        if curvature == Curvature::GaussNewton {
            along = positive_part(along);
            across = across.map(|x| x.max(0.0));
        }
        let (alpha, beta) = self.coefficients();
        let (turn_a, turn_b) = (direction(at.a).conj(), direction(at.b).conj());
        // The derivatives of the components of a and b along and across themselves.
        let (mut rows, p, q) = ([[0.0; 6]; 4], alpha.map(|x| turn_a * x), beta.map(|x| turn_b * x));
        for k in 0..3 {
            (rows[0][2 * k], rows[0][2 * k + 1]) = (p[k].re, -p[k].im);
            (rows[1][2 * k], rows[1][2 * k + 1]) = (p[k].im, p[k].re);
            (rows[2][2 * k], rows[2][2 * k + 1]) = (q[k].re, -q[k].im);
            (rows[3][2 * k], rows[3][2 * k + 1]) = (q[k].im, q[k].re);
        }
        let mut block = [[0.0; 8]; 8];
        for i in 0..6 {
            let [a, s, b, t] = rows.map(|row| self.weight * row[i]);
            let (to_a, to_b) = (along[0] * a + along[1] * b, along[1] * a + along[2] * b);
            for k in 0..6 {
                block[i][k] =
                    to_a * rows[0][k] + across[0] * s * rows[1][k] + to_b * rows[2][k] + across[1] * t * rows[3][k];
            }
        }
        block
    }
}

/// z/|z|, or 1 if that is undefined.
fn direction(z: Complex64) -> Complex64 {
    let length = z.norm();
    if length > 0.0 && length.is_finite() { z / length } else { Complex64::ONE }
}

/// Returns the symmetric matrix `[p, q; q, s]`, given as p, q, s, without its negative eigenvalues.
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_positive_part_of_a_matrix_keeps_positive_eigenvalues_alone() {
        assert_eq!(positive_part([3.0, 0.0, -1.0]), [3.0, 0.0, 0.0]);
        assert_eq!(positive_part([2.0, 1.0, 2.0]), [2.0, 1.0, 2.0]);
        assert_eq!(positive_part([-2.0, 1.0, -2.0]), [0.0; 3]);
        // The eigenvalues are ±1 along (1, 1) and (1, −1).
        assert_eq!(positive_part([0.0, 1.0, 0.0]), [0.5, 0.5, 0.5]);
    }
}
