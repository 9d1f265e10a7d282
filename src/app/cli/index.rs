//! The page of results that `run` and `reproduce` write.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use crate::app::experiment::{Config, EXPERIMENTS, has_experiments, records, write_page};

use super::experiments::{Options, load};

/// Writes `index.html` into `results`: `shown`, and every other experiment of the working directory
/// that has records there.
pub fn write_index(mut shown: Vec<Config>, options: &Options, results: &Path, out: &mut dyn Write) -> Result<()> {
    let others = if has_experiments() { experiment_files(Path::new(EXPERIMENTS))? } else { Vec::new() };
    // Settings of the command line apply only to the experiments that were run.
    let options = Options { set: Vec::new(), ..options.clone() };
    for path in others {
        if shown.iter().any(|config| config.name == name(&path)) {
            continue;
        }
        match load(std::slice::from_ref(&path), &options) {
            Ok(loaded) => shown.extend(loaded.into_iter().filter(|config| !records(config, results).is_empty())),
            Err(error) => writeln!(out, "! {} is not on the page: {error}", path.display())?,
        }
    }
    shown.sort_by(|a, b| a.name.cmp(&b.name));
    writeln!(out, "wrote {}", write_page(&shown, results)?.display())?;
    Ok(())
}

/// Returns the experiment files of a folder, sorted.
pub fn experiment_files(folder: &Path) -> Result<Vec<PathBuf>> {
    let unreadable = || format!("{} cannot be read", folder.display());
    let mut paths = Vec::new();
    for entry in folder.read_dir().with_context(unreadable)? {
        paths.push(entry.with_context(unreadable)?.path());
    }
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    if paths.is_empty() {
        bail!("{} has no experiments: no file ends in .toml", folder.display());
    }
    Ok(paths)
}

/// Returns the name of the experiment in a file.
pub fn name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}
