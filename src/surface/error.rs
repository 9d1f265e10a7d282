/// Arrays do not describe a surface.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SurfaceError {
    /// A face has fewer than three corners.
    #[error("face {face} has {corners} corners; a face has at least three (faces count from 0)")]
    TooFewCorners {
        /// The face.
        face: usize,
        /// Number of its corners.
        corners: usize,
    },
    /// A vertex index is out of range.
    #[error("face {face} has the vertex {vertex}, and there are {vertices} vertices (they count from 0)")]
    NoSuchVertex {
        /// The face.
        face: usize,
        /// The index.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// There are more vertices than 32-bit indices can number.
    #[error("{vertices} vertices are more than 32-bit indices can count")]
    TooManyVertices {
        /// Number of vertices.
        vertices: usize,
    },
    /// There are more corners than 32-bit indices can number.
    #[error("the faces up to face {face} have more corners than 32-bit indices can count")]
    TooManyCorners {
        /// The first face that does not fit.
        face: usize,
    },
    /// The number of normals is not the number of faces.
    #[error("there are {normals} normals for {faces} faces; give one for each face")]
    NormalCount {
        /// Number of normals.
        normals: usize,
        /// Number of faces.
        faces: usize,
    },
}
