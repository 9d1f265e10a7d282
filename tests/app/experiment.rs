//! Experiments: strict configs, sweeps and settings, shards, records, and results that are what the code produces.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use riemap::app::experiment::{self, Batch, Config, Event, Outcome, Record, Scratch, Shard, records, table};
use riemap::figure::{Axis, FigureError, Format, Plot, Reference, Series};
use serde_json::Value;
use tempfile::TempDir;

const PLANE: &str = "[surface]\nsource = \"plane?n=4\"\n";

/// A folder with a config `study.toml`.
fn study(text: &str) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(&path, text).unwrap();
    (folder, path)
}

fn load(text: &str, sets: &[&str]) -> Result<Config, String> {
    let (_folder, path) = study(text);
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Config::load(&path, &sets).map_err(|error| error.to_string())
}

fn names(config: &Config) -> Vec<&str> {
    config.runs.iter().map(|run| run.name.as_str()).collect()
}

fn run(config: &Config, shard: Shard, results: &Path) -> Vec<Record> {
    let configs = std::slice::from_ref(config);
    let mut records = Vec::new();
    let scratch = &Scratch::new(results, "program");
    Batch { configs, shard, threads: NonZeroUsize::MIN, apart: None, scratch }
        .run(&|| false, &mut |event| {
            if let Event::Ended { record, .. } = event {
                records.push(record.clone());
            }
        })
        .unwrap();
    records
}

#[track_caller]
fn assert_refused(text: &str, sets: &[&str], parts: &[&str]) {
    let Err(error) = load(text, sets) else { panic!("taken: {text} {sets:?}") };
    for part in parts {
        assert!(error.contains(part), "no `{part}` in: {error}");
    }
}

#[test]
fn what_a_config_does_not_have_is_refused_with_line_and_known_names() {
    assert_refused("title = \"x\"\nfoo = 3\n", &[], &["study.toml:2: unknown key `foo`", "known: title", "^^^"]);
    assert_refused(&format!("{PLANE}[map]\nshap = 1\n"), &[], &["study.toml:4", "`shap`", "`shape`", "^^^^"]);
    assert_refused(&format!("{PLANE}[map]\nshape = \"cube\"\n"), &[], &["study.toml:4", "`cube`", "`circle`"]);
    assert_refused(&format!("{PLANE}[map]\ndual = \"x\"\n"), &[], &["study.toml:4", "`x`", "barycentre, circumcentre"]);
    assert_refused(&format!("{PLANE}[solver]\nname = \"x\"\n"), &[], &["study.toml:4", "`x`", "auto"]);
    assert_refused(&format!("{PLANE}[figures]\nflat = 1\n"), &[], &["study.toml:4", "boolean"]);
    assert_refused(&format!("{PLANE}[plots.a]\ny = 1\n"), &[], &["study.toml:4"]);
    assert_refused("kind = \"x\"\n", &[], &["study.toml:1", "`x`", "known: map, cotan"]);
    assert_refused("kind = \"cotan\"\n[map]\n", &[], &["study.toml:2: unknown key `map`"]);
    assert_refused("[surface\nsource = 3\n", &[], &["study.toml:1", "unclosed"]);
    assert_refused("[map]\n", &[], &["[surface]", "`source`"]);
    // Options that contradict each other: the key that the message names; its value, where --set gave it.
    let free = format!("{PLANE}[map]\ncut = true\nboundary = \"free\"\n");
    assert_refused(&format!("{free}fix = 2\n"), &[], &["study.toml:6", "`fix`", "\n6 | fix = 2", "  | ^^^"]);
    assert_refused(&free, &["map.fix=2"], &["--set map.fix=2", "`fix`"]);
    assert_refused(&format!("{PLANE}[map]\nfix = 4\n"), &[], &["study.toml:3", "4 fixed boundary points"]);
}

