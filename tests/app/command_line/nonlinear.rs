//! Circle and free maps: `--boundary`, `--energy`, `--fix`, `--keep-order`, `--tolerance`, `--max-iterations`, `--trace`.

use riemap::solver::MINIMISERS;
use serde_json::Value;

use super::shell::{Shell, distance, hill, texture};

fn report(shell: &Shell, arguments: &[&str]) -> Value {
    shell.done(&[&["map", "--quiet", "--report", "r.json"], arguments].concat());
    serde_json::from_str(&shell.read("r.json")).unwrap()
}

fn number(report: &Value, path: &str) -> f64 {
    report.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path}"))
}

/// Boundary vertices of an n × n [`hill`].
fn is_boundary(n: usize, v: usize) -> bool {
    let (i, j) = (v / n, v % n);
    i == 0 || j == 0 || i == n - 1 || j == n - 1
}

#[test]
fn a_map_is_onto_the_circle_unless_told_otherwise() {
    let shell = Shell::new();
    for quads in [false, true] {
        shell.write("m.obj", hill(7, 1.0, quads));
        let report = report(&shell, &["m.obj", "-o", "o.obj"]);
        assert_eq!(report["solver"]["backend"], "reduced");
        // Two circles would make the corners of these coarse quads reflex: their boundary is moved onto one.
        assert_eq!(report["solver"]["exactly"], if quads { "circle" } else { "conformal" });
        assert!(number(&report, "/solver/epsilon").abs() < 0.1);
        assert_eq!(report["solver"]["status"], "converged");
        assert!(number(&report, "/solver/smallest_singular_value") > 1e-3);
        assert!(report["energy"]["H"].is_number() && report["energy"]["C"].is_number());
        assert!(report["energy"]["L"].is_null() && report["energy"]["A"].is_null() && report["energy"]["Lb"].is_null());
        let sum = number(&report, "/energy/H") + number(&report, "/energy/C");
        assert!((sum / number(&report, "/energy/total") - 1.0).abs() < 1e-12);
        let uv = texture(&shell.read("o.obj"));
        for (v, [x, y]) in uv.iter().enumerate() {
            let near = (x.hypot(*y) - 1.0).abs() < 5e-2;
            assert!(near == is_boundary(7, v) || x.hypot(*y) < 1.0, "vertex {v} at {x}, {y}");
        }
        assert_eq!(uv, shell.uv("m.obj", &["--boundary", "circle"]));
        // Terms are added in the order given.
        let spelled = ["--boundary", "circle", "--energy", "C + H", "--fix", "3", "--solver", "auto"];
        // An energy of one's own is not repaired: on quads the boundary stays on two circles, 1 ± ε/2.
        let apart = if quads { number(&report, "/solver/epsilon").abs() } else { 1e-12 };
        assert!(distance(&uv, &shell.uv("m.obj", &spelled)) <= apart);
    }
}

#[test]
fn a_free_boundary_keeps_its_lengths() {
    let shell = Shell::new();
    shell.done(&["map", "graph:cos+cos?n=9", "--boundary", "fixed", "-o", "m.obj"]);
    let report = report(&shell, &["m.obj", "--boundary", "free", "-o", "o.obj"]);
    assert!(number(&report, "/energy/total") < 1e-12);
    assert!(number(&report, "/distortion/length/boundary_max") < 1e-9);
    assert!(report["distortion"]["boundary_out_of_order"].is_null());
    assert!(report["solver"]["smallest_singular_value"].is_null());
    let positions: Vec<Vec<f64>> = super::shell::numbers(&shell.read("m.obj"), "v ").collect();
    let uv = texture(&shell.read("o.obj"));
    for k in 0..8 {
        let (a, b) = (&positions[k], &positions[k + 1]);
        let rest = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt();
        let length = (uv[k][0] - uv[k + 1][0]).hypot(uv[k][1] - uv[k + 1][1]);
        assert!((length / rest - 1.0).abs() < 1e-9, "{k}");
    }
    let again = shell.uv("m.obj", &["--boundary", "free", "--energy", "H + Lb"]);
    assert_eq!(again, uv);
}

#[test]
fn energies_have_any_coefficients() {
    let shell = Shell::new();
    shell.write("m.obj", hill(6, 1.0, false));
    for energy in ["H + L", "H + 0.5 L + A", "2H+1e-3L", "H + 0.5*L + .1 A + 1e1 Lb", "1.5e+0 H + L"] {
        let report = report(&shell, &["m.obj", "--boundary", "free", "--energy", energy]);
        let parsed: riemap::energy::Expression = energy.parse().unwrap();
        let sum: f64 = parsed
            .terms()
            .iter()
            .map(|t| t.coefficient * number(&report, &format!("/energy/{}", t.energy.name())))
            .sum();
        assert!((sum / number(&report, "/energy/total") - 1.0).abs() < 1e-12, "{energy}");
    }
}

