use std::any::Any;
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::Value;

use super::files::{extension, write_figure};
use super::scratch::Scratch;
use super::{Config, Outcome, Picture, Record, ResultsError, Run, RunError, Yield};
use crate::app::measure::process::{Bounds, End, watch};

/// A run that has ended; nothing is written yet.
pub(super) struct EndedRun {
    pub(super) record: Record,
    pictures: Vec<Picture>,
    /// Wall-clock seconds that it took.
    pub(super) seconds: f64,
}

/// Makes a run. A failure leaves a record, and so does a panic: no run may end the others.
pub(super) fn make(config: &Config, run: &Run) -> EndedRun {
    let begun = Instant::now();
    // Nothing that a panicking task leaves half-done is looked at again.
    let ended = catch_unwind(AssertUnwindSafe(|| run.task.run()));
    let seconds = begun.elapsed().as_secs_f64();
    let ended = ended.unwrap_or_else(|panic| Err(RunError::Panic { message: panic_message(panic.as_ref()) }));
    let (mut record, pictures) = record(config, run, ended);
    if let Some((data, path)) = run.data.as_ref().and_then(|data| Some((data, data.path.as_ref()?))) {
        let version = data.version(path).unwrap_or_else(|error| error.to_string());
        record.versions.insert(format!("data:{}", data.name), version);
    }
    record.pictures = pictures.iter().map(|picture| picture_name(config, run, picture)).collect();
    EndedRun { record, pictures, seconds }
}

/// Makes the run at `position` and writes its scratch record and pictures: the work of the process
/// that a [`Maker`](super::Maker) starts.
///
/// # Errors
/// [`ResultsError`]: there is no run at that position, or a file cannot be written.
pub fn make_one(scratch: &Scratch, config: &Config, position: usize) -> Result<(), ResultsError> {
    let run = config.all_runs().into_iter().find(|run| run.position == position);
    let run = run.ok_or_else(|| ResultsError::NoRun { config: config.path.clone(), position })?;
    write(scratch, config, run, &make(config, run))
}

/// Has a process of its own make a run within `limit` seconds. A process that leaves no record
/// leaves a failure. Returns `None` where `stop` has ended the process.
pub(super) fn make_apart(
    scratch: &Scratch,
    config: &Config,
    run: &Run,
    (limit, mut command): (f64, Command),
    stop: &dyn Fn() -> bool,
) -> Result<Option<EndedRun>, ResultsError> {
    // A record of an interrupted batch must not be taken for one of this process.
    scratch.remove(config, run)?;
    let bounds =
        Bounds { limit: Duration::try_from_secs_f64(limit).unwrap_or(Duration::MAX), stop, with_its_own: true };
    let process = watch(&mut command, &bounds).map_err(ResultsError::Process)?;
    let seconds = process.wall;
    let left = match process.end {
        End::Stopped => return Ok(None),
        End::OverTime => Err(RunError::OverTime { seconds: limit }),
        End::Itself(status) => scratch.record(config, run).filter(|_| status.success()).ok_or_else(|| {
            let said = process.stderr.trim().lines().last().unwrap_or_default().to_owned();
            RunError::Process { status: status.to_string(), said }
        }),
    };
    let error = match left {
        Ok(record) => return Ok(Some(EndedRun { record, pictures: Vec::new(), seconds })),
        Err(error) => error,
    };
    let (record, pictures) = record(config, run, Err(error));
    let ended = EndedRun { record, pictures, seconds };
    write(scratch, config, run, &ended)?;
    Ok(Some(ended))
}

/// Writes the scratch record of a run, after its pictures.
pub(super) fn write(scratch: &Scratch, config: &Config, run: &Run, ended: &EndedRun) -> Result<(), ResultsError> {
    for (name, picture) in ended.record.pictures.iter().zip(&ended.pictures) {
        write_figure(scratch.results(), name, &picture.bytes)?;
    }
    scratch.write(config, run, &ended.record)
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

/// Says which bounds of `[expect]` the result violates; `None` if it violates none.
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

/// The messages of an error and its causes, without repetitions.
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

fn picture_name(config: &Config, run: &Run, picture: &Picture) -> String {
    let run = if config.swept.is_empty() { String::new() } else { format!("-{}", run.picture) };
    format!("{}{run}{}.{}", config.name, picture.suffix, extension(picture.format))
}
