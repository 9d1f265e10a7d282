use std::fs;
use std::num::NonZeroUsize;

use riemap::app::experiment::{Batch, Event, Scratch, Shard, remove_stale};

use super::shared::*;

#[test]
fn records_and_pictures_of_runs_that_a_config_no_longer_has_are_removed() {
    let results = folder();
    batch(&[load("study", &pictured())], results.path(), &How::default());
    let shorter = load("study", &pictured().replace("[4, 5, 6, 7]", "[4, 6]"));
    let before = contents(results.path());
    let removed = remove_stale(&shorter, results.path()).unwrap();
    assert_eq!(removed, ["mesh=delaunay,n=5", "mesh=delaunay,n=7", "mesh=quad,n=5", "mesh=quad,n=7"]);
    let after = contents(results.path());
    assert_eq!(before.len() - after.len(), 8, "two pictures each");
    assert_eq!(recorded(results.path(), "study").len(), 4);
    assert!(remove_stale(&shorter, results.path()).unwrap().is_empty());
    let full = format!("{}[full]\n\"surface.parameters.n\" = [6]\n", STUDY.replace("[4, 5, 6, 7]", "[4]"));
    assert!(remove_stale(&load("study", &full), results.path()).unwrap().is_empty(), "long runs are not lost");
}

#[test]
fn a_line_that_is_no_record_is_an_error_with_its_number_and_nothing_is_lost() {
    let results = folder();
    let path = results.path().join("study/records.jsonl");
    fs::create_dir(results.path().join("study")).unwrap();
    fs::write(&path, "<<<<<<< HEAD\n").unwrap();
    let config = [load("study", STUDY)];
    let scratch = &Scratch::new(results.path(), "program");
    let mut errors = Vec::new();
    Batch { configs: &config, shard: Shard::ALL, threads: NonZeroUsize::MIN, apart: None, scratch }
        .run(&|| false, &mut |event| {
            if let Event::Summed { summary: Err(error), .. } = event {
                errors.push(error.to_string());
            }
        })
        .unwrap();
    assert!(errors.len() == 1 && errors[0].contains("records.jsonl:1: this is no record"), "{errors:?}");
    assert_eq!(fs::read_to_string(&path).unwrap(), "<<<<<<< HEAD\n");
    fs::remove_file(&path).unwrap();
    let told = batch(&config, results.path(), &How::default());
    assert_eq!((told.finished_before.len(), told.made.len()), (8, 0), "the runs are not made again");
    assert_eq!(recorded(results.path(), "study").len(), 8);
}

#[test]
fn a_second_batch_of_the_same_program_leaves_every_file_but_timings_as_it_was() {
    let results = folder();
    let study = [load("study", &pictured())];
    batch(&study, results.path(), &How::default());
    let provenance = results.path().join("provenance.json");
    let made_by_another = fs::read_to_string(&provenance).unwrap().replace("\"riemap\": \"", "\"riemap\": \"9.");
    fs::write(&provenance, made_by_another).unwrap();
    let first = contents(results.path());
    batch(&study, results.path(), &How { threads: 2, ..How::default() });
    assert!(contents(results.path()) == first, "the provenance, too, for no record has changed");
    let unit = pictured().replace("[sweep]", "[map]\nweight = \"unit\"\n[sweep]");
    batch(&[load("study", &unit)], results.path(), &How::default());
    assert!(!fs::read_to_string(&provenance).unwrap().contains("\"9."), "records have changed");
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
    let path = results.path().join("study/records.jsonl");
    let outside = results.path().join("precious.txt");
    fs::write(&outside, "x").unwrap();
    let damaged = fs::read_to_string(&path).unwrap().replace("study.svg", "../precious.txt");
    fs::write(&path, damaged).unwrap();
    batch(&config, results.path(), &How::default());
    assert!(outside.is_file());
}
