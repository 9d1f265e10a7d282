use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf, absolute};

/// Which interpreter runs libigl, and where and by what its environment is made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// An interpreter that has libigl; the other fields then have no effect.
    pub interpreter: Option<PathBuf>,
    /// The folder of the environment. Beside it lies a file with the suffix `.lock`.
    pub folder: PathBuf,
    /// The interpreter that makes the environment; `None`: `python3`, then `python`.
    pub maker: Option<PathBuf>,
}

impl Settings {
    /// From the variables listed at [`crate::app::compare::libigl`].
    pub fn from_variables() -> Settings {
        let variable = |name: &str| env::var_os(name).filter(|value| !value.is_empty());
        Settings {
            interpreter: variable("RIEMAP_PYTHON").map(program),
            folder: variable("RIEMAP_PYTHON_ENV")
                .map(|folder| whole(folder.as_ref()))
                .unwrap_or_else(|| target(variable("CARGO_TARGET_DIR")).join("riemap-python").join("libigl")),
            maker: variable("PYTHON").map(program),
        }
    }

    /// The default choice of interpreter with the environment in `folder`.
    pub fn in_folder(folder: &Path) -> Settings {
        Settings { interpreter: None, folder: whole(folder), maker: None }
    }
}

/// Cargo's folder for what is made: the variable, else the folder `target` the running program lies in, else `./target`.
fn target(variable: Option<OsString>) -> PathBuf {
    if let Some(folder) = variable {
        return whole(folder.as_ref());
    }
    let executable = env::current_exe().unwrap_or_default();
    let enclosing = executable.ancestors().find(|folder| folder.file_name().is_some_and(|name| name == "target"));
    enclosing.map_or_else(|| whole(Path::new("target")), Path::to_path_buf)
}

/// A bare name is looked up in `PATH`; a path is made absolute, for calls run in a temporary folder.
pub(crate) fn program(name: impl Into<PathBuf>) -> PathBuf {
    let path = name.into();
    if path.components().count() > 1 { whole(&path) } else { path }
}

fn whole(path: &Path) -> PathBuf {
    absolute(path).unwrap_or_else(|_| path.to_path_buf())
}
