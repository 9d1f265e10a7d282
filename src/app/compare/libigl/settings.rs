use std::env;
use std::ffi::OsString;
use std::path::{Path, PathBuf, absolute};

/// The interpreter that runs libigl, or the folder of its environment and the interpreter that
/// creates it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Settings {
    /// An interpreter that has libigl; the other fields are then ignored.
    pub interpreter: Option<PathBuf>,
    /// The folder of the environment, beside which there is a file with the suffix `.lock`.
    pub folder: PathBuf,
    /// The interpreter that creates the environment; `None` means `python3`, then `python`.
    pub maker: Option<PathBuf>,
}

impl Settings {
    /// Reads the environment variables listed at [`crate::app::compare::libigl`].
    pub fn from_variables() -> Settings {
        let variable = |name: &str| env::var_os(name).filter(|value| !value.is_empty());
        let home = env::home_dir().unwrap_or_else(env::temp_dir);
        Settings {
            interpreter: variable("RIEMAP_PYTHON").map(program),
            folder: variable("RIEMAP_PYTHON_ENV")
                .map(|folder| whole(folder.as_ref()))
                .unwrap_or_else(|| user_cache(variable("XDG_CACHE_HOME"), home).join("riemap").join("libigl")),
            maker: variable("PYTHON").map(program),
        }
    }

    /// Returns the default interpreter with the environment in `folder`.
    pub fn in_folder(folder: &Path) -> Settings {
        Settings { interpreter: None, folder: whole(folder), maker: None }
    }
}

/// Returns the user's cache folder: `$XDG_CACHE_HOME` if it is an absolute path, as its
/// specification demands, otherwise `~/.cache`. A folder below the working directory is never used,
/// because its programs may be anybody's.
fn user_cache(variable: Option<OsString>, home: PathBuf) -> PathBuf {
    variable.map(PathBuf::from).filter(|folder| folder.is_absolute()).unwrap_or_else(|| home.join(".cache"))
}

/// Makes a path absolute, because calls run in a temporary folder. A bare name remains as it is and
/// is found in `PATH`.
pub(crate) fn program(name: impl Into<PathBuf>) -> PathBuf {
    let path = name.into();
    if path.components().count() > 1 { whole(&path) } else { path }
}

fn whole(path: &Path) -> PathBuf {
    absolute(path).unwrap_or_else(|_| path.to_path_buf())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn environments_are_never_looked_for_below_the_working_directory() {
        let folder = |variable: &str| user_cache(Some(variable.into()), "/home/u".into());
        let cache = env::temp_dir();
        assert_eq!(folder(&cache.to_string_lossy()), cache);
        assert_eq!(folder("target"), Path::new("/home/u/.cache"));
        assert_eq!(user_cache(None, "/home/u".into()), Path::new("/home/u/.cache"));
    }
}