#[test]
fn a_wrong_value_is_blamed_on_the_sweep_or_the_setting_that_gave_it() {
    let swept = format!("{PLANE}[sweep]\n\"map.weight\" = [\n  \"unit\",\n  \"heavy\",\n]\n");
    assert_refused(&swept, &[], &["study.toml:6: `map.weight`", "`heavy`", "`integral`"]);
    assert_refused(&format!("{PLANE}[sweep]\n\"map.weight\" = []\n"), &[], &["study.toml:4", "`map.weight`"]);
    assert_refused(&format!("{PLANE}[sweep]\n\"map.weight\" = \"unit\"\n"), &[], &["study.toml:4", "array"]);
    assert_refused(PLANE, &["map.weight=heavy"], &["--set map.weight=heavy", "`heavy`", "`integral`"]);
    assert_refused(PLANE, &["map.wait=unit"], &["--set map.wait=unit", "`wait`", "`weight`"]);
    assert_refused(PLANE, &["surface.source.n=3"], &["`surface.source.n` cannot be set", "`source` is no table"]);
    assert_refused(PLANE, &["nonsense"], &["--set nonsense", "key=value"]);
    let axis = (0..200).map(|i| i.to_string()).collect::<Vec<_>>().join(",");
    let vast = format!("{PLANE}[sweep]\n\"surface.parameters.n\" = [{axis}]\n\"surface.parameters.seed\" = [{axis}]\n");
    assert_refused(&vast, &[], &["more than 10000 runs"]);
}

#[test]
fn a_damaged_config_is_an_error_at_a_line_and_never_a_panic() {
    let text = fs::read_to_string(clone().join("experiments/obtuse.toml")).unwrap();
    for (at, _) in text.char_indices().step_by(7) {
        for damage in ["", "\"", "[", "é", "\n\u{301}=", "= [=", "\r\n\0"] {
            let damaged = format!("{}{damage}", &text[..at]);
            if let Err(error) = load(&damaged, &["plots.x=é"]) {
                let blamed = ["study.toml:", "--set plots.x=é"].iter().any(|part| error.contains(part));
                assert!(blamed, "{damaged}\n{error}");
            }
        }
    }
}

#[test]
fn a_sweep_is_the_cartesian_product_in_the_order_of_the_file() {
    let text = "[surface]\nsource = \"plane\"\nparameters = { mesh = \"triangle\" }\n\
                [sweep]\n\"surface.parameters.n\" = [4, 5]\nmap.dual = [\"incentre\", \"barycentre\"]\n";
    let config = load(text, &[]).unwrap();
    let expected = ["n=4,dual=incentre", "n=4,dual=barycentre", "n=5,dual=incentre", "n=5,dual=barycentre"];
    assert_eq!(names(&config), expected);
    assert_eq!(config.runs[2].config["surface"]["parameters"]["n"], 5);
    assert_eq!(config.runs[2].config["surface"]["parameters"]["mesh"], "triangle");
    assert_eq!(config.runs[2].config["map"]["dual"], "incentre");
    assert_eq!(config.swept, ["surface.parameters.n", "map.dual"]);
}

#[test]
fn a_setting_reaches_any_key_and_takes_the_place_of_a_sweep() {
    let text = format!("{PLANE}[sweep]\n\"map.weight\" = [\"unit\", \"integral\"]\n");
    let config = load(&text, &["map.weight=unit", "title=Two words", "surface.source=\"plane?n=7\""]).unwrap();
    assert_eq!(names(&config), ["run"]);
    assert_eq!(config.title, "Two words");
    assert_eq!(config.runs[0].config["map"]["weight"], "unit");
    assert_eq!(config.runs[0].config["surface"]["source"], "plane?n=7");
    let config = load(&text, &["surface.parameters.seed=3", "expect.\"result.error\".max=3"]).unwrap();
    // A quoted dot is no separator.
    assert_eq!(config.runs[1].expect["result.error"].max, Some(3.0));
    assert_eq!(config.runs[1].config["surface"]["parameters"]["seed"], 3);
}

#[test]
fn values_that_look_alike_as_file_names_keep_records_of_their_own() {
    let config =
        load("[surface]\nsource = \"x\"\n[sweep]\n\"surface.source\" = [\"a?b\", \"a:b\", \"../a\"]\n", &[]).unwrap();
    assert_eq!(names(&config), ["source=a-b", "source=a-b-2", "source=..-a"]);
}

