use num_complex::Complex64;

use crate::quad_graph::{Periods, QuadGraph};
use crate::surface::oriented_mesh::OrientedMesh;

/// The images of the corners of faces and quads under a map.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    /// The image of every vertex of the quad graph (`nv`); for a periodic map, one of its images.
    pub z: &'a [Complex64],
    /// The offsets of faces and quads in the cover and the periods ω1, ω2; `None` for maps of
    /// discs.
    pub cover: Option<(&'a Periods, [Complex64; 2])>,
}

impl<'a> Image<'a> {
    /// Makes the image of a disc, whose vertices have one image each.
    pub fn of_disc(z: &'a [Complex64]) -> Self {
        Image { z, cover: None }
    }

    /// The images of the corners of quad `q`, in one copy of the cover.
    pub fn quad(&self, graph: &QuadGraph, q: usize) -> [Complex64; 4] {
        match self.cover {
            Some((periods, omega)) => periods.lifted(graph, q, self.z, omega),
            None => graph.quads[q].map(|v| self.z[v as usize]),
        }
    }

    /// The image of corner `c` of a face of the mesh, in the same copy of the cover as the face's
    /// first corner.
    pub fn corner(&self, disc: &OrientedMesh, c: usize) -> Complex64 {
        let z = self.z[disc.faces.corners()[c] as usize];
        match self.cover {
            Some((periods, omega)) => z + Periods::translation(periods.corners[c], omega),
            None => z,
        }
    }
}
