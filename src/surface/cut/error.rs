use crate::surface::oriented_mesh::NotADisc;

/// The surface does not become a disc, or does not become closed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CutError {
    /// Something stands against the surface that neither cut nor filling mends.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// A face to be removed that is not there.
    #[error("face {face} cannot be removed: the mesh has {faces} faces, which count from 0")]
    NoSuchFace {
        /// The face asked for.
        face: u32,
        /// The number of faces.
        faces: usize,
    },
    /// All faces were removed.
    #[error("no face is left to be mapped: remove fewer")]
    NothingLeft,
    /// The faces removed separate the others.
    #[error("without the removed faces the surface falls into {pieces} pieces: remove other faces")]
    Pieces {
        /// Number of pieces.
        pieces: usize,
    },
    /// The faces removed leave a surface that touches itself.
    #[error(
        "with these faces the surface touches itself at vertex {vertex}, in {fans} fans of faces: remove other faces"
    )]
    Pinched {
        /// The first such vertex of the source.
        vertex: u32,
        /// Fans of faces around it.
        fans: u32,
    },
    /// The surface is still no disc.
    #[error("the surface is then still no disc: boundary loops of {boundary_loops:?} edges, genus {genus}")]
    NoDiscLeft {
        /// Edges of each boundary loop, the longest loop first.
        boundary_loops: Vec<usize>,
        /// The genus.
        genus: u64,
    },
    /// A surface with holes where a closed one is needed.
    #[error("the surface is not closed: it has boundary loops of {boundary_loops:?} edges")]
    NotClosed {
        /// Edges of each boundary loop, the longest loop first.
        boundary_loops: Vec<usize>,
    },
    /// A hole of an odd number of edges in a quad mesh.
    #[error("the hole of {edges} edges at vertex {vertex} cannot be filled with quads, as {edges} is odd")]
    OddHole {
        /// The vertex of lowest index around it, as the source numbers them.
        vertex: u32,
        /// Its number of edges.
        edges: usize,
    },
    /// A hole whose edges lie so that no point makes faces of positive area with all of them.
    #[error(
        "the hole of {edges} edges at vertex {vertex} cannot be filled: some of its edges have no length or run back \
         on themselves"
    )]
    FlatHole {
        /// The vertex of lowest index around it, as the source numbers them.
        vertex: u32,
        /// Its number of edges.
        edges: usize,
    },
}
