//! The interpreter that runs the peers, and what it has.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use super::{BenchError, Contestant, Program};
use crate::app::compare::libigl::{self, Environment, Settings, program};

const SCRIPT: &str = include_str!("peers.py");

/// What is added to libigl's environment, with the arguments of pip: pinned, and left out where it cannot be had.
const EXTRAS: &[(&str, &[&[&str]])] = &[
    ("pymeshlab", &[&["--only-binary", ":all:", "pymeshlab==2025.7.post1"]]),
    (
        "scikit-sparse",
        &[
            &["--only-binary", ":all:", "Cython==3.3.1", "setuptools==80.9.0", "wheel==0.48.0", "packaging==26.4"],
            // From source, with the system's CHOLMOD.
            &["--no-build-isolation", "--no-deps", "scikit-sparse==0.4.16"],
        ],
    ),
];

/// Lines of a failed command that are worth showing.
const LINES: usize = 6;

/// Every library of linear algebra that a peer may bring is told to take one thread.
const ONE_THREAD: [&str; 5] =
    ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "BLIS_NUM_THREADS", "VECLIB_MAXIMUM_THREADS"];

/// A Python interpreter with some of the peers.
#[derive(Clone, Debug)]
pub struct Peers {
    python: PathBuf,
    isolated: bool,
    /// Of the interpreter and of the packages that it has.
    pub versions: BTreeMap<String, String>,
}

impl Peers {
    /// Those of an interpreter of the user's own.
    ///
    /// # Errors
    /// It does not run, or is no Python 3.
    pub fn of(python: &Path) -> Result<Peers, BenchError> {
        Peers::found(program(python), false)
    }

    /// Those of an environment of our own beside that of [`crate::app::compare::libigl`], made on first use: from the network, about a minute.
    /// `say` hears of packages that cannot be had.
    ///
    /// # Errors
    /// It cannot be made.
    pub fn ensure(settings: &Settings, say: &mut dyn FnMut(String)) -> Result<Peers, BenchError> {
        let settings = Peers::settings(settings);
        if let Some(python) = &settings.interpreter {
            return Peers::of(python);
        }
        let environment = Environment::with(&settings)
            .map_err(|error| BenchError::Python { python: settings.folder.clone(), reason: error.to_string() })?;
        let mut peers = Peers::found(environment.python, true)?;
        for (package, steps) in EXTRAS {
            if peers.versions.contains_key(*package) {
                continue;
            }
            let failed = steps.iter().find_map(|arguments| peers.install(arguments).err());
            match failed {
                Some(reason) => say(format!("{package} cannot be installed: {reason}")),
                None => peers = Peers::found(peers.python, true)?,
            }
        }
        Ok(peers)
    }

    /// Where [`Peers::ensure`] has its environment.
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

    fn install(&self, arguments: &[&str]) -> Result<(), String> {
        let mut pip = libigl::command(&self.python, true);
        pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-input"]).args(arguments);
        let output = pip.output().map_err(|error| error.to_string())?;
        match output.status.success() {
            true => Ok(()),
            false => Err(last_words(&String::from_utf8_lossy(&output.stderr))),
        }
    }

    /// `peers.py` with these arguments.
    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = libigl::command(&self.python, self.isolated);
        command.args(["-c", SCRIPT]).args(arguments);
        one_thread(&mut command);
        command
    }
}

/// Has every library of linear algebra take one thread.
pub(super) fn one_thread(command: &mut Command) {
    command.envs(ONE_THREAD.map(|name| (name, "1")));
}

/// What a contestant lacks, with what makes it available; `None` if it can run.
pub(super) fn lacks(peers: Option<&Peers>, contestant: &Contestant) -> Option<(&'static str, String)> {
    let Program::Peer(packages) = contestant.program else {
        return None;
    };
    let missing = packages.iter().find(|p| !peers.is_some_and(|peers| peers.versions.contains_key(p.name)))?;
    let into = peers.map(|peers| format!(" (into {})", peers.python.display())).unwrap_or_default();
    Some((missing.name, format!("{}{into}", missing.install)))
}

/// The end of what a process said, on one line.
pub(super) fn last_words(text: &str) -> String {
    let lines: Vec<&str> = text.lines().map(str::trim).filter(|line| !line.is_empty()).collect();
    lines[lines.len().saturating_sub(LINES)..].join(" / ")
}
