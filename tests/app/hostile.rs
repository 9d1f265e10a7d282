//! Configs of others: they are refused, or their results stay in the folder of results.

use std::fs;
use std::path::Path;

use riemap::app::experiment::{Batch, Config, Event, ResultsError, Scratch, Settings, Shard, check_figures};

fn load(folder: &Path, text: &str) -> Result<Config, String> {
    let path = folder.join("study.toml");
    fs::write(&path, text).unwrap();
    Config::load_with(&path, &Settings::default()).map_err(|error| error.to_string())
}

fn refused(text: &str, words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let Err(message) = load(folder.path(), text) else { panic!("accepted: {text}") };
    for word in words {
        assert!(message.contains(word), "`{word}` is missing in: {message}");
    }
}

fn swept(sweep: &str) -> String {
    format!("title = \"t\"\n[surface]\nsource = \"sphere?n=6\"\n[sweep]\n{sweep}\n")
}

#[test]
fn unknown_swept_tables_and_keys_are_refused_with_line_and_near_name() {
    refused(
        &swept("\"maps.dual\" = [\"incentre\", \"barycentre\"]"),
        &["study.toml:5", "`maps.dual`", "did you mean `map.dual`?"],
    );
    refused(&swept("nonsense = [1, 2]"), &["study.toml:5", "unknown key `nonsense`; known: "]);
    refused(&swept("\"map.duals\" = [\"incentre\"]"), &["duals"]);
}

#[test]
fn swept_keys_that_look_like_paths_or_are_cut_inside_a_character_are_refused() {
    let slashes = "/".repeat(79);
    refused(&swept(&format!("\"x./VICTIM{slashes}thesis\" = [1]")), &["unknown key `x./VICTIM"]);
    refused(&swept("\"x./ELSEWHERE/by-key\" = [1, 2]"), &["unknown key"]);
    refused(&swept(&format!("\"x.a{}\" = [1]", "é".repeat(60))), &["unknown key"]);
}

#[test]
fn names_of_plots_and_configs_that_are_paths_are_refused() {
    let plot = "[plots.\"x/../../../escaped\"]\nx = { key = \"result.input.vertices\", label = \"n\" }\n\
                y = { label = \"H\" }\nseries = [{ y = \"result.input.vertices\", label = \"v\" }]\n";
    refused(&format!("[surface]\nsource = \"sphere?n=6\"\n{plot}"), &["x/../../../escaped", "ASCII letters"]);
    let folder = tempfile::tempdir().unwrap();
    for name in ["...toml", "figures.toml", "a b.toml", "-x.toml"] {
        let path = folder.path().join(name);
        fs::write(&path, "[surface]\nsource = \"sphere?n=6\"\n").unwrap();
        assert!(Config::load_with(&path, &Settings::default()).is_err(), "{name}");
    }
}

#[test]
fn names_of_swept_values_are_refused_unless_they_are_one_safe_name_a_value() {
    let named = |names: &str| format!("{}[names]\n{names}\n", swept("\"map.dual\" = [\"incentre\", \"barycentre\"]"));
    for (names, reason) in [
        ("\"map.dual\" = [\"a\"]", "another number of names"),
        ("\"map.dual\" = [\"a\", \"../b\"]", "ASCII letters"),
        ("\"map.dual\" = [\"a\", 2]", "ASCII letters"),
        ("\"map.dual\" = [\"a\", \"a\"]", "the same name twice"),
        ("\"map.weight\" = [\"a\", \"b\"]", "is not swept"),
    ] {
        refused(&named(names), &["study.toml:", "of [names]", reason]);
    }
    let plot = "[plots.a]\nx = { key = \"result.input.vertices\", label = \"n\" }\n\
                y = { label = \"H\" }\nseries = [{ y = \"result.input.vertices\", label = \"v\" }]\n";
    refused(&format!("{}{plot}", named("\"map.dual\" = [\"a\", \"b\"]")), &["would both write figures/study-a"]);
}

#[test]
fn experiments_that_would_write_the_same_picture_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let load = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        Config::load_with(&path, &Settings::default()).unwrap()
    };
    let sweep = format!("{}[names]\n\"map.dual\" = [\"b\"]\n", swept("\"map.dual\" = [\"incentre\"]"));
    let configs = [load("a.toml", &sweep), load("a-b.toml", "[surface]\nsource = \"plane\"\n")];
    assert!(check_figures(&configs[..1]).is_ok());
    let error = check_figures(&configs).unwrap_err().to_string();
    assert!(error.contains("a.toml and ") && error.contains("would both write figures/a-b"), "{error}");
}

#[test]
fn two_runs_with_equal_configs_are_refused() {
    refused(&swept("\"surface.parameters.R\" = [1, 2, 1.0]"), &["equal configs", "`R=1`", "`R=1.0`"]);
    refused(&swept("title = [\"one\", \"two\"]"), &["equal configs"]);
}

#[test]
fn ten_thousand_runs_with_long_names_get_short_names_of_their_own() {
    // Names that are equal as far as they are not cut.
    let long = "x".repeat(80);
    let values = |from: usize| (from..from + 100).map(|i| format!("\"{long}{i}\"")).collect::<Vec<_>>().join(", ");
    let sweep = format!("\"surface.source\" = [{}]\n\"surface.parameters.s\" = [{}]", values(0), values(100));
    let folder = tempfile::tempdir().unwrap();
    let config = load(folder.path(), &swept(&sweep));
    let Ok(config) = config else { panic!("refused: {}", config.err().unwrap_or_default()) };
    let names: std::collections::HashSet<&str> = config.runs.iter().map(|run| run.name.as_str()).collect();
    assert_eq!(names.len(), 10_000);
    assert!(names.iter().all(|name| name.len() < 110), "names are short");
}

#[cfg(unix)]
#[test]
fn results_are_not_written_through_links_out_of_their_folder() {
    use std::os::unix::fs::symlink;
    let (folder, outside) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    let text = "[surface]\nsource = \"plane?n=4\"\n[figures]\nflat = true\n";
    for linked in ["study", "figures"] {
        let configs = [load(folder.path(), text).unwrap()];
        let results = folder.path().join(format!("results-{linked}"));
        fs::create_dir(&results).unwrap();
        symlink(outside.path(), results.join(linked)).unwrap();
        let threads = std::num::NonZeroUsize::MIN;
        let scratch = &Scratch::new(&results, "program");
        let batch = Batch { configs: &configs, shard: Shard::ALL, threads, apart: None, scratch };
        let mut refused = false;
        let ran = batch.run(&|| false, &mut |event| {
            let Event::Summed { summary, .. } = event else { return };
            refused |= matches!(summary, Err(ResultsError::Outside { .. }));
        });
        assert!(refused || matches!(ran, Err(ResultsError::Outside { .. })), "{linked}: {ran:?}");
        assert_eq!(outside.path().read_dir().unwrap().count(), 0);
    }
}
