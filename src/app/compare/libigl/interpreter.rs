use super::LibiglError;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// Minor version of the oldest Python 3 for which `requirements.txt` has packages.
const OLDEST_MINOR: u32 = 9;

/// Number of lines of a command's output that are shown.
const LINES: usize = 12;

/// A program that prints the version, in the syntax of every Python.
const PYTHON_VERSION: &str = "import sys; print('%d.%d.%d' % tuple(sys.version_info[:3]))";

const PACKAGE_VERSIONS: &str = r#"
import importlib.metadata, importlib.util, json, sys
def version(*names):
    for name in names:
        try: return importlib.metadata.version(name)
        except importlib.metadata.PackageNotFoundError: pass
    return "unknown"
if importlib.util.find_spec("igl") is None: sys.exit("there is no module named igl")
print(json.dumps({"python": "%d.%d.%d" % sys.version_info[:3],
    "libigl": version("libigl", "igl"), "numpy": version("numpy"), "scipy": version("scipy")}))
"#;

/// Versions of the packages in a comparison; "unknown" if a package does not report one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Versions {
    /// Version of the interpreter.
    pub python: String,
    /// Version of libigl's Python package.
    pub libigl: String,
    /// Version of numpy.
    pub numpy: String,
    /// Version of scipy.
    pub scipy: String,
}

/// Returns the last lines of both output streams of a command.
pub(super) fn last_lines(output: &Output) -> Vec<String> {
    let text = [&output.stdout[..], b"\n", &output.stderr[..]].concat();
    let text = String::from_utf8_lossy(&text);
    let lines: Vec<&str> = text.lines().filter(|line| !line.trim().is_empty()).collect();
    lines[lines.len().saturating_sub(LINES)..].iter().map(|line| line.to_string()).collect()
}

/// Returns the versions of the packages in `python`; fails if it does not run or does not have
/// libigl.
pub(super) fn versions(python: &Path, isolated: bool) -> Result<Versions, LibiglError> {
    let refuse = |lines| LibiglError::Interpreter { python: python.to_path_buf(), lines };
    let output = command(python, isolated)
        .args(["-c", PACKAGE_VERSIONS])
        .output()
        .map_err(|error| refuse(vec![error.to_string()]))?;
    if !output.status.success() {
        return Err(refuse(last_lines(&output)));
    }
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap_or_default();
    let version = |name: &str| answer[name].as_str().map(str::to_string);
    match (version("python"), version("libigl"), version("numpy"), version("scipy")) {
        (Some(python), Some(libigl), Some(numpy), Some(scipy)) => Ok(Versions { python, libigl, numpy, scipy }),
        _ => Err(refuse(last_lines(&output))),
    }
}

/// Returns the first interpreter that is new enough: the named one, otherwise `python3` or
/// `python`.
pub(super) fn find(named: Option<&Path>) -> Result<PathBuf, LibiglError> {
    let candidates = match named {
        Some(python) => vec![python.to_path_buf()],
        None => vec![PathBuf::from("python3"), PathBuf::from("python")],
    };
    let mut tried = Vec::new();
    for python in candidates {
        let wrong = match command(&python, true).args(["-c", PYTHON_VERSION]).output() {
            Err(error) => error.to_string(),
            Ok(output) if !output.status.success() => last_lines(&output).join("; "),
            Ok(output) => {
                let version = String::from_utf8_lossy(&output.stdout).trim().to_string();
                if new_enough(&version) {
                    return Ok(python);
                }
                format!("version {version}")
            }
        };
        tried.push(format!("{}: {wrong}", python.display()));
    }
    Err(LibiglError::NoPython { minimum: OLDEST_MINOR, tried })
}

fn new_enough(version: &str) -> bool {
    let mut parts = version.split('.').map_while(|part| part.parse::<u32>().ok());
    match (parts.next(), parts.next()) {
        (Some(3), Some(minor)) => minor >= OLDEST_MINOR,
        _ => false,
    }
}

/// Returns a command that runs `python` without input. An isolated one ignores `PYTHONPATH`, the
/// user's packages and the current folder, which our own environment must not see, and an
/// interpreter of the user may need.
pub(crate) fn command(python: &Path, isolated: bool) -> Command {
    let mut command = Command::new(python);
    command.stdin(Stdio::null());
    if isolated {
        command.arg("-I");
    }
    command
}
