use std::fmt;
use std::path::PathBuf;

use super::DataFile;
use super::DiagramError;
use crate::app::compare::libigl::LibiglError;
use crate::app::compare::moebius_fit::Undetermined;
use crate::app::compare::peer::{MoebiusError, PeerError};
use crate::app::compare::verify::VerifyError;
use crate::figure::FigureError;
use crate::input::InputError;
use crate::io::WriteError;
use crate::map::MapError;
use crate::surface::normals::NormalError;

/// Where in a config, or in which `--set`, something stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// Path of the config; `--set key=value`.
    pub source: String,
    /// Line, from 1; `None` for what was given with `--set`.
    pub line: Option<usize>,
    /// The text of that line.
    pub text: String,
    /// First character of the offender in `text`, from 0.
    pub column: usize,
    /// Its length in characters; at least 1.
    pub width: usize,
}

/// `file:line`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "{}:{line}", self.source),
            None => f.write_str(&self.source),
        }
    }
}

impl Place {
    /// The line with carets below the offender.
    fn excerpt(&self) -> String {
        let number = self.line.map(|line| line.to_string()).unwrap_or_default();
        let (gutter, shift) = (number.len(), self.column);
        format!("{number} | {}\n{:gutter$} | {:shift$}{}", self.text, "", "", "^".repeat(self.width))
    }
}

