//! What is mapped: positions and polygons, and all that is known of them before a formula is applied.

pub mod cut;
pub mod digital;
pub mod edges;
mod faces;
pub mod generate;
pub mod normals;
pub mod orientation;
pub mod oriented_mesh;
pub mod parameters;
mod surrogate;
pub mod topology;
mod union_find;

pub use faces::Faces;
pub use surrogate::Surrogates;
pub(crate) use union_find::UnionFind;

/// A polygon mesh as its source states it, before any judgement: indices are valid, nothing else is promised.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Vertex positions in R³ (`nv × 3`, the unit of the source). All finite.
    pub positions: Vec<[f64; 3]>,
    /// Polygons as lists of vertex indices, each index `< nv`, in the order of the source.
    pub faces: Faces,
    /// One unit normal per face (`nf × 3`) where the source gives normals: the normalised mean of the
    /// normals at the face's corners.
    pub face_normals: Option<Vec<[f64; 3]>>,
}