#[test]
fn every_iterative_backend_makes_the_same_circle_map() {
    let shell = Shell::new();
    shell.write("m.obj", hill(6, 1.0, true));
    let by_default = ["--boundary", "circle", "--solver", MINIMISERS[0].name()];
    let reference = shell.uv("m.obj", &by_default);
    for backend in MINIMISERS {
        let options = ["--boundary", "circle", "--solver", backend.name(), "--tolerance", "1e-9"];
        let apart = distance(&shell.uv("m.obj", &options), &reference);
        // The gradient is down to 1e-9, the singular values above 1e-2.
        assert!(apart < 1e-5, "{}: {apart:e}", backend.name());
    }
}

#[test]
fn an_end_that_was_set_is_written_and_said_and_one_that_was_not_is_an_error() {
    let shell = Shell::new();
    shell.write("m.obj", hill(7, 1.0, true));
    let arguments = ["map", "m.obj", "--boundary", "free", "--energy", "H + L", "--max-iterations", "2", "-o", "o.obj"];
    let ran = shell.run(&[&arguments[..], &["--report", "r.json"]].concat());
    assert_eq!(ran.code, 3, "{}", ran.err);
    assert!(ran.err.contains("riemap: warning: not converged after 2 iterations"), "{}", ran.err);
    let report: Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert_eq!((&report["solver"]["status"], &report["solver"]["iterations"]), (&"max-iterations".into(), &2.into()));
    for tolerance in ["0", "-1", "1", "nan", "inf"] {
        let ran = shell.run(&["map", "m.obj", &format!("--tolerance={tolerance}"), "-o", "p.obj"]);
        assert!(ran.code == 2 && ran.err.contains("tolerance"), "{}", ran.err);
    }
}

#[test]
fn a_trace_has_a_line_an_iteration_with_a_falling_residual() {
    let shell = Shell::new();
    shell.write("m.obj", hill(7, 1.0, false));
    let report = report(&shell, &["m.obj", "--trace", "t.csv"]);
    let text = shell.read("t.csv");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("iteration,total,H,C,gradient_norm,step,seconds"));
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|x| x.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len() as u64, report["solver"]["iterations"].as_u64().unwrap() + 1);
    for (k, row) in rows.iter().enumerate() {
        assert_eq!((row.len(), row[0]), (7, k as f64));
        assert!((row[2] + row[3] - row[1]).abs() <= 1e-13 * row[1]);
    }
    // Newton's method lowers the residual of the equations of the two circles.
    assert!(rows.windows(2).all(|w| w[1][4] <= w[0][4] && w[1][6] >= w[0][6]));
    assert!((rows[rows.len() - 1][1] - number(&report, "/energy/total")).abs() <= 1e-12 * rows[0][1]);
}

#[test]
fn options_that_change_nothing_are_noted() {
    let shell = Shell::new();
    shell.write("m.obj", hill(5, 1.0, true));
    for (options, words) in [
        (&["--boundary", "free", "--energy", "H + C"][..], "--boundary free has no effect"),
        (&["--boundary", "circle", "--energy", "H + L"], "--boundary circle has no effect"),
        (&["--boundary", "fixed", "--tolerance", "0.1"], "--tolerance has no effect"),
        (&["--dual", "incentre"], "--dual has no effect"),
    ] {
        let ran = shell.run(&[&["map", "m.obj"], options].concat());
        assert!(ran.code == 0 && ran.err.contains(words), "{options:?}: {}", ran.err);
    }
}

#[test]
fn two_fixed_points_are_warned_of() {
    let shell = Shell::new();
    let ran = shell.run(&["map", "graph:cos+cos?n=9", "--fix", "2"]);
    assert_eq!(ran.code, 0);
    assert!(ran.err.contains("two pinned points") && ran.err.contains("--fix 3"), "{}", ran.err);
    assert!(!shell.run(&["map", "graph:cos+cos?n=9"]).err.contains("pinned points"));
}

