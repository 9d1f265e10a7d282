use crate::surface::oriented_mesh::NotADisc;

/// The surface cannot be opened to a disc, or cannot be closed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CutError {
    /// The surface has a defect that neither cutting nor filling removes.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// A face to be removed does not exist.
    #[error("face {face} cannot be removed: the mesh has {faces} faces, which count from 0")]
    NoSuchFace {
        /// The index that was requested.
        face: u32,
        /// The number of faces of the surface.
        faces: usize,
    },
    /// Every face was to be removed.
    #[error("no face is left to be mapped: remove fewer faces")]
    NothingLeft,
    /// The removed faces disconnect the rest of the surface.
    #[error("without the removed faces the surface has {pieces} connected components: remove other faces")]
    Pieces {
        /// Number of connected components.
        pieces: usize,
    },
    /// The removed faces leave a surface that touches itself at a vertex (not a manifold there).
    #[error(
        "without the removed faces the surface touches itself at vertex {vertex}, where {fans} fans of \
         faces meet: remove other faces"
    )]
    Pinched {
        /// The first such vertex, as an index of the source.
        vertex: u32,
        /// Number of fans of faces around it.
        fans: u32,
    },
    /// The requested steps were carried out and the surface is still not a disc.
    #[error("the surface is still not a disc: boundary loops of {boundary_loops:?} edges, genus {genus}")]
    NoDiscLeft {
        /// Number of edges of each boundary loop, the longest loop first.
        boundary_loops: Vec<usize>,
        /// Genus of the surface.
        genus: u64,
    },
    /// A closed surface is needed and this one has a boundary.
    #[error("the surface is not closed: it has boundary loops of {boundary_loops:?} edges")]
    NotClosed {
        /// Number of edges of each boundary loop, the longest loop first.
        boundary_loops: Vec<usize>,
    },
    /// A hole of a quad mesh has an odd number of edges, so that quads cannot fill it.
    #[error("the hole of {edges} edges at vertex {vertex} cannot be filled with quads, because {edges} is odd")]
    OddHole {
        /// The vertex of lowest index around the hole, as an index of the source.
        vertex: u32,
        /// Number of edges of the hole.
        edges: usize,
    },
    /// No position of a central vertex gives every face that would fill the hole a positive area.
    #[error(
        "the hole of {edges} edges at vertex {vertex} cannot be filled: some of its edges have no length or run back \
         on themselves"
    )]
    FlatHole {
        /// The vertex of lowest index around the hole, as an index of the source.
        vertex: u32,
        /// Number of edges of the hole.
        edges: usize,
    },
}
