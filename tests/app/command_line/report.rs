//! The JSON report.

use serde_json::Value;

use super::shell::{Shell, hill};

fn report(shell: &Shell, arguments: &[&str]) -> Value {
    shell.done(&[&["map", "--boundary", "fixed", "--quiet", "--report", "r.json"], arguments].concat());
    serde_json::from_str(&shell.read("r.json")).unwrap()
}

/// The fields of interface.md: `n` a finite number, `?` such a number or null, `u` a count, `b`, `s`.
const FIELDS: &str = "
    input.path:s input.kind:s input.vertices:u input.faces:u input.boundary_loops:u input.euler:n input.genus:u
    quad_graph.vertices:u quad_graph.quads:u quad_graph.boundary_vertices:u quad_graph.min_re_rho:n quad_graph.clamped:u
    energy.total:? energy.H:? energy.C:? energy.A:? energy.L:? energy.Lb:?
    solver.backend:s solver.status:s solver.valid:b solver.repaired:b solver.iterations:u solver.gradient_norm:?
    solver.seconds.read:n solver.seconds.assemble:n solver.seconds.order:n solver.seconds.factor:n solver.seconds.solve:n
    solver.seconds.total:n
    solver.smallest_singular_value:?
    distortion.quasi_conformal.median:n distortion.quasi_conformal.p90:n distortion.quasi_conformal.without_ears:n
    distortion.quasi_conformal.mean:n distortion.quasi_conformal.area_mean:n distortion.quasi_conformal.p99:n
    distortion.quasi_conformal.max:n distortion.area.mean:n distortion.area.max:n distortion.symmetric_dirichlet:n
    distortion.rho_residual.mean:n distortion.rho_residual.max:n distortion.length.mean:n distortion.length.max:n
    distortion.flipped:u distortion.boundary_crosses:b distortion.boundary_out_of_order:u";

#[test]
fn every_field_is_there_with_its_type() {
    let shell = Shell::new();
    shell.write("t.obj", hill(6, 1.0, false));
    shell.write("q.obj", hill(6, 1.0, true));
    for arguments in [&["t.obj"][..], &["q.obj"], &["t.obj", "--dual", "circumcentre"], &["enneper?n=8"]] {
        let report = report(&shell, arguments);
        for field in FIELDS.split_whitespace() {
            let (path, kind) = field.split_once(':').unwrap();
            let value = report.pointer(&format!("/{}", path.replace('.', "/")));
            let value = value.unwrap_or_else(|| panic!("{arguments:?} has no {path}"));
            let fits = match kind {
                "n" => value.is_f64() || value.is_i64(),
                "?" => value.is_number() || value.is_null(),
                "u" => value.is_u64(),
                "b" => value.is_boolean(),
                _ => value.is_string(),
            };
            assert!(fits, "{arguments:?} {path}: {value}");
        }
        // Not of this map.
        for path in ["/periods/tau", "/energy/C", "/energy/A", "/energy/L", "/energy/Lb"] {
            assert!(report.pointer(path).is_none_or(Value::is_null), "{path}");
        }
    }
}

#[test]
fn its_values_are_those_of_the_map() {
    let shell = Shell::new();
    shell.write("t.obj", hill(6, 1.0, false));
    let report = report(&shell, &["t.obj"]);
    let number = |path: &str| report.pointer(path).and_then(Value::as_f64).unwrap();
    assert_eq!((&report["input"]["path"], &report["input"]["kind"]), (&"t.obj".into(), &"triangle".into()));
    for (path, value) in [
        ("/input/vertices", 36),
        ("/input/faces", 50),
        ("/input/boundary_loops", 1),
        ("/input/euler", 1),
        ("/input/genus", 0),
        // Vertices, faces and boundary edges; edges; twice the boundary edges: 2 (106 − 85) = 40 + 2.
        ("/quad_graph/vertices", 36 + 50 + 20),
        ("/quad_graph/quads", 85),
        ("/quad_graph/boundary_vertices", 40),
        ("/quad_graph/clamped", 0),
        ("/distortion/flipped", 0),
        ("/distortion/boundary_out_of_order", 0),
    ] {
        assert_eq!(number(path), f64::from(value), "{path}");
    }
    assert_eq!(report["riemap"]["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["solver"]["valid"], true);
    assert_eq!(report["distortion"]["boundary_crosses"], false);
    assert_eq!(number("/energy/total"), number("/energy/H"));
    assert!(number("/energy/H") > 0.0 && number("/energy/H") < 1.0);
    assert!(number("/quad_graph/min_re_rho") > 0.0);
    // The gradient vanishes at the minimum, to rounding.
    assert!(number("/solver/gradient_norm") < 1e-12);
    let errors = ["mean", "area_mean", "p99", "max"].map(|k| number(&format!("/distortion/quasi_conformal/{k}")));
    assert!(errors[0] >= 1.0 && errors[1] >= 1.0 && errors[0] < errors[3] && errors[2] <= errors[3]);
    for what in ["area", "length"] {
        let [mean, max] = ["mean", "max"].map(|k| number(&format!("/distortion/{what}/{k}")));
        assert!(1.0 < mean && mean < max, "{what}");
    }
    assert!(number("/distortion/symmetric_dirichlet") > 4.0);
    let phases =
        ["read", "assemble", "order", "factor", "solve", "total"].map(|k| number(&format!("/solver/seconds/{k}")));
    // Sums of readings of one clock.
    assert!(phases.iter().all(|s| *s >= 0.0) && phases[..5].iter().sum::<f64>() <= phases[5] + 1e-9);
}

#[test]
fn a_perfect_map_is_reported_as_perfect() {
    let shell = Shell::new();
    shell.write("m.obj", "v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nf 1 2 3 4\n");
    // A square on a square.
    let report = report(&shell, &["m.obj", "--shape", "square"]);
    for path in ["quasi_conformal/max", "area/max", "length/max"] {
        let value = report.pointer(&format!("/distortion/{path}")).and_then(Value::as_f64).unwrap();
        // A few roundings of quotients near 1.
        assert!((value - 1.0).abs() < 1e-14, "{path}: {value}");
    }
    assert!((report["distortion"]["symmetric_dirichlet"].as_f64().unwrap() - 4.0).abs() < 1e-13);
}

#[test]
fn folds_are_counted_reported_and_warned_of() {
    let shell = Shell::new();
    // A square with its centre, which is held outside.
    shell.write("m.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
    let arguments =
        ["map", "m.obj", "--boundary", "fixed", "--pin", "4=5,5", "--quiet", "--report", "r.json", "-o", "o.obj"];
    let ran = shell.run(&arguments);
    assert!(ran.code == 0 && ran.out.is_empty());
    assert!(ran.err.starts_with("riemap: warning: ") && ran.err.contains("flipped"), "{}", ran.err);
    let report: Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    let flipped = report["distortion"]["flipped"].as_u64().unwrap();
    assert!((1..4).contains(&flipped) && report["solver"]["valid"] == false);
    assert_eq!(report["distortion"]["boundary_crosses"], false);
}
