use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::shared::{folder, recorded};

const PLANE: &str = "[surface]\nsource = \"plane\"\n[sweep]\n\"surface.parameters.n\" = [4, 5]\n";
const ABSENT: &str = "[surface]\nsource = \"data:tri/camelhead.off\"\n";

/// Runs the program in a folder with experiments and no data.
fn riemap(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let program = Command::new(env!("CARGO_BIN_EXE_riemap"))
        .current_dir(folder)
        .env("RIEMAP_DATA", folder.join("no-data"))
        .args(arguments)
        .output();
    let Output { status, stdout, stderr } = program.unwrap();
    (status.code(), String::from_utf8(stdout).unwrap() + &String::from_utf8(stderr).unwrap())
}

fn clone_with(experiments: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = folder();
    fs::create_dir(folder.path().join("experiments")).unwrap();
    for (name, text) in experiments {
        fs::write(folder.path().join("experiments").join(name), text).unwrap();
    }
    folder
}

#[test]
fn reproduce_passes_over_what_has_no_data_and_run_refuses_it_with_the_same_advice() {
    let folder = clone_with(&[("plane.toml", PLANE), ("real.toml", ABSENT)]);
    let (code, text) = riemap(folder.path(), &["reproduce"]);
    assert_eq!(code, Some(0), "{text}");
    let advice = "get it from https://github.com/libigl/libigl-tutorial-data, file camelhead.off";
    assert!(text.contains("real passed over: ") && text.contains(advice), "{text}");
    assert!(text.contains("2 runs in ") && text.contains("2 done"), "{text}");
    assert!(!folder.path().join("results/real").exists());
    let (code, text) = riemap(folder.path(), &["run", "experiments/plane.toml", "experiments/real.toml"]);
    assert!(code == Some(1) && text.contains(advice) && text.contains("experiments/real.toml"), "{text}");
    assert!(!text.contains("[1/"), "something was run: {text}");
}

#[test]
fn reproduce_takes_settings_shards_and_full_runs_and_removes_what_is_stale() {
    let folder = clone_with(&[("plane.toml", &format!("{PLANE}[full]\n\"surface.parameters.n\" = [6]\n"))]);
    let records = || recorded(&folder.path().join("results"), "plane");
    assert_eq!(riemap(folder.path(), &["reproduce", "--shard", "2/2"]).0, Some(0));
    assert_eq!(records(), ["n=5"]);
    assert_eq!(riemap(folder.path(), &["reproduce", "--full", "plane"]).0, Some(0));
    assert_eq!(records(), ["n=4", "n=5", "n=6"]);
    let (code, text) = riemap(folder.path(), &["reproduce", "--set", "surface.parameters.n=7"]);
    assert!(code == Some(0) && !text.contains("removed"), "{text}");
    assert_eq!(records(), ["n=4", "n=5", "n=6", "run"]);
    let (code, text) = riemap(folder.path(), &["reproduce"]);
    assert!(code == Some(0) && text.contains("plane run removed: "), "{text}");
    assert_eq!(records(), ["n=4", "n=5", "n=6"]);
}

#[test]
fn what_is_not_as_expected_is_told_at_the_end_and_by_the_exit_code() {
    let refuted = format!("{PLANE}[expect]\n\"result.input.vertices\" = {{ max = 25 }}\n");
    let folder = clone_with(&[("plane.toml", &refuted), ("zebra.toml", PLANE)]);
    let (code, text) = riemap(folder.path(), &["reproduce"]);
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("4 runs in ") && text.contains("3 done, 1 refuted"), "{text}");
    assert!(text.contains("! plane n=5: refuted: `result.input.vertices` is 3"), "{text}");
    assert!(folder.path().join("results/zebra/table.md").is_file());
}
