//! Writing and removing files below the folder of results.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use super::ResultsError;
use super::inside::inside;
use crate::figure::Format;
use crate::io::atomically;

/// The extension of a picture's file.
pub(super) fn extension(format: Format) -> &'static str {
    match format {
        Format::Png => "png",
        Format::Svg => "svg",
    }
}

/// Writes `figures/<name>` and returns its path.
pub(super) fn write_figure(results: &Path, name: &str, bytes: &[u8]) -> Result<PathBuf, ResultsError> {
    let path = inside(results, Path::new("figures").join(name))?;
    path.parent().map_or(Ok(()), make_folder)?;
    atomically(&path, |out| out.write_all(bytes))?;
    Ok(path)
}

/// Makes a folder and those above it.
pub(super) fn make_folder(folder: &Path) -> Result<(), ResultsError> {
    fs::create_dir_all(folder).map_err(|source| ResultsError::Folder { path: folder.to_owned(), source })
}

/// Removes a file if it exists.
pub(super) fn remove(path: &Path) -> Result<(), ResultsError> {
    match fs::remove_file(path) {
        Err(source) if source.kind() != io::ErrorKind::NotFound => {
            Err(ResultsError::Remove { path: path.to_owned(), source })
        }
        _ => Ok(()),
    }
}

/// Removes files in `figures/`. A name that is not the plain name of a file is left alone.
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

/// Locks a folder against other processes until the file is dropped; `None` where the system has no
/// such locks.
pub(super) fn lock(folder: &Path) -> Option<File> {
    File::open(folder).and_then(|folder| folder.lock().map(|()| folder)).ok()
}
