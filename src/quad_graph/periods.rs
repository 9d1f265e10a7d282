use num_complex::Complex64;

use super::QuadGraph;
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::homology::Homology;

/// How the corners of quads and faces lie in the universal cover of a torus: a map with the periods ω1, ω2 has the vertex v
/// at `z_v + m ω1 + n ω2` where its offset is `[m, n]`.
///
/// A dual vertex of a triangle mesh lies in the frame of its face, that of the face's first corner.
#[derive(Clone, Debug, PartialEq)]
pub struct Periods {
    /// Of the corners of every quad, relative to the first (`nf × 4`; the first is `[0, 0]`).
    pub quads: Vec<[[i32; 2]; 4]>,
    /// Of the corners of every face of the mesh, relative to its first.
    pub corners: Vec<[i32; 2]>,
}

/// No offsets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum PeriodsError {
    /// A quad graph of another mesh.
    #[error("the quad graph is not that of the mesh: quad {quad} does not fit")]
    OtherMesh {
        /// The first such quad.
        quad: usize,
    },
    /// A change of basis beyond 32-bit integers.
    #[error(
        "the periods are so unequal that the offset {offset:?} leaves the range of 32-bit integers in the new basis"
    )]
    OutOfRange {
        /// An offset in the old basis.
        offset: [i32; 2],
    },
}

impl Periods {
    /// The offsets of `graph`, made of `disc` with the given edges.
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

    /// The quad (vi, c_g, vj, c_f) of the edge of the corner c of f and the corner d of g.
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
            // vi is the corner c of f, and of g the one behind d.
            let minus = |offset: [i32; 2]| offset.map(|x| -x);
            let along = homology.form[c].map(i32::from);
            quads.push([[0, 0], minus(self.corners[ahead[1]]), along, minus(self.corners[c])]);
        }
        Ok(quads)
    }

    /// The offsets by the basis `(ω2', ω1')ᵀ = M (ω2, ω1)ᵀ`, M = [[a, b], [c, d]] of determinant 1: an offset [m, n] becomes
    /// [a m − b n, d n − c m].
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

    /// `m ω1 + n ω2`.
    pub fn translation([m, n]: [i32; 2], [omega1, omega2]: [Complex64; 2]) -> Complex64 {
        f64::from(m) * omega1 + f64::from(n) * omega2
    }

    /// The corners of quad `q` under the map that is z in the cover's fundamental domain and has the periods ω.
    pub fn lifted(&self, graph: &QuadGraph, q: usize, z: &[Complex64], omega: [Complex64; 2]) -> [Complex64; 4] {
        let (quad, offsets) = (&graph.quads[q], &self.quads[q]);
        [0, 1, 2, 3].map(|k| z[quad[k] as usize] + Self::translation(offsets[k], omega))
    }
}
