use std::fs;
use std::path::Path;

use riemap::app::experiment::{Config, DataFile, Origin, Outcome, Settings, data_folders};

use super::shared::*;

/// A square of two triangles.
const OFF: &str = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const SWEPT: &str = "[surface]\nsource = \"\"\n[sweep]\n\
    \"surface.source\" = [\"plane?n=4\", \"data:tri/square.off\", \"data:tri/other.off\"]\n";

fn config(data: &Path) -> Config {
    load_with("study", SWEPT, &Settings { data: vec![data.to_owned()], ..Settings::default() }).unwrap()
}

#[test]
fn a_public_file_is_found_in_the_first_folder_that_has_it() {
    let (first, second) = (folder(), folder());
    for folder in [&first, &second] {
        fs::create_dir(folder.path().join("tri")).unwrap();
    }
    fs::write(second.path().join("tri/square.off"), OFF).unwrap();
    let folders = [first.path().to_owned(), second.path().to_owned()];
    let find = || DataFile::find("data:tri/square.off", &folders).unwrap().path;
    assert_eq!(find(), Some(second.path().join("tri/square.off")));
    fs::write(first.path().join("tri/square.off"), OFF).unwrap();
    assert_eq!(find(), Some(first.path().join("tri/square.off")));
    assert_eq!(DataFile::find("tri/square.off", &folders), None, "a source without data: is a path as ever");
    assert_eq!(data_folders(Some("/d".into())), [Path::new("/d")]);
    let usual = data_folders(None);
    assert!(
        usual[0].ends_with("../shared/data") && usual[1].ends_with("data") && data_folders(Some("".into())) == usual
    );
}

#[test]
fn a_run_without_its_data_is_passed_over_and_one_with_them_says_which_they_were() {
    let (data, results) = (folder(), folder());
    assert_eq!(batch(&[config(data.path())], results.path(), &How::default()).made.len(), 1);
    fs::create_dir(data.path().join("tri")).unwrap();
    fs::write(data.path().join("tri/square.off"), OFF).unwrap();
    let told = batch(&[config(data.path())], results.path(), &How::default());
    assert_eq!(told.made.len(), 2);
    let record = &told.made[1];
    assert_eq!((record.outcome, record.run.as_str()), (Outcome::Done, "source=data-tri-square.off"));
    let version = &record.versions["data:tri/square.off"];
    assert!(version.starts_with("sha256:") && version.len() == 7 + 64, "{version}");
    // Wherever the file lies, the record is the same.
    assert_eq!(record.get("result.input.path").unwrap(), "data:tri/square.off");
    let folder = data.path().to_str().unwrap();
    assert!(!serde_json::to_string(record).unwrap().contains(folder), "{record:?}");
    let table = fs::read_to_string(results.path().join("study/table.md")).unwrap();
    assert!(table.contains("2 of 3 runs."), "{table}");
}

#[test]
fn the_advice_says_where_a_known_file_comes_from() {
    let folders = [Path::new("/nowhere").to_owned()];
    for Origin { name, repository, path, .. } in Origin::all() {
        let advice = DataFile::find(&format!("data:{name}"), &folders).unwrap().to_string();
        for part in [name, repository, path, "/nowhere"] {
            assert!(advice.contains(part), "no `{part}` in: {advice}");
        }
    }
    let unknown = DataFile::find("data:x.off", &folders).unwrap().to_string();
    assert!(unknown.contains("data:x.off") && unknown.contains("experiments/data.md"), "{unknown}");
}

#[test]
fn every_public_file_that_is_here_is_the_one_in_the_table() {
    let here = data_folders(std::env::var_os("RIEMAP_DATA"));
    let source = |origin: &Origin| format!("data:{}", origin.name);
    let (results, mut found) = (folder(), 0);
    for origin in Origin::all().filter(|origin| DataFile::find(&source(origin), &here).unwrap().path.is_some()) {
        // The run fails, for exact normals of a file are not known; which file it was the record tells all the same.
        let text =
            format!("kind = \"normals\"\n[surface]\nsource = \"{}\"\n[normals]\nname = \"surfel\"\n", source(&origin));
        let config = load_with("study", &text, &Settings { data: here.clone(), ..Settings::default() }).unwrap();
        let record = &batch(&[config], results.path(), &How::default()).made[0];
        assert_eq!(record.versions[&source(&origin)], format!("sha256:{}", origin.sha256));
        found += 1;
    }
    if found == 0 {
        println!("skipped: no public files in {here:?}");
    }
}
