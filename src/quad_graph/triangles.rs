//! The triangles of the mesh at rest, which the energies of maps without folds compare a map with.

use num_complex::Complex64;

use super::{TangentPlanes, difference};
use crate::surface::disc::Disc;
use crate::surface::vector::{cross, dot, norm};

/// A triangle at rest: a face, or the triangle that a corner of a quad makes with its neighbours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestTriangle {
    /// Its vertices, counter-clockwise.
    pub vertices: [u32; 3],
    /// Where the third vertex is when the first is at 0 and the second at 1. Im w > 0, but where the triangle has no area.
    pub w: Complex64,
    /// The length of the edge from the first vertex to the second.
    pub length: f64,
    /// What it counts for: the area of a triangle; of a corner of a quad half of it, as the four of a flat quad cover it twice.
    pub area: f64,
    /// What it counts for where every face counts for 1.
    pub share: f64,
    /// Its face, as the source numbers them.
    pub face: u32,
}

impl RestTriangle {
    /// Whether it has a shape.
    pub fn is_proper(&self) -> bool {
        self.w.im > 0.0 && self.w.is_finite() && self.length > 0.0 && self.area > 0.0 && self.area.is_finite()
    }
}

/// The triangles of a disc: its faces, or the four corners of each of its quads, projected on `planes` where these are given.
pub(super) fn rest_triangles(disc: &Disc, planes: Option<&TangentPlanes>) -> Vec<RestTriangle> {
    let mut triangles = Vec::with_capacity(disc.faces.corners().len());
    for (f, polygon) in disc.faces.iter().enumerate() {
        let n = polygon.len();
        let (corners, share) = if n == 3 { (1, 1.0) } else { (n, 0.5) };
        for k in 0..corners {
            let vertices = [k, (k + 1) % n, (k + n - 1) % n].map(|k| polygon[k]);
            let edge = |to: u32| {
                let d = difference(&disc.positions, vertices[0], to);
                planes.map_or(d, |planes| planes.project(f, d))
            };
            let (ahead, behind) = (edge(vertices[1]), edge(vertices[2]));
            let (length_squared, twice_area) = (dot(ahead, ahead), norm(cross(ahead, behind)));
            triangles.push(RestTriangle {
                vertices,
                w: Complex64::new(dot(ahead, behind), twice_area) / length_squared,
                length: length_squared.sqrt(),
                area: 0.5 * share * twice_area,
                share: 1.0 / corners as f64,
                face: disc.source_face[f],
            });
        }
    }
    triangles
}
