use std::path::PathBuf;

/// Failure of a call to libigl. Vertices and triangles are counted from 0.
#[derive(Debug, thiserror::Error)]
pub enum LibiglError {
    /// No usable Python interpreter to create the environment.
    #[error(
        "libigl needs Python 3.{minimum} or newer, and none was found:\n{}\n\
         Install Python, or name an interpreter in $PYTHON.",
        indent(tried)
    )]
    NoPython {
        /// The required minor version.
        minimum: u32,
        /// Each interpreter that was tried, with its fault.
        tried: Vec<String>,
    },
    /// Python without its `venv` or `ensurepip` module, as Debian ships it.
    #[error(
        "{} cannot make virtual environments:\n{}\n\
         On Debian and Ubuntu: apt install python3-venv. Or set $RIEMAP_PYTHON to an interpreter that has libigl.",
        python.display(), indent(lines)
    )]
    NoVenv {
        /// The interpreter.
        python: PathBuf,
        /// The last lines it printed.
        lines: Vec<String>,
    },
    /// A command that creates the environment failed.
    #[error(
        "making the Python environment for libigl failed: {command} ({status}). Its last lines:\n{}\n\
         It is made once and needs the network for that: connect and run again. Without a network: set \
         $RIEMAP_PYTHON to an interpreter that has libigl, or $RIEMAP_PYTHON_ENV to the folder of an environment \
         that riemap made before.",
        indent(lines)
    )]
    Making {
        /// The command line.
        command: String,
        /// How it ended.
        status: String,
        /// The last lines it printed.
        lines: Vec<String>,
    },
    /// The folder exists and was not created by riemap; it would have to be emptied.
    #[error(
        "{} is not empty and was not made by riemap, so it is left alone. Set $RIEMAP_PYTHON_ENV to a folder that \
         does not exist; an environment of your own with libigl: set $RIEMAP_PYTHON to its interpreter.",
        folder.display()
    )]
    ForeignFolder {
        /// The folder.
        folder: PathBuf,
    },
    /// A part of an environment that someone else could have put there; it is not executed.
    #[error(
        "{} belongs to another user or can be written by others, so nothing in it is executed. Remove it, or set \
         $RIEMAP_PYTHON_ENV to a folder that does not exist.",
        path.display()
    )]
    NotOwn {
        /// The folder or file.
        path: PathBuf,
    },
    /// The environment was created by another version of riemap, or is incomplete.
    #[error("the Python environment in {} is missing, unfinished or made for another version of riemap", folder.display())]
    Stale {
        /// The folder.
        folder: PathBuf,
    },
    /// An interpreter that does not run, or does not have libigl.
    #[error(
        "{} cannot be used to run libigl:\n{}\n\
         Install libigl there (pip install libigl=={}), or unset $RIEMAP_PYTHON to let riemap make its own environment.",
        python.display(), indent(lines), super::VERSION
    )]
    Interpreter {
        /// The interpreter.
        python: PathBuf,
        /// The last lines it printed, or the message of the system.
        lines: Vec<String>,
    },
    /// A file or folder that cannot be read or written.
    #[error("{}: {source}. Another folder for libigl's environment can be set with $RIEMAP_PYTHON_ENV.", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The reason given by the system.
        source: std::io::Error,
    },
    /// A temporary file of a call cannot be read or written.
    #[error("handing data to libigl through {}: {source}. Another temporary folder can be set with $TMPDIR.", path.display())]
    Exchange {
        /// The file or folder.
        path: PathBuf,
        /// The reason given by the system.
        source: std::io::Error,
    },
    /// The process of libigl failed; the lines have its traceback.
    #[error("libigl's {function} failed in {} ({status}):\n{}", python.display(), indent(lines))]
    Call {
        /// The function that was called.
        function: &'static str,
        /// The interpreter.
        python: PathBuf,
        /// How the process ended.
        status: String,
        /// The last lines it printed.
        lines: Vec<String>,
    },
    /// The file with the answer is malformed.
    #[error("libigl's {function} gave no readable answer: {what}")]
    Answer {
        /// The function that was called.
        function: &'static str,
        /// The fault in it.
        what: String,
    },
    /// A vertex index of a triangle is out of range.
    #[error("triangle {triangle} (0-based) names vertex {vertex}, there are {count} vertices")]
    TriangleIndex {
        /// The triangle.
        triangle: usize,
        /// The vertex index.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// The index of a fixed vertex is out of range.
    #[error("fixed vertex {vertex} (0-based) does not exist, there are {count} vertices")]
    FixedIndex {
        /// The index.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A vertex is fixed twice, on which libigl crashes.
    #[error("vertex {vertex} (0-based) is fixed twice")]
    FixedTwice {
        /// The vertex.
        vertex: u32,
    },
    /// The numbers of values and of fixed vertices differ.
    #[error("{fixed} fixed vertices, but {values} values for them")]
    ValueCount {
        /// Number of fixed vertices.
        fixed: usize,
        /// Number of values.
        values: usize,
    },
    /// Fewer than two vertices are fixed, so that similarities remain free.
    #[error("{fixed} vertex fixed; a least-squares conformal map needs two")]
    TooFewFixed {
        /// Number of fixed vertices.
        fixed: usize,
    },
    /// A position or value is infinite or not a number.
    #[error("{what} {index} (0-based) is not finite")]
    NotFinite {
        /// "position of vertex", "value of fixed vertex" or "libigl's result at vertex".
        what: &'static str,
        /// Its index.
        index: usize,
    },
    /// A vertex has no path of edges to a fixed one, so that its value is not determined.
    #[error(
        "vertex {vertex} (0-based) is not joined to any fixed vertex: its value is free. \
         Map connected surfaces only, without unreferenced vertices."
    )]
    Undetermined {
        /// The first such vertex.
        vertex: usize,
    },
}

fn indent(lines: &[String]) -> String {
    lines.iter().map(|line| format!("    {line}")).collect::<Vec<_>>().join("\n")
}
