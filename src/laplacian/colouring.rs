//! Black and white vertices, and the quads in terms of their black diagonals.

use num_complex::Complex64;

use super::LaplacianError;
use crate::quad_graph::QuadGraph;

/// The division of the vertices into black and white ones.
///
/// Every edge of a quad graph joins a black vertex and a white one. The vertices of a triangle mesh
/// are black; on a quad mesh, the class of the first boundary vertex is (of vertex 0 if there is no
/// boundary).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Colouring {
    is_black: Vec<bool>,
}

/// A quad with its black diagonal first: `z_f − z_g = iρ (z_j − z_i)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlackQuad {
    /// The ends i, j of the black diagonal.
    pub black: [u32; 2],
    /// The white vertices g, f; f lies on the left of the diagonal from i to j.
    pub white: [u32; 2],
    /// ρ relative to the black diagonal.
    pub rho: Complex64,
}

impl Colouring {
    /// Colours the vertices of `graph`.
    ///
    /// # Errors
    /// [`LaplacianError::NotTwoColoured`].
    pub fn new(graph: &QuadGraph) -> Result<Self, LaplacianError> {
        if graph.primal < graph.vertices {
            return Ok(Colouring { is_black: (0..graph.vertices).map(|v| v < graph.primal).collect() });
        }
        let (class, classes) = graph.diagonal_classes();
        if classes != 2 {
            return Err(LaplacianError::NotTwoColoured { classes });
        }
        let first = graph.boundary.first().map_or(0, |&v| v as usize);
        Ok(Colouring { is_black: class.iter().map(|&k| k == class[first]).collect() })
    }

    /// Returns the colouring with black and white exchanged.
    #[must_use]
    pub fn exchanged(&self) -> Self {
        Colouring { is_black: self.is_black.iter().map(|black| !black).collect() }
    }

    /// Whether vertex `v` is black.
    pub fn is_black(&self, v: u32) -> bool {
        self.is_black[v as usize]
    }

    /// Returns quad `q` of `graph` in terms of its black diagonal. If its first vertex is white, ρ
    /// is the inverse of the quad's own.
    pub fn quad(&self, graph: &QuadGraph, q: usize) -> BlackQuad {
        let [v0, v1, v2, v3] = graph.quads[q];
        let rho = graph.rho[q];
        match self.is_black(v0) {
            true => BlackQuad { black: [v0, v2], white: [v1, v3], rho },
            false => BlackQuad { black: [v1, v3], white: [v2, v0], rho: rho.inv() },
        }
    }

    /// Iterates over all quads of `graph` in terms of their black diagonals.
    pub fn quads(&self, graph: &QuadGraph) -> impl Iterator<Item = BlackQuad> + Clone {
        (0..graph.quads.len()).map(|q| self.quad(graph, q))
    }
}
