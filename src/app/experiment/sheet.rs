use std::fs;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::files::write_figure;
use super::{Config, Record, ResultsError};
use crate::figure::{compose, small_copy};

/// `[sheet]`: the pictures of all runs as one figure, `figures/NAME.png`, and a copy for README and
/// paper, `figures/small/NAME.png`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SheetSpec {
    /// Number of pictures in a row.
    pub columns: usize,
}

impl Default for SheetSpec {
    fn default() -> SheetSpec {
        SheetSpec { columns: 1 }
    }
}

/// Width of the copy in pixels.
const SMALL: u32 = 900;

impl SheetSpec {
    /// Makes both from the pictures of the records, and nothing while runs or their pictures are
    /// missing: a clone has records of runs that cannot be made here for want of data, but not
    /// their pictures.
    ///
    /// # Errors
    /// Pictures that cannot be read or written.
    pub(super) fn make(
        self,
        config: &Config,
        records: &[Record],
        results: &Path,
    ) -> Result<Vec<PathBuf>, ResultsError> {
        let made = |name: &str| records.iter().any(|record| record.run == name);
        let panels: Vec<PathBuf> =
            records.iter().filter_map(panel).map(|name| results.join("figures").join(name)).collect();
        let complete = config.runs.iter().all(|run| made(&run.name)) && panels.iter().all(|path| path.is_file());
        if !complete || panels.is_empty() {
            return Ok(Vec::new());
        }
        let read = |path: &PathBuf| fs::read(path).map_err(|source| ResultsError::Panel { path: path.clone(), source });
        let panels: Vec<Vec<u8>> = panels.iter().map(read).collect::<Result<_, _>>()?;
        let failed = |source| ResultsError::Sheet { config: config.path.clone(), source };
        let figure = match &panels[..] {
            [one] => one.clone(),
            many => compose(many, self.columns).map_err(failed)?,
        };
        let copy = small_copy(&figure, SMALL).map_err(failed)?;
        Ok(vec![
            write_figure(results, &format!("{}.png", config.name), &figure)?,
            write_figure(results, &format!("small/{}.png", config.name), &copy)?,
        ])
    }
}

/// The picture of a run that is placed on the sheet: of several, the one with a checkerboard.
pub(super) fn panel(record: &Record) -> Option<&String> {
    let pixels = || record.pictures.iter().filter(|name| name.ends_with(".png"));
    pixels().find(|name| name.ends_with("-checkerboard.png")).or_else(|| pixels().next())
}
