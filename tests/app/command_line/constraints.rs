//! Where the boundary goes: `--shape`, `--positions`, `--pin`, `--hold`.

use super::shell::{Shell, distance, hill};

/// Boundary vertices of an n × n [`hill`].
fn is_boundary(n: usize, v: usize) -> bool {
    let (i, j) = (v / n, v % n);
    i == 0 || j == 0 || i == n - 1 || j == n - 1
}

#[test]
fn the_square_has_its_corners_and_the_boundary_lies_on_it() {
    let shell = Shell::new();
    for quads in [false, true] {
        shell.write("m.obj", hill(7, 1.0, quads));
        let uv = shell.uv("m.obj", &["--shape", "square"]);
        for corner in [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]] {
            assert_eq!(uv.iter().filter(|p| **p == corner).count(), 1, "{corner:?}");
        }
        for (v, [x, y]) in uv.iter().enumerate() {
            let on_side = x.abs().max(y.abs());
            // Interpolation between corners rounds.
            assert_eq!(is_boundary(7, v), (on_side - 1.0).abs() < 1e-15, "vertex {v} at {x}, {y}");
        }
    }
}

#[test]
fn pins_hold_inner_and_boundary_vertices_once() {
    let shell = Shell::new();
    shell.write("m.obj", hill(7, 1.0, false));
    let free = shell.uv("m.obj", &[]);
    let pinned = shell.uv("m.obj", &["--pin", "24=0.1,-0.2", "--pin", "0= 1.5 , 2e0"]);
    let twice = ["map", "m.obj", "--boundary", "fixed", "--pin", "0=9,9", "--pin", "0=1,1"];
    assert!(shell.refused(&twice).contains("vertex 0 is pinned twice"));
    assert_eq!((pinned[24], pinned[0]), ([0.1, -0.2], [1.5, 2.0]));
    // Everything else on the boundary stays.
    assert!((1..49).filter(|&v| is_boundary(7, v)).all(|v| pinned[v] == free[v]));
    assert!(shell.refused(&["map", "m.obj", "--boundary", "fixed", "--pin", "49=0,0"]).contains("vertex 49"));
    assert!(shell.refused(&["map", "m.obj", "--boundary", "fixed", "--pin", "4=1e308,0"]).contains("vertex 4"));
}

#[test]
fn positions_hold_what_they_list() {
    let shell = Shell::new();
    shell.write("m.obj", hill(5, 1.0, true));
    let place = |v: usize| [(v / 5) as f64 * 2.0, (v % 5) as f64 * 3.0 - 1.0];
    let lines = (0..25).filter(|&v| is_boundary(5, v)).map(|v| format!("{v} {} {}\n", place(v)[0], place(v)[1]));
    let text = format!("# vertex x y\n\n{}", lines.collect::<String>().replacen('\n', " # the first\r\n", 1));
    shell.write("places.txt", &text);
    let uv = shell.uv("m.obj", &["--positions", "places.txt"]);
    assert!((0..25).filter(|&v| is_boundary(5, v)).all(|v| uv[v] == place(v)));

    for (bad, words) in [
        (format!("{text}7 1\n"), &["line 19", "7 1"][..]),
        (format!("{text}7 1 x\n"), &["line 19", "7 1 x"]),
        (format!("{text}7 1 nan\n"), &["line 19", "nan"]),
        (format!("{text}-7 1 1\n"), &["line 19", "-7"]),
        (format!("{text}\n0 1 1\n"), &["line 20", "vertex 0", "line 3"]),
        (format!("{text}25 1 1\n"), &["vertex 25"]),
        ("0 0 0\n1 0 1\n".to_owned(), &["2 vertices held"]),
        (String::new(), &["0 vertices held"]),
    ] {
        shell.write("bad.txt", bad);
        let message = shell.refused(&["map", "m.obj", "--boundary", "fixed", "--positions", "bad.txt", "-o", "o.obj"]);
        assert!(words.iter().all(|word| message.contains(word)), "{words:?}: {message}");
    }
    assert!(shell.refused(&["map", "m.obj", "--boundary", "fixed", "--positions", "none.txt"]).contains("none.txt"));
}