#[test]
fn a_staircase_is_warned_of_and_can_be_kept_in_order() {
    let shell = Shell::new();
    // A grid of 9 × 9 cells without steps of 1 to 3 cells at its corners.
    let (n, mut text) = (10u32, String::new());
    for v in 0..n * n {
        text += &format!("v {} {} {}\n", v / n, v % n, 0.05 * f64::from(v / n) * f64::from(v % n));
    }
    for c in 0..81u32 {
        let (i, j) = (c / 9, c % 9);
        let from_corner = i.min(8 - i) + j.min(8 - j);
        if from_corner >= 3 {
            let a = i * n + j + 1;
            text += &format!("f {a} {} {} {}\n", a + n, a + n + 1, a + 1);
        }
    }
    shell.write("m.obj", text);
    let plain = shell.run(&["map", "m.obj", "--valid", "off", "--report", "r.json"]);
    let report: Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert!(number(&report, "/distortion/boundary_out_of_order") > 0.0);
    assert!(
        plain.code == 0 && plain.err.contains("out of order") && plain.err.contains("--keep-order"),
        "{}",
        plain.err
    );
    let kept = shell.run(&["map", "m.obj", "--valid", "off", "--keep-order", "--report", "r.json"]);
    let report: Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert_eq!(number(&report, "/distortion/boundary_out_of_order"), 0.0);
    assert!(kept.code == 0 && !kept.err.contains("out of order"), "{}", kept.err);
    // By default a map without flipped faces replaces it, and a note says so.
    let valid = shell.run(&["map", "m.obj", "--report", "r.json"]);
    let report: Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert!(valid.code == 0 && valid.err.contains("the conformal map had"), "{}", valid.err);
    assert_eq!((&report["solver"]["valid"], &report["solver"]["repaired"]), (&true.into(), &true.into()));
}

#[test]
fn contradictions_are_refused_with_what_would_do() {
    let shell = Shell::new();
    shell.write("m.obj", hill(5, 1.0, true));
    for (options, words) in [
        (&["--energy", "H"][..], &["--boundary fixed"][..]),
        (&["--boundary", "free", "--energy", "H"], &["--boundary fixed"]),
        (&["--solver", "lu"], &["`lu`", "levenberg-marquardt"]),
        (&["--boundary", "fixed", "--solver", "lbfgs"], &["lbfgs"]),
        (&["--boundary", "free", "--keep-order"], &["--keep-order", "--boundary circle"]),
        (&["--pin", "0=1,0", "--pin", "4=-1,0", "--pin", "24=0,1", "--pin", "20=0,-1"], &["out of order"]),
        (&["--pin", "25=1,0"], &["vertex 25"]),
        (&["--pin", "0=3,0"], &["vertex 0", "at distance 3"]),
        (&["--pin", "12=1,0"], &["vertex 12", "not on the boundary"]),
        (&["--boundary", "free", "--fix", "2"], &["--fix", "--boundary circle"]),
        (&["--shape", "square"], &["--boundary fixed"]),
        (&["--energy", "Lb"], &["undetermined"]),
        (&["--energy", "0 H"], &["undetermined"]),
        (&["--boundary", "fixed", "--trace", "t.csv"], &["nonlinear"]),
    ] {
        let message = shell.refused(&[&["map", "m.obj", "-o", "o.obj"], options].concat());
        assert!(words.iter().all(|word| message.contains(word)), "{options:?}: {message}");
    }
}

#[test]
fn circle_and_free_maps_do_not_depend_on_the_unit_of_length() {
    let shell = Shell::new();
    for boundary in ["circle", "free"] {
        shell.write("m.obj", hill(6, 1.0, true));
        let reference = shell.uv("m.obj", &["--boundary", boundary]);
        for scale in [1e-20, 1e-3, 1e3, 1e20] {
            shell.write("m.obj", hill(6, scale, true));
            let uv = shell.uv("m.obj", &["--boundary", boundary]);
            let unit = if boundary == "circle" { 1.0 } else { scale };
            let uv: Vec<[f64; 2]> = uv.iter().map(|p| p.map(|x| x / unit)).collect();
            // The gradient is down to 1e-10; digits of the positions differ in the last place.
            let apart = distance(&uv, &reference);
            assert!(apart < 1e-7, "{boundary} {scale:e}: {apart:e}");
        }
    }
}

#[test]
fn the_smallest_discs_are_mapped_to_the_circle_and_freely() {
    let shell = Shell::new();
    let square = "v 0 0 0\nv 1 0 0\nv 1.5 1 0\nv 0 1.2 0\n";
    for faces in ["f 1 2 3\n", "f 1 2 3\nf 1 3 4\n", "f 1 2 3 4\n"] {
        shell.write("m.obj", format!("{square}{faces}"));
        for boundary in ["circle", "free"] {
            for weight in ["integral", "unit"] {
                let options = ["--boundary", boundary, "--weight", weight];
                let uv = shell.uv("m.obj", &options);
                assert!(uv.iter().flatten().all(|x| x.is_finite()), "{faces} {options:?}");
            }
        }
    }
}

