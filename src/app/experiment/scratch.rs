use std::fs;
use std::path::{Path, PathBuf};

use super::data::sha256;
use super::files::{make_folder, remove};
use super::inside::inside;
use super::{Config, Outcome, Record, ResultsError, Run, Shard};
use crate::io::atomically;

/// The folder of all scratch records, below the folder of results.
const ROOT: &str = ".unfinished";

/// The records of the runs that one program has finished in a folder of results, one file
/// `<results>/.unfinished/<program>/<experiment>/<run>.json` per run.
///
/// # Rationale
/// A batch may be killed at any moment, and shards of it may work in the same folder at the same
/// time. With one file per run nothing is rewritten and no two processes write the same file. At
/// the summary of an experiment its scratch records are merged into `records.jsonl`; a batch that
/// has ended removes them, so that only an interrupted batch is resumed.
#[derive(Clone, Debug)]
pub struct Scratch {
    results: PathBuf,
    program: String,
}

impl Scratch {
    /// Returns the scratch records of the program called `program` in the folder `results`.
    pub fn new(results: &Path, program: &str) -> Scratch {
        Scratch { results: results.to_owned(), program: program.to_owned() }
    }

    /// Returns the scratch records of the running program. Its name is the hash of the executable:
    /// a program that has been rebuilt resumes nothing.
    ///
    /// # Errors
    /// [`ResultsError::Program`]: the executable cannot be read.
    pub fn of_this_program(results: &Path) -> Result<Scratch, ResultsError> {
        let hash = std::env::current_exe().and_then(|path| sha256(&path)).map_err(ResultsError::Program)?;
        Ok(Scratch::new(results, &hash[..16]))
    }

    /// The folder of results.
    pub fn results(&self) -> &Path {
        &self.results
    }

    /// The name of the program.
    pub fn program(&self) -> &str {
        &self.program
    }

    /// The record of a run, if there is one and it has the settings of the run.
    pub(super) fn record(&self, config: &Config, run: &Run) -> Option<Record> {
        let text = fs::read_to_string(self.results.join(self.path(config, run))).ok()?;
        serde_json::from_str(&text).ok().filter(|record: &Record| record.config == run.config)
    }

    /// The record of a run that need not be made again. A failed run is made again, because its
    /// failure may have had a cause that is gone, such as a missing network.
    pub(super) fn finished(&self, config: &Config, run: &Run) -> Option<Record> {
        self.record(config, run).filter(|record| record.outcome != Outcome::Failed)
    }

    /// Writes the record of a run.
    pub(super) fn write(&self, config: &Config, run: &Run, record: &Record) -> Result<(), ResultsError> {
        let path = inside(&self.results, self.path(config, run))?;
        let folder = path.parent().unwrap_or(&self.results);
        let json = serde_json::to_string(record)?;
        let write = || {
            make_folder(folder)?;
            Ok::<_, ResultsError>(atomically(&path, |out| writeln!(out, "{json}"))?)
        };
        // Another shard that has just ended may have removed the empty folder.
        write().or_else(|_| write())
    }

    /// Removes the record of a run.
    pub(super) fn remove(&self, config: &Config, run: &Run) -> Result<(), ResultsError> {
        remove(&inside(&self.results, self.path(config, run))?)
    }

    /// Removes the records of a shard of `configs`, whichever program has written them.
    ///
    /// # Errors
    /// [`ResultsError::Remove`]: a file cannot be removed.
    pub fn forget(&self, configs: &[Config], shard: Shard) -> Result<(), ResultsError> {
        let root = inside(&self.results, ROOT)?;
        for program in subfolders(&root) {
            for config in configs {
                let folder = program.join(&config.name);
                if folder.is_symlink() {
                    continue;
                }
                for (_, run) in config.shard(shard) {
                    remove(&folder.join(format!("{}.json", run.name)))?;
                }
                // The folder remains if it has records of other shards.
                let _ = fs::remove_dir(&folder);
            }
            let _ = fs::remove_dir(&program);
        }
        let _ = fs::remove_dir(&root);
        Ok(())
    }

    /// The path of a record below the folder of results.
    fn path(&self, config: &Config, run: &Run) -> PathBuf {
        Path::new(ROOT).join(&self.program).join(&config.name).join(format!("{}.json", run.name))
    }
}

fn subfolders(folder: &Path) -> Vec<PathBuf> {
    let entries = folder.read_dir().into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).filter(|path| path.is_dir() && !path.is_symlink()).collect()
}
