//! Comparison of speed with other programs: `riemap bench`. Every run is a process of its own.
//!
//! | file | contents |
//! |---|---|
//! | `case.rs` | the tables of meshes and of contestants |
//! | `run.rs`, `contest.rs` | all meshes in sequence; on each mesh, the contestants in turns |
//! | `python.rs`, `peers.py` | the interpreter with the peers, and the script it runs |
//! | `target.rs` | the mesh as files, and the measurement of maps |
//! | `bff.rs` | the maps of the program of Boundary First Flattening |
//! | `exchange.rs` | the speed of reading and writing |
//! | `record.rs`, `median.rs`, `requirement.rs` | the record; medians and ratios; performance bars |
//! | `table.rs`, `chart.rs` | the record as Markdown, CSV and plots |

mod bff;
mod case;
mod chart;
mod contest;
mod error;
mod exchange;
mod median;
mod python;
mod record;
mod requirement;
mod run;
mod table;
mod target;

use std::path::{Path, PathBuf};

pub use case::{CASES, CONTESTANTS, Case, Contestant, MapClass, Package, Program, Source, case};
pub use chart::plots;
pub use error::BenchError;
pub use median::medians;
pub use python::Peers;
pub use record::{ContestOutcome, Entry, Exchange, Measured, Quality, Record, Seconds};
pub use requirement::{Verdict, verdicts};
pub use run::{Event, Plan, chosen, run};
pub use table::{bars, brief, csv, markdown};

use crate::io::{WriteError, stage};

/// Returns the contestant of that name.
pub fn contestant(name: &str) -> Option<&'static Contestant> {
    CONTESTANTS.iter().find(|contestant| contestant.name == name)
}

/// Files that [`write()`] always writes.
pub const FILES: [&str; 3] = ["table.md", "bench.csv", "bench.json"];

/// Writes `table.md`, `bench.csv`, `bench.json` and the plots into `folder`, all or none, and
/// returns their paths. Plots of an earlier record that this one does not have are removed.
///
/// # Errors
/// The folder cannot be created, or a file cannot be written.
pub fn write(record: &Record, folder: &Path) -> Result<Vec<PathBuf>, BenchError> {
    let json = serde_json::json!({ "bars": verdicts(record), "record": record });
    let texts = [markdown(record), csv(record), format!("{}\n", serde_json::to_string_pretty(&json)?)];
    let texts = texts.into_iter().map(String::into_bytes);
    let mut files: Vec<(String, Vec<u8>)> = FILES.iter().map(|name| name.to_string()).zip(texts).collect();
    files.extend(plots(record)?);
    std::fs::create_dir_all(folder).map_err(|source| WriteError::Io { path: folder.to_owned(), source })?;
    let staged = files.iter().map(|(name, bytes)| stage(&folder.join(name), |out| out.write_all(bytes)));
    let staged: Vec<_> = staged.collect::<Result<_, _>>()?;
    staged.into_iter().try_for_each(|file| file.publish())?;
    for stale in chart::files().filter(|name| files.iter().all(|(file, _)| file != name)) {
        let path = folder.join(stale);
        match std::fs::remove_file(&path) {
            Err(source) if source.kind() != std::io::ErrorKind::NotFound => Err(WriteError::Io { path, source })?,
            _ => {}
        }
    }
    Ok(files.into_iter().map(|(name, _)| folder.join(name)).collect())
}
