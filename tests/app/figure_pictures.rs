//! Figures of experiments: red faces, captions, sheets of several runs, small copies.

use std::fs;
use std::num::NonZeroUsize;
use std::path::Path;

use num_complex::Complex64;
use riemap::app::experiment::{self, Batch, Caption, Config, Outcome, Record, Scratch, Shard};
use riemap::app::measure::stopwatch::Stopwatch;
use riemap::distortion::{Image, corner_errors, face_maps};
use riemap::figure::{FlatMap, Format, MARK};
use riemap::input::Input;
use riemap::map::{self, MapOptions};
use serde_json::json;

/// Runs and sums up a config.
fn study(text: &str, results: &Path) -> Vec<Record> {
    let path = results.join("study.toml");
    fs::write(&path, text).unwrap();
    let config = Config::load(&path, &[]).unwrap();
    let configs = std::slice::from_ref(&config);
    let scratch = &Scratch::new(results, "program");
    let batch = Batch { configs, shard: Shard::ALL, threads: NonZeroUsize::MIN, apart: None, scratch };
    batch.run(&|| false, &mut |_| {}).unwrap();
    experiment::summarise(&config, results).unwrap().records
}

fn size(path: &Path) -> [u32; 2] {
    let reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    [reader.info().width, reader.info().height]
}

/// Pixels of [`MARK`] in a PNG of 8-bit RGB.
fn marked_pixels(path: &Path) -> usize {
    let mut reader = png::Decoder::new(std::io::BufReader::new(fs::File::open(path).unwrap())).read_info().unwrap();
    let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut rgb).unwrap();
    rgb.chunks_exact(3).filter(|p| **p == MARK.0).count()
}

#[test]
fn flat_faces_are_red_where_their_error_is_beyond_the_mark_and_grey_elsewhere() {
    let points: Vec<[f64; 2]> = (0..10).map(|i| [f64::from(i / 2), f64::from(i % 2)]).collect();
    let faces = (0..4).map(|i| [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1]).collect::<Vec<[u32; 4]>>();
    let faces = faces.iter().collect();
    let values = [1.0, 1.3, 1.2, f64::INFINITY];
    let map = |mark| FlatMap {
        points: &points,
        faces: &faces,
        values: &values,
        flipped: &[],
        mark,
        title: "",
        scale_label: "",
    };
    let svg = String::from_utf8(map(Some(1.25)).render(Format::Svg).unwrap()).unwrap();
    let fills = svg.lines().filter_map(|line| line.strip_prefix("<polygon fill=\"")).map(|line| &line[..7]);
    let red = MARK.to_string();
    let of_faces: Vec<bool> = fills.take(4).map(|fill| fill == red).collect();
    assert_eq!(of_faces, [false, true, false, true]);
    assert!(svg.contains("&gt; 1.25") && svg.contains("#f6f6f6"));
    for mark in [1.0, f64::NAN, f64::INFINITY] {
        assert!(map(Some(mark)).render(Format::Svg).unwrap_err().to_string().contains("above it"));
    }
}

#[test]
fn corner_errors_of_an_affine_map_are_its_own_and_see_angles_that_diagonals_do_not() {
    let input = Input::open("plane?n=3").unwrap();
    let mapped = map::map_input(&input, &MapOptions::default(), &mut Stopwatch::start()).unwrap();
    let (disc, graph) = (&mapped.domain.disc, &mapped.domain.graph);
    let errors = |f: &dyn Fn([f64; 3]) -> [f64; 2]| {
        let place = |p: &[f64; 3]| {
            let [x, y] = f(*p);
            Complex64::new(x, y)
        };
        let z: Vec<Complex64> = disc.positions.iter().map(place).collect();
        let image = Image::of_disc(&z);
        let maps = face_maps(disc, graph, &image);
        (corner_errors(disc, None, &image, &maps), maps)
    };
    // Rounding of a few operations on numbers of size 1.
    let (turned, _) = errors(&|[x, y, _]| [3.0 - y, x]);
    assert!(turned.iter().all(|e| (e - 1.0).abs() < 1e-12), "{turned:?}");
    let (stretched, _) = errors(&|[x, y, _]| [2.0 * x, y]);
    assert!(stretched.iter().all(|e| (e - 2.0).abs() < 1e-12), "{stretched:?}");
    let (mirrored, _) = errors(&|[x, y, _]| [-x, y]);
    assert!(mirrored.iter().all(|e| *e < 0.0), "{mirrored:?}");

    // A quad whose diagonals are kept while one slides along the other: σ1/σ2 = 1, the angles are others.
    let face = disc.faces.get(0);
    let mut z: Vec<Complex64> = disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect();
    let along = 0.3 * (z[face[2] as usize] - z[face[0] as usize]);
    z[face[1] as usize] += along;
    z[face[3] as usize] += along;
    let image = Image::of_disc(&z);
    let maps = face_maps(disc, graph, &image);
    assert!((maps[0].quasi_conformal() - 1.0).abs() < 1e-12);
    assert!(corner_errors(disc, None, &image, &maps)[0] > 1.5);
}

