//! Tangent planes that are given beside the positions: estimated normals of digital surfaces, normals of files.

use super::difference;
use crate::geometry::vector::{add, cross, dot, norm, scale, sub};
use crate::surface::oriented_mesh::OrientedMesh;

/// What the rest lengths and areas of a quad mesh with given normals are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RestSource {
    /// Those of the face projected on its tangent plane; of an edge the mean over its faces. They fit ρ.
    #[default]
    Projected,
    /// Those of the positions: 1 for all edges and surfels of a digital surface, as the paper has it.
    Unit,
}

/// The tangent plane of every face, by its unit normal, on which ρ and the rest geometry are measured.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentPlanes {
    /// Unit normals (`nf × 3`).
    pub normals: Vec<[f64; 3]>,
    /// Faces whose normal was tilted by [`TangentPlanes::guarded`].
    pub tilted: usize,
    /// What rest lengths and areas are.
    pub rest: RestSource,
}

impl TangentPlanes {
    /// The smallest cosine between a face's own normal and the given one: 87° apart.
    ///
    /// As it vanishes the projected face does, and ρ with it. Where surfels are as steep as that they are few and cover a
    /// share of the surface of about its square.
    pub const SMALLEST_COSINE: f64 = 0.05;

    /// The planes of these normals, as they are.
    pub fn exactly(normals: Vec<[f64; 3]>, rest: RestSource) -> Self {
        TangentPlanes { normals, tilted: 0, rest }
    }

    /// The planes of these normals, where n makes an angle with the face's own normal m whose cosine is less than
    /// [`SMALLEST_COSINE`](Self::SMALLEST_COSINE) with n turned towards m until it has that one.
    ///
    /// m is the direction of d02 × d13, on a surfel its axis. A degenerate face keeps its normal.
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

    /// The length of `d`, an edge of `face`, as it counts at rest.
    pub fn length(&self, face: usize, d: [f64; 3]) -> f64 {
        match self.rest {
            RestSource::Unit => norm(d),
            RestSource::Projected => norm(self.project(face, d)),
        }
    }

    /// `d` projected on the plane of `face`.
    pub fn project(&self, face: usize, d: [f64; 3]) -> [f64; 3] {
        let n = self.normals[face];
        sub(d, scale(dot(d, n), n))
    }
}

/// The unit vector along `d02 × d13`; `None` where there is none.
pub(crate) fn own_normal(disc: &OrientedMesh, polygon: &[u32]) -> Option<[f64; 3]> {
    let &[v0, v1, v2, v3] = polygon else { return None };
    let area = cross(difference(&disc.positions, v0, v2), difference(&disc.positions, v1, v3));
    let length = norm(area);
    (length > 0.0 && length.is_finite()).then(|| scale(1.0 / length, area))
}

/// The unit vector at the smallest cosine to `own`, on the side of `tangential`.
fn turned_towards(own: [f64; 3], tangential: [f64; 3]) -> [f64; 3] {
    const COSINE: f64 = TangentPlanes::SMALLEST_COSINE;
    let length = norm(tangential);
    // A normal that is exactly opposite has no side.
    if length < 1e-12 {
        return own;
    }
    add(scale(COSINE, own), scale((1.0 - COSINE * COSINE).sqrt() / length, tangential))
}
