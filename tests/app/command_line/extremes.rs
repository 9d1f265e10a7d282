//! Inputs at the edges: the smallest, the largest, the thinnest, and none at all.

use super::shell::{Shell, distance, hill, texture};

#[test]
fn the_smallest_discs_are_mapped() {
    let shell = Shell::new();
    let square = "v 0 0 0\nv 1 0 0\nv 1.5 1 0\nv 0 1.2 0\n";
    for (faces, kept) in [("f 1 2 3\n", 3), ("f 1 2 3\nf 1 3 4\n", 4), ("f 1 2 3 4\n", 4)] {
        shell.write("m.obj", format!("{square}{faces}"));
        for dual in ["barycentre", "circumcentre", "incentre"] {
            for hold in ["whole", "primal"] {
                let arguments =
                    ["map", "m.obj", "--boundary", "fixed", "--dual", dual, "--hold", hold, "--quiet", "-o", "o.obj"];
                if (dual, hold) == ("circumcentre", "whole") && !faces.contains('4') {
                    // The angle across from the longest edge is obtuse or right.
                    assert!(shell.refused(&arguments).contains("Re ρ"));
                    continue;
                }
                if shell.run(&arguments).code != 0 {
                    assert_eq!((dual, hold), ("circumcentre", "whole"), "{faces}");
                    continue;
                }
                let uv = texture(&shell.read("o.obj"));
                // All vertices are on the boundary, and so on the circle.
                assert!(uv[..kept].iter().all(|p| (p[0].hypot(p[1]) - 1.0).abs() < 1e-15), "{faces} {dual} {hold}");
            }
        }
    }
}

#[test]
fn maps_do_not_depend_on_the_unit_of_length_and_units_out_of_range_are_refused() {
    let shell = Shell::new();
    for quads in [false, true] {
        shell.write("m.obj", hill(6, 1.0, quads));
        let reference = shell.uv("m.obj", &[]);
        for scale in [1e-55, 1e-20, 1e20, 1e55] {
            shell.write("m.obj", hill(6, scale, quads));
            let apart = distance(&shell.uv("m.obj", &["--picture", "p.svg"]), &reference);
            // The digits of the positions differ in the last place.
            assert!(apart < 1e-12, "{scale:e}: {apart:e}");
        }
        for scale in [1e-310, 1e-200, 1e-100, 1e77, 1e100, 1e200, 1e300] {
            shell.write("m.obj", hill(6, scale, quads));
            let message = shell.refused(&["map", "m.obj", "-o", "o.obj", "--report", "r.json"]);
            assert!(message.contains("extends over") && message.contains("scale"), "{scale:e}: {message}");
            let info = shell.run(&["info", "m.obj"]);
            assert!(info.code == 1 && info.out.contains("Not ready"), "{scale:e}: {}", info.out);
        }
    }
}

#[test]
fn garbage_is_refused_by_its_line() {
    let shell = Shell::new();
    let mut state = 1u64;
    let bytes: Vec<u8> = (0..20_000_000)
        .map(|_| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 56) as u8
        })
        .collect();
    for (name, place) in [("g.obj", "line "), ("g.off", "line "), ("g.ply", "line "), ("g.stl", "byte ")] {
        shell.write(name, &bytes);
        for command in ["info", "map"] {
            let message = shell.refused(&[command, name]);
            let said = message.strip_prefix(&format!("{name}, "));
            assert!(said.is_some_and(|m| m.starts_with(place)) && message.len() < 500, "{message}");
        }
        std::fs::remove_file(shell.path(name)).unwrap();
    }
}

