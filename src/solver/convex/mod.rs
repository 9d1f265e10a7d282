//! Convex combination maps: every inner vertex of the mesh is a weighted mean of its neighbours, the boundary is held.
//!
//! ```text
//! Σ_j w_ij (z_j − z_i) = 0        at every inner vertex i, over its neighbours j
//! ```
//!
//! With positive weights, whether w_ij = w_ji or not, and the boundary held on a strictly convex curve, every face is mapped to a
//! strictly convex one and the map is one-to-one, if no two inner faces share more than a vertex or an edge (Tutte 1963; Floater, *One-to-one
//! piecewise linear mappings over triangulations*, Math. Comp. 2003). New weights are one row of [`EDGE_WEIGHTS`].

mod depth;
mod solve;
mod weights;

pub use depth::{Towards, outward};
pub use solve::{ConvexSolution, convex_map};

use crate::surface::oriented_mesh::OrientedMesh;

/// The weight `w_ij` of a vertex's neighbour. Of a pair that occurs several times the weights add up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// i.
    pub vertex: u32,
    /// j.
    pub neighbour: u32,
    /// w_ij, in any unit that is the same for all neighbours of i.
    pub weight: f64,
}

/// Weights by name.
pub struct EdgeWeights {
    /// Its name for `--weights`.
    pub name: &'static str,
    /// One line for `riemap list`.
    pub about: &'static str,
    /// Whether all weights are positive, so that the map is one-to-one but for rounding.
    pub convex: bool,
    /// The weights of a disc.
    pub make: fn(&OrientedMesh) -> Result<Vec<Weighted>, ConvexError>,
}

/// All weights.
pub static EDGE_WEIGHTS: &[EdgeWeights] = &[
    EdgeWeights {
        name: "mean-value",
        about: "(tan α/2 + tan β/2)/l, α and β the angles beside the edge: positive, flat convex meshes stay as they are",
        convex: true,
        make: weights::mean_value,
    },
    EdgeWeights {
        name: "uniform",
        about: "1, Tutte's barycentric map: positive, sees no geometry",
        convex: true,
        make: weights::uniform,
    },
    EdgeWeights {
        name: "cotan",
        about: "½(cot α + cot β), α and β opposite the edge: discrete harmonic, negative at obtuse pairs; triangles alone",
        convex: false,
        make: weights::cotan,
    },
    EdgeWeights {
        name: "outward",
        about: "1 towards the boundary, 0.1 along and away from it: positive, keeps deep parts large",
        convex: true,
        make: |disc| Ok(outward(disc, Towards::All, 0.1)),
    },
];

/// The row of the weights of that name.
///
/// # Errors
/// No such name.
pub fn edge_weights(name: &str) -> Result<&'static EdgeWeights, ConvexError> {
    EDGE_WEIGHTS.iter().find(|row| row.name == name).ok_or_else(|| ConvexError::Unknown {
        name: name.to_owned(),
        known: EDGE_WEIGHTS.iter().map(|row| row.name).collect::<Vec<_>>().join(", "),
    })
}

/// No convex combination map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConvexError {
    /// No such weights.
    #[error("unknown weights `{name}`; known: {known}")]
    Unknown {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// Cotangents of quads.
    #[error("cotan weights are of triangles, and the faces have {corners} corners: use mean-value or uniform weights")]
    NotTriangles {
        /// Corners of each face.
        corners: usize,
    },
    /// An angle of 0 or π.
    #[error("{name} weights are not defined at face {face}: it has no area; move or remove a vertex")]
    NoAngle {
        /// The weights.
        name: &'static str,
        /// The first such face, as the source numbers them.
        face: u32,
    },
    /// A boundary vertex that is free.
    #[error("boundary vertex {vertex} is free, and convex combination maps hold the whole boundary of the mesh")]
    FreeBoundary {
        /// The first such vertex, as the source numbers them.
        vertex: u32,
    },
    /// The matrix has no inverse.
    #[error("the mean-value system of {size} vertices is singular to rounding: the mesh has nearly degenerate faces")]
    Singular {
        /// Unknowns.
        size: usize,
    },
    /// The factor does not fit.
    #[error("the factor of {size} unknowns does not fit into memory or its indices")]
    TooLarge {
        /// Unknowns.
        size: usize,
    },
}
