//! The quad graph: vertices, quads, one complex number ρ per quad. All that the energies and system (2) know.

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
pub(crate) use triangles::triangles_of_face;

use std::ops::Range;

use num_complex::Complex64;

use crate::geometry::vector;

/// A quad graph with the rest geometry that a map is compared with.
///
/// For a disc the counts satisfy `2 (nv − nf) = nb + 2`: system (2) lacks `nb + 2` real equations.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadGraph {
    /// Number of vertices, `nv`.
    pub vertices: usize,
    /// Vertices `0 .. primal` are those of the mesh; the others are dual vertices of a triangle mesh.
    pub primal: usize,
    /// Vertices (v0, v1, v2, v3) of each quad, counter-clockwise (`nf × 4`).
    pub quads: Vec<[u32; 4]>,
    /// ρ of each quad (`nf`): `z3 − z1 = iρ(z2 − z0)` where z is conformal (2).
    pub rho: Vec<Complex64>,
    /// |d02| of each quad at rest (`nf`), the unit of the positions. Its area is ½ Re ρ |d02|².
    pub diagonal: Vec<f64>,
    /// Quads whose given normal was tilted to keep ρ away from 0 and ∞; see [`TangentPlanes::guarded`].
    pub tilted: usize,
    /// The boundary loops one behind the other, each with the surface on its left (`nb`).
    pub boundary: Vec<u32>,
    /// The positions in `boundary` of every loop, the outer one first: one for a disc, none for a closed surface.
    pub loops: Vec<Range<usize>>,
    /// Rest length of the edge from each boundary vertex to the next (`nb`).
    pub boundary_length: Vec<f64>,
    /// About where each vertex is in space (`nv × 3`): tells how to number unknowns, and has no part in any map.
    pub places: Vec<[f64; 3]>,
}

/// The geometry of a mesh gives no usable ρ.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum QuadGraphError {
    /// Faces of a number of corners that the method does not take.
    #[error("the faces have {corners} corners each; triangles or quads are needed: triangulate them")]
    Corners {
        /// Corners of each face.
        corners: usize,
    },
    /// A quad whose diagonals span no area.
    #[error(
        "face {face} is degenerate: its diagonals, of vertices {vertices:?}, are parallel, without length, or beyond \
         the range of doubles, and ρ is not defined: move or remove a vertex"
    )]
    DegenerateQuad {
        /// The face.
        face: usize,
        /// Its vertices, as the source numbers them.
        vertices: [u32; 4],
    },
    /// A quad that its normal sees from the side or from below.
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
    /// A triangle without area.
    #[error(
        "face {face} is degenerate: its vertices {vertices:?} are on one line or beyond the range of doubles: move or \
         remove a vertex"
    )]
    DegenerateTriangle {
        /// The face.
        face: usize,
        /// Its vertices, as the source numbers them.
        vertices: [u32; 3],
    },
    /// The foot of the perpendicular is not on its boundary edge.
    #[error(
        "the perpendicular from the dual point of face {face} misses its boundary edge {edge:?}: the midpoint of the \
         edge is always on it"
    )]
    FootOutsideEdge {
        /// The face.
        face: usize,
        /// Ends of the edge, as the source numbers them.
        edge: [u32; 2],
    },
    /// More vertices than indices can hold.
    #[error("the quad graph would have {vertices} vertices, more than 32-bit indices can number")]
    TooLarge {
        /// Vertices it would have.
        vertices: usize,
    },
}

impl QuadGraph {
    /// Whether `v` is a dual vertex, of no place on the mesh.
    pub fn is_dual(&self, v: u32) -> bool {
        v as usize >= self.primal
    }

    /// The smallest Re ρ; positive where integral weights are defined.
    pub fn min_re_rho(&self) -> f64 {
        self.rho.iter().map(|rho| rho.re).fold(f64::INFINITY, f64::min)
    }

    /// Whether every ρ is real: diagonals at right angles, as circumcentres make them.
    pub fn is_orthogonal(&self) -> bool {
        self.rho.iter().all(|rho| rho.im == 0.0)
    }

    /// ½ |d02 × d13| = ½ Re ρ |d02|², the rest area of quad `q`.
    pub fn area(&self, q: usize) -> f64 {
        0.5 * self.rho[q].re * self.diagonal[q] * self.diagonal[q]
    }

    /// Vertices connected by diagonals: a label for each vertex and the number of classes.
    ///
    /// (2) sees a map through the diagonals alone, so each class can be translated without notice. A disc has two:
    /// black (the mesh's own vertices, of a triangle mesh) and white.
    pub fn diagonal_classes(&self) -> (Vec<u32>, usize) {
        let mut classes = crate::surface::UnionFind::new(self.vertices);
        for &[v0, v1, v2, v3] in &self.quads {
            classes.unite(v0, v2);
            classes.unite(v1, v3);
        }
        classes.labels()
    }

    /// The quads around every vertex.
    pub fn incidence(&self) -> Incidence {
        let mut offsets = vec![0u32; self.vertices + 1];
        for &v in self.quads.iter().flatten() {
            offsets[v as usize + 1] += 1;
        }
        for v in 0..self.vertices {
            offsets[v + 1] += offsets[v];
        }
        let mut quads = vec![0; 4 * self.quads.len()];
        let mut cursor = offsets.clone();
        for (q, quad) in self.quads.iter().enumerate() {
            for &v in quad {
                quads[cursor[v as usize] as usize] = q as u32;
                cursor[v as usize] += 1;
            }
        }
        Incidence { offsets, quads }
    }

    /// The length of the boundary at rest.
    pub fn perimeter(&self) -> f64 {
        self.boundary_length.iter().sum()
    }
}

/// The quads around every vertex of a quad graph.
pub struct Incidence {
    offsets: Vec<u32>,
    quads: Vec<u32>,
}

impl Incidence {
    /// The quads of which `v` is a vertex, ascending.
    pub fn quads_at(&self, v: u32) -> &[u32] {
        &self.quads[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }
}

/// x_b − x_a
fn difference(positions: &[[f64; 3]], a: u32, b: u32) -> [f64; 3] {
    vector::sub(positions[b as usize], positions[a as usize])
}

/// The one loop of a boundary of `n` vertices; none where there is no boundary.
fn one_loop(n: usize) -> Vec<Range<usize>> {
    std::iter::once(0..n).filter(|whole| !whole.is_empty()).collect()
}
