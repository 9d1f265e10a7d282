//! Convex combination maps: every inner vertex of the mesh is a weighted mean of its neighbours,
//! and the boundary is pinned.
//!
//! ```text
//! Σ_j w_ij (z_j − z_i) = 0        at every inner vertex i, over its neighbours j
//! ```
//!
//! With positive weights, symmetric or not, and the boundary pinned on a strictly convex curve,
//! every face is mapped to a strictly convex one and the map is injective, provided that no two
//! inner faces share more than a vertex or an edge (Tutte 1963; Floater, *One-to-one piecewise
//! linear mappings over triangulations*, Math. Comp. 2003). New weights are one row of
//! [`EDGE_WEIGHTS`].

mod depth;
mod solve;
mod weights;

pub use depth::{Towards, outward};
pub use solve::{ConvexSolution, convex_map};

use crate::surface::oriented_mesh::OrientedMesh;

/// The weight `w_ij` of a neighbour of a vertex. The weights of pairs that occur several times are
/// added.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Weighted {
    /// The vertex i.
    pub vertex: u32,
    /// The neighbour j.
    pub neighbour: u32,
    /// The weight w_ij, in a unit common to all neighbours of i.
    pub weight: f64,
}

/// An entry of the table of weights.
pub struct EdgeWeights {
    /// The name, as used in options.
    pub name: &'static str,
    /// A description of one line.
    pub about: &'static str,
    /// Whether all weights are positive, so that the map is injective up to rounding.
    pub convex: bool,
    /// Computes the weights of a disc.
    pub make: fn(&OrientedMesh) -> Result<Vec<Weighted>, ConvexError>,
}

/// The table of all weights.
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

/// Returns the table entry of the weights with this name.
///
/// # Errors
/// [`ConvexError::Unknown`].
pub fn edge_weights(name: &str) -> Result<&'static EdgeWeights, ConvexError> {
    EDGE_WEIGHTS.iter().find(|row| row.name == name).ok_or_else(|| ConvexError::Unknown {
        name: name.to_owned(),
        known: EDGE_WEIGHTS.iter().map(|row| row.name).collect::<Vec<_>>().join(", "),
    })
}

/// A convex combination map cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConvexError {
    /// No weights have this name.
    #[error("unknown weights `{name}`; known: {known}")]
    Unknown {
        /// The requested name.
        name: String,
        /// The known names.
        known: String,
    },
    /// Cotangent weights are defined only for triangles.
    #[error(
        "cotan weights are defined for triangles only, and the faces have {corners} corners: use mean-value or uniform weights"
    )]
    NotTriangles {
        /// Number of corners of each face.
        corners: usize,
    },
    /// An angle is 0 or π.
    #[error("{name} weights are not defined at face {face}: it has no area; move or remove a vertex")]
    NoAngle {
        /// Name of the weights.
        name: &'static str,
        /// The first such face, as an index of the source.
        face: u32,
    },
    /// A boundary vertex is free.
    #[error("boundary vertex {vertex} is free, and convex combination maps hold the whole boundary of the mesh")]
    FreeBoundary {
        /// The first such vertex, as an index of the source.
        vertex: u32,
    },
    /// The matrix is singular.
    #[error("the mean-value system of {size} vertices is singular to rounding: the mesh has nearly degenerate faces")]
    Singular {
        /// Number of unknowns.
        size: usize,
    },
    /// The factor does not fit into memory or its indices.
    #[error("the factor of {size} unknowns does not fit into memory or its indices")]
    TooLarge {
        /// Number of unknowns.
        size: usize,
    },
}
