use std::path::PathBuf;

/// Why libigl could not be asked. Vertex and triangle indices are 0-based.
#[derive(Debug, thiserror::Error)]
pub enum LibiglError {
    /// No usable Python interpreter to make the environment with.
    #[error(
        "libigl needs Python 3.{minimum} or newer, and none was found:\n{}\n\
         Install Python, or name an interpreter in $PYTHON.",
        indent(tried)
    )]
    NoPython {
        /// The minor version asked for.
        minimum: u32,
        /// Each interpreter tried, with what was wrong.
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
    /// A command that makes the environment failed.
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
    /// The folder exists and is not riemap's; it would have to be emptied.
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
    /// The environment was not made by this version of riemap, or not to the end.
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
        /// What was wrong: the last lines it printed, or the system's message.
        lines: Vec<String>,
    },
    /// A file or folder that cannot be read or written.
    #[error("{}: {source}. Another folder for libigl's environment can be set with $RIEMAP_PYTHON_ENV.", path.display())]
    Io {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// A temporary file of a call cannot be read or written.
    #[error("handing data to libigl through {}: {source}. Another temporary folder can be set with $TMPDIR.", path.display())]
    Exchange {
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// libigl's process failed; its traceback is in the lines.
    #[error("libigl's {function} failed in {} ({status}):\n{}", python.display(), indent(lines))]
    Call {
        /// The function called.
        function: &'static str,
        /// The interpreter.
        python: PathBuf,
        /// How the process ended.
        status: String,
        /// The last lines it printed.
        lines: Vec<String>,
    },
    /// The answer file is not what `calls.py` writes.
    #[error("libigl's {function} gave no readable answer: {what}")]
    Answer {
        /// The function called.
        function: &'static str,
        /// What is missing or wrong.
        what: String,
    },
    /// A triangle's vertex index that no vertex has.
    #[error("triangle {triangle} (0-based) names vertex {vertex}, there are {count} vertices")]
    TriangleIndex {
        /// The triangle.
        triangle: usize,
        /// The index it has.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A fixed vertex that does not exist.
    #[error("fixed vertex {vertex} (0-based) does not exist, there are {count} vertices")]
    FixedIndex {
        /// The index.
        vertex: u32,
        /// Number of vertices.
        count: usize,
    },
    /// A vertex fixed twice; libigl would crash.
    #[error("vertex {vertex} (0-based) is fixed twice")]
    FixedTwice {
        /// The vertex.
        vertex: u32,
    },
    /// Not one value per fixed vertex.
    #[error("{fixed} fixed vertices, but {values} values for them")]
    ValueCount {
        /// Number of fixed vertices.
        fixed: usize,
        /// Number of values.
        values: usize,
    },
    /// Fewer than two fixed vertices: similarities are left free.
    #[error("{fixed} vertex fixed; a least-squares conformal map needs two")]
    TooFewFixed {
        /// Number of fixed vertices.
        fixed: usize,
    },
    /// A position or value that is infinite or not a number.
    #[error("{what} {index} (0-based) is not finite")]
    NotFinite {
        /// "position of vertex", "value of fixed vertex" or "libigl's result at vertex".
        what: &'static str,
        /// Its index.
        index: usize,
    },
    /// A vertex that no path of edges joins to a fixed one: its value is not determined.
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
