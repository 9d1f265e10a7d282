use std::path::PathBuf;

use crate::figure::FigureError;
use crate::input::InputError;
use crate::io::WriteError;
use crate::map::MapError;
use crate::surface::oriented_mesh::NotADisc;

/// No comparison.
#[derive(Debug, thiserror::Error)]
pub enum BenchError {
    /// No case of that name.
    #[error("unknown case `{name}`; known: {known}")]
    UnknownCase {
        /// As given.
        name: String,
        /// Every case.
        known: String,
    },
    /// The sizes asked for are too large for all cases asked for.
    #[error("none of the cases {cases} has a mesh of the sizes asked for")]
    NoMesh {
        /// As asked for.
        cases: String,
    },
    /// An interpreter that does not run.
    #[error(
        "{} cannot run the peers: {reason}\nName another interpreter of Python 3 with --python, or compare sizes alone with \
         --no-peers.",
        python.display()
    )]
    Python {
        /// The interpreter.
        python: PathBuf,
        /// The system's message, or the last lines it printed.
        reason: String,
    },
    /// A mesh that cannot be made or read.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A public file that is no disc.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// A surface that has no quad graph.
    #[error(transparent)]
    Map(#[from] MapError),
    /// A file that cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A plot that cannot be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A record that JSON has no words for.
    #[error("the record cannot be written")]
    Json(#[from] serde_json::Error),
    /// This program's own file, or a temporary one.
    #[error("{what}: {source}")]
    Io {
        /// What was wanted of the system.
        what: String,
        /// What it said.
        source: std::io::Error,
    },
}

impl BenchError {
    pub(super) fn io(what: impl Into<String>) -> impl FnOnce(std::io::Error) -> BenchError {
        let what = what.into();
        move |source| BenchError::Io { what, source }
    }
}
