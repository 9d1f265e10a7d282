//! Runs in processes of their own, with a time limit, over the meshes of a folder.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};
use std::thread::sleep;
use std::time::{Duration, Instant};

use riemap::app::experiment::{Outcome, Record, Settings};

use super::shared::{folder, load_with, names};

fn riemap(folder: &Path, arguments: &[&str], python: Option<&Path>) -> (Option<i32>, String) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_riemap"));
    program.current_dir(folder).args(arguments);
    if let Some(python) = python {
        program.env("RIEMAP_PYTHON", python);
    }
    let Output { status, stdout, stderr } = program.output().unwrap();
    (status.code(), String::from_utf8(stdout).unwrap() + &String::from_utf8(stderr).unwrap())
}

/// The record of the run whose name ends in `run`.
fn record(results: &Path, run: &str) -> Record {
    let text = fs::read_to_string(results.join("study/records.jsonl")).unwrap();
    let mut records = text.lines().map(|line| serde_json::from_str::<Record>(line).unwrap());
    records.find(|record| record.run.ends_with(run)).unwrap()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

#[test]
fn a_folder_takes_the_place_of_the_swept_sources() {
    let meshes = folder();
    for (name, text) in [("b.obj", SQUARE), ("a.OBJ", SQUARE), ("broken.off", "OFF\n1 1"), ("notes.txt", "no mesh")] {
        fs::write(meshes.path().join(name), text).unwrap();
    }
    fs::create_dir(meshes.path().join("more.obj")).unwrap();
    let work = folder();
    let study = "time-limit = 30\nmay-fail = true\n[surface]\nsource = \"plane\"\n[sweep]\n\"map.boundary\" = [\"free\"]\n\
        \"surface.source\" = [\"plane\", \"sphere\"]\n[table]\ncolumns = [[\"result.input.faces\", \"faces\"]]\n\
        [groups]\nby = [\"config.map.boundary\"]\ncolumns = [{ key = \"result.solver.valid\", take = \"count\", label = \"valid\" }]\n\
        [plots.circle]\ntitle = \"\"\nonly = { \"config.map.boundary\" = \"circle\" }\n\
        x = { key = \"result.input.faces\", label = \"\" }\ny = { label = \"\" }\n\
        series = [{ y = \"result.distortion.flipped\", label = \"\" }]\n";
    fs::write(work.path().join("study.toml"), study).unwrap();
    // A plot of maps that are not made is left out.
    let set = format!("folder={}", meshes.path().display());
    let (code, text) = riemap(work.path(), &["run", "study.toml", "--set", &set], None);
    // The broken one has a record, too, and is no reason to complain.
    assert_eq!(code, Some(0), "{text}");
    assert!(text.contains("3 runs in") && text.contains("2 done, 1 failed"), "{text}");
    let table = fs::read_to_string(work.path().join("results/study/table.md")).unwrap();
    assert!(table.contains("a.OBJ | 2 | done") && table.contains("b.obj | 2 | done"), "{table}");
    assert!(table.contains("broken.off") && table.contains("| failed: "), "{table}");
    assert!(table.contains("| free | 3 (1 failed) | 2 of 3 |"), "{table}");
    // The same within one process: the same numbers.
    let of = |results: &str| record(&work.path().join(results), "a.OBJ");
    let together = study.replace("time-limit = 30\n", "");
    fs::write(work.path().join("study.toml"), together).unwrap();
    assert_eq!(riemap(work.path(), &["run", "study.toml", "--set", &set, "--results", "again"], None).0, Some(0));
    assert!(of("results").same_numbers(&of("again")));
}

#[test]
fn what_is_no_folder_of_meshes_is_refused() {
    let empty = folder();
    for (given, reason) in [("nowhere", "No such file"), (empty.path().to_str().unwrap(), "no mesh files (.obj")] {
        let settings = Settings { sets: vec![format!("folder={given}")], ..Settings::default() };
        let error = load_with("study", "[surface]\nsource = \"plane\"\n", &settings).err().unwrap();
        assert!(error.contains("--set folder=") && error.contains(given) && error.contains(reason), "{error}");
    }
    let error =
        load_with("study", "time-limit = 0\n[surface]\nsource = \"plane\"\n", &Settings::default()).err().unwrap();
    assert!(error.contains("study.toml:1") && error.contains("above 0"), "{error}");
    // Without a sweep over sources the folder makes one.
    fs::write(empty.path().join("square.obj"), SQUARE).unwrap();
    let settings = Settings { sets: vec![format!("folder={}", empty.path().display())], ..Settings::default() };
    let config = load_with("study", "[surface]\nsource = \"plane\"\n", &settings).unwrap();
    assert!(names(&config).len() == 1 && names(&config)[0].ends_with("square.obj"), "{:?}", names(&config));
}

#[cfg(unix)]
#[test]
fn a_run_over_its_time_ends_with_all_that_it_has_called() {
    use std::os::unix::fs::PermissionsExt;
    let work = folder();
    // In place of Python: says who it is, and does not come to an end.
    let (python, pid) = (work.path().join("python"), work.path().join("pid"));
    fs::write(&python, format!("#!/bin/sh\necho $$ > {}\nexec sleep 600\n", pid.display())).unwrap();
    fs::set_permissions(&python, fs::Permissions::from_mode(0o755)).unwrap();
    let study = "kind = \"peer\"\ntime-limit = 1.5\n[surface]\nsource = \"plane?n=4&mesh=triangle\"\n[method]\n\
        name = \"riemap\"\n[sweep]\n\"method.name\" = [\"riemap\", \"libigl-harmonic\"]\n";
    fs::write(work.path().join("study.toml"), study).unwrap();
    let begun = Instant::now();
    let (code, text) = riemap(work.path(), &["run", "study.toml"], Some(&python));
    assert!(begun.elapsed() < Duration::from_secs(60), "it waited for the sleeper");
    assert_eq!(code, Some(1), "{text}");
    let failed = record(&work.path().join("results"), "name=libigl-harmonic");
    assert_eq!(failed.error.as_deref(), Some("over the time limit of 1.5 s"));
    assert_eq!(failed.outcome, Outcome::Failed);
    assert_eq!(record(&work.path().join("results"), "name=riemap").outcome, Outcome::Done);
    let pid = fs::read_to_string(pid).unwrap();
    let alive = || Command::new("kill").args(["-0", pid.trim()]).output().unwrap().status.success();
    // A killed process is gone as soon as whoever inherits it has looked at it.
    for _ in 0..100 {
        if !alive() {
            return;
        }
        sleep(Duration::from_millis(50));
    }
    panic!("process {pid} is still there");
}
