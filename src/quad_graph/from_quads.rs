use super::rho::{extrinsic, with_normal};
use super::{QuadGraph, QuadGraphError, difference};
use crate::surface::disc::Disc;
use crate::surface::vector::norm;

/// What the ρ of a quad mesh is computed from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RhoSource {
    /// The diagonals in R³, equation (1).
    #[default]
    Positions,
    /// The diagonals projected on the plane of each face's given normal.
    Normals,
}

impl QuadGraph {
    /// The quads of a quad mesh as they are, ρ extrinsic or from the faces' normals.
    ///
    /// # Errors
    /// A face whose diagonals give no ρ; normals asked for where there are none.
    pub fn from_quads(disc: &Disc, source: RhoSource) -> Result<Self, QuadGraphError> {
        let normals = match source {
            RhoSource::Positions => None,
            RhoSource::Normals => Some(disc.face_normals.as_deref().ok_or(QuadGraphError::NoNormals)?),
        };
        let mut graph = QuadGraph {
            vertices: disc.positions.len(),
            primal: disc.positions.len(),
            quads: Vec::with_capacity(disc.faces.len()),
            rho: Vec::with_capacity(disc.faces.len()),
            diagonal: Vec::with_capacity(disc.faces.len()),
            boundary: disc.boundary.clone(),
            boundary_length: Vec::with_capacity(disc.boundary.len()),
        };
        for (face, polygon) in disc.faces.iter().enumerate() {
            let &[v0, v1, v2, v3] = polygon else { return Err(QuadGraphError::Corners { corners: polygon.len() }) };
            let d02 = difference(&disc.positions, v0, v2);
            let d13 = difference(&disc.positions, v1, v3);
            let seen = match normals {
                None => extrinsic(d02, d13).ok_or_else(|| QuadGraphError::DegenerateQuad {
                    face,
                    vertices: [v0, v1, v2, v3].map(|v| disc.source_vertex[v as usize]),
                }),
                Some(normals) => with_normal(d02, d13, normals[face])
                    .ok_or(QuadGraphError::NormalOffFace { face, normal: normals[face] }),
            }?;
            graph.quads.push([v0, v1, v2, v3]);
            graph.rho.push(seen.rho);
            graph.diagonal.push(seen.length);
        }
        for (k, &v) in disc.boundary.iter().enumerate() {
            let next = disc.boundary[(k + 1) % disc.boundary.len()];
            graph.boundary_length.push(norm(difference(&disc.positions, v, next)));
        }
        Ok(graph)
    }
}
