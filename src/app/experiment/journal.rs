use std::fs::{self, File};
use std::path::{Path, PathBuf};

use super::data::sha256;
use super::inside::inside;
use super::run::{remove, stored};
use super::{Config, Outcome, Record, ResultsError, Run, Shard};

/// The folder of all journals.
const ROOT: &str = ".unfinished";

/// What an interrupted batch has finished: empty files `<results>/.unfinished/<program>/<experiment>/<run>`. A batch that
/// ends takes its own away, so that the records of a clone, which somebody else has made, are never taken for its own.
/// One file a run: nothing is rewritten, and shards at work in the same folder do not meet.
#[derive(Clone, Debug)]
pub struct Journal {
    results: PathBuf,
    /// `.unfinished/PROGRAM`, below the folder of results.
    folder: PathBuf,
}

impl Journal {
    /// That of the program called `program` in the folder of results.
    pub fn new(results: &Path, program: &str) -> Journal {
        Journal { results: results.to_owned(), folder: Path::new(ROOT).join(program) }
    }

    /// That of the program at work, told from others by its bytes: one that is built anew makes everything anew.
    ///
    /// # Errors
    /// [`ResultsError::Journal`]: the executable cannot be read.
    pub fn of_this_program(results: &Path) -> Result<Journal, ResultsError> {
        let executable = std::env::current_exe().and_then(|path| sha256(&path));
        let hash = executable.map_err(|source| ResultsError::Journal { path: results.join(ROOT), source })?;
        Ok(Journal::new(results, &hash[..16]))
    }

    /// The record of a run that is finished: noted here, and there with the same settings. What failed is not finished; it
    /// may have been for want of something that is there now.
    pub(super) fn finished(&self, results: &Path, config: &Config, run: &Run) -> Option<Record> {
        let noted = self.results.join(&self.folder).join(&config.name).join(&run.name).is_file();
        let record = if noted { stored(results, config, run) } else { None };
        record.filter(|record| record.outcome != Outcome::Failed)
    }

    /// Notes that a run is finished. Its record must have been written.
    pub(super) fn note(&self, config: &Config, run: &Run) -> Result<(), ResultsError> {
        let path = inside(&self.results, self.folder.join(&config.name).join(&run.name))?;
        let folder = path.parent().unwrap_or(&self.results);
        let noted = fs::create_dir_all(folder).and_then(|()| File::create(&path).map(drop));
        // Another shard that has just ended may take the empty folder away.
        let again = |_| fs::create_dir_all(folder).and_then(|()| File::create(&path).map(drop));
        noted.or_else(again).map_err(|source| ResultsError::Journal { path, source })
    }

    /// Forgets what is noted of a shard of `configs`, by whatever program.
    ///
    /// # Errors
    /// [`ResultsError::Remove`]: a file does not go away.
    pub fn forget(&self, configs: &[Config], shard: Shard) -> Result<(), ResultsError> {
        let root = inside(&self.results, ROOT)?;
        for program in subfolders(&root) {
            for config in configs {
                let folder = program.join(&config.name);
                if folder.is_symlink() {
                    continue;
                }
                for (_, run) in config.shard(shard) {
                    remove(&folder.join(&run.name))?;
                }
                // Unless others are still noted in it.
                let _ = fs::remove_dir(&folder);
            }
            let _ = fs::remove_dir(&program);
        }
        let _ = fs::remove_dir(&root);
        Ok(())
    }
}

fn subfolders(folder: &Path) -> Vec<PathBuf> {
    let entries = folder.read_dir().into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).filter(|path| path.is_dir() && !path.is_symlink()).collect()
}
