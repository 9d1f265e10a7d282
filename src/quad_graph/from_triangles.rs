use num_complex::Complex64;

use super::dual::{BoundaryDual, DualPoint};
use super::{QuadGraph, QuadGraphError, one_loop};
use crate::geometry::vector::{add, cross, dot, norm, scale};
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;

impl QuadGraph {
    /// Makes the quad graph of a triangle mesh, with a dual vertex for each face and for each
    /// boundary edge.
    ///
    /// Each edge vi → vj with face f on its left and g on its right gives the quad (vi, c_g, vj,
    /// c_f), with the two triangles unfolded into a plane. In coordinates in which the edge is 0 →
    /// 1, c_f = s + ih and (from the other end) c_g = s' + ih' give
    ///
    /// ```text
    /// ρ = (c_f − c_g) / i = (h + h') − i (s + s' − 1)
    /// ```
    ///
    /// On a boundary edge c_g is the dual vertex on it. The vertices are those of the mesh, then
    /// one per face, then one per boundary edge in the order of the boundary.
    ///
    /// # Errors
    /// A triangle without area; a perpendicular that misses its boundary edge.
    pub fn from_triangles(
        disc: &OrientedMesh,
        dual: &dyn DualPoint,
        boundary_dual: BoundaryDual,
    ) -> Result<Self, QuadGraphError> {
        let (primal, faces, loop_length) = (disc.positions.len(), disc.faces.len(), disc.boundary.len());
        let vertices = primal + faces + loop_length;
        if vertices >= u32::MAX as usize {
            return Err(QuadGraphError::TooLarge { vertices });
        }
        let edges = Edges::new(&disc.faces, primal);
        // The longest that one of an edge's faces has there.
        let mut diagonal = vec![0.0f64; edges.len()];
        let placed = place_dual_points(disc, dual, |c, length| {
            let longest = &mut diagonal[edges.of_corner[c] as usize];
            *longest = longest.max(length);
        })?;
        let corner_vertex = disc.faces.corners();
        let face_dual = |f: u32| primal as u32 + f;

        let mut boundary_position = vec![u32::MAX; primal];
        for (k, &v) in disc.boundary.iter().enumerate() {
            boundary_position[v as usize] = k as u32;
        }
        let mut graph = QuadGraph {
            vertices,
            primal,
            quads: Vec::with_capacity(edges.len()),
            rho: Vec::with_capacity(edges.len()),
            diagonal,
            tilted: 0,
            boundary: Vec::with_capacity(2 * loop_length),
            loops: one_loop(2 * loop_length),
            boundary_length: vec![0.0; 2 * loop_length],
            places: places(disc),
        };
        for (k, &v) in disc.boundary.iter().enumerate() {
            graph.boundary.extend([v, (primal + faces + k) as u32]);
        }
        for e in 0..edges.len() {
            let corners = edges.corners(e);
            let c = corners[0] as usize;
            let f = edges.face_of_corner[c];
            let (vi, vj) = (corner_vertex[c], corner_vertex[next_in(&disc.faces, f as usize, c)]);
            let length = graph.diagonal[e];
            let (s, h) = placed[c];
            let (right, rho) = match corners {
                &[_, d] => {
                    let (s_right, h_right) = placed[d as usize];
                    (face_dual(edges.face_of_corner[d as usize]), Complex64::new(h + h_right, 1.0 - s - s_right))
                }
                _ => {
                    let foot = match boundary_dual {
                        BoundaryDual::Midpoint => 0.5,
                        BoundaryDual::Foot => s,
                    };
                    if !(foot > 0.0 && foot < 1.0) {
                        let edge = [vi, vj].map(|v| disc.source_vertex[v as usize]);
                        let face = disc.source_face[f as usize] as usize;
                        return Err(QuadGraphError::FootOutsideEdge { face, edge });
                    }
                    let k = boundary_position[vi as usize] as usize;
                    graph.boundary_length[2 * k] = foot * length;
                    graph.boundary_length[2 * k + 1] = (1.0 - foot) * length;
                    ((primal + faces + k) as u32, Complex64::new(h, foot - s))
                }
            };
            graph.quads.push([vi, right, vj, face_dual(f)]);
            graph.rho.push(rho);
        }
        Ok(graph)
    }
}

/// Returns the vertices, the barycentres of the faces and the midpoints of the boundary edges.
fn places(disc: &OrientedMesh) -> Vec<[f64; 3]> {
    let mean = |vertices: &[u32]| {
        let sum = vertices.iter().fold([0.0; 3], |sum, &v| add(sum, disc.positions[v as usize]));
        scale(1.0 / vertices.len() as f64, sum)
    };
    let (loop_, n) = (&disc.boundary, disc.boundary.len());
    let mut places = disc.positions.clone();
    places.extend(disc.faces.iter().map(mean));
    places.extend((0..n).map(|k| mean(&[loop_[k], loop_[(k + 1) % n]])));
    places
}

/// Returns for each corner the dual point (s, h) of its face, in coordinates in which the corner's
/// edge is 0 → 1. `measured` receives the length of every corner's edge.
pub(super) fn place_dual_points(
    disc: &OrientedMesh,
    dual: &dyn DualPoint,
    mut measured: impl FnMut(usize, f64),
) -> Result<Vec<(f64, f64)>, QuadGraphError> {
    let mut placed = Vec::with_capacity(disc.faces.corners().len());
    for (face, polygon) in disc.faces.iter().enumerate() {
        let &[a, b, c] = polygon else { return Err(QuadGraphError::Corners { corners: polygon.len() }) };
        let edges = [0, 1, 2].map(|k| disc.spoke(face, k, (k + 1) % 3));
        let twice_area = norm(cross(edges[0], scale(-1.0, edges[2])));
        for k in 0..3 {
            let (edge, back) = (edges[k], edges[(k + 2) % 3]);
            let length_squared = dot(edge, edge);
            let (s, h) = dual.place(-dot(edge, back) / length_squared, twice_area / length_squared);
            if !(s.is_finite() && h.is_finite() && length_squared > 0.0) {
                let vertices = [a, b, c].map(|v| disc.source_vertex[v as usize]);
                let face = disc.source_face[face] as usize;
                return Err(QuadGraphError::DegenerateTriangle { face, vertices });
            }
            measured(placed.len(), length_squared.sqrt());
            placed.push((s, h));
        }
    }
    Ok(placed)
}