#[test]
fn boundary_lengths_of_a_file_are_met_and_reported() {
    let shell = Shell::new();
    shell.write("m.obj", hill(5, 1.0, true));
    let map = ["map", "m.obj", "--boundary-lengths", "lengths.txt", "-o", "o.obj", "--report", "r.json"];
    let free = |extra: &[&'static str]| [&map[..], &["--boundary", "free"], extra].concat();
    shell.write("lengths.txt", format!("# a square, each side half as long\nfactors\n{}", "0.5\n".repeat(16)));
    assert!(shell.done(&free(&[])).contains("16 boundary edges, given by factors"));
    let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    let lengths = &report["boundary_lengths"];
    assert_eq!((&lengths["given"], &lengths["edges"]), (&"factors".into(), &16.into()));
    assert!(lengths["error"]["max"].as_f64().unwrap() < 1e-8, "{lengths}");

    assert!(shell.refused(&map).contains("--boundary free"));
    for (bad, words) in [
        ("1\n".repeat(15), &["15 boundary lengths", "16 edges"][..]),
        ("1\nx\n".to_owned(), &["lengths.txt, line 2", "x"]),
        ("0 1 1\n".to_owned(), &["has no length", "16 edges"]),
        ("6 7 1\n".to_owned(), &["6 7", "no boundary edge"]),
        (format!("{}100\n", "1\n".repeat(15)), &["100", "15", "no polygon"]),
    ] {
        shell.write("lengths.txt", bad);
        let message = shell.refused(&free(&[]));
        assert!(words.iter().all(|word| message.contains(word)), "{words:?}: {message}");
    }
}

#[test]
fn a_flat_mesh_held_where_it_lies_is_mapped_to_itself() {
    let shell = Shell::new();
    for kind in ["quad", "triangle", "delaunay"] {
        let name = format!("plane?n=8&mesh={kind}");
        shell.done(&["map", &name, "-o", "m.obj", "--quiet"]);
        let positions: Vec<[f64; 2]> =
            super::shell::numbers(&shell.read("m.obj"), "v ").map(|v| [v[0], v[1]]).collect();
        let disc = shell.uv("m.obj", &[]);
        let boundary = (0..disc.len()).filter(|&v| disc[v][0].hypot(disc[v][1]) > 1.0 - 1e-12);
        let lines = boundary.map(|v| format!("{v} {:?} {:?}\n", positions[v][0], positions[v][1]));
        shell.write("places.txt", lines.collect::<String>());
        for dual in ["barycentre", "incentre"] {
            let uv = shell.uv("m.obj", &["--positions", "places.txt", "--dual", dual]);
            // The identity is conformal: rounding of a well-conditioned system of some 300 unknowns.
            assert!(distance(&uv, &positions) < 1e-12, "{kind} {dual}: {}", distance(&uv, &positions));
        }
    }
}

#[test]
fn every_way_to_weight_and_to_place_dual_vertices_gives_a_map() {
    let shell = Shell::new();
    shell.write("t.obj", hill(6, 1.0, false));
    let plain = shell.uv("t.obj", &[]);
    for options in [
        &["--boundary", "fixed", "--shape", "circle", "--weight", "integral", "--hold", "whole"][..],
        &["--dual", "barycentre", "--boundary-dual", "midpoint", "--rho", "positions", "--solver", "auto"],
    ] {
        assert_eq!(shell.uv("t.obj", options), plain, "{options:?} are the defaults");
    }
    for options in [
        &["--weight", "unit"][..],
        &["--hold", "primal"],
        &["--dual", "incentre"],
        &["--dual", "circumcentre"],
        &["--dual", "circumcentre", "--boundary-dual", "foot"],
    ] {
        let uv = shell.uv("t.obj", options);
        let apart = distance(&uv, &plain);
        // Another discretisation of the same map on a coarse mesh.
        assert!(apart > 1e-6 && apart < 0.2, "{options:?}: {apart}");
    }
}
