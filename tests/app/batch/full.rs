use std::fs;

use riemap::app::experiment::Settings;

use super::shared::*;

const FULL: &str = "[surface]\nsource = \"plane\"\n[sweep]\n\"surface.parameters.mesh\" = [\"quad\", \"triangle\"]\n\
    \"surface.parameters.n\" = [4, 5]\n[full]\n\"surface.parameters.n\" = [13]\n";

fn full() -> Settings {
    Settings { full: true, ..Settings::default() }
}

#[test]
fn full_runs_are_appended_to_the_sweep_where_they_are_asked_for() {
    let (usual, all) = (load("study", FULL), load_with("study", FULL, &full()).unwrap());
    assert_eq!(names(&usual), ["mesh=quad,n=4", "mesh=quad,n=5", "mesh=triangle,n=4", "mesh=triangle,n=5"]);
    let more = ["mesh=quad,n=13", "mesh=triangle,n=13"];
    assert_eq!(usual.more.iter().map(|run| run.name.as_str()).collect::<Vec<_>>(), more);
    assert!(all.more.is_empty() && all.runs.len() == 6);
    let order: Vec<&str> = usual.all_runs().iter().map(|run| run.name.as_str()).collect();
    assert_eq!(order, names(&all));
    assert_eq!(all.runs[2].config["surface"]["parameters"]["n"], 13);
    assert!(all.runs[0].config.get("full").is_none() && all.runs[0].config == usual.runs[0].config);
}

#[test]
fn full_records_stay_in_the_table_when_the_others_are_made_again() {
    let (usual, all) = (load("study", FULL), load_with("study", FULL, &full()).unwrap());
    let results = folder();
    let table = || fs::read_to_string(results.path().join("study/table.md")).unwrap();
    batch(&[usual], results.path(), &How::default());
    assert!(!table().contains("| 13 |") && !table().contains("of 4 runs"));
    batch(&[all], results.path(), &How::default());
    let complete = table();
    assert!(complete.contains("| 13 |"));
    batch(&[load("study", FULL)], results.path(), &How::default());
    assert_eq!(table(), complete);
}

#[test]
fn a_setting_takes_the_place_of_a_sweep_with_its_full_values() {
    let settings = Settings { sets: vec!["surface.parameters.n=9".to_owned()], ..full() };
    assert_eq!(names(&load_with("study", FULL, &settings).unwrap()), ["mesh=quad", "mesh=triangle"]);
}

#[test]
fn new_keys_are_as_strict_as_the_old_ones() {
    for (text, parts) in [
        (
            FULL.replace("[full]\n\"surface.parameters.n\"", "[full]\n\"surface.parameters.m\""),
            [
                "study.toml:7: ",
                "`surface.parameters.m` of [full] is not swept; [sweep] has: surface.parameters.mesh, surface.parameters.n",
            ],
        ),
        (FULL.replace("[13]", "6"), ["study.toml:7: ", "array"]),
        (FULL.replace("[13]", "[]"), ["study.toml:7: ", "one value or more"]),
        (
            FULL.replace("[13]", "[\"x\"]").replace("parameters.n", "component"),
            ["study.toml:7: `surface.component`", "invalid type"],
        ),
        (format!("full = 3\n{}", "[surface]\nsource = \"plane\"\n"), ["study.toml:1: ", "`full`"]),
        (format!("alone = 1\n{FULL}"), ["study.toml:1: ", "boolean"]),
    ] {
        let Err(error) = load_with("study", &text, &Settings::default()) else { panic!("taken: {text}") };
        for part in parts {
            assert!(error.contains(part), "no `{part}` in: {error}");
        }
        assert!(error.contains('^'), "{error}");
    }
}
