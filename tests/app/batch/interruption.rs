use std::fs;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};

use riemap::app::experiment::{Outcome, RunError, Scratch, Settings};

use super::shared::*;

#[test]
fn an_interrupted_batch_goes_on_where_it_was_and_ends_with_the_same_results() {
    let configs = [load("a", STUDY), load("b", &STUDY.replace("plane", "sphere"))];
    let (results, whole) = (folder(), folder());
    let first = batch(&configs, results.path(), &How { stop_after: 11, ..How::default() });
    assert_eq!(first.made.len(), 11);
    assert_eq!(first.summed, ["a"]);
    let second = batch(&configs, results.path(), &How::default());
    assert_eq!(second.finished_before.len(), first.made.len());
    assert_eq!(second.made.len(), 16 - first.made.len());
    assert_eq!(second.summed, ["a", "b"]);
    batch(&configs, whole.path(), &How::default());
    assert!(contents(results.path()) == contents(whole.path()), "or a scratch record remains");
}

#[test]
fn what_a_complete_batch_or_another_program_left_is_made_again() {
    let configs = [load("study", STUDY)];
    let results = folder();
    let how = How::default();
    batch(&configs, results.path(), &how);
    assert_eq!(batch(&configs, results.path(), &how).made.len(), 8, "records of a complete batch are no reason");
    fs::remove_dir_all(results.path()).unwrap();
    assert_eq!(batch(&configs, results.path(), &How { stop_after: 3, ..how }).made.len(), 3);
    let how = How { program: "another", ..How::default() };
    assert_eq!(batch(&configs, results.path(), &how).made.len(), 8);
    assert!(!results.path().join(".unfinished").exists(), "records of older programs go as well");
}

#[test]
fn records_of_other_settings_and_failures_are_no_reason_to_skip_a_run() {
    let text = "[surface]\nsource = \"plane\"\n[sweep]\n\"surface.parameters.n\" = [4, 5, 6, 7]\n";
    let mut configs = [load("study", text)];
    configs[0].runs[0].task = Box::new(Made(|| Err(RunError::Panic { message: "no network".to_owned() })));
    let results = folder();
    let how = How::default;
    let first = batch(&configs, results.path(), &How { stop_after: 3, ..how() });
    assert_eq!(first.made[0].outcome, Outcome::Failed);
    let sets = vec!["map.weight=unit".to_owned()];
    let other = [load_with("study", text, &Settings { sets, ..Settings::default() }).unwrap()];
    let second = batch(&other, results.path(), &How { stop_after: 0, ..how() });
    assert!(second.finished_before.is_empty());
    let third = batch(&[load("study", text)], results.path(), &how());
    assert_eq!((first.made.len(), third.finished_before.len()), (3, 2));
    assert!(third.made.iter().any(|record| record.run == "n=4" && record.outcome == Outcome::Done));
}

#[test]
fn what_fails_because_of_the_interruption_leaves_no_record() {
    use std::sync::atomic::{AtomicBool, Ordering};
    static STOPPED: AtomicBool = AtomicBool::new(false);
    let mut configs = [load("study", STUDY)];
    // As a program that a run has called dies of the same Ctrl-C.
    configs[0].runs[1].task = Box::new(Made(|| {
        STOPPED.store(true, Ordering::SeqCst);
        Err(RunError::Panic { message: "killed".to_owned() })
    }));
    let results = folder();
    let (threads, scratch) = (std::num::NonZeroUsize::MIN, &Scratch::new(results.path(), "program"));
    let shard = riemap::app::experiment::Shard::ALL;
    let batch = riemap::app::experiment::Batch { configs: &configs, shard, threads, apart: None, scratch };
    batch.run(&|| STOPPED.load(Ordering::SeqCst), &mut |_| {}).unwrap();
    let scratch = results.path().join(".unfinished/program/study");
    let files: Vec<PathBuf> = fs::read_dir(&scratch).unwrap().map(|e| e.unwrap().path()).collect();
    assert_eq!(files, [scratch.join("mesh=quad,n=4.json")]);
}

// ---- The program, killed -------------------------------------------------------------------------------------------

/// Five small runs, then `more` that take a while.
fn long(more: usize) -> String {
    let sizes: Vec<String> = (4..9).chain(70..70 + more).map(|n| n.to_string()).collect();
    format!(
        "[surface]\nsource = \"sphere?mesh=delaunay\"\n[map]\nboundary = \"circle\"\n[sweep]\n\
         \"surface.parameters.n\" = [{}]\n",
        sizes.join(", ")
    )
}

/// The program at work on `study.toml`, when its third run has ended.
fn begun(folder: &Path) -> Child {
    let mut child = riemap(folder, &[]).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let mut out = BufReader::new(child.stdout.take().unwrap());
    let mut line = String::new();
    while !line.starts_with("[3/") {
        line.clear();
        assert!(out.read_line(&mut line).unwrap() > 0, "ended before its third run");
    }
    child.stdout = Some(out.into_inner());
    child
}

fn riemap(folder: &Path, options: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_riemap"));
    command.current_dir(folder).args(["run", "study.toml"]).args(options);
    command
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn finish(folder: &Path, options: &[&str]) -> String {
    let Output { status, stdout, stderr } = riemap(folder, options).output().unwrap();
    assert!(status.success(), "{}", text(&stderr));
    text(&stdout)
}

#[test]
fn a_killed_program_goes_on_and_ends_with_the_results_of_one_that_was_not() {
    let (killed, whole) = (folder(), folder());
    for folder in [&killed, &whole] {
        fs::write(folder.path().join("study.toml"), long(12)).unwrap();
    }
    let mut child = begun(killed.path());
    child.kill().unwrap();
    child.wait().unwrap();
    let out = finish(killed.path(), &[]);
    assert!(out.contains("finished before (--fresh: again)") && out.contains("17 runs"), "{out}");
    let made = out.lines().filter(|line| line.starts_with('[')).count();
    assert!(made <= 17 - 3, "made again: {out}");
    finish(whole.path(), &[]);
    let [killed, whole] = [killed, whole].map(|folder| contents(&folder.path().join("results")));
    assert!(killed == whole);
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_with_130_and_says_how_to_go_on_and_fresh_starts_again() {
    let folder = folder();
    // So many that the signal comes before the last is begun, however busy the machine.
    fs::write(folder.path().join("study.toml"), long(95)).unwrap();
    let child = begun(folder.path());
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let Output { status, stdout, stderr } = child.wait_with_output().unwrap();
    assert_eq!(status.code(), Some(130), "{}", text(&stdout));
    assert!(text(&stdout).contains("in progress"), "{}", text(&stdout));
    let message = text(&stderr);
    assert!(message.contains("of 100 runs are finished; the same command goes on from there"), "{message}");
    let shard = ["--shard", "1/50"];
    let out = finish(folder.path(), &[&shard[..], &["--fresh"]].concat());
    assert!(out.contains("[2/2]") && out.contains("n=4") && !out.contains("finished before"), "{out}");
}
