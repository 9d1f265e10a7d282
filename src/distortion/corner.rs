use num_complex::Complex64;

use super::singular::singular_values;
use super::{FaceMap, Image};
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::quad_graph::TangentPlanes;
use crate::surface::oriented_mesh::OrientedMesh;

/// Returns for every face, except those that fill holes, the largest σ1/σ2 of the triangles that
/// its corners form with their neighbours.
///
/// For a triangle this is its own σ1/σ2, for a quad the worst of four. It is negative if one of the
/// triangles is flipped and +∞ if one collapses. `maps` are those of [`super::face_maps`].
///
/// # Rationale
/// The diagonals of a quad, and hence the σ1/σ2 of its [`FaceMap`], do not determine its angles: a
/// quad at the corner of a square keeps ρ while its angle of 90° is opened to 180° on a circle.
/// Surfels are measured on their tangent planes.
pub fn corner_errors(disc: &OrientedMesh, planes: Option<&TangentPlanes>, image: &Image, maps: &[FaceMap]) -> Vec<f64> {
    let of_face = |(f, polygon): (usize, &[u32])| {
        if disc.surrogates.has(f) {
            return if maps[f].convex { 1.0 } else { f64::INFINITY };
        }
        let n = polygon.len();
        if n == 3 {
            return signed(maps[f].sigma1, maps[f].sigma2);
        }
        let first = disc.faces.corner_range(f).start;
        let at = |k: usize| image.corner(disc, first + k % n);
        let from = |k: usize, l: usize| {
            let edge = sub(disc.positions[polygon[l % n] as usize], disc.positions[polygon[k % n] as usize]);
            planes.map_or(edge, |planes| planes.project(f, edge))
        };
        let of_corner = |k: usize| {
            let (ahead, behind) = (from(k, k + 1), from(k, k + n - 1));
            let length = norm(ahead);
            let w = Complex64::new(dot(ahead, behind), norm(cross(ahead, behind))) / (length * length);
            let (sigma1, sigma2) = singular_values(w, at(k + 1) - at(k), at(k + n - 1) - at(k));
            signed(sigma1, sigma2)
        };
        (0..n).map(of_corner).fold(1.0, worse)
    };
    disc.faces.iter().enumerate().take(disc.source_faces()).map(of_face).collect()
}

/// σ1/σ2; +∞ for triangles that collapse, even if rounding gives σ2 < 0 or σ1 = 0.
fn signed(sigma1: f64, sigma2: f64) -> f64 {
    let ratio = sigma1 / sigma2;
    if ratio.is_nan() { f64::INFINITY } else { ratio }
}

/// The larger of two values of σ1/σ2, where negative values (flipped triangles) are the largest.
fn worse(a: f64, b: f64) -> f64 {
    match (a < 0.0, b < 0.0) {
        (false, false) | (true, true) => a.max(b),
        (true, false) => a,
        (false, true) => b,
    }
}
