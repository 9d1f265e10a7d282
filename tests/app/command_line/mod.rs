//! The command line as interface.md states it: what users and scripts rely on.

mod bench;
mod constraints;
mod digital;
mod documentation;
mod extremes;
mod nonlinear;
mod outputs;
mod refusals;
mod report;
mod schema;
mod shell;
mod solvers;
mod system;

use std::io::Read;
use std::process::Stdio;

use riemap::app::bench::{CASES, CONTESTANTS};
use riemap::constraint::Shape;
use riemap::energy::{ENERGIES, EnergyKind};
use riemap::quad_graph::dual::DUAL_POINTS;
use riemap::solver::convex::EDGE_WEIGHTS;
use riemap::solver::{LINEAR_SOLVERS, MINIMISERS};
use riemap::surface::generate::SURFACES;
use shell::{Shell, hill};

#[test]
fn wrong_usage_exits_with_2_and_shows_what_is_possible() {
    let shell = Shell::new();
    for (arguments, word) in [
        (&[][..], "Usage"),
        (&["map"], "<MESH>"),
        (&["frobnicate"], "frobnicate"),
        (&["map", "a.obj", "--frob"], "--frob"),
        (&["map", "a.obj", "--solver", "frob"], "cholesky"),
        (&["map", "a.obj", "--dual", "frob"], "barycentre"),
        (&["map", "a.obj", "--shape", "frob"], "circle"),
        (&["map", "a.obj", "--weight", "frob"], "integral"),
        (&["map", "a.obj", "--hold", "frob"], "primal"),
        (&["map", "a.obj", "--weights", "frob"], "mean-value"),
        (&["map", "a.obj", "--valid", "frob"], "best-qc"),
        (&["map", "a.obj", "--rho", "frob"], "normals"),
        (&["map", "a.obj", "--boundary", "frob"], "fixed"),
        (&["map", "a.obj", "--boundary", "frob"], "circle"),
        (&["map", "a.obj", "--boundary", "frob"], "free"),
        (&["map", "a.obj", "--solver", "frob"], "levenberg-marquardt"),
        (&["map", "a.obj", "--energy", "H + frob"], "frob"),
        (&["map", "a.obj", "--energy", "H + -1 L"], "-1"),
        (&["map", "a.obj", "--energy", "H + H"], "twice"),
        (&["map", "a.obj", "--energy", "H L"], "H L"),
        (&["map", "a.obj", "--energy", "H + inf L"], "inf"),
        (&["map", "a.obj", "--energy", "H +"], "H"),
        (&["map", "a.obj", "--energy", ""], "term"),
        (&["map", "a.obj", "--fix", "4"], "2..=3"),
        (&["map", "a.obj", "--fix", "1"], "2..=3"),
        (&["map", "a.obj", "--tolerance", "x"], "--tolerance"),
        (&["map", "a.obj", "--max-iterations=-1"], "--max-iterations"),
        (&["map", "a.obj", "--boundary-dual", "frob"], "midpoint"),
        (&["map", "a.obj", "--pin", "0=1"], "V=X,Y"),
        (&["map", "a.obj", "--pin", "-1=0,0"], "V=X,Y"),
        (&["map", "a.obj", "--pin", "0=nan,0"], "finite"),
        (&["info"], "<MESH>"),
    ] {
        let ran = shell.run(arguments);
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{arguments:?}");
        assert!(ran.err.contains(word), "{arguments:?}: {}", ran.err);
    }
}

#[test]
fn every_command_has_help() {
    let shell = Shell::new();
    for command in ["info", "map", "verify", "list"] {
        assert!(shell.done(&["--help"]).contains(command));
        assert!(shell.done(&[command, "--help"]).contains(&format!("riemap {command}")));
    }
    let options = "--output --boundary --energy --fix --keep-order --start --tolerance --max-iterations --trace --shape --positions --pin --hold --weights --valid --surrogate --weight --dual --boundary-dual --rho --solver \
                   --system --report --picture --texture --quiet";
    let help = shell.done(&["map", "--help"]);
    for option in options.split(' ') {
        assert!(help.contains(option), "{option}");
    }
    assert_eq!(shell.done(&["--version"]), format!("riemap {}\n", env!("CARGO_PKG_VERSION")));
}

#[test]
fn list_names_every_row_of_every_table() {
    let list = Shell::new().done(&["list"]);
    let names = LINEAR_SOLVERS.iter().map(|b| b.name()).chain(MINIMISERS.iter().map(|b| b.name()));
    let names = names.chain(EDGE_WEIGHTS.iter().map(|w| w.name));
    let names = names.chain(ENERGIES.iter().map(|row| row.name()));
    let names = names.chain(DUAL_POINTS.iter().map(|d| d.name())).chain(Shape::ALL.iter().map(|s| s.0));
    let names = names.chain(CASES.iter().map(|c| c.name)).chain(CONTESTANTS.iter().map(|c| c.name));
    for name in names {
        assert!(list.lines().any(|line| line.split_whitespace().next() == Some(name)), "{name}");
    }
    for surface in SURFACES {
        assert!(list.contains(&surface.synopsis()) && list.contains(surface.about), "{}", surface.name);
    }
}

#[test]
fn info_tells_what_a_surface_is_and_whether_it_can_be_mapped() {
    let shell = Shell::new();
    let say = |content: &str| {
        shell.write("m.obj", content);
        let ran = shell.run(&["info", "m.obj"]);
        assert_eq!(ran.code == 0, !ran.out.contains("Not ready"), "{}", ran.err);
        ran.out
    };
    let disc = say(&hill(4, 1.0, false));
    for words in ["triangle mesh", "16 vertices", "33 edges", "18 faces", "1 boundary loop of 12 edges", "genus 0"] {
        assert!(disc.contains(words), "{words}: {disc}");
    }
    assert!(disc.ends_with("A disc: ready for `riemap map`.\n"), "{disc}");
    assert!(say(&hill(4, 1.0, true)).contains("quad mesh"));

    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    for (mesh, words) in [
        (tetrahedron.to_owned(), "closed"),
        (tetrahedron.replace("f 3 1 4", "f 1 3 4"), "1 face was oriented against"),
        (format!("{tetrahedron}v 9 9 9\n"), "1 vertex belongs to no face: vertex 4"),
        (format!("{tetrahedron}v 2 2 2\nf 1 2 5\n"), "the edge 0–1 has 3 faces"),
        (format!("{}v 9 9 9\nv 8 9 9\nv 9 8 9\nf 17 18 19\n", hill(4, 1.0, false)), "2 connected components"),
        ("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".to_owned(), "1 face has no area: face 0"),
        ("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nf 1 2 3 4\nf 3 5 4\n".to_owned(), "face 1"),
    ] {
        let out = say(&mesh);
        assert!(out.contains(words) && out.contains("→") && out.contains("Not ready"), "{words}: {out}");
    }
}

#[test]
fn a_reader_that_has_enough_is_no_error() {
    let shell = Shell::new();
    shell.write("m.obj", hill(4, 1.0, false));
    for arguments in
        [&["list"][..], &["info", "m.obj"], &["map", "m.obj"], &["map", "m.obj", "--system", "/dev/stdout"]]
    {
        let mut child = shell.command(arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let mut err = String::new();
        child.stderr.take().unwrap().read_to_string(&mut err).unwrap();
        assert!(child.wait().unwrap().success() && err.is_empty(), "{arguments:?}: {err}");
    }
}
