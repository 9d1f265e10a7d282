//! What studies are made of: fitted exponents, choices of runs.

#![allow(clippy::unwrap_used)]

use std::collections::BTreeMap;
use std::fs;

use riemap::experiment::{Abscissa, Config, FitSpec, Outcome, PlotSpec, Record, table};
use serde_json::{Value, json};

/// A config whose plot `NAME` is `plot`, read as a file is.
fn load(name: &str, plot: &str) -> Result<Config, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(&path, format!("[surface]\nsource = \"plane?n=4\"\n[plots.{name}]\n{plot}")).unwrap();
    Config::load(&path, &[]).map_err(|error| error.to_string())
}

#[track_caller]
fn assert_refused(name: &str, plot: &str, parts: &[&str]) {
    let Err(error) = load(name, plot) else { panic!("taken: {plot}") };
    for part in parts {
        assert!(error.contains(part), "no `{part}` in: {error}");
    }
}

fn record(config: Value, result: Value) -> Record {
    Record {
        experiment: "study".to_owned(),
        run: "run".to_owned(),
        config,
        outcome: Outcome::Done,
        error: None,
        result,
        pictures: Vec::new(),
        timings: Value::Null,
        versions: BTreeMap::new(),
    }
}

/// y = 3 n⁻² for kind a; y = n for kind b; n = 8 … 64.
fn records() -> Vec<Record> {
    let of = |kind: &'static str, y: fn(f64) -> f64| {
        [64.0, 8.0, 16.0, 32.0].map(|n| record(json!({"n": n, "kind": kind}), json!({"y": y(n)})))
    };
    [of("a", |n| 3.0 / (n * n)), of("b", |n| n)].concat()
}

const PLOT: &str = "title = \"Error\"\nx = { key = \"config.n\", label = \"n\", log = true }\n\
                    y = { label = \"error\", log = true }\n";

fn plot(rest: &str) -> Config {
    load("a", &format!("{PLOT}{rest}")).unwrap()
}

fn spec(config: &Config) -> &PlotSpec {
    config.plots.values().next().unwrap()
}

#[test]
fn a_power_law_has_its_exponent() {
    // Rounding of logarithms of numbers up to 1e5 apart: some units in the last place.
    for exponent in [-3.0, -0.5, 0.0, 1.0, 1.37, 2.0] {
        let points: Vec<[f64; 2]> = [3.0f64, 10.0, 1e3, 5e4].iter().map(|x| [*x, 0.7 * x.powf(exponent)]).collect();
        for (x, sign) in [(Abscissa::Cells, -1.0), (Abscissa::Width, 1.0), (Abscissa::Size, 1.0)] {
            let fitted = FitSpec { x, last: 4 }.fit(&points).unwrap();
            assert!((fitted.exponent - sign * exponent).abs() < 1e-13, "{x:?} {exponent}: {}", fitted.exponent);
            assert_eq!(fitted.points, 4);
        }
    }
}

#[test]
fn the_asymptotic_end_counts_and_points_without_a_logarithm_do_not() {
    // Slope 1 up to x = 4, slope 2 from there on, in no order.
    let points = [[16.0, 64.0], [1.0, 1.0], [4.0, 4.0], [2.0, 2.0], [8.0, 16.0]];
    let exponent = |x| FitSpec { x, last: 3 }.fit(&points).unwrap().exponent;
    assert!((exponent(Abscissa::Size) - 2.0).abs() < 1e-14);
    assert!((exponent(Abscissa::Cells) + 2.0).abs() < 1e-14);
    assert!((exponent(Abscissa::Width) - 1.0).abs() < 1e-14);
    let holes = [[0.0, 1.0], [-1.0, 1.0], [32.0, 0.0], [f64::NAN, 1.0], [64.0, f64::INFINITY]];
    let with_holes = [&points[..], &holes].concat();
    let fit = FitSpec { x: Abscissa::Size, last: 3 };
    assert_eq!(fit.fit(&with_holes), fit.fit(&points));
    for nothing in [&[][..], &[[1.0, 2.0]], &[[1.0, 2.0], [1.0, 3.0]], &holes] {
        assert_eq!(fit.fit(nothing), None);
    }
}

#[test]
fn a_fit_stands_in_the_legend_and_below_the_table() {
    let config = plot(
        "series = [{ y = \"result.y\", by = \"config.kind\", label = \"{}\", fit = \"cells\" }]\n\
         [table]\ncolumns = []\n",
    );
    let labels: Vec<String> = spec(&config).plot(&records()).series.into_iter().map(|series| series.label).collect();
    assert_eq!(labels, ["a, order 2.00", "b, order −1.00"]);
    let markdown = table(&config, &records(), false).unwrap();
    let expected = "\n## Error: fitted orders\n\n| series | order | points |\n| --: | --: | --: |\n\
                    | a | 2.000 | 3 |\n| b | -1.000 | 3 |\n";
    assert!(markdown.ends_with(expected), "{markdown}");
    // Without a fit the table ends with the records.
    let plain = plot("series = [{ y = \"result.y\", label = \"y\" }]\n[table]\ncolumns = []\n");
    assert!(!table(&plain, &records(), false).unwrap().contains("##"));
}

#[test]
fn only_takes_a_value_or_a_list_of_them() {
    let points = |only: &str| {
        let config = plot(&format!("only = {{ {only} }}\nseries = [{{ y = \"result.y\", label = \"y\" }}]\n"));
        spec(&config).plot(&records()).series.first().map_or(0, |series| series.points.len())
    };
    assert_eq!(points(""), 8);
    assert_eq!(points("\"config.kind\" = \"a\""), 4);
    assert_eq!(points("\"config.n\" = [8, 16.0, 99]"), 4);
    assert_eq!(points("\"config.n\" = [8, 16], \"config.kind\" = [\"b\"]"), 2);
    assert_eq!(points("\"config.n\" = []"), 0);
}

#[test]
fn a_plot_that_contradicts_itself_is_refused_at_its_line() {
    let linear = "x = { key = \"config.n\", label = \"n\", log = true }\ny = { label = \"y\" }\n";
    let series = |fit: &str| format!("series = [{{ y = \"result.y\", label = \"y\", fit = {fit} }}]\n");
    assert_refused("a", &format!("{linear}{}", series("\"cells\"")), &["study.toml:3", "plot `a`", "logarithmic"]);
    let cases =
        [("\"rows\"", "`cells`"), ("true", "\"cells\""), ("{ x = \"cells\", last = 1 }", "2 or more"), ("{}", "`x`")];
    for (fit, part) in cases {
        assert_refused("a", &format!("{PLOT}{}", series(fit)), &["study.toml:", part]);
    }
    let timed = format!("{PLOT}series = [{{ y = \"timings.total\", label = \"y\" }}]\n");
    assert_refused("cost", &timed, &["study.toml:3", "plot `cost`", "`-timings`"]);
    assert!(load("cost-timings", &timed).is_ok() && load("timings", &timed).is_ok());
}
