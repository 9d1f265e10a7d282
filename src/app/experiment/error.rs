use std::path::PathBuf;

use super::DataFile;
use super::DiagramError;
use super::place::Place;
use crate::app::compare::libigl::LibiglError;
use crate::app::compare::moebius_fit::Undetermined;
use crate::app::compare::peer::{MoebiusError, PeerError};
use crate::app::compare::verify::VerifyError;
use crate::figure::FigureError;
use crate::input::InputError;
use crate::io::WriteError;
use crate::map::MapError;
use crate::surface::normals::NormalError;

/// An error in a config.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file cannot be read.
    #[error("{}: the config cannot be read", path.display())]
    Read {
        /// Its path.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// Invalid TOML, an unknown key, a value of the wrong type or an unknown name, as reported by
    /// the TOML reader.
    #[error("{place}: {}{message}\n{}", swept.as_ref().map(|key| format!("`{key}`: ")).unwrap_or_default(), place.excerpt())]
    Toml {
        /// Where.
        place: Box<Place>,
        /// The message of the TOML reader.
        message: String,
        /// The key, where a sweep or `--set` gave the value.
        swept: Option<String>,
    },
    /// A top-level key that this kind of experiment does not have.
    #[error("{place}: unknown key `{key}`{}; known: {known}\n{}", did_you_mean(meant), place.excerpt())]
    UnknownKey {
        /// Where.
        place: Box<Place>,
        /// The key.
        key: String,
        /// The key with the most similar name, if one is similar.
        meant: Option<String>,
        /// The known keys.
        known: String,
    },
    /// Two points of the sweep that compute the same: one of the swept values has no effect.
    #[error("{source_name}: the runs `{first}` and `{second}` have equal configs; leave one of them out of [sweep]")]
    EqualRuns {
        /// Path of the config.
        source_name: String,
        /// Name of the earlier run.
        first: String,
        /// Name of the later run.
        second: String,
    },
    /// A value that is not one of the known names.
    #[error("{place}: unknown {what} `{name}`; known: {known}\n{}", place.excerpt())]
    UnknownName {
        /// Where.
        place: Box<Place>,
        /// The kind of thing that it names.
        what: &'static str,
        /// The name.
        name: String,
        /// The known names.
        known: String,
    },
    /// A contradictory plot.
    #[error("{place}: plot `{plot}`: {reason}\n{}", place.excerpt())]
    Plot {
        /// Where.
        place: Box<Place>,
        /// Its name.
        plot: String,
        /// The contradiction.
        reason: &'static str,
    },
    /// A missing table that the kind of experiment requires.
    #[error("{source_name}: the table [{table}] is missing or incomplete: {message}")]
    Missing {
        /// Path of the config.
        source_name: String,
        /// Name of the table.
        table: String,
        /// The message of the TOML reader.
        message: String,
    },
    /// A dotted key that leads through a value that is not a table.
    #[error("{place}: `{key}` cannot be set: `{at}` is no table\n{}", place.excerpt())]
    NoTable {
        /// Where.
        place: Box<Place>,
        /// The dotted key.
        key: String,
        /// The part that is not a table.
        at: String,
    },
    /// A swept key without values.
    #[error("{place}: `{key}` needs an array of one value or more to be swept over\n{}", place.excerpt())]
    EmptySweep {
        /// Where.
        place: Box<Place>,
        /// The dotted key.
        key: String,
    },
    /// A key of `[full]`, `[names]`, `[[without]]` or `[[expect-where]]` that `[sweep]` does not
    /// have.
    #[error("{place}: `{key}` of {table} is not swept; [sweep] has: {known}\n{}", place.excerpt())]
    NotSwept {
        /// Where.
        place: Box<Place>,
        /// The table of the key.
        table: String,
        /// The dotted key.
        key: String,
        /// The swept keys.
        known: String,
    },
    /// A line of `[names]` that does not name the values of a swept key.
    #[error("{place}: `{key}` of [names] {reason}\n{}", place.excerpt())]
    Names {
        /// Where.
        place: Box<Place>,
        /// The swept key.
        key: String,
        /// What is wrong with the names.
        reason: &'static str,
    },
    /// Two experiments, or two results of one, that would write the same file.
    #[error("{first} and {second} would both write figures/{name}: give one of the two another name")]
    SameFigure {
        /// The file, without extension.
        name: String,
        /// Path of a config.
        first: String,
        /// Path of another config, or of the same.
        second: String,
    },
    /// A folder without meshes, or one that cannot be read.
    #[error("{place}: folder {folder}: {reason}\n{}", place.excerpt())]
    Folder {
        /// Where.
        place: Box<Place>,
        /// Its path.
        folder: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A time limit that is not a positive number.
    #[error("{place}: time-limit = {seconds}: it needs a number of seconds above 0\n{}", place.excerpt())]
    TimeLimit {
        /// Where.
        place: Box<Place>,
        /// The number.
        seconds: f64,
    },
    /// A sweep with too many runs.
    #[error("{source_name}: the sweep makes more than {limit} runs")]
    TooManyRuns {
        /// Path of the config.
        source_name: String,
        /// The largest number allowed.
        limit: usize,
    },
    /// An argument of `--set` that is not `key=value`.
    #[error("--set {text}: expected key=value, for example --set map.dual=circumcentre")]
    Set {
        /// The argument.
        text: String,
    },
    /// A file name that cannot name a folder of results.
    #[error("{}: the config's file name names its results: before .toml it needs letters, digits, - _ and ., a letter or \
             digit first, and not `figures`, `bench` or `provenance`", path.display())]
    Name {
        /// The path.
        path: PathBuf,
    },
}

fn did_you_mean(meant: &Option<String>) -> String {
    meant.as_ref().map(|key| format!(", did you mean `{key}`?")).unwrap_or_default()
}

/// An error that ended a run without a result. Its text goes into the record.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A missing public file.
    #[error("{file}")]
    NoData {
        /// The file.
        file: DataFile,
    },
    /// A panic, which is a bug of the program.
    #[error("riemap panicked, which it must never do; please report this: {message}")]
    Panic {
        /// The message of the panic.
        message: String,
    },
    /// A run in a process of its own that exceeded the time limit.
    #[error("over the time limit of {seconds} s")]
    OverTime {
        /// The limit in seconds.
        seconds: f64,
    },
    /// A process that ended without a record, for example because memory was exhausted.
    #[error("the process of the run ended without a record, {status}{}{said}", if said.is_empty() { "" } else { ": " })]
    Process {
        /// The contradiction.
        status: String,
        /// The last line of its error output.
        said: String,
    },
    /// The surface cannot be read or generated.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The map cannot be computed.
    #[error(transparent)]
    Map(#[from] MapError),
    /// The normals cannot be estimated.
    #[error(transparent)]
    Normals(#[from] NormalError),
    /// Normals of a surface whose exact ones are not known.
    #[error("the exact normals of {source_name} are not known; take a generated digital surface")]
    NoExactNormals {
        /// The surface.
        source_name: String,
    },
    /// The comparison with libigl failed.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// A peer could not compute its map.
    #[error(transparent)]
    Peer(#[from] PeerError),
    /// A map that cannot be aligned with the exact one.
    #[error(transparent)]
    Moebius(#[from] MoebiusError),
    /// No Möbius map fits the map of a peer to the exact one.
    #[error(transparent)]
    Fit(#[from] Undetermined),
    /// libigl is not available.
    #[error(transparent)]
    Libigl(#[from] LibiglError),
    /// The diagram cannot be drawn.
    #[error(transparent)]
    Diagram(#[from] DiagramError),
    /// The picture cannot be drawn.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A caption refers to a key that does not exist.
    #[error("the caption has {{{key}}}, but there is no such key; known in `{at}`: {known}")]
    CaptionKey {
        /// The dotted key.
        key: String,
        /// The part of it that exists.
        at: String,
        /// The keys below that part.
        known: String,
    },
    /// A caption refers to a key without a value outside of brackets.
    #[error("the caption has {{{key}}}, which has no value here; in [ ] it would be left out")]
    CaptionValue {
        /// The dotted key.
        key: String,
    },
    /// A result that cannot be encoded as JSON.
    #[error("the result cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// An error in writing or summarising results.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// The process of a run cannot be started.
    #[error("the process of a run cannot be started")]
    Process(#[source] std::io::Error),
    /// The config has no run at this position.
    #[error("{config} has no run {position}")]
    NoRun {
        /// Path of the config.
        config: String,
        /// The position among its runs, from 0.
        position: usize,
    },
    /// A folder cannot be created.
    #[error("{}: the folder cannot be made", path.display())]
    Folder {
        /// Its path.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A path that a link leads out of the folder of results.
    #[error("{}: this leads out of the folder of results, {}; nothing is written or removed there", path.display(), results.display())]
    Outside {
        /// The path.
        path: PathBuf,
        /// The folder of results.
        results: PathBuf,
    },
    /// A file of earlier results cannot be removed.
    #[error("{}: the file cannot be removed", path.display())]
    Remove {
        /// Its path.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A line of `records.jsonl` that is no record.
    #[error("{}:{line}: this is no record; mend the line or remove it", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
        /// The error of the JSON reader.
        source: serde_json::Error,
    },
    /// The executable of the running program cannot be read, so that its scratch records have no
    /// name.
    #[error("the program cannot read its own executable")]
    Program(#[source] std::io::Error),
    /// A thread cannot be started.
    #[error("no thread can be started")]
    Thread(#[from] std::io::Error),
    /// A file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A record cannot be encoded as JSON.
    #[error("a record cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// A key in `[table]`, `[plots]` or `[expect]` that no record has.
    #[error("{config}: `{key}` in [{table}] is in no record; records have: {known}")]
    UnknownKey {
        /// Path of the config.
        config: String,
        /// The dotted key.
        key: String,
        /// The table that refers to it.
        table: String,
        /// The keys that records have.
        known: String,
    },
    /// A picture of a run cannot be read.
    #[error("{}: the picture cannot be read", path.display())]
    Panel {
        /// Its path.
        path: PathBuf,
        /// The error of the operating system.
        source: std::io::Error,
    },
    /// A sheet that cannot be made.
    #[error("{config}: the pictures of its runs cannot be put on one sheet")]
    Sheet {
        /// Path of the config.
        config: String,
        /// The cause.
        source: FigureError,
    },
    /// A plot that cannot be drawn.
    #[error("{config}: plot `{plot}` cannot be drawn")]
    Plot {
        /// Path of the config.
        config: String,
        /// Its name.
        plot: String,
        /// The cause.
        source: FigureError,
    },
}
