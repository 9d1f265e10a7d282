use num_complex::Complex64;

use super::QuadGraph;
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::homology::Homology;

/// Offsets of the corners of quads and faces in the universal cover of a torus.
///
/// If the map has the periods ω1, ω2 and a corner has vertex v and offset `[m, n]`, its image is
/// `z_v + m ω1 + n ω2`. A dual vertex of a triangle mesh is in the frame of its face, which is that
/// of the face's first corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Periods {
    /// Offsets of the corners of every quad relative to the first (`nf × 4`; the first is `[0,
    /// 0]`).
    pub quads: Vec<[[i32; 2]; 4]>,
    /// Offsets of the corners of every face of the mesh relative to its first corner.
    pub corners: Vec<[i32; 2]>,
}

/// The offsets cannot be computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PeriodsError {
    /// The quad graph belongs to a different mesh.
    #[error("the quad graph is not that of the mesh: quad {quad} does not fit")]
    OtherMesh {
        /// The first such quad.
        quad: usize,
    },
    /// A change of basis leads to offsets beyond 32-bit integers.
    #[error(
        "the periods are so unequal that the offset {offset:?} leaves the range of 32-bit integers in the new basis"
    )]
    OutOfRange {
        /// The offset in the old basis.
        offset: [i32; 2],
    },
}

impl Periods {
    /// Computes the offsets of `graph`, which was made from `disc` with the given edges.
    ///
    /// # Errors
    /// [`PeriodsError::OtherMesh`].
    pub fn new(
        disc: &OrientedMesh,
        graph: &QuadGraph,
        edges: &Edges,
        homology: &Homology,
    ) -> Result<Self, PeriodsError> {
        let mut corners = Vec::with_capacity(homology.form.len());
        for f in 0..disc.faces.len() {
            let mut at = [0; 2];
            for c in disc.faces.corner_range(f) {
                corners.push(at);
                at = [0, 1].map(|k| at[k] + i32::from(homology.form[c][k]));
            }
        }
        let periods = Periods { quads: Vec::new(), corners };
        let quads = match graph.primal == graph.vertices {
            true => periods.of_quads(disc, graph),
            false => periods.of_triangles(disc, graph, edges, homology),
        }?;
        Ok(Periods { quads, ..periods })
    }

    fn of_quads(&self, disc: &OrientedMesh, graph: &QuadGraph) -> Result<Vec<[[i32; 2]; 4]>, PeriodsError> {
        let (offsets, rest) = self.corners.as_chunks();
        let (vertices, _) = disc.faces.corners().as_chunks::<4>();
        let fits = |q: usize| vertices.get(q) == graph.quads.get(q);
        match (0..graph.quads.len().max(vertices.len())).find(|&q| !fits(q)) {
            Some(quad) => Err(PeriodsError::OtherMesh { quad }),
            None if !rest.is_empty() => Err(PeriodsError::OtherMesh { quad: vertices.len() }),
            None => Ok(offsets.to_vec()),
        }
    }

    /// Offsets of the quad (vi, c_g, vj, c_f) at the edge of corner c of face f and corner d of
    /// face g.
    fn of_triangles(
        &self,
        disc: &OrientedMesh,
        graph: &QuadGraph,
        edges: &Edges,
        homology: &Homology,
    ) -> Result<Vec<[[i32; 2]; 4]>, PeriodsError> {
        let vertex = disc.faces.corners();
        let mut quads = Vec::with_capacity(edges.len());
        for e in 0..edges.len().max(graph.quads.len()) {
            let other_mesh = PeriodsError::OtherMesh { quad: e };
            if e >= edges.len() || e >= graph.quads.len() {
                return Err(other_mesh);
            }
            let &[c, d] = edges.corners(e) else { return Err(other_mesh) };
            let (c, d) = (c as usize, d as usize);
            let [f, g] = [c, d].map(|c| edges.face_of_corner[c]);
            let ahead = [next_in(&disc.faces, f as usize, c), next_in(&disc.faces, g as usize, d)];
            let dual = |f: u32| disc.positions.len() as u32 + f;
            if graph.quads[e] != [vertex[c], dual(g), vertex[ahead[0]], dual(f)] || vertex[ahead[1]] != vertex[c] {
                return Err(other_mesh);
            }
            // vi is at corner c of f, and at the corner after d of g.
            let minus = |offset: [i32; 2]| offset.map(|x| -x);
            let along = homology.form[c].map(i32::from);
            quads.push([[0, 0], minus(self.corners[ahead[1]]), along, minus(self.corners[c])]);
        }
        Ok(quads)
    }

    /// Transforms the offsets to the basis `(ω2', ω1')ᵀ = M (ω2, ω1)ᵀ`, where M = [[a, b], [c, d]]
    /// has determinant 1: an offset [m, n] becomes [a m − b n, d n − c m].
    ///
    /// # Errors
    /// [`PeriodsError::OutOfRange`].
    pub fn change_basis(&mut self, [[a, b], [c, d]]: [[i64; 2]; 2]) -> Result<(), PeriodsError> {
        for offset in self.quads.as_flattened_mut().iter_mut().chain(&mut self.corners) {
            let [m, n] = offset.map(i64::from);
            let combined = |p: i64, q: i64| i32::try_from(p.checked_mul(m)?.checked_add(q.checked_mul(n)?)?).ok();
            let (Some(first), Some(second)) = (combined(a, b.wrapping_neg()), combined(c.wrapping_neg(), d)) else {
                return Err(PeriodsError::OutOfRange { offset: *offset });
            };
            *offset = [first, second];
        }
        Ok(())
    }

    /// The translation `m ω1 + n ω2`.
    pub fn translation([m, n]: [i32; 2], [omega1, omega2]: [Complex64; 2]) -> Complex64 {
        f64::from(m) * omega1 + f64::from(n) * omega2
    }

    /// The images of the corners of quad `q` under the map with vertex values z and periods ω.
    pub fn lifted(&self, graph: &QuadGraph, q: usize, z: &[Complex64], omega: [Complex64; 2]) -> [Complex64; 4] {
        let (quad, offsets) = (&graph.quads[q], &self.quads[q]);
        [0, 1, 2, 3].map(|k| z[quad[k] as usize] + Self::translation(offsets[k], omega))
    }
}
