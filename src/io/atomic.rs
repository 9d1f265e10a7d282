use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::{Builder, TempPath};

use super::WriteError;

/// Writes a file so that it is either complete or not there: [`stage`] and [`Staged::publish`].
///
/// # Errors
///
/// [`WriteError::Io`] when the system refuses or `write` fails; nothing is left behind then.
pub fn atomically(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), WriteError> {
    stage(path, write)?.publish()
}

/// A file written in full and not yet in its place. Dropped, it leaves nothing behind.
pub struct Staged {
    path: PathBuf,
    content: Content,
}

enum Content {
    File { temporary: TempPath, target: PathBuf },
    Device(Vec<u8>),
}

/// Writes a file into a temporary one in the same folder. Of several outputs all are staged before the first is
/// published, so that a failure leaves none.
///
/// An existing file is replaced only by [`Staged::publish`], and keeps its permissions; a link to it stays a link. What
/// goes to a device or pipe (`/dev/stdout`) is kept in memory until then.
///
/// # Errors
///
/// [`WriteError::Io`] when the system refuses or `write` fails.
pub fn stage(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<Staged, WriteError> {
    let content = content(path, write).map_err(|source| WriteError::Io { path: path.to_owned(), source })?;
    Ok(Staged { path: path.to_owned(), content })
}

impl Staged {
    /// Puts the file in its place.
    ///
    /// # Errors
    ///
    /// [`WriteError::Io`] when the system refuses.
    pub fn publish(self) -> Result<(), WriteError> {
        let published = match self.content {
            Content::File { temporary, target } => temporary.persist(target).map_err(|e| e.error),
            Content::Device(bytes) => {
                fs::OpenOptions::new().write(true).open(&self.path).and_then(|mut device| device.write_all(&bytes))
            }
        };
        published.map_err(|source| WriteError::Io { path: self.path, source })
    }
}

fn content(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<Content> {
    let existing = existing(path)?;
    if existing.as_ref().is_some_and(|metadata| !metadata.is_file()) {
        let mut bytes = Vec::new();
        write(&mut bytes)?;
        return Ok(Content::Device(bytes));
    }
    let target = if existing.is_some() { fs::canonicalize(path)? } else { path.to_owned() };
    // Without the name of the temporary file, which means nothing to the user.
    let temporary = builder().tempfile_in(folder_of(&target)).map_err(|e| io::Error::from(e.kind()))?;
    let (file, temporary) = temporary.into_parts();
    let file = buffered(file, write)?;
    if let Some(metadata) = existing {
        file.set_permissions(metadata.permissions())?;
    }
    Ok(Content::File { temporary, target })
}

/// Whether a file can be written under this name, as far as can be told without writing.
///
/// # Errors
///
/// [`WriteError::Io`] for a folder, a file that is read-only, or a folder that does not exist.
pub fn can_be_written(path: &Path) -> Result<(), WriteError> {
    existing(path).map(drop).map_err(|source| WriteError::Io { path: path.to_owned(), source })
}

/// What is there under the name of an output.
fn existing(path: &Path) -> io::Result<Option<fs::Metadata>> {
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
        Ok(metadata) if metadata.permissions().readonly() => Err(io::ErrorKind::PermissionDenied.into()),
        Ok(metadata) => Ok(Some(metadata)),
        // The system's own words where the folder is missing.
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

/// Temporary files as any new file is made: readable by others if the umask lets them.
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
