use std::path::{Path, PathBuf};

use super::files::{extension, lock, write_figure};
use super::inside::inside;
use super::store::records;
use super::tables::{made, table};
use super::{Config, GroupSpec, Record, ResultsError};
use crate::figure::{FigureError, Format};
use crate::io::atomically;

/// The summary of the records of a config.
#[derive(Clone, Debug)]
pub struct Summary {
    /// The records in the order of the runs. Records of other settings do not count.
    pub records: Vec<Record>,
    /// The tables and plots that were written.
    pub files: Vec<PathBuf>,
}

/// Summarises the records of `config` in `results`, of all shards: writes `<config>/table.md` with
/// everything that is the same on every run, `<config>/timings.md`, and the plots in `figures/`.
/// Without any record nothing is written.
///
/// # Errors
/// A key that no record has; a plot or file that cannot be made.
pub fn summarise(config: &Config, results: &Path) -> Result<Summary, ResultsError> {
    let folder = inside(results, &config.name)?;
    // Of shards that end at the same time, the last to read must be the last to write.
    let _lock = lock(&folder);
    let records = records(config, results);
    if records.is_empty() {
        return Ok(Summary { records, files: Vec::new() });
    }
    let complete = made(config, &records) == config.runs.len();
    // What is in no record yet may be in those of other shards.
    if complete {
        check_keys(config, &records)?;
    }
    // A clone has records without timings.
    let timed = records.iter().any(|record| !record.timings.is_null());
    let mut files = Vec::new();
    for (name, timings) in [("table.md", false), ("timings.md", true)] {
        if let Some(text) = table(config, &records, timings).filter(|_| timed || !timings) {
            let path = inside(results, Path::new(&config.name).join(name))?;
            atomically(&path, |out| out.write_all(text.as_bytes()))?;
            files.push(path);
        }
    }
    let finished = records.iter().any(|record| !record.result.is_null());
    for (name, spec) in config.plots.iter().filter(|(_, spec)| finished && (timed || !spec.is_of_timings())) {
        for format in [Format::Png, Format::Svg] {
            let bytes = match spec.plot(&records).render(format) {
                // Of runs that may fail, or of which `--set` has made a part, there may be none.
                Err(FigureError::NoPoints) if !complete || config.may_fail => continue,
                Err(source) => {
                    return Err(ResultsError::Plot { config: config.path.clone(), plot: name.clone(), source });
                }
                Ok(bytes) => bytes,
            };
            files.push(write_figure(results, &format!("{}-{name}.{}", config.name, extension(format)), &bytes)?);
        }
    }
    if let Some(sheet) = config.sheet {
        files.extend(sheet.make(config, &records, results)?);
    }
    Ok(Summary { records, files })
}

/// A misspelt key must not become an empty column or plot. Without a single result there is nothing
/// to check against.
fn check_keys(config: &Config, records: &[Record]) -> Result<(), ResultsError> {
    let finished: Vec<&Record> = records.iter().filter(|record| !record.result.is_null()).collect();
    let Some(example) = finished.first() else { return Ok(()) };
    let columns = config.columns.iter().map(|column| (&column.key, "table".to_owned()));
    let plots = config.plots.iter().flat_map(|(name, p)| p.keys().map(move |key| (key, format!("plots.{name}"))));
    let groups = config.groups.iter().flat_map(GroupSpec::keys).map(|key| (key, "groups".to_owned()));
    let timed = finished.iter().any(|record| !record.timings.is_null());
    for (key, table) in columns.chain(groups).chain(plots).filter(|(key, _)| timed || !key.starts_with("timings.")) {
        if finished.iter().all(|record| record.get(key).is_none()) {
            let part = key.split('.').next().unwrap_or(key);
            let known: Vec<String> = example.keys().into_iter().filter(|known| known.starts_with(part)).collect();
            let known =
                if known.is_empty() { "config.…, result.…, timings.…".to_owned() } else { known.join(", ") };
            return Err(ResultsError::UnknownKey { config: config.path.clone(), key: key.clone(), table, known });
        }
    }
    Ok(())
}
