use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde_json::Value;

use super::repository::revision;
use super::{Config, Outcome, Picture, Record, ResultsError, Run, RunError, Shard, Yield};
use crate::figure::Format;
use crate::io::atomically;

/// A run that has just ended.
#[derive(Clone, Copy, Debug)]
pub struct Progress<'a> {
    /// Its position among all runs of the config, from 0.
    pub position: usize,
    /// All runs of the config.
    pub total: usize,
    /// Its record.
    pub record: &'a Record,
    /// Wall-clock seconds that it took.
    pub seconds: f64,
}

/// Runs the runs of `shard` one after the other; each leaves `results/<config>/<run>.json` and its pictures in
/// `results/figures/` before the next begins. A run that fails is a record too.
///
/// # Errors
/// [`ResultsError`] where files cannot be written.
pub fn run(
    config: &Config,
    shard: Shard,
    results: &Path,
    mut watch: impl FnMut(Progress),
) -> Result<Vec<Record>, ResultsError> {
    let folder = results.join(&config.name);
    make(&folder)?;
    let mut versions = BTreeMap::from([("riemap".to_owned(), env!("CARGO_PKG_VERSION").to_owned())]);
    versions.extend(revision().map(|revision| ("revision".to_owned(), revision)));
    let mut records = Vec::new();
    for (position, run) in config.shard(shard) {
        let begun = Instant::now();
        let ended = run.task.run();
        let seconds = begun.elapsed().as_secs_f64();
        let (mut record, pictures) = record(config, run, ended);
        record.versions.extend(versions.clone());
        for Picture { suffix, format, bytes } in pictures {
            write_figure(results, &format!("{}{suffix}", figure_name(config, run)), format, &bytes)?;
        }
        write_json(&folder.join(format!("{}.json", run.name)), &record)?;
        watch(Progress { position, total: config.runs.len(), record: &record, seconds });
        records.push(record);
    }
    Ok(records)
}

/// The record, and the pictures where there is a result.
fn record(config: &Config, run: &Run, ended: Result<Yield, RunError>) -> (Record, Vec<Picture>) {
    let mut record = Record {
        experiment: config.name.clone(),
        run: run.name.clone(),
        config: run.config.clone(),
        outcome: Outcome::Done,
        error: None,
        result: Value::Null,
        timings: Value::Null,
        versions: BTreeMap::new(),
    };
    match ended {
        Err(error) => {
            record.outcome = Outcome::Failed;
            record.error = Some(with_causes(&error));
            (record, Vec::new())
        }
        Ok(yielded) => {
            record.result = yielded.result;
            record.timings = yielded.timings;
            record.versions = yielded.versions;
            record.error = refutation(run, &record);
            if record.error.is_some() {
                record.outcome = Outcome::Refuted;
            }
            (record, yielded.pictures)
        }
    }
}

/// What `[expect]` excludes.
fn refutation(run: &Run, record: &Record) -> Option<String> {
    let violations = run.expect.iter().filter_map(|(key, bound)| {
        let violation = match record.get(key) {
            Some(value) => bound.violation(&value)?,
            None => format!("is not in the record; it has: {}", record.keys().join(", ")),
        };
        Some(format!("`{key}` {violation}"))
    });
    let violations: Vec<String> = violations.collect();
    (!violations.is_empty()).then(|| violations.join("; "))
}

/// An error and everything that it is because of, once each.
fn with_causes(error: &dyn std::error::Error) -> String {
    let mut text = error.to_string();
    let mut cause = error.source();
    while let Some(error) = cause {
        let message = error.to_string();
        if !text.ends_with(&message) {
            text = format!("{text}: {message}");
        }
        cause = error.source();
    }
    text
}

fn figure_name(config: &Config, run: &Run) -> String {
    if config.swept.is_empty() { config.name.clone() } else { format!("{}-{}", config.name, run.name) }
}

pub(super) fn write_figure(results: &Path, name: &str, format: Format, bytes: &[u8]) -> Result<PathBuf, ResultsError> {
    let folder = results.join("figures");
    make(&folder)?;
    let extension = match format {
        Format::Png => "png",
        Format::Svg => "svg",
    };
    let path = folder.join(format!("{name}.{extension}"));
    atomically(&path, |out| out.write_all(bytes))?;
    Ok(path)
}

pub(super) fn make(folder: &Path) -> Result<(), ResultsError> {
    fs::create_dir_all(folder).map_err(|source| ResultsError::Folder { path: folder.to_owned(), source })
}

fn write_json(path: &Path, record: &Record) -> Result<(), ResultsError> {
    let json = serde_json::to_string_pretty(record)?;
    Ok(atomically(path, |out| writeln!(out, "{json}"))?)
}
