//! The quad graph: vertices, quads and one complex number ρ per quad, on which the energies and
//! system (2) are defined.

mod curvature;
pub mod dual;
mod from_quads;
mod from_triangles;
pub mod metric;
mod periods;
pub mod rho;
mod tangent;
mod triangles;

pub use curvature::curvature;
pub use periods::{Periods, PeriodsError};
pub(crate) use tangent::own_normal;
pub use tangent::{RestSource, TangentPlanes};
pub use triangles::RestTriangle;
pub(crate) use triangles::{area_at_rest, triangles_of_face};

use std::ops::Range;

use num_complex::Complex64;

use crate::geometry::vector;
use crate::sparse::Lists;

/// A quad graph with the rest geometry of its quads and boundary.
///
/// For a disc `2 (nv − nf) = nb + 2`: system (2) lacks `nb + 2` real equations.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadGraph {
    /// Number of vertices, `nv`.
    pub vertices: usize,
    /// Vertices `0 .. primal` are those of the mesh; the others are dual vertices of a triangle
    /// mesh.
    pub primal: usize,
    /// Vertices (v0, v1, v2, v3) of each quad, counter-clockwise (`nf × 4`).
    pub quads: Vec<[u32; 4]>,
    /// ρ of each quad (`nf`): z is conformal if `z3 − z1 = iρ(z2 − z0)` (2).
    pub rho: Vec<Complex64>,
    /// d02| of each quad at rest (`nf`), in the unit of the positions. The area of the quad is ½ Re ρ |d02|².
    pub diagonal: Vec<f64>,
    /// Number of quads whose given normal was tilted to keep ρ away from 0 and ∞; see
    /// [`TangentPlanes::guarded`].
    pub tilted: usize,
    /// The concatenated boundary loops, each with the surface on its left (`nb`).
    pub boundary: Vec<u32>,
    /// The range of each loop in `boundary`, the outer loop first; one for a disc, none for a
    /// closed surface.
    pub loops: Vec<Range<usize>>,
    /// Rest length of the edge from each boundary vertex to the next (`nb`).
    pub boundary_length: Vec<f64>,
    /// Approximate position of each vertex in space (`nv × 3`). It is used only to order unknowns
    /// and does not influence the map.
    pub places: Vec<[f64; 3]>,
}

/// The geometry of a mesh does not define ρ.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum QuadGraphError {
    /// The faces are neither triangles nor quads.
    #[error("the faces have {corners} corners each; triangles or quads are needed: triangulate them")]
    Corners {
        /// Number of corners of each face.
        corners: usize,
    },
    /// The diagonals of a quad span no area.
    #[error(
        "face {face} is degenerate: its diagonals, of vertices {vertices:?}, are parallel, without length, or beyond \
         the range of doubles, and ρ is not defined: move or remove a vertex"
    )]
    DegenerateQuad {
        /// The face.
        face: usize,
        /// Its vertices, as indices of the source.
        vertices: [u32; 4],
    },
    /// The given normal of a quad is perpendicular to the quad's own or points to its other side.
    #[error(
        "face {face} is seen edge-on or from below along its given normal {normal:?}, and ρ is not defined: correct \
         the normals, or compute ρ from the positions"
    )]
    NormalOffFace {
        /// The face.
        face: usize,
        /// Its normal.
        normal: [f64; 3],
    },
    /// A triangle has no area.
    #[error(
        "face {face} is degenerate: its vertices {vertices:?} are on one line or beyond the range of doubles: move or \
         remove a vertex"
    )]
    DegenerateTriangle {
        /// The face.
        face: usize,
        /// Its vertices, as indices of the source.
        vertices: [u32; 3],
    },
    /// The foot of a perpendicular does not lie on its boundary edge.
    #[error(
        "the perpendicular from the dual point of face {face} misses its boundary edge {edge:?}: the midpoint of the \
         edge is always on it"
    )]
    FootOutsideEdge {
        /// The face.
        face: usize,
        /// The ends of the edge, as indices of the source.
        edge: [u32; 2],
    },
    /// The graph has more vertices than 32-bit indices can number.
    #[error("the quad graph would have {vertices} vertices, more than 32-bit indices can number")]
    TooLarge {
        /// Number of vertices.
        vertices: usize,
    },
}

impl QuadGraph {
    /// Whether `v` is a dual vertex rather than a vertex of the mesh.
    pub fn is_dual(&self, v: u32) -> bool {
        v as usize >= self.primal
    }

    /// The smallest Re ρ; integral weights are defined if it is positive.
    pub fn min_re_rho(&self) -> f64 {
        self.rho.iter().map(|rho| rho.re).fold(f64::INFINITY, f64::min)
    }

    /// Whether every ρ is real, that is, all diagonals are orthogonal, as with circumcentres.
    pub fn is_orthogonal(&self) -> bool {
        self.rho.iter().all(|rho| rho.im == 0.0)
    }

    /// The rest area ½ |d02 × d13| = ½ Re ρ |d02|² of quad `q`.
    pub fn area(&self, q: usize) -> f64 {
        0.5 * self.rho[q].re * self.diagonal[q] * self.diagonal[q]
    }

    /// Finds the classes of vertices connected by diagonals: a label for each vertex, and the
    /// number of classes.
    ///
    /// System (2) involves only differences along diagonals, so each class can be translated
    /// freely. A disc has two classes: black (for a triangle mesh, its own vertices) and white.
    pub fn diagonal_classes(&self) -> (Vec<u32>, usize) {
        let mut classes = crate::surface::UnionFind::new(self.vertices);
        for &[v0, v1, v2, v3] in &self.quads {
            classes.unite(v0, v2);
            classes.unite(v1, v3);
        }
        classes.labels()
    }

    /// Finds the quads around every vertex.
    pub fn incidence(&self) -> Lists {
        let pairs = self.quads.iter().zip(0..).flat_map(|(quad, q)| quad.map(|v| (v, q)));
        Lists::new(self.vertices, pairs)
    }

    /// The length of the boundary at rest.
    pub fn perimeter(&self) -> f64 {
        self.boundary_length.iter().sum()
    }
}

/// x_b − x_a.
fn difference(positions: &[[f64; 3]], a: u32, b: u32) -> [f64; 3] {
    vector::sub(positions[b as usize], positions[a as usize])
}

/// The single loop of a boundary of `n` vertices; none if n is 0.
fn one_loop(n: usize) -> Vec<Range<usize>> {
    std::iter::once(0..n).filter(|whole| !whole.is_empty()).collect()
}