#[test]
fn shards_cover_all_runs_once_and_their_results_merge() {
    let text = "[surface]\nsource = \"plane\"\n[sweep]\n\"surface.parameters.n\" = [3, 4, 5, 6, 7]\n";
    let config = load(text, &[]).unwrap();
    let results = tempfile::tempdir().unwrap();
    let mut seen = Vec::new();
    for shard in ["1/3", "2/3", "3/3"] {
        let records = run(&config, shard.parse().unwrap(), results.path());
        seen.extend(records.into_iter().map(|record| record.run));
        let summary = experiment::summarise(&config, results.path()).unwrap();
        assert_eq!(summary.records.len(), seen.len());
    }
    seen.sort();
    assert_eq!(seen, ["n=3", "n=4", "n=5", "n=6", "n=7"]);
    let merged = fs::read_to_string(results.path().join("study/table.md")).unwrap();
    let whole = tempfile::tempdir().unwrap();
    run(&config, Shard::ALL, whole.path());
    experiment::summarise(&config, whole.path()).unwrap();
    assert_eq!(merged, fs::read_to_string(whole.path().join("study/table.md")).unwrap());
    for text in ["0/3", "4/3", "1/0", "1", "a/b", "-1/3"] {
        assert!(text.parse::<Shard>().is_err(), "{text}");
    }
}

#[test]
fn failures_and_refutations_are_records_and_do_not_stop_the_rest() {
    let text = "[surface]\nsource = \"plane\"\n[sweep]\n\"surface.parameters.mesh\" = [\"quad\", \"round\", \"triangle\"]\n\
                [expect]\n\"result.input.kind\" = { equal = \"quad\" }\n";
    let config = load(text, &["surface.parameters.n=4"]).unwrap();
    let results = tempfile::tempdir().unwrap();
    let records = run(&config, Shard::ALL, results.path());
    let outcomes: Vec<Outcome> = records.iter().map(|record| record.outcome).collect();
    assert_eq!(outcomes, [Outcome::Done, Outcome::Failed, Outcome::Refuted]);
    assert!(records[1].error.as_ref().unwrap().contains("round") && records[1].result.is_null());
    assert!(records[2].error.as_ref().unwrap().contains("`result.input.kind` is \"triangle\", expected \"quad\""));
    let summary = experiment::summarise(&config, results.path()).unwrap();
    // The names of the runs are sorted in the file, and in the summary they are in the order of the sweep.
    assert_eq!(
        summary.records.iter().map(Record::same_on_every_run).collect::<Vec<_>>(),
        records.iter().map(Record::same_on_every_run).collect::<Vec<_>>()
    );
    let markdown = table(&config, &records, false).unwrap();
    assert!(markdown.contains("failed: ") && markdown.contains("refuted: ") && markdown.contains("| done |"));
}

#[test]
fn records_of_other_settings_do_not_count() {
    let results = tempfile::tempdir().unwrap();
    run(&load(PLANE, &["map.weight=unit"]).unwrap(), Shard::ALL, results.path());
    assert!(experiment::summarise(&load(PLANE, &[]).unwrap(), results.path()).unwrap().records.is_empty());
}

#[test]
fn a_misspelt_key_of_a_column_or_plot_is_told_with_the_known_ones() {
    let column = format!("{PLANE}[table]\ncolumns = [{{ key = \"result.energy.HH\", label = \"H\" }}]\n");
    let plot = format!(
        "{PLANE}[plots.a]\nx = {{ key = \"result.input.vertices\", label = \"v\" }}\ny = {{ label = \"H\" }}\n\
         series = [{{ y = \"result.energy.HH\", label = \"H\" }}]\n"
    );
    for text in [column, plot] {
        let config = load(&text, &[]).unwrap();
        let results = tempfile::tempdir().unwrap();
        run(&config, Shard::ALL, results.path());
        let error = experiment::summarise(&config, results.path()).unwrap_err().to_string();
        assert!(error.contains("`result.energy.HH`") && error.contains("result.energy.H,"), "{error}");
    }
}

// ---- Results in the clone ------------------------------------------------------------------------------------------

