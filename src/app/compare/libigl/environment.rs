use super::interpreter::{self, Versions};
use super::ownership;
use super::{LibiglError, Settings};
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;

/// Version of libigl in the environment.
pub const VERSION: &str = "2.6.3";

const REQUIREMENTS: &str = include_str!("requirements.txt");

/// The requirements that pip installs. They are written first: a folder that has them is ours, and
/// may be emptied.
const MARKER: &str = "riemap-requirements.txt";

/// A copy of the requirements that is written last, and marks a finished environment.
const STAMP: &str = "riemap-finished.txt";

/// A Python interpreter with libigl.
#[derive(Clone, Debug)]
pub struct Environment {
    /// The interpreter.
    pub python: PathBuf,
    /// Versions of its packages.
    pub versions: Versions,
    isolated: bool,
}

impl Environment {
    /// Returns the environment that the variables name (see [`crate::app::compare::libigl`]), and
    /// creates it if it does not exist: some 280 MB from the network in 10 to 60 seconds.
    ///
    /// Several processes may ask at once; one creates it and the others wait. An unfinished
    /// environment, or one with other versions, is created anew.
    pub fn ensure() -> Result<Environment, LibiglError> {
        Environment::with(&Settings::from_variables())
    }

    /// Does the same as [`Environment::ensure`] with the given settings.
    pub fn with(settings: &Settings) -> Result<Environment, LibiglError> {
        if let Some(python) = &settings.interpreter {
            let versions = interpreter::versions(python, false)?;
            return Ok(Environment { python: python.clone(), versions, isolated: false });
        }
        let folder = &settings.folder;
        match Environment::finished(folder) {
            Ok(environment) => return Ok(environment),
            Err(error @ LibiglError::NotOwn { .. }) => return Err(error),
            Err(_) => {}
        }
        refuse_foreign(folder)?;
        let lock = lock(folder)?;
        // Another process may have made it while this one waited.
        let environment = Environment::finished(folder).or_else(|_| {
            make(settings)?;
            Environment::finished(folder)
        })?;
        drop(lock);
        Ok(environment)
    }

    /// Whether [`Environment::with`] returns at once, with no environment to create.
    pub fn is_ready(settings: &Settings) -> bool {
        settings.interpreter.is_some() || Environment::finished(&settings.folder).is_ok()
    }

    /// Returns the environment in `folder` if it is complete and has the pinned versions. The
    /// interpreter is run to see this, because the Python that created the environment may have
    /// been removed or replaced.
    fn finished(folder: &Path) -> Result<Environment, LibiglError> {
        let stale = || LibiglError::Stale { folder: folder.to_path_buf() };
        ownership::check(folder)?;
        if fs::read(folder.join(STAMP)).ok().as_deref() != Some(REQUIREMENTS.as_bytes()) {
            return Err(stale());
        }
        let python = executable(folder);
        let versions = interpreter::versions(&python, true)?;
        if versions.libigl != VERSION {
            return Err(stale());
        }
        Ok(Environment { python, versions, isolated: true })
    }

    /// Returns a command that runs this interpreter.
    pub(super) fn command(&self) -> Command {
        interpreter::command(&self.python, self.isolated)
    }
}

fn executable(folder: &Path) -> PathBuf {
    if cfg!(windows) { folder.join("Scripts").join("python.exe") } else { folder.join("bin").join("python") }
}

/// Locks a file until it is dropped, after waiting for other holders. The system releases the lock
/// however its holder ends.
fn lock(folder: &Path) -> Result<File, LibiglError> {
    let mut name = folder.as_os_str().to_os_string();
    name.push(".lock");
    let path = PathBuf::from(name);
    if let Some(parent) = path.parent() {
        fs::create_dir_all(parent).map_err(at(parent))?;
    }
    let file = File::create(&path).map_err(at(&path))?;
    file.lock().map_err(at(&path))?;
    Ok(file)
}

fn make(settings: &Settings) -> Result<(), LibiglError> {
    let folder = &settings.folder;
    let base = interpreter::find(settings.maker.as_deref())?;
    clear(folder)?;
    fs::create_dir_all(folder).map_err(at(folder))?;
    ownership::close(folder)?;
    let marker = folder.join(MARKER);
    fs::write(&marker, REQUIREMENTS).map_err(at(&marker))?;

    let mut venv = interpreter::command(&base, true);
    run(venv.args(["-m", "venv"]).arg(folder)).map_err(|error| match error {
        LibiglError::Making { lines, .. } if lines.iter().any(|line| lacks_venv(line)) => {
            LibiglError::NoVenv { python: base.clone(), lines }
        }
        error => error,
    })?;
    let python = executable(folder);
    // Wheels only: from source it would take a C++ compiler and half an hour.
    let mut pip = interpreter::command(&python, true);
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-input"]);
    run(pip.args(["--require-hashes", "--only-binary", ":all:", "-r"]).arg(&marker))?;
    run(interpreter::command(&python, true).args(["-c", "import igl; igl.harmonic, igl.cotmatrix"]))?;

    let stamp = folder.join(STAMP);
    fs::write(&stamp, REQUIREMENTS).map_err(at(&stamp))
}

fn lacks_venv(line: &str) -> bool {
    line.contains("ensurepip") || line.contains("No module named venv")
}

/// Refuses folders that exist, are not empty, and were not created by riemap.
fn refuse_foreign(folder: &Path) -> Result<(), LibiglError> {
    let empty = fs::read_dir(folder).map_or(true, |mut entries| entries.next().is_none());
    if empty || folder.join(MARKER).is_file() {
        return Ok(());
    }
    Err(LibiglError::ForeignFolder { folder: folder.to_path_buf() })
}

/// Empties the folder. The stamp is removed first, so that the rest is not taken for an
/// environment.
fn clear(folder: &Path) -> Result<(), LibiglError> {
    refuse_foreign(folder)?;
    if !folder.exists() {
        return Ok(());
    }
    let _ = fs::remove_file(folder.join(STAMP));
    // The marker stays, or an interruption here would leave a folder that is not known as ours.
    for entry in fs::read_dir(folder).map_err(at(folder))? {
        let path = entry.map_err(at(folder))?.path();
        if path.file_name().is_some_and(|name| name == MARKER) {
            continue;
        }
        if path.is_dir() && !path.is_symlink() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) }
            .map_err(at(&path))?;
    }
    Ok(())
}

fn run(command: &mut Command) -> Result<(), LibiglError> {
    let (status, lines) = match command.output() {
        Ok(output) if output.status.success() => return Ok(()),
        Ok(output) => (output.status.to_string(), interpreter::last_lines(&output)),
        Err(error) => ("it did not start".to_string(), vec![error.to_string()]),
    };
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    let words: Vec<_> = words.map(|word| word.to_string_lossy()).collect();
    Err(LibiglError::Making { command: words.join(" "), status, lines })
}

fn at(path: &Path) -> impl Fn(std::io::Error) -> LibiglError {
    let path = path.to_path_buf();
    move |source| LibiglError::Io { path: path.clone(), source }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_pinned_version_is_the_one_installed() {
        assert!(REQUIREMENTS.lines().any(|line| line.starts_with(&format!("libigl=={VERSION} "))));
    }
}
