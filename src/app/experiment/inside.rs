use std::path::{Component, Path, PathBuf};

use super::ResultsError;

/// Joins `relative` to the folder of results and fails where the path leads out of it: by `..`, by
/// an absolute part, or through a link, dangling ones included. Everything that experiments write
/// or remove goes through here.
///
/// # Errors
/// [`ResultsError::Outside`].
pub(super) fn inside(results: &Path, relative: impl AsRef<Path>) -> Result<PathBuf, ResultsError> {
    let mut path = results.to_owned();
    for part in relative.as_ref().components() {
        path.push(part);
        let outside = || ResultsError::Outside { path: path.clone(), results: results.to_owned() };
        if !matches!(part, Component::Normal(_)) {
            return Err(outside());
        }
        if path.is_symlink() {
            let real = path.canonicalize().map_err(|_| outside())?;
            let root = results.canonicalize().map_err(|_| outside())?;
            if !real.starts_with(root) {
                return Err(outside());
            }
        }
    }
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_with_parents_or_of_its_own_root_is_refused() {
        for relative in ["../x", "a/../../x", "/etc/x", ""] {
            assert_eq!(inside(Path::new("results"), relative).is_ok(), relative.is_empty(), "{relative}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn links_out_of_the_folder_are_refused_and_links_within_are_not() {
        use std::os::unix::fs::symlink;
        let (results, other) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
        std::fs::create_dir(results.path().join("real")).unwrap();
        symlink(results.path().join("real"), results.path().join("within")).unwrap();
        symlink(other.path(), results.path().join("out")).unwrap();
        symlink("nowhere", results.path().join("dangling")).unwrap();
        assert!(inside(results.path(), "within/a.json").is_ok());
        assert!(inside(results.path(), "out/a.json").is_err());
        assert!(inside(results.path(), "out").is_err());
        assert!(inside(results.path(), "dangling").is_err());
    }
}
