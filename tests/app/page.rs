//! `results/index.html`: what it shows of experiments, made from configs and records alone.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;
use std::process::Command;

use riemap::app::experiment::{Batch, Config, Scratch, Settings, Shard, page};
use tempfile::TempDir;

const FIGURE: &str = r#"
title = "Flat < & > \"quoted\""
claim = "A flat square stays <flat>."
[surface]
source = "graph:flat"     # <b>no markup</b>
[map]
boundary = "fixed"
[sweep]
"surface.parameters.n" = [4, 5]
[figures]
flat = true
[expect]
"result.distortion.flipped" = { equal = 0 }
[table]
columns = [["result.energy.H", "H <i>"], ["result.solver.backend", "backend"]]
[plots.energy]
title = "Energy <x>"
x = { key = "config.surface.parameters.n", label = "n", log = true }
y = { label = "H", log = true }
series = [{ y = "result.energy.H", label = "H", fit = "cells" }]
"#;

const REFUTED: &str = r#"
title = "Refuted"
[surface]
source = "graph:flat?n=5"
[table]
columns = [["result.energy.H", "H"]]
[expect]
"result.distortion.flipped" = { min = 1 }
"#;

const FAILED: &str = "title = \"Failed\"\n[surface]\nsource = \"<nowhere>.off\"\n";
const UNBOUNDED: &str = "title = \"Unbounded\"\n[surface]\nsource = \"graph:flat?n=4\"\n[table]\ncolumns = [[\"result.energy.H\", \"H\"]]\n";
const ABSENT: &str = "title = \"Absent\"\n[surface]\nsource = \"data:tri/camelhead.off\"\n";

/// Configs in `folder`/experiments, their runs of `shard` made in `folder`/results, none of the data being there; the page.
fn made(texts: &[(&str, &str)], shard: &str, folder: &Path) -> String {
    let experiments = folder.join("experiments");
    fs::create_dir_all(&experiments).unwrap();
    let settings = Settings { data: vec![folder.join("data")], ..Settings::default() };
    let load = |(name, text): &(&str, &str)| {
        let path = experiments.join(format!("{name}.toml"));
        fs::write(&path, text).unwrap();
        Config::load_with(&path, &settings).unwrap()
    };
    let configs: Vec<Config> = texts.iter().map(load).collect();
    let results = folder.join("results");
    let shard: Shard = shard.parse().unwrap();
    let scratch = &Scratch::new(&results, "program");
    let batch = Batch { configs: &configs, shard, threads: NonZeroUsize::MIN, apart: None, scratch };
    batch.run(&|| false, &mut |_| {}).unwrap();
    page(&configs, &results)
}

/// The section of an experiment.
#[track_caller]
fn section<'a>(page: &'a str, name: &str) -> &'a str {
    let from = page.find(&format!("<h3 id=\"{name}\">")).unwrap();
    &page[from..from + page[from..].find("</section>").unwrap()]
}

#[test]
fn page_has_claims_verdicts_tables_configs_and_commands() {
    let folder = TempDir::new().unwrap();
    let text = made(&[("fig01", FIGURE), ("study", REFUTED)], "1/1", folder.path());
    let figure = section(&text, "fig01");
    for expected in [
        "A flat square stays &lt;flat&gt;.",
        ">holds</span> 2 runs, all as claimed.",
        "riemap reproduce fig01",
        "experiments/fig01.toml",
        "<span class=\"t\">[figures]</span>",
        "<th scope=\"col\">n</th>",
        "<th scope=\"col\">H &lt;i&gt;</th>",
        "<th scope=\"col\" class=\"word\">backend</th>",
        "Energy &lt;x&gt;: fitted orders",
        "<a href=\"fig01/\">records</a>",
    ] {
        assert!(figure.contains(expected), "`{expected}` is not in {figure}");
    }
    assert!(section(&text, "study").contains("refuted</span> 1 run, 1 against the claim."));
    assert!(text.contains("<li>3 runs of 2 experiments</li>"));
}

#[test]
fn text_of_configs_and_records_is_never_taken_for_markup() {
    let folder = TempDir::new().unwrap();
    let text = made(&[("fig01", FIGURE), ("study", FAILED)], "1/1", folder.path());
    for markup in ["<flat>", "Flat < ", "\"quoted\"\"", "<b>", "<i>", "<x>", "<nowhere>"] {
        assert!(!text.contains(markup), "{markup} is taken for markup");
    }
    assert!(section(&text, "study").contains("&lt;nowhere&gt;.off"), "the error is not in the table");
}

#[test]
fn what_is_not_claimed_or_not_made_does_not_hold() {
    let folder = TempDir::new().unwrap();
    let configs = [("fig01", FIGURE), ("failed", FAILED), ("made", UNBOUNDED), ("absent", ABSENT)];
    let text = made(&configs, "1/2", folder.path());
    assert!(section(&text, "fig01").contains("incomplete</span> 1 run, 1 missing."));
    assert!(section(&text, "failed").contains("failed</span> 1 run, 1 failed."));
    assert!(section(&text, "made").contains("made</span> 1 run, with no bounds to keep."));
    let absent = section(&text, "absent");
    assert!(absent.contains("not made</span> It needs data:tri/camelhead.off, "), "{absent}");
    assert!(!text.contains(&folder.path().display().to_string()), "a folder of this machine is on the page");
    assert!(!text.contains("holds</span>"));
}

