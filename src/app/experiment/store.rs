//! `records.jsonl` and `timings.jsonl`: the records of an experiment in a folder of results.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::files::{lock, make_folder, remove_pictures};
use super::inside::inside;
use super::provenance::Provenance;
use super::scratch::Scratch;
use super::{Config, Record, ResultsError};
use crate::io::atomically;

/// The file of the records, below the folder of the experiment. It is the same on every run of the
/// same program.
const RECORDS: &str = "records.jsonl";
/// The file of the timings, which differ from run to run.
const TIMINGS: &str = "timings.jsonl";

/// The seconds that one run has taken: a line of `timings.jsonl`.
#[derive(Serialize, Deserialize)]
struct Timing {
    run: String,
    timings: Value,
}

/// The records that `results` has of the runs of `config`, in the order of the runs, runs of
/// `[full]` included, with their timings where these are there. A record of other settings does not
/// count, nor does a line that is no record.
pub fn records(config: &Config, results: &Path) -> Vec<Record> {
    let folder = results.join(&config.name);
    let by_run = |record: Record| (record.run.clone(), record);
    let mut stored: BTreeMap<String, Record> = lines(&folder.join(RECORDS)).flatten().map(by_run).collect();
    let mut timings = timings(&folder);
    let runs = config.all_runs().into_iter();
    runs.filter_map(|run| {
        let mut record = stored.remove(&run.name).filter(|record| record.config == run.config)?;
        record.timings = timings.remove(&run.name).unwrap_or_default();
        Some(record)
    })
    .collect()
}

/// Merges the scratch records of `config` into `records.jsonl` and `timings.jsonl`, both sorted by
/// the names of the runs, and removes pictures that a run had before and has no longer. Where the
/// records change, `provenance.json` is written.
///
/// # Errors
/// [`ResultsError`]: a line of `records.jsonl` that is no record, which must not be lost in
/// silence; a file that cannot be written.
pub(super) fn merge(config: &Config, scratch: &Scratch) -> Result<(), ResultsError> {
    let results = scratch.results();
    let made: Vec<Record> = config.all_runs().into_iter().filter_map(|run| scratch.record(config, run)).collect();
    if made.is_empty() {
        return Ok(());
    }
    let folder = inside(results, &config.name)?;
    make_folder(&folder)?;
    let _lock = lock(&folder);
    let mut stored = stored(results, config)?;
    let mut timings = timings(&folder);
    let (mut pictures, mut versions) = (BTreeSet::new(), BTreeMap::new());
    for record in made {
        let line = record.same_on_every_run();
        timings.insert(record.run.clone(), record.timings);
        versions.extend(record.versions);
        pictures.extend(stored.insert(record.run, line).into_iter().flat_map(|former| former.pictures));
    }
    let kept: BTreeSet<&String> = stored.values().flat_map(|record| &record.pictures).collect();
    remove_pictures(results, pictures.iter().filter(|picture| !kept.contains(picture)))?;
    let lines = timings.into_iter().map(|(run, timings)| Timing { run, timings });
    write(results, config, TIMINGS, lines)?;
    if write(results, config, RECORDS, stored.values())? {
        Provenance::update(results, versions)?;
    }
    Ok(())
}

/// Removes the records of runs that `config` no longer has, not even with `[full]`, with their
/// pictures. A record of other settings under the name of a run stays until the run is made; plots
/// that the config no longer has stay. Returns the names of the runs removed.
///
/// # Errors
/// [`ResultsError`] as `merge`.
pub fn remove_stale(config: &Config, results: &Path) -> Result<Vec<String>, ResultsError> {
    let folder = inside(results, &config.name)?;
    if !folder.join(RECORDS).is_file() {
        return Ok(Vec::new());
    }
    let _lock = lock(&folder);
    let known: BTreeSet<&str> = config.all_runs().into_iter().map(|run| run.name.as_str()).collect();
    let is_known = |run: &String| known.contains(run.as_str());
    let (kept, stale): (BTreeMap<_, _>, BTreeMap<_, _>) =
        stored(results, config)?.into_iter().partition(|(run, _)| is_known(run));
    if stale.is_empty() {
        return Ok(Vec::new());
    }
    let shown: BTreeSet<&String> = kept.values().flat_map(|record| &record.pictures).collect();
    let pictures = stale.values().flat_map(|record| &record.pictures);
    remove_pictures(results, pictures.filter(|picture| !shown.contains(picture)))?;
    let timings = timings(&folder).into_iter().filter(|(run, _)| is_known(run));
    write(results, config, TIMINGS, timings.map(|(run, timings)| Timing { run, timings }))?;
    write(results, config, RECORDS, kept.values())?;
    Ok(stale.into_keys().collect())
}

/// All records of `config` by the names of their runs, also of runs that `config` does not have.
fn stored(results: &Path, config: &Config) -> Result<BTreeMap<String, Record>, ResultsError> {
    let path = inside(results, Path::new(&config.name).join(RECORDS))?;
    let numbered = lines(&path).enumerate().map(|(i, line)| {
        let record: Record = line.map_err(|source| ResultsError::Line { path: path.clone(), line: i + 1, source })?;
        Ok((record.run.clone(), record))
    });
    numbered.collect()
}

/// The timings by the names of the runs.
fn timings(folder: &Path) -> BTreeMap<String, Value> {
    let lines = lines::<Timing>(&folder.join(TIMINGS)).flatten();
    lines.map(|timing| (timing.run, timing.timings)).collect()
}

/// The lines of a file, each a JSON text; none where there is no file.
fn lines<T: DeserializeOwned>(path: &Path) -> impl Iterator<Item = Result<T, serde_json::Error>> + use<T> {
    let text = fs::read_to_string(path).unwrap_or_default();
    let lines: Vec<_> = text.lines().map(serde_json::from_str).collect();
    lines.into_iter()
}

/// Writes a file of the experiment, one value a line. Returns whether that changed it.
fn write(
    results: &Path,
    config: &Config,
    name: &str,
    values: impl Iterator<Item = impl Serialize>,
) -> Result<bool, ResultsError> {
    let path: PathBuf = inside(results, Path::new(&config.name).join(name))?;
    let mut text = String::new();
    for value in values {
        text.push_str(&serde_json::to_string(&value)?);
        text.push('\n');
    }
    if fs::read(&path).is_ok_and(|former| former == text.as_bytes()) {
        return Ok(false);
    }
    atomically(&path, |out| out.write_all(text.as_bytes()))?;
    Ok(true)
}