fn clone() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn experiments() -> Vec<Config> {
    let folder = clone().join("experiments");
    let mut paths: Vec<PathBuf> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    paths.sort();
    paths.iter().map(|path| Config::load(path, &[]).unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn committed(config: &Config) -> Vec<Record> {
    records(config, &clone().join("results"))
}

/// Numbers equal up to what compilers and processors may round differently: relative 1e-6; below 1e-9 all is rounding.
#[track_caller]
fn assert_close(a: &Value, b: &Value, key: &str) {
    match (a, b) {
        (Value::Object(x), Value::Object(y)) => {
            assert_eq!(x.keys().collect::<Vec<_>>(), y.keys().collect::<Vec<_>>(), "{key}");
            x.iter().for_each(|(name, value)| assert_close(value, &y[name], &format!("{key}.{name}")));
        }
        (Value::Array(x), Value::Array(y)) => {
            assert_eq!(x.len(), y.len(), "{key}");
            x.iter().zip(y).for_each(|(x, y)| assert_close(x, y, key));
        }
        (Value::Number(x), Value::Number(y)) => {
            let (x, y) = (x.as_f64().unwrap(), y.as_f64().unwrap());
            assert!((x - y).abs() <= 1e-9 + 1e-6 * x.abs().max(y.abs()), "{key}: {x} is now {y}");
        }
        _ => assert_eq!(a, b, "{key}"),
    }
}

#[test]
fn results_have_one_successful_record_of_every_run_and_no_other() {
    for config in experiments() {
        let file = clone().join("results").join(&config.name).join("records.jsonl");
        let lines = fs::read_to_string(file).unwrap();
        let found: Vec<Record> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        assert!(found.is_sorted_by_key(|record| &record.run), "{}", config.name);
        let mut names: Vec<&str> = names(&config);
        names.sort_unstable();
        assert!(found.iter().map(|record| record.run.as_str()).eq(names), "{}", config.name);
        // Records of other settings do not count.
        let counted = committed(&config);
        assert_eq!(counted.len(), config.runs.len(), "{}: run `riemap reproduce` again", config.name);
        for record in counted {
            assert_eq!(record.outcome, Outcome::Done, "{} {}", config.name, record.run);
            assert!(record.versions.is_empty(), "{} {}", config.name, record.run);
        }
    }
}

#[test]
fn pictures_in_results_have_short_names_that_latex_and_shells_take_as_they_are() {
    let configs = experiments();
    experiment::check_figures(&configs).unwrap();
    for picture in configs.iter().flat_map(committed).flat_map(|record| record.pictures) {
        let (stem, _) = picture.rsplit_once('.').unwrap();
        assert!(stem.len() <= 50, "{picture}");
        assert!(stem.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c)), "{picture}");
    }
}

#[test]
fn tables_and_plots_in_results_are_what_the_records_say() {
    for config in experiments() {
        let records = committed(&config);
        let results = clone().join("results");
        let markdown = fs::read_to_string(results.join(&config.name).join("table.md")).unwrap();
        assert_eq!(markdown, table(&config, &records, false).unwrap(), "{}", config.name);
        for (name, spec) in config.plots.iter().filter(|(_, spec)| !spec.is_of_timings()) {
            let svg = fs::read(results.join(format!("figures/{}-{name}.svg", config.name))).unwrap();
            assert!(svg == spec.plot(&records).render(Format::Svg).unwrap(), "{} {name}", config.name);
        }
    }
}

#[test]
fn the_fixed_circle_comes_out_as_in_results_and_the_same_twice() {
    let path = clone().join("experiments/fixed_circle.toml");
    let config = Config::load(&path, &[]).unwrap();
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    let [first, second] = folders.each_ref().map(|folder| run(&config, Shard::ALL, folder.path()).remove(0));
    assert!(first.same_numbers(&second));
    assert_ne!(first.timings, Value::Null);
    for picture in ["figures/fixed_circle.png", "figures/fixed_circle.svg"] {
        let [a, b] = folders.each_ref().map(|folder| fs::read(folder.path().join(picture)).unwrap());
        assert!(a == b, "{picture}");
    }
    assert_close(&committed(&config)[0].result, &first.result, "result");
}

