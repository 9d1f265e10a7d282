use std::ffi::OsString;
use std::fmt;
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

/// The prefix of a source that names a public file.
const PREFIX: &str = "data:";
/// The table of public files, as people read it.
static TABLE: &str = include_str!("../../../experiments/data.md");

/// Where a public file comes from: a row of `experiments/data.md`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Origin {
    /// The name in experiments, after `data:`.
    pub name: &'static str,
    /// Owner and name on GitHub.
    pub repository: &'static str,
    /// The path of the file in the repository.
    pub path: &'static str,
    /// SHA-256 of the file that the results were made with, hexadecimal.
    pub sha256: &'static str,
}

impl Origin {
    /// All rows of the table.
    pub fn all() -> impl Iterator<Item = Origin> {
        TABLE.lines().filter_map(Origin::parse)
    }

    /// A row of the table; `None` for headings and text.
    fn parse(line: &'static str) -> Option<Origin> {
        let cells: Vec<&str> = line.strip_prefix('|')?.strip_suffix('|')?.split('|').map(str::trim).collect();
        let [name, repository, path, sha256] = cells[..] else { return None };
        (sha256.len() == 64).then_some(Origin { name, repository, path, sha256 })
    }
}

/// The folders in which public files are looked up: only `named` if it is given (the variable
/// `RIEMAP_DATA`), else `../shared/data` and `data` of the working directory.
pub fn data_folders(named: Option<OsString>) -> Vec<PathBuf> {
    if let Some(folder) = named.filter(|name| !name.is_empty()) {
        return vec![folder.into()];
    }
    ["../shared/data", "data"].map(PathBuf::from).into()
}

/// A public file that an experiment names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DataFile {
    /// Its name, after `data:`.
    pub name: String,
    /// Its path; `None` if it is in none of the folders.
    pub path: Option<PathBuf>,
    /// The folders in which it was looked up.
    pub folders: Vec<PathBuf>,
}

impl DataFile {
    /// The public file that `source` names, looked up in `folders`; `None` for any other source.
    pub fn find(source: &str, folders: &[PathBuf]) -> Option<DataFile> {
        let name = source.strip_prefix(PREFIX)?;
        let path = folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file());
        Some(DataFile { name: name.to_owned(), path, folders: folders.to_vec() })
    }

    /// Its row in the table.
    pub fn origin(&self) -> Option<Origin> {
        Origin::all().find(|origin| origin.name == self.name)
    }

    /// Returns `sha256:…` of the file at `path`, with a note if the table has another hash.
    pub(super) fn version(&self, path: &Path) -> std::io::Result<String> {
        let found = sha256(path)?;
        Ok(match self.origin().filter(|origin| origin.sha256 != found) {
            Some(origin) => format!("sha256:{found}, not the sha256:{} of experiments/data.md", origin.sha256),
            None => format!("sha256:{found}"),
        })
    }
}

/// Says where a missing file comes from and where to put it.
impl fmt::Display for DataFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let folders: Vec<String> = self.folders.iter().map(|folder| folder.display().to_string()).collect();
        let folders = if folders.is_empty() { "any folder of data".to_owned() } else { folders.join(" or ") };
        write!(f, "{PREFIX}{} is not in {folders}; ", self.name)?;
        match self.origin() {
            Some(Origin { repository, path, .. }) => {
                write!(f, "get it from https://github.com/{repository}, file {path}, and put it there as {}", self.name)
            }
            None => write!(f, "put it there, or name one of experiments/data.md"),
        }
    }
}

/// SHA-256 of a file, hexadecimal.
pub(super) fn sha256(path: &Path) -> std::io::Result<String> {
    let digest = Sha256::digest(std::fs::read(path)?);
    Ok(digest.iter().map(|byte| format!("{byte:02x}")).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_of_the_table_is_read_and_is_a_hash() {
        let rows = TABLE.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| name")).count();
        let origins: Vec<Origin> = Origin::all().collect();
        assert!(rows > 0 && origins.len() == rows, "{rows} rows, {} read", origins.len());
        for origin in origins {
            let hexadecimal = origin.sha256.bytes().all(|b| b.is_ascii_digit() || (b'a'..=b'f').contains(&b));
            assert!(hexadecimal && !origin.path.is_empty() && origin.repository.contains('/'), "{origin:?}");
        }
    }

    #[test]
    fn a_file_of_another_hash_is_told_apart() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("tri")).unwrap();
        // The standard's example: FIPS 180-2, appendix B.1.
        std::fs::write(folder.path().join("tri/camelhead.off"), "abc").unwrap();
        let file = DataFile::find("data:tri/camelhead.off", &[folder.path().to_owned()]).unwrap();
        let version = file.version(file.path.as_ref().unwrap()).unwrap();
        let abc = "sha256:ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad, not the sha256:bdafbd63";
        assert!(version.starts_with(abc), "{version}");
    }
}
