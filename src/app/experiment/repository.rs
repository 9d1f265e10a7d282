use std::path::Path;
use std::process::Command;

/// The folder in which the program was compiled.
const CLONE: &str = env!("CARGO_MANIFEST_DIR");

/// Whether the working directory holds `experiments/`. Nothing is looked for, read or written in
/// the folder that the program was compiled in.
pub fn has_experiments() -> bool {
    Path::new(EXPERIMENTS).is_dir()
}

/// The folder of experiments, below the working directory.
pub const EXPERIMENTS: &str = "experiments";

/// The git revision of the clone in which the program was compiled, with `-dirty` if its sources
/// differ from it; `None` if it cannot be determined.
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
