use std::path::PathBuf;

use crate::figure::FigureError;
use crate::input::InputError;
use crate::io::WriteError;
use crate::map::MapError;
use crate::surface::oriented_mesh::NotADisc;

/// Failure of a comparison.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// There is no case of that name.
    #[error("unknown case `{name}`; known: {known}")]
    UnknownCase {
        /// The name.
        name: String,
        /// All cases.
        known: String,
    },
    /// The requested sizes are too large for all requested cases.
    #[error("none of the cases {cases} has a mesh of the sizes asked for")]
    NoMesh {
        /// The requested sizes.
        cases: String,
    },
    /// An interpreter does not run.
    #[error(
        "{} cannot run the peers: {reason}\nName another interpreter of Python 3 with --python, or measure only riemap with \
         --no-peers.",
        python.display()
    )]
    Python {
        /// The interpreter.
        python: PathBuf,
        /// The message of the system, or the last lines it printed.
        reason: String,
    },
    /// A mesh cannot be generated or read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A public file is not a disc.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// A surface has no quad graph.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A plot cannot be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// The record cannot be written as JSON.
    #[error("the record cannot be written")]
    Json(#[from] serde_json::Error),
    /// The file of this program, or a temporary one, cannot be used.
    #[error("{what}: {source}")]
    Io {
        /// The failed operation.
        what: String,
        /// The reason given by the system.
        source: std::io::Error,
    },
}

impl BenchError {
    pub(super) fn io(what: impl Into<String>) -> impl FnOnce(std::io::Error) -> BenchError {
        let what = what.into();
        move |source| BenchError::Io { what, source }
    }
}
