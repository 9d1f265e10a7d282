use std::fs;

use riemap::app::experiment::remove_stale;

use super::shared::*;

#[test]
fn records_and_pictures_of_runs_that_a_config_no_longer_has_are_removed() {
    let results = folder();
    batch(&[load("study", &pictured())], results.path(), &How::default());
    fs::write(results.path().join("study/notes.json"), "{}").unwrap();
    let shorter = load("study", &pictured().replace("[4, 5, 6, 7]", "[4, 6]"));
    let before = contents_without_notes(results.path());
    let removed = remove_stale(&shorter, results.path()).unwrap();
    assert_eq!(removed.len(), 4, "{removed:?}");
    let after = contents_without_notes(results.path());
    assert_eq!(before.len() - after.len(), 4 + 8, "records and two pictures each");
    assert!(after.keys().all(|path| !path.to_string_lossy().contains("n=5")));
    assert!(results.path().join("study/notes.json").is_file(), "is no record");
    assert!(remove_stale(&shorter, results.path()).unwrap().is_empty());
    let full = format!("{}[full]\n\"surface.parameters.n\" = [6]\n", STUDY.replace("[4, 5, 6, 7]", "[4]"));
    assert!(remove_stale(&load("study", &full), results.path()).unwrap().is_empty(), "long runs are not lost");
    fs::remove_file(results.path().join("study/notes.json")).unwrap();
}

fn contents_without_notes(results: &std::path::Path) -> std::collections::BTreeMap<std::path::PathBuf, Vec<u8>> {
    let notes = results.join("study/notes.json");
    fs::rename(&notes, results.join("study/notes.md")).unwrap();
    let mut found = contents(results);
    found.retain(|path, _| path != std::path::Path::new("study/notes.md"));
    fs::rename(results.join("study/notes.md"), &notes).unwrap();
    found
}

#[test]
fn a_record_names_its_pictures_and_those_that_are_not_made_any_more_go() {
    let results = folder();
    let flat = "[surface]\nsource = \"plane?n=4\"\n[figures]\nflat = true\n";
    let record = batch(&[load("study", flat)], results.path(), &How::default()).made.remove(0);
    assert_eq!(record.pictures, ["study.png", "study.svg"]);
    let figures = results.path().join("figures");
    assert!(record.pictures.iter().all(|name| figures.join(name).is_file()));
    fs::write(figures.join("mine.png"), "x").unwrap();
    batch(&[load("study", &flat.replace("true", "false"))], results.path(), &How::default());
    let left: Vec<_> = figures.read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(left, ["mine.png"]);
}

#[test]
fn a_record_cannot_name_a_file_outside_of_the_figures() {
    let results = folder();
    let flat = "[surface]\nsource = \"plane?n=4\"\n[figures]\nflat = true\n";
    let config = [load("study", flat)];
    batch(&config, results.path(), &How::default());
    let path = results.path().join("study/run.json");
    let outside = results.path().join("precious.txt");
    fs::write(&outside, "x").unwrap();
    let damaged = fs::read_to_string(&path).unwrap().replace("study.svg", "../precious.txt");
    fs::write(&path, damaged).unwrap();
    batch(&config, results.path(), &How::default());
    assert!(outside.is_file());
}