#[test]
fn slivers_come_to_an_end() {
    let shell = Shell::new();
    let mut strip = String::new();
    for i in 0..20 {
        strip += &format!("v {i} 0 0\nv {i} 1e-9 0\n");
    }
    for a in (1..39).step_by(2) {
        strip += &format!("f {a} {} {}\nf {a} {} {}\n", a + 2, a + 3, a + 3, a + 1);
    }
    let needle = "v 0 0 0\nv 1 0 0\nv .5 1e-14 0\nv .5 1 0\nf 1 2 3\nf 2 4 3\nf 4 1 3\n".to_owned();
    for mesh in [strip, needle] {
        shell.write("m.obj", mesh);
        for boundary in ["circle", "free"] {
            let ran = shell.run(&["map", "m.obj", "--boundary", boundary, "-o", "o.obj"]);
            // A map, or one clear error: no panic, no NaN.
            match ran.code {
                0 => assert!(texture(&shell.read("o.obj")).iter().flatten().all(|x| x.is_finite())),
                _ => assert!(ran.err.starts_with("riemap: error: "), "{}", ran.err),
            }
            println!("{boundary}: {} {}", ran.code, ran.err);
        }
    }
}

#[test]
fn a_flat_mesh_held_where_it_lies_keeps_its_place_under_metric_energies() {
    let shell = Shell::new();
    shell.done(&["map", "plane?n=8&mesh=quad", "--boundary", "fixed", "-o", "m.obj", "--quiet"]);
    let positions: Vec<[f64; 2]> = super::shell::numbers(&shell.read("m.obj"), "v ").map(|v| [v[0], v[1]]).collect();
    let lines = positions.iter().enumerate().map(|(v, p)| format!("{v} {:?} {:?}\n", p[0], p[1]));
    let disc = shell.uv("m.obj", &[]);
    let boundary: Vec<bool> = disc.iter().map(|p| p[0].hypot(p[1]) > 1.0 - 1e-12).collect();
    let held = lines.zip(&boundary).filter(|(_, on)| **on).map(|(line, _)| line);
    shell.write("places.txt", held.collect::<String>());
    // The start is the minimum, to rounding: nothing is left to reduce, and that is no failure.
    let uv = shell.uv("m.obj", &["--boundary", "fixed", "--positions", "places.txt", "--energy", "H + L"]);
    assert!(distance(&uv, &positions) < 1e-10);
}

#[test]
fn what_valid_maps_are_promised_for_is_said_where_they_are_not() {
    let shell = Shell::new();
    shell.write("m.obj", hill(5, 1.0, false));
    shell.write("l.txt", format!("factors\n{}", "1\n".repeat(16)));
    let free = ["--boundary", "free"];
    let folds = "rough?n=12&height=2&mesh=delaunay";
    // The surface, the options, what is said of them; nothing where they do what they say.
    for (surface, options, note) in [
        ("m.obj", &["--valid", "auto"][..], ""),
        ("m.obj", &["--valid", "best-qc"], ""),
        ("m.obj", &["--valid", "off"], ""),
        ("m.obj", &["--valid", "one-to-one"], "--valid one-to-one is the same as auto"),
        ("m.obj", &[&free[..], &["--valid", "one-to-one"]].concat(), ""),
        ("m.obj", &[&free[..], &["--valid", "one-to-one", "--energy", "MIPS"]].concat(), "minimum of --energy"),
        ("m.obj", &["--energy", "H + C", "--valid", "off"], ""),
        ("m.obj", &["--pin", "0=1,0", "--valid", "auto"], "--valid has no effect beside pins"),
        (
            "m.obj",
            &[&free[..], &["--boundary-lengths", "l.txt", "--valid", "auto"]].concat(),
            "beside --boundary-lengths",
        ),
        ("m.obj", &["--boundary", "fixed", "--valid", "auto"], "--valid has no effect on a fixed boundary"),
        ("m.obj", &["--boundary", "fixed", "--weights", "uniform", "--valid", "auto"], ""),
        ("torus?n=9", &["--boundary", "periodic", "--valid", "auto"], "--valid has no effect: a map with periods"),
        ("digital-cap?R=5", &["--valid", "auto"], ""),
        ("m.obj", &["--keep-order"], ""),
        (folds, &[], ""),
        (folds, &["--fix", "2"], ""),
        (folds, &["--keep-order"], "--keep-order has no effect"),
        (folds, &["--solver", "reduced"], "--solver has no effect"),
    ] {
        let ran = shell.run(&[&["map", surface, "--quiet"], options].concat());
        assert_eq!(ran.code, 0, "{surface} {options:?}: {}", ran.err);
        let said = ran.err.lines().any(|line| line.contains(if note.is_empty() { "no effect" } else { note }));
        assert_eq!(said, !note.is_empty(), "{surface} {options:?}: {}", ran.err);
    }
}