#[test]
fn faces_without_area_are_refused_with_advice_and_mapped_by_a_surrogate() {
    let shell = Shell::new();
    // A square with a vertex in the middle of a side of its diagonal, and one more at the place of a corner.
    let mesh = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .5 0\nv 1 1 0\nf 1 2 3\nf 1 3 5\nf 1 5 4\nf 5 3 4\nf 2 6 3\n";
    shell.write("m.obj", mesh);
    let message = shell.refused(&["map", "m.obj", "-o", "o.obj", "--report", "r.json"]);
    assert!(message.contains("2 faces have no area: face 1") && message.contains("--surrogate"), "{message}");
    assert!(shell.run(&["info", "m.obj"]).out.contains("--surrogate"));
    for height in ["--surrogate", "--surrogate=0.3"] {
        let ran = shell.run(&["map", "m.obj", height, "-o", "o.obj", "--report", "r.json"]);
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(ran.err.contains("2 faces have no area, the first is face 1"), "{}", ran.err);
        let written = shell.read("o.obj");
        let positions =
            |text: &str| text.lines().filter(|l| l.starts_with("v ")).map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(positions(&written), positions(mesh));
        let uv = texture(&written);
        let mut places: Vec<[u64; 2]> = uv.iter().map(|p| p.map(f64::to_bits)).collect();
        places.sort_unstable();
        places.dedup();
        assert_eq!(places.len(), 6, "vertices at one place in the plane");
        let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
        assert_eq!(report["solver"]["valid"], true);
        let surrogates = &report["input"]["surrogates"];
        assert_eq!((&surrogates["count"], &surrogates["faces"]), (&2.into(), &serde_json::json!([1, 4])));
    }
    for wrong in ["--surrogate=0", "--surrogate=2", "--surrogate=x", "--surrogate=nan"] {
        assert_eq!(shell.run(&["map", "m.obj", wrong]).code, 2, "{wrong}");
    }
    shell.write("w.obj", hill(4, 1.0, false));
    assert!(shell.run(&["map", "w.obj", "--surrogate"]).err.contains("no effect"));
}

#[test]
fn slivers_are_mapped_and_what_folds_is_warned_of() {
    let shell = Shell::new();
    // A strip of 38 triangles, 1e9 times as long as wide.
    let mut strip = String::new();
    for i in 0..20 {
        strip += &format!("v {i} 0 0\nv {i} 1e-9 0\n");
    }
    for a in (1..39).step_by(2) {
        strip += &format!("f {a} {} {}\nf {a} {} {}\n", a + 2, a + 3, a + 3, a + 1);
    }
    // A triangle of height 1e-14 on the edge of another.
    let needle = "v 0 0 0\nv 1 0 0\nv .5 1e-14 0\nv .5 1 0\nf 1 2 3\nf 2 4 3\nf 4 1 3\n".to_owned();
    for mesh in [strip, needle] {
        shell.write("m.obj", mesh);
        for dual in ["barycentre", "incentre", "circumcentre"] {
            let ran = shell.run(&[
                "map",
                "m.obj",
                "--boundary",
                "fixed",
                "--dual",
                dual,
                "-o",
                "o.obj",
                "--report",
                "r.json",
            ]);
            assert_eq!(ran.code, 0, "{dual}: {}", ran.err);
            // A vertex 1e-14 from the boundary may cross it by the error of so coarse a mesh, no farther.
            assert!(texture(&shell.read("o.obj")).iter().all(|p| p[0].hypot(p[1]) < 1.2), "{dual}");
            let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
            assert_eq!(report["distortion"]["flipped"] == 0, !ran.err.contains("flipped"), "{dual}: {}", ran.err);
            assert!(report["solver"]["residual"].as_f64().unwrap() < 1e-12, "{dual}");
        }
    }
}

#[test]
fn a_mesh_of_a_hundred_thousand_faces_is_mapped() {
    let shell = Shell::new();
    for (name, faces) in [("graph:cos+cos?n=225&mesh=triangle", 100_352), ("plane?n=317", 100_489)] {
        shell.done(&["map", name, "-o", "o.obj", "--report", "r.json", "--picture", "p.png", "--system", "a.mtx"]);
        let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
        assert_eq!(report["input"]["faces"], faces);
        assert!(report["distortion"]["flipped"] == 0 && report["solver"]["valid"] == true);
        assert_eq!(texture(&shell.read("o.obj")).len() as u64, report["input"]["vertices"].as_u64().unwrap());
    }
}
