//! The triangles of the mesh at rest, with which the energies of maps without flipped faces compare
//! a map.

use num_complex::Complex64;

use super::TangentPlanes;
use crate::geometry::vector::{cross, dot, norm};
use crate::surface::Surrogates;
use crate::surface::oriented_mesh::OrientedMesh;

/// A triangle at rest: a face, or the triangle of a corner of a quad and its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestTriangle {
    /// Its vertices, counter-clockwise.
    pub vertices: [u32; 3],
    /// The position of the third vertex if the first is at 0 and the second at 1. Im w > 0 unless
    /// the triangle has no area.
    pub w: Complex64,
    /// The length of the edge from the first vertex to the second.
    pub length: f64,
    /// The integral weight: the area of a triangle; for a corner of a quad half of its area,
    /// because the four corners of a flat quad cover it twice.
    pub area: f64,
    /// The unit weight, by which every face counts for 1, and a face with a surrogate for the
    /// surrogate's height.
    pub share: f64,
    /// Its face, as an index of the source.
    pub face: u32,
}

impl RestTriangle {
    /// Whether the triangle has a positive finite area.
    pub fn is_proper(&self) -> bool {
        self.w.im > 0.0 && self.w.is_finite() && self.length > 0.0 && self.area > 0.0 && self.area.is_finite()
    }
}

/// Returns the triangles of a disc: its faces, or the four corners of each of its quads, projected
/// to `planes` if given.
///
/// A corner of a quad can have no area although the quad has: its angle is 0 or π, or one of its
/// edges has no length. With `opened` it is given an area in the same way as [`Surrogates`] do for
/// triangles.
pub(super) fn rest_triangles(disc: &OrientedMesh, planes: Option<&TangentPlanes>, opened: bool) -> Vec<RestTriangle> {
    let mut triangles = Vec::with_capacity(disc.faces.corners().len());
    (0..disc.faces.len()).for_each(|f| triangles.extend(triangles_of_face(disc, planes, opened, f)));
    triangles
}

/// Returns the area of a surface, the sum over its triangles, opened as far as they can be.
pub(crate) fn area_at_rest(disc: &OrientedMesh, planes: Option<&TangentPlanes>) -> f64 {
    (0..disc.faces.len()).flat_map(|f| triangles_of_face(disc, planes, true, f)).map(|t| t.area).sum()
}

/// Returns the triangles of face `f`: the face itself, or the four corners of a quad; `opened` as
/// for [`rest_triangles`].
pub(crate) fn triangles_of_face<'a>(
    disc: &'a OrientedMesh,
    planes: Option<&'a TangentPlanes>,
    opened: bool,
    f: usize,
) -> impl Iterator<Item = RestTriangle> + 'a {
    let polygon = disc.faces.get(f);
    let n = polygon.len();
    let (count, share) = if n == 3 { (1, 1.0) } else { (n, 0.5) };
    (0..count).map(move |k| {
        let corners = [k, (k + 1) % n, (k + n - 1) % n];
        let edge = |to: usize| {
            let d = disc.spoke(f, k, to);
            planes.map_or(d, |planes| planes.project(f, d))
        };
        let (mut ahead, mut behind) = (edge(corners[1]), edge(corners[2]));
        if opened && n > 3 {
            [ahead, behind] = Surrogates::opened([ahead, behind]);
        }
        let (length_squared, twice_area) = (dot(ahead, ahead), norm(cross(ahead, behind)));
        RestTriangle {
            vertices: corners.map(|k| polygon[k]),
            w: Complex64::new(dot(ahead, behind), twice_area) / length_squared,
            length: length_squared.sqrt(),
            area: 0.5 * share * twice_area,
            share: disc.surrogates.share(f) / count as f64,
            face: disc.source_face[f],
        }
    })
}