const FIGURE: &str = "[surface]\nsource = \"graph:cos+cos?n=9\"\n[map]\nenergy = \"H + C\"\nweight = \"unit\"\n[figures]\n\
    checkerboard = { squares = 8, side = 200 }\n";

#[test]
fn a_caption_has_the_numbers_of_the_report_and_a_key_that_is_not_there_fails_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let caption = "caption = \"E = {result.energy.total}[, A = {result.energy.A}]\"\n";
    let records = study(&format!("{FIGURE}{caption}"), folder.path());
    assert_eq!(records[0].outcome, Outcome::Done, "{:?}", records[0].error);
    let caption = Caption::parse("H is {result.energy.H}, {result.input.faces} quads, {config.map.weight}").unwrap();
    let filled = caption.filled(&json!({"config": records[0].config, "result": records[0].result})).unwrap();
    let h = records[0].result["energy"]["H"].as_f64().unwrap();
    let (mantissa, exponent) = filled[5..].split_once("×10⁻").unwrap();
    let exponent = exponent
        .split_once(',')
        .unwrap()
        .0
        .chars()
        .fold(0, |n, c| 10 * n + "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().position(|d| d == c).unwrap() as i32);
    // Three digits are printed.
    let printed: f64 = mantissa.parse::<f64>().unwrap() * 10f64.powi(-exponent);
    assert!((printed / h - 1.0).abs() < 5e-3, "{filled}, H = {h}");
    assert!(filled.ends_with(", 64 quads, unit"));

    for (wrong, part) in [("{result.energy.E}", "total"), ("{result.energy.A}", "no value")] {
        let record = &study(&format!("{FIGURE}caption = \"{wrong}\"\n"), folder.path())[0];
        assert_eq!(record.outcome, Outcome::Failed);
        assert!(record.error.as_ref().unwrap().contains(part), "{:?}", record.error);
    }
    let path = folder.path().join("wrong.toml");
    fs::write(&path, format!("{FIGURE}caption = \"{{a\"\n")).unwrap();
    assert!(Config::load(&path, &[]).err().unwrap().to_string().contains("wrong.toml:8"));
}

#[test]
fn a_sheet_holds_the_pictures_of_all_runs_and_has_a_small_copy() {
    let folder = tempfile::tempdir().unwrap();
    let marks = "mark = { above = 1.1, by = \"corners\" }\n[sweep]\n\"map.energy\" = [\"H + C\", \"H + Lb\", \"H + L\"]\n[sheet]\ncolumns = 2\n";
    let records = study(&format!("{FIGURE}{marks}"), folder.path());
    let figures = folder.path().join("figures");
    let panels: Vec<[u32; 2]> = records
        .iter()
        .map(|record| {
            let path = figures.join(&record.pictures[0]);
            // On the map, the colour bar, and the surface.
            let red = marked_pixels(&path) > 0;
            assert_eq!(red, record.result["marked"]["faces"] != 0, "{}", record.run);
            size(&path)
        })
        .collect();
    assert!(records.iter().any(|record| record.result["marked"]["faces"] != 0));
    let [first, second, third] = panels[..] else { panic!("{panels:?}") };
    let sheet = size(&figures.join("study.png"));
    assert_eq!(sheet, [first[0].max(third[0]) + second[0], first[1].max(second[1]) + third[1]]);
    let copy = figures.join("small/study.png");
    assert_eq!(size(&copy), [900, (f64::from(sheet[1]) * 900.0 / f64::from(sheet[0])).round() as u32]);
    assert!(fs::metadata(&copy).unwrap().len() < 200_000);
}