#[test]
fn figures_of_the_paper_come_first_and_what_needs_data_last() {
    let folder = TempDir::new().unwrap();
    let configs = [("a", ABSENT), ("b", UNBOUNDED), ("fig02", UNBOUNDED), ("fig10", UNBOUNDED), ("fig_x", UNBOUNDED)];
    let text = made(&configs, "1/1", folder.path());
    let places = ["fig02", "fig10", "b", "fig_x", "a"].map(|name| text.find(&format!("<h3 id=\"{name}\">")).unwrap());
    assert!(places.is_sorted(), "{places:?}");
}

#[test]
fn every_picture_on_the_page_is_there_with_its_size() {
    let folder = TempDir::new().unwrap();
    let text = made(&[("fig01", FIGURE)], "1/1", folder.path());
    let mut pictures = 0;
    for piece in text.split("<img src=\"").skip(1) {
        let file = piece.split('"').next().unwrap();
        let bytes = fs::read(folder.path().join("results").join(file)).unwrap();
        let [width, height] = [16, 20].map(|at| u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()));
        assert!(piece.contains(&format!("width=\"{width}\" height=\"{height}\"")), "{file} is {width} × {height}");
        pictures += 1;
    }
    // The plot, and a flat map of each run.
    assert_eq!(pictures, 3);
    for piece in text.split("<a href=\"figures/").skip(1) {
        let file = piece.split('"').next().unwrap();
        assert!(folder.path().join("results/figures").join(file).is_file(), "{file} is linked to and not there");
    }
}

#[test]
fn same_results_make_the_same_page() {
    let (one, two) = (TempDir::new().unwrap(), TempDir::new().unwrap());
    // No column of times is in these.
    let configs = [("fig01", FIGURE), ("study", REFUTED), ("made", UNBOUNDED), ("real", ABSENT)];
    let [a, b] = [one.path(), two.path()].map(|folder| made(&configs, "1/1", folder));
    assert_eq!(a, b);
}

#[test]
fn both_commands_leave_a_page_of_all_that_was_made() {
    let folder = TempDir::new().unwrap();
    let experiments = folder.path().join("experiments");
    fs::create_dir(&experiments).unwrap();
    fs::write(experiments.join("first.toml"), UNBOUNDED).unwrap();
    fs::write(experiments.join("second.toml"), UNBOUNDED).unwrap();
    fs::write(experiments.join("broken.toml"), "[surface").unwrap();
    fs::write(folder.path().join("own.toml"), UNBOUNDED).unwrap();
    let riemap = |arguments: &[&str]| {
        let run =
            Command::new(env!("CARGO_BIN_EXE_riemap")).args(arguments).current_dir(folder.path()).output().unwrap();
        assert!(run.status.success(), "{run:?}");
        let page = fs::read_to_string(folder.path().join("results/index.html")).unwrap();
        (String::from_utf8(run.stdout).unwrap(), page)
    };
    let (said, page) = riemap(&["reproduce", "second"]);
    assert!(said.contains("broken.toml is not on the page: ") && said.contains("index.html"), "{said}");
    assert!(section(&page, "second").contains("riemap reproduce second") && !page.contains("id=\"first\""));
    let (_, page) = riemap(&["run", "own.toml"]);
    assert!(section(&page, "own").contains("<code>riemap run own.toml</code>"));
    assert!(page.contains("id=\"second\"") && !page.contains("id=\"first\""));
}

#[test]
fn a_page_shows_the_bars_of_bench_where_there_are_some() {
    let folder = tempfile::tempdir().unwrap();
    let without = made(&[("fig01", FIGURE)], "1/1", folder.path());
    assert!(!without.contains("part-speed"));

    let bench = folder.path().join("results/bench");
    fs::create_dir_all(&bench).unwrap();
    let bar =
        |what: &str, holds: &str| format!(r#"{{"what": "{what}", "measured": 0.5, "bound": "≤ 1", "holds": {holds}}}"#);
    let bars = [bar("a < b", "true"), bar("c", "false"), bar("d", "null")].join(", ");
    fs::write(bench.join("bench.json"), format!(r#"{{"bars": [{bars}]}}"#)).unwrap();
    fs::write(bench.join("solve.svg"), "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"50\" height=\"40\"/>")
        .unwrap();
    let with = made(&[("fig01", FIGURE)], "1/1", folder.path());
    assert!(with.contains("1 of 3 bars hold"));
    assert!(with.contains("<a href=\"#part-speed\">") && with.contains("<h2 id=\"part-speed\">"));
    assert!(with.contains("a &lt; b") && with.contains("not measured") && !with.contains("a < b"));
    assert!(with.contains("src=\"bench/solve.svg\" width=\"50\" height=\"40\"") && !with.contains("memory.svg"));

    // A record that is none is as good as none.
    fs::write(bench.join("bench.json"), "{").unwrap();
    assert!(!made(&[("fig01", FIGURE)], "1/1", folder.path()).contains("part-speed"));
}
