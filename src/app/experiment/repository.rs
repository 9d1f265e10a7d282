use std::path::{Path, PathBuf};
use std::process::Command;

/// Where the program was built: Cargo's manifest.
const CLONE: &str = env!("CARGO_MANIFEST_DIR");

/// The folder that holds `experiments/` (and gets `results/`): the current one, else the clone that the program was built
/// in; `None` if neither has experiments.
pub fn find_experiments() -> Option<PathBuf> {
    [Path::new(""), Path::new(CLONE)].into_iter().find(|root| root.join("experiments").is_dir()).map(Path::to_owned)
}

/// The git revision of the clone that the program was built in, with `-dirty` if what the program is made of differs from
/// it; `None` where that is not to be had.
pub fn revision() -> Option<String> {
    // A tree without a repository of its own may lie inside somebody else's.
    if !Path::new(CLONE).join(".git").exists() {
        return None;
    }
    let revision = git(&["rev-parse", "--short=12", "HEAD"])?;
    let changes = git(&["status", "--porcelain", "--", "src", "Cargo.toml", "Cargo.lock"])?;
    Some(if changes.is_empty() { revision } else { format!("{revision}-dirty") })
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").arg("-C").arg(CLONE).args(arguments).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    output.status.success().then(|| text.trim().to_owned())
}
