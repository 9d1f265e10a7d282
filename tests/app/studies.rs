//! What studies are made of: fitted exponents, choices of runs.

use std::collections::BTreeMap;
use std::fs;
use std::num::NonZeroUsize;

use riemap::app::experiment::{
    Abscissa, Batch, Config, Event, FitSpec, Outcome, PlotSpec, Record, Scratch, Shard, table, trace,
};
use riemap::app::measure::stopwatch::Traced;
use riemap::solver::Iteration;
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
    let labels: Vec<String> =
        spec(&config).plot(&records()).plots[0].series.clone().into_iter().map(|series| series.label).collect();
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
        let panels = spec(&config).plot(&records());
        panels.plots.first().and_then(|plot| plot.series.first()).map_or(0, |series| series.points.len())
    };
    assert_eq!(points(""), 8);
    assert_eq!(points("\"config.kind\" = \"a\""), 4);
    assert_eq!(points("\"config.n\" = [8, 16.0, 99]"), 4);
    assert_eq!(points("\"config.n\" = [8, 16], \"config.kind\" = [\"b\"]"), 2);
    assert_eq!(points("\"config.n\" = []"), 0);
}

#[test]
fn a_series_has_runs_of_its_own_and_panels_share_names_without_exponents() {
    let config = plot(
        "series = [{ y = \"result.y\", label = \"b\", only = { \"config.kind\" = \"b\" } }, \
         { y = \"result.y\", label = \"all\" }]\n",
    );
    let panels = spec(&config).plot(&records());
    let points: Vec<usize> = panels.plots[0].series.iter().map(|series| series.points.len()).collect();
    assert_eq!(points, [4, 8]);
    let series = "series = [{ y = \"result.y\", label = \"y\", fit = \"cells\" }]\n";
    let config = plot(&format!("{series}panels = {{ columns = [\"config.kind\"] }}\n"));
    let panels = spec(&config).plot(&records());
    assert_eq!(panels.columns, 2);
    assert!(panels.plots.iter().all(|plot| plot.series[0].label == "y"));
    let fits = spec(&config).fits(&records());
    let exponents: Vec<(&str, f64)> = fits.iter().map(|(name, fit)| (name.as_str(), fit.unwrap().exponent)).collect();
    assert!(exponents[0].0 == "a: y" && exponents[1].0 == "b: y", "{exponents:?}");
    // Rounding of logarithms.
    assert!((exponents[0].1 - 2.0).abs() < 1e-13 && (exponents[1].1 + 1.0).abs() < 1e-13, "{exponents:?}");
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

// ---- Iterations and panels ------------------------------------------------------------------------------------------

/// The records of a config that is run.
fn run(text: &str) -> (tempfile::TempDir, Config, Vec<Record>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(&path, text).unwrap();
    let config = Config::load(&path, &[]).unwrap();
    let batch = Batch {
        configs: std::slice::from_ref(&config),
        shard: Shard::ALL,
        threads: NonZeroUsize::MIN,
        apart: None,
        scratch: &Scratch::new(folder.path(), "program"),
    };
    let mut records = Vec::new();
    let mut collect = |event: Event| {
        if let Event::Ended { record, .. } = event {
            records.push(record.clone());
        }
    };
    batch.run(&|| false, &mut collect).unwrap();
    (folder, config, records)
}

fn numbers(record: &Record, key: &str) -> Vec<f64> {
    let value = record.get(key).unwrap();
    value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

const SWEEP: &str = "[surface]\nsource = \"graph:cos+cos\"\n[solver]\nmax-iterations = 400\n\
                     [sweep]\n\"map.energy\" = [\"H + C\", \"H + L\"]\n\"surface.parameters.n\" = [7, 9]\n\
                     \"solver.name\" = [\"reduced\", \"levenberg-marquardt\", \"fletcher-reeves\"]\n\
                     [[without]]\nruns = { \"map.energy\" = \"H + L\", \"solver.name\" = [\"reduced\"] }\n\
                     because = \"it does not reduce\"\n";

#[test]
fn a_trace_begins_at_the_start_and_ends_at_the_map() {
    let figures = "[figures]\nconvergence = { x = \"iteration\", y = \"total\" }\n";
    let (_folder, config, records) = run(&format!("{SWEEP}{figures}"));
    assert_eq!(records.len(), 10);
    for record in &records {
        assert_eq!(record.error, None, "{}", record.run);
        let [iteration, total, gradient] =
            ["iteration", "total", "gradient_norm"].map(|name| numbers(record, &format!("result.trace.{name}")));
        let seconds = numbers(record, "timings.trace.seconds");
        let n = iteration.len();
        assert!(n <= 150 && [total.len(), gradient.len(), seconds.len()] == [n; 3], "{}", record.run);
        assert_eq!(iteration[0], 0.0);
        assert_eq!(iteration[n - 1], record.get("result.solver.iterations").unwrap().as_f64().unwrap());
        assert_eq!(total[n - 1], record.get("result.energy.total").unwrap().as_f64().unwrap());
        assert!(iteration.windows(2).all(|w| w[0] < w[1]) && seconds.windows(2).all(|w| w[0] <= w[1]));
        // Minimisers lower the energy at every step; where it is 1e-13 of the start's, sums round. Newton's method on the boundary
        // lowers the residual of its equations.
        let falling = if record.run.contains("name=reduced") { &gradient } else { &total };
        let total = falling;
        assert!(total.windows(2).all(|w| w[1] <= w[0] + 1e-13 * total[0]), "{}: {total:?}", record.run);
    }
    // All minimisers of one problem begin at the same map.
    let starts: Vec<f64> = records[7..10].iter().map(|r| numbers(r, "result.trace.total")[0]).collect();
    assert_eq!(records[8].get("config.surface.parameters.n"), records[9].get("config.surface.parameters.n"));
    assert_eq!(starts[1], starts[2]);
    // E = Σ terms at the start: the same number as a map that is not iterated at all would report.
    let text = format!("{PLANE}[map]\nenergy = \"H + L\"\n[solver]\nmax-iterations = 0\n{figures}");
    let begun = &run(&text).2[0];
    assert_eq!(numbers(begun, "result.trace.total").len(), 1);
    assert_eq!(config.plots.keys().collect::<Vec<_>>(), ["convergence"]);
}

const PLANE: &str = "[surface]\nsource = \"plane?n=4\"\n";

#[test]
fn records_have_a_trace_only_where_it_is_drawn() {
    let record = &run(PLANE).2[0];
    assert!(record.get("result.trace").is_none() && record.get("timings.trace").is_none());
}

#[test]
fn many_iterations_are_thinned_evenly_on_a_logarithmic_axis_with_both_ends() {
    let at = |number: usize| Traced {
        iteration: Iteration {
            number,
            total: 1.0 / (number + 1) as f64,
            terms: Vec::new(),
            gradient_norm: number as f64,
            step: 0.0,
        },
        seconds: number as f64,
    };
    for n in [1usize, 2, 149, 150, 151, 152, 1000, 50_001] {
        let all: Vec<Traced> = (0..n).map(at).collect();
        let (result, timings) = trace(&all, None);
        let kept: Vec<usize> = serde_json::from_value(result["iteration"].clone()).unwrap();
        assert!(kept.len() == n.min(kept.len()) && kept.len() <= 150, "{n}");
        assert!(n > 150 || kept.len() == n, "{n}: {}", kept.len());
        assert!(kept[0] == 0 && kept[kept.len() - 1] == n - 1 && kept.windows(2).all(|w| w[0] < w[1]), "{n}");
        // No gap on the logarithmic axis is much wider than the 149th part of it, but for those between neighbours.
        let widest = 1.6 * (n as f64).ln() / 148.0;
        assert!(kept[1..].windows(2).all(|w| w[1] - w[0] == 1 || (w[1] as f64 / w[0] as f64).ln() < widest), "{n}");
        assert_eq!(timings["seconds"], result["gradient_norm"]);
    }
    // Stages begin at 0 again; their numbers go on, and the last energy is the map's.
    let stages: Vec<Traced> = [0, 1, 2, 0, 1].map(at).to_vec();
    let (result, _) = trace(&stages, Some(7.0));
    assert_eq!(result["iteration"], json!([0, 1, 2, 2, 3]));
    assert_eq!(result["total"][4], json!(7.0));
    assert_eq!(trace(&[], Some(1.0)).0["total"], json!([]));
}

#[test]
fn convergence_is_drawn_of_any_sweep_with_a_panel_for_what_is_no_curve() {
    let figures =
        "[figures]\nconvergence = [{ x = \"iteration\", y = \"excess\" }, { x = \"seconds\", y = \"total\" }]\n";
    let (folder, config, records) = run(&format!("{SWEEP}{figures}"));
    let panels = config.plots["convergence"].plot(&records);
    assert_eq!(panels.columns, 2);
    let titles: Vec<&str> = panels.plots.iter().map(|plot| plot.title.as_str()).collect();
    assert!(titles[0].starts_with("H + C, n = 7, E* = ") && titles[3].starts_with("H + L, n = 9, E* = "), "{titles:?}");
    let curves: Vec<&str> = panels.plots[2].series.iter().map(|series| series.label.as_str()).collect();
    assert_eq!(curves, ["levenberg-marquardt", "fletcher-reeves"]);
    // The lowest energy is taken away where it is a minimum, and then no point is below it.
    let lowest = records[6..8].iter().flat_map(|r| numbers(r, "result.trace.total")).fold(f64::INFINITY, f64::min);
    let first = numbers(&records[6], "result.trace.total")[0];
    assert_eq!(panels.plots[2].series[0].points[0], [0.0, first - lowest]);
    assert!(
        lowest > 0.1 && panels.plots.iter().flat_map(|p| &p.series).flat_map(|s| &s.points).all(|p| p[1] >= -1e-13)
    );
    let files: Vec<String> = riemap::app::experiment::summarise(&config, folder.path())
        .unwrap()
        .files
        .iter()
        .map(|file| file.file_name().unwrap().to_string_lossy().into_owned())
        .collect();
    for name in ["study-convergence.svg", "study-convergence-timings.svg", "study-convergence.png"] {
        assert!(files.contains(&name.to_owned()), "{files:?}");
    }
    let svg = fs::read_to_string(folder.path().join("figures/study-convergence.svg")).unwrap();
    // Names once in the legend, axes once for all panels.
    for (part, times) in [(">fletcher-reeves<", 1), (">iteration<", 1), (">E − E*<", 1), ("H + L, n = 7", 1)] {
        assert_eq!(svg.matches(part).count(), times, "{part}");
    }
    assert!(roxmltree::Document::parse(&svg).is_ok());
    // A sweep without solvers: its last key is in the legend. Without a sweep: the backend.
    let figures = "[figures]\nconvergence = { x = \"iteration\", y = \"gradient_norm\" }\n";
    for (sweep, labels) in [("[sweep]\n\"map.fix\" = [2, 3]\n", &["fix = 2", "fix = 3"][..]), ("", &["reduced"])] {
        let (_folder, config, records) = run(&format!("{PLANE}{sweep}{figures}"));
        let panels = config.plots["convergence"].plot(&records);
        assert_eq!(panels.plots[0].series.iter().map(|s| s.label.as_str()).collect::<Vec<_>>(), labels);
    }
}

#[test]
fn what_is_left_out_is_said_below_the_table() {
    let (_folder, config, records) = run(SWEEP);
    let markdown = table(&config, &records, false).unwrap();
    assert!(markdown.ends_with("\nLeft out: energy H + L, name reduced: it does not reduce\n"), "{markdown}");
}

#[test]
fn figures_and_left_out_runs_that_make_no_sense_are_refused_with_their_line() {
    let refused = |text: &str, parts: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("study.toml");
        fs::write(&path, format!("{PLANE}{text}")).unwrap();
        let Err(error) = Config::load(&path, &[]) else { panic!("taken: {text}") };
        for part in parts {
            assert!(error.to_string().contains(part), "no `{part}` in: {error}");
        }
    };
    let figure = |value: &str| format!("[figures]\nconvergence = {value}\n");
    refused(&figure("true"), &["study.toml:4", "x = \"iteration\""]);
    refused(
        &figure("{ x = \"iterations\", y = \"total\" }"),
        &["study.toml:4", "`iterations`", "`iteration`", "`seconds`"],
    );
    refused(&figure("{ x = \"iteration\", y = \"E\" }"), &["study.toml:4", "`E`", "`excess`"]);
    refused(&figure("{ x = \"iteration\" }"), &["study.toml:4", "`y`"]);
    let twice = "{ x = \"iteration\", y = \"total\" }";
    refused(&figure(&format!("[{twice}, {twice}]")), &["study.toml:", "the same name"]);
    refused("[[without]]\nruns = { \"map.fix\" = 3 }\nbecause = \"x\"\n", &["study.toml:3", "`map.fix`", "not swept"]);
    refused("[[without]]\nruns = {}\n", &["study.toml:3", "`because`"]);
}
