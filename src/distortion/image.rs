use num_complex::Complex64;

use crate::quad_graph::{Periods, QuadGraph};
use crate::surface::oriented_mesh::OrientedMesh;

/// Where a map puts the corners of faces and quads.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    /// The image of every vertex of the quad graph (`nv`); of a periodic map, one of its images.
    pub z: &'a [Complex64],
    /// How faces and quads lie in the cover, and the periods ω1, ω2; `None` for maps of discs.
    pub cover: Option<(&'a Periods, [Complex64; 2])>,
}

impl<'a> Image<'a> {
    /// That of a disc, where every vertex has one place.
    pub fn of_disc(z: &'a [Complex64]) -> Self {
        Image { z, cover: None }
    }

    /// The corners of quad `q`, side by side.
    pub fn quad(&self, graph: &QuadGraph, q: usize) -> [Complex64; 4] {
        match self.cover {
            Some((periods, omega)) => periods.lifted(graph, q, self.z, omega),
            None => graph.quads[q].map(|v| self.z[v as usize]),
        }
    }

    /// The corner `c` of a face of the mesh, beside that face's first corner.
    pub fn corner(&self, disc: &OrientedMesh, c: usize) -> Complex64 {
        let z = self.z[disc.faces.corners()[c] as usize];
        match self.cover {
            Some((periods, omega)) => z + Periods::translation(periods.corners[c], omega),
            None => z,
        }
    }
}
