//! The cotan equivalence: with circumcentres system (2) gives libigl's harmonic map.
//!
//! libigl itself is asked, in the environment that `riemap verify` makes; making it needs the network once, and the
//! error says what to do without one.

use std::path::{Path, PathBuf};

use riemap::app::compare::libigl::Environment;
use riemap::app::compare::verify::{Comparison, SURFACES, TOLERANCE, compare, cotan_map};
use riemap::app::experiment::data_folders;
use riemap::input::Input;
use riemap::solver::Silent;
use riemap::surface::topology::diagnosis::Diagnosis;

fn environment() -> Environment {
    Environment::ensure().unwrap_or_else(|error| panic!("{error}"))
}

fn comparison(source: &str, libigl: &Environment) -> Comparison {
    let input = Input::open(source).unwrap_or_else(|error| panic!("{error}"));
    let ours = cotan_map(&input.surface, &mut Silent).unwrap_or_else(|error| panic!("{source}: {error}"));
    compare(&ours, libigl).unwrap_or_else(|error| panic!("{source}: {error}"))
}

fn share_of_negative_weights(c: &Comparison) -> f64 {
    c.negative_weights as f64 / c.interior_edges as f64
}

#[test]
fn cotan_map_equals_libigl() {
    let libigl = environment();
    let rows: Vec<Comparison> = SURFACES.iter().map(|name| comparison(name, &libigl)).collect();
    for (name, row) in SURFACES.iter().zip(&rows) {
        assert!(row.is_equal() && row.difference <= 1e-9, "{name}: {:e}", row.difference);
    }
    let hard = |row: &&Comparison| row.vertices >= 20_000 && share_of_negative_weights(row) > 0.3;
    assert!(rows.iter().any(|row| hard(&row)), "none has 20 000 vertices and 30 % negative weights");
    assert!(rows.iter().any(|row| row.vertices >= 100_000));
}

#[test]
fn cotan_map_equals_libigl_on_public_meshes() {
    let Some(data) = data() else {
        eprintln!("no public data: set $RIEMAP_DATA to their folder");
        return;
    };
    let libigl = environment();
    let mut compared = 0;
    for path in meshes(&data) {
        let source = path.to_string_lossy();
        let Ok(input) = Input::open(&source) else { continue };
        let disc = Diagnosis::new(&input.surface).fatal().next().is_none();
        if !disc || input.surface.faces().arity() != Some(3) {
            continue;
        }
        let row = comparison(&source, &libigl);
        assert!(row.is_equal(), "{source}: {:e}", row.difference);
        compared += 1;
    }
    assert!(compared > 0, "no triangle disc in {}", data.display());
}

#[test]
fn a_map_that_is_not_the_same_is_told_apart() {
    let libigl = environment();
    let input = Input::open(SURFACES[1]).unwrap();
    let mut ours = cotan_map(&input.surface, &mut Silent).unwrap();
    assert!(compare(&ours, &libigl).unwrap().is_equal());
    let inner = (0..ours.disc.positions.len()).find(|&v| !ours.disc.boundary.contains(&(v as u32))).unwrap();
    let there = ours.map.z[inner];
    ours.map.z[inner].im += 2.0 * TOLERANCE;
    assert!(!compare(&ours, &libigl).unwrap().is_equal(), "one vertex is off by twice the tolerance");
    ours.map.z[inner].im = f64::NAN;
    assert!(!compare(&ours, &libigl).unwrap().is_equal(), "NaN is not equal to anything");
    ours.map.z[inner] = there;
    // A boundary vertex is handed to libigl as it is: what differs is the map inside.
    let boundary = ours.disc.boundary[0] as usize;
    ours.map.z[boundary].re += 1e-3;
    assert!(!compare(&ours, &libigl).unwrap().is_equal(), "the boundary has moved and the inside has not");
}

#[test]
fn verify_prints_json_with_a_member_for_every_mesh() {
    environment();
    let run = |meshes: &[&str]| {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_riemap"));
        let output = command.args(["verify", "--json"]).args(meshes).output().unwrap();
        (output.status.code(), serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap())
    };
    let (code, value) = run(&[SURFACES[0]]);
    let row = &value["meshes"][0];
    assert_eq!((code, &row["equal"], &row["mesh"]), (Some(0), &true.into(), &SURFACES[0].into()));
    assert!(row["difference"].as_f64().is_some_and(|d| d <= TOLERANCE) && value["libigl"].is_string());
    // A mesh that cannot be compared does not hide the others.
    let (code, value) = run(&["plane?n=4", SURFACES[0]]);
    assert_eq!(
        (code, &value["meshes"][0]["equal"], &value["meshes"][1]["equal"]),
        (Some(1), &false.into(), &true.into())
    );
    assert!(value["meshes"][0]["error"].as_str().is_some_and(|error| error.contains("triangle")));
}

/// The folder of public meshes, where there is one.
fn data() -> Option<PathBuf> {
    data_folders(std::env::var_os("RIEMAP_DATA")).into_iter().find(|folder| folder.is_dir())
}

/// All files of a folder and its folders, sorted.
fn meshes(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.into_iter().flat_map(|path| if path.is_dir() { meshes(&path) } else { vec![path] }).collect()
}
