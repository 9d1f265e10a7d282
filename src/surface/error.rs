/// Why arrays are not a surface.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SurfaceError {
    /// A face with fewer than three corners.
    #[error("face {face} has {corners} corners; a face has at least three (faces count from 0)")]
    TooFewCorners {
        /// The face.
        face: usize,
        /// Its number of corners.
        corners: usize,
    },
    /// A vertex index out of range.
    #[error("face {face} has the vertex {vertex}, and there are {vertices} vertices (they count from 0)")]
    NoSuchVertex {
        /// The face.
        face: usize,
        /// The index.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// More vertices than 32-bit indices can count.
    #[error("{vertices} vertices are more than 32-bit indices can count")]
    TooManyVertices {
        /// Number of vertices.
        vertices: usize,
    },
    /// More corners than 32-bit indices can count.
    #[error("the faces up to face {face} have more corners than 32-bit indices can count")]
    TooManyCorners {
        /// The face that is one too many.
        face: usize,
    },
    /// Another number of normals than of faces.
    #[error("there are {normals} normals for {faces} faces; give one for each face")]
    NormalCount {
        /// Number of normals.
        normals: usize,
        /// Number of faces.
        faces: usize,
    },
}
