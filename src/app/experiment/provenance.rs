use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::ResultsError;
use super::files::lock;
use super::inside::inside;
use super::repository::revision;
use crate::io::atomically;

/// The file, below the folder of results.
const FILE: &str = "provenance.json";

/// The program and the machine that made the records of a folder of results: `provenance.json`. It
/// is written only where records change, so that the same program leaves the folder as it was.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Provenance {
    /// Version of Riemap.
    pub riemap: String,
    /// Git revision of the program that changed a record last.
    pub revision: Option<String>,
    /// Processor and system of that program, such as `x86_64-v3 linux`. Floating-point numbers are
    /// the same bit for bit only on the same platform.
    pub platform: String,
    /// Versions of public files and of other programs that took part.
    pub versions: BTreeMap<String, String>,
}

impl Provenance {
    /// The provenance of a folder of results; `None` where there is none.
    pub fn read(results: &Path) -> Option<Provenance> {
        serde_json::from_str(&fs::read_to_string(results.join(FILE)).ok()?).ok()
    }

    /// Writes this program, its platform, and `versions` beside those that are there.
    pub(super) fn update(results: &Path, versions: BTreeMap<String, String>) -> Result<(), ResultsError> {
        let path = inside(results, FILE)?;
        let _lock = lock(results);
        let former = Provenance::read(results);
        let mut provenance = Provenance {
            riemap: env!("CARGO_PKG_VERSION").to_owned(),
            revision: revision(),
            platform: platform(),
            versions: former.clone().unwrap_or_default().versions,
        };
        provenance.versions.extend(versions);
        if former.as_ref() != Some(&provenance) {
            let json = serde_json::to_string_pretty(&provenance)?;
            atomically(&path, |out| writeln!(out, "{json}"))?;
        }
        Ok(())
    }
}

/// The platform, as far as it decides how floating-point numbers are rounded: of x86-64 also the
/// level of its vector instructions, on which the order of sums depends.
fn platform() -> String {
    use std::env::consts::{ARCH, OS};
    format!("{ARCH}{} {OS}", level())
}

#[cfg(target_arch = "x86_64")]
fn level() -> &'static str {
    match () {
        () if is_x86_feature_detected!("avx512f") => "-v4",
        () if is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma") => "-v3",
        () => "",
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn level() -> &'static str {
    ""
}
