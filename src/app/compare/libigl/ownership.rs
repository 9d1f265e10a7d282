use std::fs;
use std::io;
use std::path::Path;

use super::LibiglError;

/// Fails unless the folder of an environment and its programs belong to the user and cannot be
/// written by anybody else. A folder that does not exist is accepted, and created later.
///
/// # Errors
/// [`LibiglError::NotOwn`], [`LibiglError::Io`].
pub(super) fn check(folder: &Path) -> Result<(), LibiglError> {
    // The group matters for the folder alone, which then keeps it from what is inside: where every
    // user has a group of their own, Python makes what is inside writable for it.
    for (path, others) in [(folder.to_owned(), 0o022), (folder.join("bin"), 0o002), (folder.join("pyvenv.cfg"), 0o002)]
    {
        match fs::metadata(&path) {
            Ok(metadata) if is_own(&metadata, others) => {}
            Ok(_) => return Err(LibiglError::NotOwn { path }),
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            Err(source) => return Err(LibiglError::Io { path, source }),
        }
    }
    Ok(())
}

/// Removes the permissions of everybody else from the folder.
///
/// # Errors
/// [`LibiglError::Io`].
pub(super) fn close(folder: &Path) -> Result<(), LibiglError> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        let closed = fs::set_permissions(folder, fs::Permissions::from_mode(0o700));
        closed.map_err(|source| LibiglError::Io { path: folder.to_owned(), source })?;
    }
    Ok(())
}

#[cfg(unix)]
fn is_own(metadata: &fs::Metadata, others: u32) -> bool {
    use std::os::unix::fs::MetadataExt;
    metadata.uid() == nix::unistd::geteuid().as_raw() && metadata.mode() & others == 0
}

#[cfg(not(unix))]
fn is_own(_: &fs::Metadata, _: u32) -> bool {
    true
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::os::unix::fs::PermissionsExt;

    #[test]
    fn an_environment_that_others_can_write_to_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o770)).unwrap();
        assert!(check(folder.path()).is_err());
        close(folder.path()).unwrap();
        check(folder.path()).unwrap();
        let bin = folder.path().join("bin");
        fs::create_dir(&bin).unwrap();
        fs::set_permissions(&bin, fs::Permissions::from_mode(0o777)).unwrap();
        assert!(matches!(check(folder.path()), Err(LibiglError::NotOwn { path }) if path == bin));
    }
}
