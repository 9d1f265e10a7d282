//! The interpreter that runs the peers, and its packages.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

use tempfile::NamedTempFile;

use super::{BenchError, Contestant, Program};
use crate::app::compare::libigl::{self, Environment, Settings, program};

const SCRIPT: &str = include_str!("peers.py");

/// A package that is added to libigl's environment.
struct Extra {
    name: &'static str,
    /// Files of requirements with hashes, installed one after the other with these further
    /// arguments of pip.
    steps: &'static [(&'static str, &'static [&'static str])],
    /// Whether it is compiled with libraries of the system, and therefore installed only on
    /// request.
    from_source: bool,
}

/// All packages. One that cannot be installed is left out.
const EXTRAS: &[Extra] = &[
    Extra {
        name: "pymeshlab",
        steps: &[(include_str!("pymeshlab.txt"), &["--only-binary", ":all:"])],
        from_source: false,
    },
    Extra {
        name: "scikit-sparse",
        steps: &[
            (include_str!("scikit-sparse-build.txt"), &["--only-binary", ":all:"]),
            // From source, with the system's CHOLMOD.
            (include_str!("scikit-sparse.txt"), &["--no-build-isolation", "--no-deps"]),
        ],
        from_source: true,
    },
];

/// The program of Boundary First Flattening.
const BFF: &str = "bff-command-line";

/// Number of lines of a failed command that are shown.
const LINES: usize = 6;

/// Variables that limit every library of linear algebra to one thread.
const ONE_THREAD: [&str; 5] =
    ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"];

/// A Python interpreter with some of the peers.
#[derive(Clone, Debug)]
pub struct Peers {
    python: PathBuf,
    isolated: bool,
    /// Versions of the interpreter and of its packages.
    pub versions: BTreeMap<String, String>,
}

impl Peers {
    /// Returns the peers of an interpreter that the user named.
    ///
    /// # Errors
    /// The interpreter does not run, or is not a Python 3.
    pub fn of(python: &Path) -> Result<Peers, BenchError> {
        Peers::found(program(python), false)
    }

    /// Returns the peers of our own environment, beside that of [`crate::app::compare::libigl`]. It
    /// is created on first use, from the network in about a minute. `build` includes packages that
    /// are compiled from source; `say` is called with packages that cannot be installed.
    ///
    /// # Errors
    /// The environment cannot be created.
    pub fn ensure(settings: &Settings, build: bool, say: &mut dyn FnMut(String)) -> Result<Peers, BenchError> {
        let settings = Peers::settings(settings);
        if let Some(python) = &settings.interpreter {
            return Peers::of(python);
        }
        let environment = Environment::with(&settings)
            .map_err(|error| BenchError::Python { python: settings.folder.clone(), reason: error.to_string() })?;
        let mut peers = Peers::found(environment.python, true)?;
        for Extra { name, steps, .. } in EXTRAS.iter().filter(|extra| build || !extra.from_source) {
            if peers.versions.contains_key(*name) {
                continue;
            }
            let mut installed = steps.iter().map(|(file, arguments)| peers.install(file, arguments));
            let failed = installed.find_map(Result::err);
            match failed {
                Some(reason) => say(format!("{name} cannot be installed: {reason}")),
                None => peers = Peers::found(peers.python, true)?,
            }
        }
        Ok(peers)
    }

    /// Returns the folder of the environment of [`Peers::ensure`].
    pub fn settings(settings: &Settings) -> Settings {
        let mut folder = settings.folder.clone().into_os_string();
        folder.push("-bench");
        Settings { folder: folder.into(), ..settings.clone() }
    }

    fn found(python: PathBuf, isolated: bool) -> Result<Peers, BenchError> {
        let mut peers = Peers { python, isolated, versions: BTreeMap::new() };
        let output = peers.command(&["versions"]).output();
        let refuse = |reason: String| BenchError::Python { python: peers.python.clone(), reason };
        let output = output.map_err(|error| refuse(error.to_string()))?;
        let said = String::from_utf8_lossy(&output.stdout);
        match serde_json::from_str(&said) {
            Ok(versions) if output.status.success() => peers.versions = versions,
            _ => {
                let words = last_words(&format!("{said}\n{}", String::from_utf8_lossy(&output.stderr)));
                return Err(refuse(format!("it ended with {} and said `{words}`", output.status)));
            }
        }
        Ok(peers)
    }

    /// Installs requirements whose hashes pip checks.
    fn install(&self, requirements: &str, arguments: &[&str]) -> Result<(), String> {
        let mut file = NamedTempFile::new().map_err(|error| error.to_string())?;
        file.write_all(requirements.as_bytes()).map_err(|error| error.to_string())?;
        let mut pip = libigl::command(&self.python, true);
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-input"]);
        pip.arg("--require-hashes").args(arguments).arg("-r").arg(file.path());
        let output = pip.output().map_err(|error| error.to_string())?;
        match output.status.success() {
            true => Ok(()),
            false => Err(last_words(&String::from_utf8_lossy(&output.stderr))),
        }
    }

    /// Returns a command that runs `peers.py` with these arguments.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = libigl::command(&self.python, self.isolated);
        command.args(["-c", SCRIPT]).args(arguments);
        one_thread(&mut command);
        command
    }
}

/// Limits every library of linear algebra to one thread.
pub(super) fn one_thread(command: &mut Command) {
    command.envs(ONE_THREAD.map(|name| (name, "1")));
}

/// Returns the package or program that a contestant lacks, and how to install it; `None` if it can
/// run.
pub(super) fn lacks(
    peers: Option<&Peers>,
    bff: Option<&Path>,
    contestant: &Contestant,
) -> Option<(&'static str, String)> {
    let packages = match contestant.program {
        Program::Riemap(_) => return None,
        Program::Bff(_) if bff.is_some() => return None,
        Program::Bff(_) => return Some((BFF, "build it and name it with --bff".to_owned())),
        Program::Peer(packages) => packages,
    };
    let missing = packages.iter().find(|p| !peers.is_some_and(|peers| peers.versions.contains_key(p.name)))?;
    let into = peers.map(|peers| format!(" (into {})", peers.python.display())).unwrap_or_default();
    Some((missing.name, format!("{}{into}", missing.install)))
}

/// Returns the end of the output of a process on one line.
pub(super) fn last_words(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    lines[lines.len().saturating_sub(LINES)..].join(" / ")
}
