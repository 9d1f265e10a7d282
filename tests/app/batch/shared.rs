use std::collections::BTreeMap;
use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use riemap::app::experiment::{Batch, Config, Event, Record, RunError, Scratch, Settings, Shard, Task, Yield};
use tempfile::TempDir;

/// Eight runs.
pub const STUDY: &str = "[surface]\nsource = \"plane\"\n[sweep]\n\
    \"surface.parameters.mesh\" = [\"quad\", \"delaunay\"]\n\"surface.parameters.n\" = [4, 5, 6, 7]\n";

/// The same with two pictures of each run, and a plot.
pub fn pictured() -> String {
    format!("{STUDY}[figures]\nflat = true\n{PLOT}")
}

/// A plot.
pub const PLOT: &str = "[plots.h]\nx = { key = \"result.input.vertices\", label = \"vertices\" }\n\
    y = { label = \"H\" }\nseries = [{ y = \"result.energy.H\", label = \"H\" }]\n";

pub fn load_with(name: &str, text: &str, settings: &Settings) -> Result<Config, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("{name}.toml"));
    fs::write(&path, text).unwrap();
    Config::load_with(&path, settings).map_err(|error| error.to_string())
}

pub fn load(name: &str, text: &str) -> Config {
    load_with(name, text, &Settings::default()).unwrap()
}

pub fn names(config: &Config) -> Vec<&str> {
    config.runs.iter().map(|run| run.name.as_str()).collect()
}

pub fn folder() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// What a batch is to be made like; `stop_after`: how many records it may write before it is asked to stop.
pub struct How<'a> {
    pub threads: usize,
    pub shard: Shard,
    /// Name of the program.
    pub program: &'a str,
    pub stop_after: usize,
}

impl Default for How<'_> {
    fn default() -> Self {
        How { threads: 1, shard: Shard::ALL, program: "program", stop_after: usize::MAX }
    }
}

/// What a batch told.
#[derive(Default)]
pub struct PoolEvent {
    pub made: Vec<Record>,
    pub finished_before: Vec<Record>,
    /// `+` and `-` with the name of the config: begun and ended.
    pub order: Vec<String>,
    pub summed: Vec<String>,
}

pub fn batch(configs: &[Config], results: &Path, how: &How) -> PoolEvent {
    // By what is on disk, for events are heard some time after.
    let stop = || how.stop_after != usize::MAX && written(results) >= how.stop_after;
    let mut told = PoolEvent::default();
    let threads = NonZeroUsize::new(how.threads).unwrap();
    let scratch = &Scratch::new(results, how.program);
    Batch { configs, shard: how.shard, threads, apart: None, scratch }
        .run(&stop, &mut |event| match event {
            Event::Begun { config, .. } => told.order.push(format!("+{}", config.name)),
            Event::Ended { config, record, .. } => {
                told.order.push(format!("-{}", config.name));
                told.made.push(record.clone());
            }
            Event::Finished { record, .. } => told.finished_before.push(record.clone()),
            Event::Summed { config, summary } => {
                summary.unwrap();
                told.summed.push(config.name.clone());
            }
            Event::Pulse => {}
        })
        .unwrap();
    told
}

/// How many scratch records there are.
fn written(results: &Path) -> usize {
    let below = |path: PathBuf| path.read_dir().into_iter().flatten().flatten().map(|entry| entry.path());
    let json = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "json");
    below(results.join(".unfinished")).flat_map(below).flat_map(below).filter(json).count()
}

/// The names of the runs that have a record in the results of an experiment, in the order of the file.
pub fn recorded(results: &Path, experiment: &str) -> Vec<String> {
    let text = fs::read_to_string(results.join(experiment).join("records.jsonl")).unwrap_or_default();
    text.lines().map(|line| serde_json::from_str::<Record>(line).unwrap().run).collect()
}

/// All files below `results` but timings, by path.
pub fn contents(results: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    fn collect(folder: &Path, root: &Path, found: &mut BTreeMap<PathBuf, Vec<u8>>) {
        for entry in folder.read_dir().unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                collect(&path, root, found);
                continue;
            }
            // What a killed program was about to write: it has no name yet.
            if path.file_name().unwrap().to_string_lossy().starts_with('.') {
                continue;
            }
            let bytes = fs::read(&path).unwrap();
            // These tell of times; the page is compared in tests/page.rs.
            let timed = ["timings.md", "timings.jsonl", "index.html"];
            if !timed.iter().any(|name| path.file_name().unwrap() == *name) {
                found.insert(path.strip_prefix(root).unwrap().to_owned(), bytes);
            }
        }
    }
    let mut found = BTreeMap::new();
    collect(results, results, &mut found);
    found
}

/// A task made of a function.
pub struct Made(pub fn() -> Result<Yield, RunError>);

impl Task for Made {
    fn run(&self) -> Result<Yield, RunError> {
        (self.0)()
    }
}
