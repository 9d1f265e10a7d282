use super::rho::{extrinsic, with_normal};
use super::{QuadGraph, QuadGraphError, TangentPlanes, difference, one_loop};
use crate::geometry::vector::norm;
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;

impl QuadGraph {
    /// Makes the quad graph of a quad mesh, with ρ extrinsic or measured on given tangent planes.
    ///
    /// # Errors
    /// A face whose diagonals do not define ρ.
    pub fn from_quads(disc: &OrientedMesh, planes: Option<&TangentPlanes>) -> Result<Self, QuadGraphError> {
        let mut graph = QuadGraph {
            vertices: disc.positions.len(),
            primal: disc.positions.len(),
            quads: Vec::with_capacity(disc.faces.len()),
            rho: Vec::with_capacity(disc.faces.len()),
            diagonal: Vec::with_capacity(disc.faces.len()),
            tilted: planes.map_or(0, |planes| planes.tilted),
            boundary: disc.boundary.clone(),
            loops: one_loop(disc.boundary.len()),
            boundary_length: Vec::new(),
            places: disc.positions.clone(),
        };
        for (face, polygon) in disc.faces.iter().enumerate() {
            let &[v0, v1, v2, v3] = polygon else { return Err(QuadGraphError::Corners { corners: polygon.len() }) };
            let (d02, d13) = (disc.spoke(face, 0, 2), disc.spoke(face, 1, 3));
            let seen = match planes {
                None => extrinsic(d02, d13).ok_or_else(|| QuadGraphError::DegenerateQuad {
                    face: disc.source_face[face] as usize,
                    vertices: [v0, v1, v2, v3].map(|v| disc.source_vertex[v as usize]),
                }),
                Some(TangentPlanes { normals, .. }) => {
                    with_normal(d02, d13, normals[face]).ok_or(QuadGraphError::NormalOffFace {
                        face: disc.source_face[face] as usize,
                        normal: normals[face],
                    })
                }
            }?;
            graph.quads.push([v0, v1, v2, v3]);
            graph.rho.push(seen.rho);
            graph.diagonal.push(seen.length);
        }
        graph.boundary_length = boundary_lengths(disc, planes);
        Ok(graph)
    }
}

/// Returns the rest length of the edge from each boundary vertex to the next.
fn boundary_lengths(disc: &OrientedMesh, planes: Option<&TangentPlanes>) -> Vec<f64> {
    let n = disc.boundary.len();
    let ahead = |k: usize| difference(&disc.positions, disc.boundary[k], disc.boundary[(k + 1) % n]);
    if planes.is_none() && disc.surrogates.height == 0.0 {
        return (0..n).map(|k| norm(ahead(k))).collect();
    }
    let mut position = vec![u32::MAX; disc.positions.len()];
    for (k, &v) in disc.boundary.iter().enumerate() {
        position[v as usize] = k as u32;
    }
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let mut lengths = vec![0.0; n];
    for e in 0..edges.len() {
        let &[c] = edges.corners(e) else { continue };
        let face = edges.face_of_corner[c as usize] as usize;
        let corner_vertex = disc.faces.corners();
        let (v, w) = (corner_vertex[c as usize], corner_vertex[next_in(&disc.faces, face, c as usize)]);
        lengths[position[v as usize] as usize] = match planes {
            Some(planes) => planes.length(face, difference(&disc.positions, v, w)),
            None => {
                let longest = (0..4).map(|k| norm(disc.spoke(face, k, (k + 1) % 4))).fold(0.0, f64::max);
                match disc.edge_length(&[c], &edges.face_of_corner) {
                    0.0 => disc.surrogates.height * longest,
                    length => length,
                }
            }
        };
    }
    lengths
}