#[test]
fn a_checkerboard_is_drawn_beside_the_flat_map_under_a_name_of_its_own() {
    let figures = "[figures]\nflat = true\ncheckerboard = { squares = 8, up = \"-y\", towards = [0, 1, 3] }\n";
    let config = load(&format!("{PLANE}{figures}"), &[]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(run(&config, Shard::ALL, folder.path())[0].error, None);
    for picture in ["study-flat.png", "study-flat.svg", "study-checkerboard.png"] {
        assert!(folder.path().join("figures").join(picture).is_file(), "{picture}");
    }
    assert_refused(&format!("{PLANE}[figures]\ncheckerboard = {{ squares = -1 }}\n"), &[], &["study.toml:4", "-1"]);
    assert_refused(&format!("{PLANE}[figures]\ncheckerboard = {{ length = 8 }}\n"), &[], &["study.toml:4", "squares"]);
}

#[test]
fn a_run_against_libigl_comes_out_as_in_results() {
    let config = Config::load(&clone().join("experiments/obtuse.toml"), &[]).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let shard = Shard { index: 4, count: config.runs.len() };
    let record = run(&config, shard, folder.path()).remove(0);
    assert_eq!(record.error, None);
    assert_close(&committed(&config)[3].result, &record.result, "result");
}

// ---- Plots ---------------------------------------------------------------------------------------------------------

fn plot(log: bool, points: &[[f64; 2]]) -> Plot {
    let axis = |label: &str| Axis { label: label.to_owned(), log };
    let series = vec![Series { label: "E & more".to_owned(), points: points.to_vec(), cloud: false }];
    Plot { title: "Title".to_owned(), x: axis("across"), y: axis("up"), series, references: Vec::new() }
}

fn svg(plot: &Plot) -> String {
    String::from_utf8(plot.render(Format::Svg).unwrap()).unwrap()
}

#[test]
fn a_plot_shows_title_axes_legend_and_ticks() {
    let text = svg(&plot(true, &[[10.0, 1e-3], [1000.0, 1e-6], [100.0, 1e-5]]));
    for part in [">Title<", ">across<", ">up<", ">E &amp; more<", ">10²<", ">10⁻⁴<"] {
        assert!(text.contains(part), "{part}");
    }
    assert!(roxmltree::Document::parse(&text).is_ok());
    assert!(plot(true, &[[10.0, 1e-3]]).render(Format::Png).unwrap().starts_with(b"\x89PNG"));
}

#[test]
fn points_without_a_place_on_an_axis_are_left_out() {
    let whole = plot(true, &[[1.0, 1.0], [10.0, 2.0]]);
    let more = plot(true, &[[1.0, 1.0], [-1.0, 1.0], [2.0, 0.0], [3.0, f64::NAN], [f64::INFINITY, 1.0], [10.0, 2.0]]);
    assert_eq!(svg(&whole), svg(&more));
    for log in [false, true] {
        let empty = plot(log, &[[f64::NAN, 1.0]]).render(Format::Svg);
        assert!(matches!(empty, Err(FigureError::NoPoints)));
    }
}

#[test]
fn any_range_of_numbers_gets_a_plot_with_labels_or_an_error() {
    let extremes = [0.0, 1.0, -1.0, 1e-300, 5e-324, 1e300, f64::MAX, -f64::MAX, 1.0 + 1e-15, 1e-15, 12345.678, 1e12];
    for log in [false, true] {
        for a in extremes {
            for b in extremes {
                match plot(log, &[[a, b], [b, a]]).render(Format::Svg) {
                    Ok(bytes) => {
                        let text = String::from_utf8(bytes).unwrap();
                        assert!(!text.contains("NaN") && !text.contains("inf"), "{log} {a:e} {b:e}");
                        assert!(text.matches("<text").count() >= 6, "{log} {a:e} {b:e}: no ticks");
                    }
                    Err(FigureError::PlotRange { .. } | FigureError::NoPoints) => {}
                    Err(error) => panic!("{log} {a:e} {b:e}: {error}"),
                }
            }
        }
    }
}

#[test]
fn a_sloped_reference_needs_logarithmic_axes() {
    let mut sloped = plot(false, &[[1.0, 1.0], [10.0, 2.0]]);
    sloped.references.push(Reference { label: "order 2".to_owned(), slope: -2.0, through: None });
    assert!(matches!(sloped.render(Format::Svg), Err(FigureError::Slope { label }) if label == "order 2"));
    sloped.x.log = true;
    sloped.y.log = true;
    assert!(svg(&sloped).contains(">order 2<"));
}
