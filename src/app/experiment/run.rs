use std::any::Any;
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::inside::inside;
use super::repository::revision;
use super::{Config, Outcome, Picture, Record, ResultsError, Run, RunError, Yield};
use crate::app::measure::process::{Bounds, End, watch};
use crate::figure::Format;
use crate::io::atomically;

/// A run that has ended; nothing is written yet.
pub(super) struct Ended {
    pub(super) record: Record,
    pictures: Vec<Picture>,
    /// Wall-clock seconds that it took.
    pub(super) seconds: f64,
}

/// Makes a run. A failure is a record too, and so is a panic: no run may end the others.
pub(super) fn make(config: &Config, run: &Run, versions: &BTreeMap<String, String>) -> Ended {
    let begun = Instant::now();
    // Nothing that a panicking task leaves half-done is looked at again.
    let ended = catch_unwind(AssertUnwindSafe(|| run.task.run()));
    let seconds = begun.elapsed().as_secs_f64();
    let ended = ended.unwrap_or_else(|panic| Err(RunError::Panic { message: panic_message(panic.as_ref()) }));
    let (mut record, pictures) = record(config, run, ended);
    record.versions.extend(versions.clone());
    if let Some((data, path)) = run.data.as_ref().and_then(|data| Some((data, data.path.as_ref()?))) {
        let version = data.version(path).unwrap_or_else(|error| error.to_string());
        record.versions.insert(format!("data:{}", data.name), version);
    }
    record.pictures = pictures.iter().map(|picture| picture_name(config, run, picture)).collect();
    Ended { record, pictures, seconds }
}

/// Makes a run and writes its record and pictures into `results`: what a process does that a [`Maker`](super::Maker) calls.
///
/// # Errors
/// No run at that place; files that cannot be written.
pub fn make_one(results: &Path, config: &Config, position: usize) -> Result<(), ResultsError> {
    let run = config.all_runs().into_iter().find(|run| run.position == position);
    let run = run.ok_or_else(|| ResultsError::NoRun { config: config.path.clone(), position })?;
    write(results, config, run, &make(config, run, &versions()))
}

/// Has a run made by a process of its own within some seconds; a process that leaves no record leaves a failure. `None` where all is
/// to stop.
pub(super) fn make_apart(
    results: &Path,
    config: &Config,
    run: &Run,
    versions: &BTreeMap<String, String>,
    (limit, mut command): (f64, Command),
    stop: &dyn Fn() -> bool,
) -> Result<Option<Ended>, ResultsError> {
    let bounds =
        Bounds { limit: Duration::try_from_secs_f64(limit).unwrap_or(Duration::MAX), stop, with_its_own: true };
    let process = watch(&mut command, &bounds).map_err(ResultsError::Process)?;
    let seconds = process.wall;
    let left = match process.end {
        End::Stopped => return Ok(None),
        End::OverTime => Err(RunError::OverTime { seconds: limit }),
        End::Itself(status) => stored(results, config, run).filter(|_| status.success()).ok_or_else(|| {
            let said = process.stderr.trim().lines().last().unwrap_or_default().to_owned();
            RunError::Process { status: status.to_string(), said }
        }),
    };
    let error = match left {
        Ok(record) => return Ok(Some(Ended { record, pictures: Vec::new(), seconds })),
        Err(error) => error,
    };
    let (mut record, pictures) = record(config, run, Err(error));
    record.versions.extend(versions.clone());
    let ended = Ended { record, pictures, seconds };
    write(results, config, run, &ended)?;
    Ok(Some(ended))
}

/// Those that every record has: the program's, and of which revision it is.
pub(super) fn versions() -> BTreeMap<String, String> {
    let mut versions = BTreeMap::from([("riemap".to_owned(), env!("CARGO_PKG_VERSION").to_owned())]);
    versions.extend(revision().map(|revision| ("revision".to_owned(), revision)));
    versions
}

/// Writes `<config>/<run>.json` and the pictures, and removes those that the run had and has no more.
pub(super) fn write(results: &Path, config: &Config, run: &Run, ended: &Ended) -> Result<(), ResultsError> {
    let path = inside(results, record_path(config, run))?;
    let former = read(&path).map(|record| record.pictures).unwrap_or_default();
    for (name, picture) in ended.record.pictures.iter().zip(&ended.pictures) {
        write_figure(results, name, &picture.bytes)?;
    }
    make_folder(&inside(results, &config.name)?)?;
    let json = serde_json::to_string_pretty(&ended.record)?;
    atomically(&path, |out| writeln!(out, "{json}"))?;
    remove_pictures(results, former.iter().filter(|name| !ended.record.pictures.contains(name)))
}

/// The record that `results` has of a run, if it is one of the same settings.
pub(super) fn stored(results: &Path, config: &Config, run: &Run) -> Option<Record> {
    read(&results.join(record_path(config, run))).filter(|record| record.config == run.config)
}

pub(super) fn read(path: &Path) -> Option<Record> {
    serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
}

/// Removes files in `figures/`; what is not the plain name of a file is left alone.
pub(super) fn remove_pictures<'n>(
    results: &Path,
    names: impl IntoIterator<Item = &'n String>,
) -> Result<(), ResultsError> {
    for name in names {
        if Path::new(name).file_name().is_some_and(|file| file == name.as_str()) {
            remove(&inside(results, Path::new("figures").join(name))?)?;
        }
    }
    Ok(())
}

/// Removes a file, if it is still there.
pub(super) fn remove(path: &Path) -> Result<(), ResultsError> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(ResultsError::Remove { path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

fn panic_message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a message").to_owned()
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
        pictures: Vec::new(),
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

/// The path of a record below the folder of results.
fn record_path(config: &Config, run: &Run) -> PathBuf {
    Path::new(&config.name).join(format!("{}.json", run.name))
}

fn picture_name(config: &Config, run: &Run, picture: &Picture) -> String {
    let run = if config.swept.is_empty() { String::new() } else { format!("-{}", run.picture) };
    format!("{}{run}{}.{}", config.name, picture.suffix, extension(picture.format))
}

pub(super) fn extension(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Svg => "svg",
    }
}

pub(super) fn write_figure(results: &Path, name: &str, bytes: &[u8]) -> Result<PathBuf, ResultsError> {
    let path = inside(results, Path::new("figures").join(name))?;
    path.parent().map_or(Ok(()), make_folder)?;
    atomically(&path, |out| out.write_all(bytes))?;
    Ok(path)
}

pub(super) fn make_folder(folder: &Path) -> Result<(), ResultsError> {
    fs::create_dir_all(folder).map_err(|source| ResultsError::Folder { path: folder.to_owned(), source })
}
