use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::inside::inside;
use super::run::{read, remove, remove_pictures};
use super::{Config, ResultsError, records};

/// Removes what `results` has of runs that `config` no longer makes, also with `[full]`: records of this experiment under
/// names of no run, with their pictures. Records that runs of other settings left under the name of a run stay until it is
/// made; plots that the config no longer has stay. Returns the records removed.
///
/// # Errors
/// [`ResultsError::Remove`]: a file does not go away.
pub fn remove_stale(config: &Config, results: &Path) -> Result<Vec<PathBuf>, ResultsError> {
    let known: HashSet<String> = config.all_runs().iter().map(|run| format!("{}.json", run.name)).collect();
    let kept: Vec<String> = records(config, results).into_iter().flat_map(|record| record.pictures).collect();
    let mut removed = Vec::new();
    // No folder, no records.
    for entry in inside(results, &config.name)?.read_dir().into_iter().flatten().flatten() {
        let path = entry.path();
        let json = path.extension().is_some_and(|extension| extension == "json");
        if !json || entry.file_name().to_str().is_some_and(|name| known.contains(name)) {
            continue;
        }
        let Some(record) = read(&path).filter(|record| record.experiment == config.name) else { continue };
        remove_pictures(results, record.pictures.iter().filter(|picture| !kept.contains(picture)))?;
        remove(&path)?;
        removed.push(path);
    }
    removed.sort();
    Ok(removed)
}
