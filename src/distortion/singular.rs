use num_complex::Complex64;

use super::Image;
use crate::energy::conformal;
use crate::geometry::predicate::{diagonals_cross_left, orientation};
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::quad_graph::QuadGraph;
use crate::surface::oriented_mesh::OrientedMesh;

/// The affine map `z ↦ a z + b z̄` of one face, in the face's own plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceMap {
    /// a| + |b|, the larger singular value.
    pub sigma1: f64,
    /// a| − |b|, the smaller singular value; negative if the face is flipped.
    pub sigma2: f64,
    /// Area on the surface.
    pub area: f64,
    /// Whether the image is positively oriented, by an exact predicate on the vertices of a
    /// triangle or the diagonals of a quad.
    pub positive: bool,
    /// Whether all corners of the image are positively oriented, by an exact predicate.
    pub convex: bool,
}

impl FaceMap {
    /// The quasi-conformal distortion σ1/σ2; 1 is conformal.
    pub fn quasi_conformal(&self) -> f64 {
        self.sigma1 / self.sigma2
    }

    /// Whether the face has a shape to compare with; faces with a surrogate at rest do not.
    pub fn has_shape(&self) -> bool {
        !self.sigma1.is_nan()
    }

    /// Whether the face is not flipped and σ1/σ2 is finite.
    pub fn is_regular(&self) -> bool {
        self.positive && self.sigma2 > 0.0 && self.quasi_conformal().is_finite()
    }
}

/// Returns the affine maps of all faces of `disc` except those that fill holes, for triangles from
/// their vertices and for quads from their diagonals and ρ. Singular values are NaN if the face has
/// a surrogate at rest.
pub fn face_maps(disc: &OrientedMesh, graph: &QuadGraph, image: &Image) -> Vec<FaceMap> {
    let of_face = |f: usize, polygon: &[u32]| match *polygon {
        [i, j, k] => {
            let first = disc.faces.corner_range(f).start;
            triangle(disc, [i, j, k], [0, 1, 2].map(|k| image.corner(disc, first + k)))
        }
        _ => quad(graph, f, image.quad(graph, f)),
    };
    let measured = |(f, polygon): (usize, &[u32])| match disc.surrogates.has(f) {
        false => of_face(f, polygon),
        true => FaceMap { sigma1: f64::NAN, sigma2: f64::NAN, area: 0.0, ..of_face(f, polygon) },
    };
    disc.faces.iter().enumerate().take(disc.source_faces()).map(measured).collect()
}

/// The affine map of a triangle: with the edge i → j as 0 → ℓ and the third vertex at wℓ, `z_j −
/// z_i = (a + b)ℓ`, `z_k − z_i = (a w + b w̄)ℓ`.
fn triangle(disc: &OrientedMesh, [i, j, k]: [u32; 3], [zi, zj, zk]: [Complex64; 3]) -> FaceMap {
    let [x, y, t] = [i, j, k].map(|v| disc.positions[v as usize]);
    let (edge, third) = (sub(y, x), sub(t, x));
    let (length_squared, twice_area) = (dot(edge, edge), norm(cross(edge, third)));
    let w = Complex64::new(dot(edge, third), twice_area) / length_squared;
    let along = (zj - zi) / length_squared.sqrt();
    let across = (zk - zi) / length_squared.sqrt();
    let b = (along * w - across) / Complex64::new(0.0, 2.0 * w.im);
    let positive = orientation(zi, zj, zk) > 0.0;
    face_map(along - b, b, 0.5 * twice_area, positive, positive)
}

/// The affine map of a quad: `b = i r / (2 Re ρ |d02|)`, `a = (z2 − z0)/|d02| − b` with d02 along
/// the real axis.
fn quad(graph: &QuadGraph, q: usize, corners: [Complex64; 4]) -> FaceMap {
    let length = graph.diagonal[q];
    let b = Complex64::I * conformal::residual_at(graph.rho[q], corners) / (2.0 * graph.rho[q].re * length);
    let a = (corners[2] - corners[0]) / length - b;
    let convex = (0..4).all(|k| orientation(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]) > 0.0);
    face_map(a, b, graph.area(q), diagonals_cross_left(corners), convex)
}

/// Returns σ1 and σ2, up to a common factor, of the affine map that takes 1 to `along` and w (Im w
/// > 0) to `across`: `along = a + b`, `across = a w + b w̄`.
pub(super) fn singular_values(w: Complex64, along: Complex64, across: Complex64) -> (f64, f64) {
    let b = (along * w - across) / Complex64::new(0.0, 2.0 * w.im);
    let a = along - b;
    (a.norm() + b.norm(), a.norm() - b.norm())
}

fn face_map(a: Complex64, b: Complex64, area: f64, positive: bool, convex: bool) -> FaceMap {
    FaceMap { sigma1: a.norm() + b.norm(), sigma2: a.norm() - b.norm(), area, positive, convex }
}
