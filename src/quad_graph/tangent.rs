//! Tangent planes given in addition to positions: estimated normals of digital surfaces, normals of
//! files.

use super::difference;
use crate::geometry::vector::{add, cross, dot, norm, scale, sub};
use crate::surface::oriented_mesh::OrientedMesh;

/// The source of the rest lengths and areas of a quad mesh with given normals.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RestSource {
    /// The face projected on its tangent plane; for edges the mean over its faces. This is
    /// consistent with ρ.
    #[default]
    Projected,
    /// The positions: 1 for all edges and surfels of a digital surface, as in the paper.
    Unit,
}

/// The tangent plane of every face, given by its unit normal, on which ρ and the rest geometry are
/// measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentPlanes {
    /// Unit normals (`nf × 3`).
    pub normals: Vec<[f64; 3]>,
    /// Number of faces whose normal was tilted by [`TangentPlanes::guarded`].
    pub tilted: usize,
    /// The source of rest lengths and areas.
    pub rest: RestSource,
}

impl TangentPlanes {
    /// The smallest cosine between a face's own normal and the given one, an angle of 87°.
    ///
    /// As the cosine tends to 0, so do the area of the projected face and ρ. Surfels as steep as
    /// this are few; their share of the surface is of the order of the square of the cosine.
    pub const SMALLEST_COSINE: f64 = 0.05;

    /// Makes the planes of these normals without changing them.
    pub fn exactly(normals: Vec<[f64; 3]>, rest: RestSource) -> Self {
        TangentPlanes { normals, tilted: 0, rest }
    }

    /// Makes the planes of these normals, tilted where necessary.
    ///
    /// If the cosine of the angle between n and the face's own normal m is less than
    /// [`SMALLEST_COSINE`](Self::SMALLEST_COSINE), n is rotated towards m until it has that cosine.
    /// m is the direction of d02 × d13; for a surfel it is its axis. A degenerate face keeps its
    /// given normal.
    pub fn guarded(disc: &OrientedMesh, mut normals: Vec<[f64; 3]>, rest: RestSource) -> Self {
        let mut tilted = 0;
        for (normal, polygon) in normals.iter_mut().zip(disc.faces.iter()) {
            let Some(own) = own_normal(disc, polygon) else { continue };
            let cosine = dot(*normal, own);
            if cosine < Self::SMALLEST_COSINE {
                *normal = turned_towards(own, sub(*normal, scale(cosine, own)));
                tilted += 1;
            }
        }
        TangentPlanes { normals, tilted, rest }
    }

    /// The rest length of the edge `d` of `face`.
    pub fn length(&self, face: usize, d: [f64; 3]) -> f64 {
        match self.rest {
            RestSource::Unit => norm(d),
            RestSource::Projected => norm(self.project(face, d)),
        }
    }

    /// Projects `d` to the plane of `face`.
    pub fn project(&self, face: usize, d: [f64; 3]) -> [f64; 3] {
        let n = self.normals[face];
        sub(d, scale(dot(d, n), n))
    }
}

/// Returns the unit vector along `d02 × d13`, or `None` if that vanishes or overflows.
pub(crate) fn own_normal(disc: &OrientedMesh, polygon: &[u32]) -> Option<[f64; 3]> {
    let &[v0, v1, v2, v3] = polygon else { return None };
    let area = cross(difference(&disc.positions, v0, v2), difference(&disc.positions, v1, v3));
    let length = norm(area);
    (length > 0.0 && length.is_finite()).then(|| scale(1.0 / length, area))
}

/// Returns the unit vector at the smallest cosine to `own`, on the side of `tangential`.
fn turned_towards(own: [f64; 3], tangential: [f64; 3]) -> [f64; 3] {
    const COSINE: f64 = TangentPlanes::SMALLEST_COSINE;
    let length = norm(tangential);
    // A normal that is exactly opposite has no side.
    if length < 1e-12 {
        return own;
    }
    add(scale(COSINE, own), scale((1.0 - COSINE * COSINE).sqrt() / length, tangential))
}
