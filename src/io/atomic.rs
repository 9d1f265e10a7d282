use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, TempPath};

use super::WriteError;

/// Writes a file atomically: it is either complete or does not exist ([`stage`], then
/// [`Staged::publish`]).
///
/// # Errors
/// [`WriteError::Io`] if the system refuses or `write` fails; no partial file remains.
pub fn atomically(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    stage(path, write)?.publish()
}

/// A file that is completely written but not yet in its final place. Dropping it removes it.
pub struct Staged {
    path: PathBuf,
    content: StagedContent,
}

enum StagedContent {
    File { temporary: TempPath, target: PathBuf },
    Device(Vec<u8>),
}

/// Writes a file to a temporary file in the same folder.
///
/// A program with several outputs stages all of them before it publishes the first, so that a
/// failure leaves none. An existing file is replaced only by [`Staged::publish`]; it keeps its
/// permissions, and a link to it stays a link. Output to a device or pipe (`/dev/stdout`) is kept
/// in memory until then.
///
/// # Errors
/// [`WriteError::Io`] if the system refuses or `write` fails.
pub fn stage(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Staged, WriteError> {
    let content = content(path, write).map_err(|source| WriteError::Io { path: path.to_owned(), source })?;
    Ok(Staged { path: path.to_owned(), content })
}

impl Staged {
    /// Moves the file to its final place.
    ///
    /// # Errors
    /// [`WriteError::Io`] if the system refuses.
    pub fn publish(self) -> Result<(), WriteError> {
        let published = match self.content {
            StagedContent::File { temporary, target } => temporary.persist(target).map_err(|e| e.error),
            StagedContent::Device(bytes) => {
                fs::OpenOptions::new().write(true).open(&self.path).and_then(|mut device| device.write_all(&bytes))
            }
        };
        published.map_err(|source| WriteError::Io { path: self.path, source })
    }
}

fn content(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<StagedContent> {
    let existing = existing(path)?;
    if existing.as_ref().is_some_and(|metadata| !metadata.is_file()) {
        let mut bytes = Vec::new();
        write(&mut bytes)?;
        return Ok(StagedContent::Device(bytes));
    }
    let target = if existing.is_some() { fs::canonicalize(path)? } else { path.to_owned() };
    // The error is given without the name of the temporary file, which means nothing to the user.
    let temporary = builder().tempfile_in(folder_of(&target)).map_err(|e| io::Error::from(e.kind()))?;
    let (file, temporary) = temporary.into_parts();
    let file = buffered(file, write)?;
    if let Some(metadata) = existing {
        file.set_permissions(metadata.permissions())?;
    }
    Ok(StagedContent::File { temporary, target })
}

/// Checks, as far as possible without writing, whether a file can be written under this name.
///
/// # Errors
/// [`WriteError::Io`] for a folder, a read-only file, or a file in a folder that does not exist.
pub fn can_be_written(path: &Path) -> Result<(), WriteError> {
    existing(path).map(drop).map_err(|source| WriteError::Io { path: path.to_owned(), source })
}

/// Returns the metadata of an existing output file; `None` if it does not exist but its folder
/// does.
fn existing(path: &Path) -> io::Result<Option<fs::Metadata>> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(metadata) if metadata.permissions().readonly() => Err(io::ErrorKind::PermissionDenied.into()),
        Ok(metadata) => Ok(Some(metadata)),
        // If the folder is missing, the system's own message says so.
        Err(e) if e.kind() == io::ErrorKind::NotFound => fs::metadata(folder_of(path)).map(|_| None),
        Err(e) => Err(e),
    }
}

fn buffered<W: Write>(inner: W, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<W> {
    let mut buffer = BufWriter::with_capacity(1 << 18, inner);
    write(&mut buffer)?;
    buffer.into_inner().map_err(io::IntoInnerError::into_error)
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    }
}

/// Makes temporary files with the usual permissions of a new file, subject to the umask.
#[cfg(unix)]
fn builder() -> Builder<'static, 'static> {
    use std::os::unix::fs::PermissionsExt;
    let mut builder = Builder::new();
    builder.prefix(".riemap-").permissions(fs::Permissions::from_mode(0o666));
    builder
}

#[cfg(not(unix))]
fn builder() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".riemap-");
    builder
}