/// A config that cannot be taken as it stands.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// The file is not to be had.
    #[error("{}: the config cannot be read", path.display())]
    Read {
        /// Its path.
        path: PathBuf,
        /// The system's word.
        source: std::io::Error,
    },
    /// No TOML, an unknown key, a value of the wrong type, an unknown name: as the TOML reader says it.
    #[error("{place}: {}{message}\n{}", swept.as_ref().map(|key| format!("`{key}`: ")).unwrap_or_default(), place.excerpt())]
    Toml {
        /// Where.
        place: Box<Place>,
        /// What is wrong, and what is known.
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
        /// The key of a near name, if there is one.
        meant: Option<String>,
        /// The keys there are.
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
    /// A value that is none of the names it could be.
    #[error("{place}: unknown {what} `{name}`; known: {known}\n{}", place.excerpt())]
    UnknownName {
        /// Where.
        place: Box<Place>,
        /// What it names.
        what: &'static str,
        /// The name.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A plot that contradicts itself.
    #[error("{place}: plot `{plot}`: {reason}\n{}", place.excerpt())]
    Plot {
        /// Where.
        place: Box<Place>,
        /// Its name.
        plot: String,
        /// How.
        reason: &'static str,
    },
    /// A table that the kind needs.
    #[error("{source_name}: the table [{table}] is missing or incomplete: {message}")]
    Missing {
        /// Path of the config.
        source_name: String,
        /// Name of the table.
        table: String,
        /// What the TOML reader misses in it.
        message: String,
    },
    /// A dotted key that leads through something that is no table.
    #[error("{place}: `{key}` cannot be set: `{at}` is no table\n{}", place.excerpt())]
    NoTable {
        /// Where.
        place: Box<Place>,
        /// The dotted key.
        key: String,
        /// The part that is no table.
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
    /// A key of `[full]`, `[names]`, `[[without]]` or `[[expect-where]]` that `[sweep]` does not have.
    #[error("{place}: `{key}` of {table} is not swept; [sweep] has: {known}\n{}", place.excerpt())]
    NotSwept {
        /// Where.
        place: Box<Place>,
        /// Whose key it is.
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
    /// A folder of meshes that is none.
    #[error("{place}: folder {folder}: {reason}\n{}", place.excerpt())]
    Folder {
        /// Where.
        place: Box<Place>,
        /// Its path.
        folder: String,
        /// What is wrong with it.
        reason: String,
    },
    /// A limit that is no time.
    #[error("{place}: time-limit = {seconds}: it needs a number of seconds above 0\n{}", place.excerpt())]
    TimeLimit {
        /// Where.
        place: Box<Place>,
        /// The number.
        seconds: f64,
    },
    /// A cartesian product out of hand.
    #[error("{source_name}: the sweep makes more than {limit} runs")]
    TooManyRuns {
        /// Path of the config.
        source_name: String,
        /// How many are allowed.
        limit: usize,
    },
    /// No `key=value`.
    #[error("--set {text}: expected key=value, for example --set map.dual=circumcentre")]
    Set {
        /// What was given.
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

/// A run that ended without a result; its text goes into the record.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// A public file that is not there.
    #[error("{file}")]
    NoData {
        /// The file.
        file: DataFile,
    },
    /// A mistake of the program.
    #[error("riemap panicked, which it must never do; please report this: {message}")]
    Panic {
        /// What it said.
        message: String,
    },
    /// A run in a process of its own that took too long.
    #[error("over the time limit of {seconds} s")]
    OverTime {
        /// The limit.
        seconds: f64,
    },
    /// A process that ended without a record: out of memory, say.
    #[error("the process of the run ended without a record, {status}{}{said}", if said.is_empty() { "" } else { ": " })]
    Process {
        /// How.
        status: String,
        /// The last that it said.
        said: String,
    },
    /// No surface.
    #[error(transparent)]
    Input(#[from] InputError),
    /// No map.
    #[error(transparent)]
    Map(#[from] MapError),
    /// No estimate of the normals.
    #[error(transparent)]
    Normals(#[from] NormalError),
    /// Normals of a surface whose exact ones are not known.
    #[error("the exact normals of {source_name} are not known; take a generated digital surface")]
    NoExactNormals {
        /// The surface.
        source_name: String,
    },
    /// No comparison.
    #[error(transparent)]
    Verify(#[from] VerifyError),
    /// No map of a peer.
    #[error(transparent)]
    Peer(#[from] PeerError),
    /// A map that cannot be laid over the exact one.
    #[error(transparent)]
    Moebius(#[from] MoebiusError),
    /// No Möbius map fits a peer's map to the exact one.
    #[error(transparent)]
    Fit(#[from] Undetermined),
    /// No libigl.
    #[error(transparent)]
    Libigl(#[from] LibiglError),
    /// No diagram.
    #[error(transparent)]
    Diagram(#[from] DiagramError),
    /// No picture.
    #[error(transparent)]
    Figure(#[from] FigureError),
    /// A caption asks for what is not there.
    #[error("the caption has {{{key}}}, but there is no such key; known in `{at}`: {known}")]
    CaptionKey {
        /// The dotted key.
        key: String,
        /// The part of it that is there.
        at: String,
        /// The keys there.
        known: String,
    },
    /// A caption asks for what this map does not have.
    #[error("the caption has {{{key}}}, which has no value here; in [ ] it would be left out")]
    CaptionValue {
        /// The dotted key.
        key: String,
    },
    /// A result that is no JSON.
    #[error("the result cannot be written as JSON")]
    Json(#[from] serde_json::Error),
}

/// Results that cannot be written or summed up.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// A run that was to be made in a process of its own.
    #[error("the process of a run cannot be started")]
    Process(#[source] std::io::Error),
    /// No such run.
    #[error("{config} has no run {position}")]
    NoRun {
        /// Path of the config.
        config: String,
        /// The place among its runs, from 0.
        position: usize,
    },
    /// No folder.
    #[error("{}: the folder cannot be made", path.display())]
    Folder {
        /// Its path.
        path: PathBuf,
        /// The system's word.
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
    /// A file of former results that does not go away.
    #[error("{}: the file cannot be removed", path.display())]
    Remove {
        /// Its path.
        path: PathBuf,
        /// The system's word.
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
    /// The executable of the running program cannot be read, so that its scratch records have no name.
    #[error("the program cannot read its own executable")]
    Program(#[source] std::io::Error),
    /// No thread to run an experiment on.
    #[error("no thread can be started")]
    Thread(#[from] std::io::Error),
    /// No file.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// A record that cannot be encoded.
    #[error("a record cannot be written as JSON")]
    Json(#[from] serde_json::Error),
    /// A key in `[table]`, `[plots]` or `[expect]` that no record has.
    #[error("{config}: `{key}` in [{table}] is in no record; records have: {known}")]
    UnknownKey {
        /// Path of the config.
        config: String,
        /// The dotted key.
        key: String,
        /// Where it stands.
        table: String,
        /// The keys that records have.
        known: String,
    },
    /// A picture of a run that is there no more.
    #[error("{}: the picture cannot be read", path.display())]
    Panel {
        /// Its path.
        path: PathBuf,
        /// The system's word.
        source: std::io::Error,
    },
    /// A sheet that cannot be made.
    #[error("{config}: the pictures of its runs cannot be put on one sheet")]
    Sheet {
        /// Path of the config.
        config: String,
        /// Why.
        source: FigureError,
    },
    /// A plot that cannot be drawn.
    #[error("{config}: plot `{plot}` cannot be drawn")]
    Plot {
        /// Path of the config.
        config: String,
        /// Its name.
        plot: String,
        /// Why.
        source: FigureError,
    },
}
