//! What fails says what is wrong and where, and leaves nothing behind.

use super::shell::{FIXED, Shell, hill};

/// Every output there is.
const FILES: [&str; 8] = ["-o", "o.obj", "--report", "r.json", "--system", "a.mtx", "--picture", "p.png"];

#[test]
fn a_mesh_that_cannot_be_mapped_is_refused_with_its_place() {
    let shell = Shell::new();
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
    for (name, mesh, words) in [
        ("m.obj", String::new(), &["m.obj", "empty"][..]),
        ("m.obj", " \n\n".to_owned(), &["empty"]),
        ("m.obj", square.to_owned(), &["no faces", "4 vertices"]),
        ("m.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n".to_owned(), &["line 2", "nan", "finite"]),
        ("m.obj", "v 0 0 0\nv 1 0 1e999\nv 0 1 0\nf 1 2 3\n".to_owned(), &["line 2", "1e999", "finite"]),
        ("m.obj", format!("{square}f 1 2 5\n"), &["line 5", "vertex 5"]),
        ("m.obj", format!("{square}f 1 2 zwei\n"), &["line 5", "zwei"]),
        ("m.obj", format!("{square}f 1 2\n"), &["line 5", "2 corners"]),
        ("m.obj", format!("{square}f 1 2 1\n"), &["face 0", "vertex 0", "twice"]),
        ("m.obj", format!("{square}f 1 2 3\nf 1 2 3 4\n"), &["1 with 3 corners", "1 with 4 corners", "face 1"]),
        ("m.obj", format!("{square}f 1 2 3\nf 1 2 4\nf 2 1 3\n"), &["0–1", "3 faces"]),
        ("m.obj", format!("{square}v 5 5 5\nf 1 2 3\nf 1 4 5\n"), &["vertex 0", "2 fans"]),
        ("m.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n".to_owned(), &["face 0", "no area"]),
        ("m.obj", "v 0 0 0\nv 0 0 0\nv 2 1 0\nf 1 2 3\n".to_owned(), &["vertices 0 and 1", "same place"]),
        ("m.obj", format!("{square}v 0 0 1\nf 1 3 2\nf 1 2 5\nf 2 3 5\nf 3 1 5\n"), &["closed", "cut"]),
        ("m.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n".to_owned(), &["m.off", "ends too early"]),
        ("m.ply", "ply\nformat ascii 1.0\nelement vertex 99999999999\n".to_owned(), &["m.ply"]),
        ("m.stl", "solid x\nfacet\n".to_owned(), &["m.stl", "line"]),
        ("m.txt", hill(3, 1.0, false), &["m.txt", ".obj"]),
    ] {
        shell.write(name, mesh);
        let message = shell.refused(&[&["map", name], &FILES[..]].concat());
        for word in words {
            assert!(message.contains(word), "`{word}` is not in: {message}");
        }
        // Each cause once.
        assert!(!words.iter().any(|w| w.len() > 9 && message.matches(w).count() > 1), "{message}");
        std::fs::remove_file(shell.path(name)).unwrap();
    }
}

#[test]
fn surfaces_of_other_shapes_than_a_disc_are_told_what_to_do() {
    let shell = Shell::new();
    // A ring of eight triangles, closed as it is or with a twist.
    let ring = |twist: bool| {
        let mut text = String::new();
        for k in 0..4 {
            let (x, y) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][k];
            text += &format!("v {x} {y} 0\nv {} {} {}\n", 2.0 * x, 2.0 * y, 0.3 * k as f64);
        }
        for k in 0..4 {
            let (a, b) = (2 * k + 1, 2 * k + 2);
            let (c, d) = if k < 3 {
                (a + 2, b + 2)
            } else if twist {
                (2, 1)
            } else {
                (1, 2)
            };
            text += &format!("f {a} {b} {d}\nf {a} {d} {c}\n");
        }
        text
    };
    for (mesh, words) in [(ring(false), "2 boundary loops"), (ring(true), "not orientable")] {
        shell.write("m.obj", mesh);
        let message = shell.refused(&[&["map", "m.obj"], &FILES[..]].concat());
        assert!(message.contains(words) && message.contains("cut"), "{message}");
    }
    let two = hill(3, 1.0, false) + &hill(3, 1.0, false).replace('v', "v 50").replace("f ", "f -0 ");
    shell.write("m.obj", two.lines().filter(|l| !l.contains("-0")).map(|l| format!("{l}\n")).collect::<String>());
    assert_eq!(shell.run(&["map", "m.obj"]).code, 0, "unused vertices do not count as a component");
}

#[test]
fn an_output_that_cannot_be_written_is_refused_before_any_other_is() {
    let shell = Shell::new();
    shell.write("m.obj", hill(4, 1.0, false));
    shell.write("old.obj", "old");
    shell.write("locked.json", "old");
    let mut permissions = std::fs::metadata(shell.path("locked.json")).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(shell.path("locked.json"), permissions).unwrap();
    std::fs::create_dir(shell.path("folder.json")).unwrap();
    for (outputs, word) in [
        (&["-o", "old.obj", "--report", "no/r.json"][..], "no/r.json"),
        (&["-o", "old.obj", "--report", "m.obj/r.json"], "m.obj/r.json"),
        (&["-o", "old.obj", "--report", "folder.json"], "folder.json"),
        (&["-o", "old.obj", "--report", "locked.json"], "locked.json"),
        (&["-o", "old.obj", "--system", "no/a.mtx"], "no/a.mtx"),
        (&["-o", "old.obj", "--picture", "no/p.png"], "no/p.png"),
        (&["-o", "old.obj", "--picture", "p.gif"], "p.gif"),
        (&["-o", "old.obj", "--texture", "no/t.png"], "no/t.png"),
        (&["-o", "old.obj", "--texture", "t.svg"], "t.svg"),
        (&["-o", "old.obj", "--texture", "t"], ".png"),
        (&["-o", "old.obj", "--texture", "t.png", "--picture", "t.png"], "t.png"),
        (&["-o", "old.obj", "--report", "old.obj"], "old.obj"),
        (&["-o", "no/o.obj", "--report", "r.json"], "no/o.obj"),
        (&["-o", "o.stl", "--report", "r.json"], ".ply"),
        (&["-o", "o", "--report", "r.json"], ".obj"),
        #[cfg(target_os = "linux")]
        (&["-o", "old.obj", "--report", "/dev/full"], "/dev/full"),
    ] {
        let arguments = [&["map", "m.obj"], outputs].concat();
        if outputs.contains(&"/dev/full") {
            // Known only at the very end, when files are in their places already.
            assert!(shell.run(&arguments).err.contains(word));
            continue;
        }
        let message = shell.refused(&arguments);
        assert!(message.contains(word) && !message.contains(".riemap-"), "{message}");
    }
}

#[test]
fn a_source_that_is_not_there_is_named() {
    let shell = Shell::new();
    std::fs::create_dir(shell.path("folder")).unwrap();
    for (source, words) in [
        ("nowhere.obj", "nowhere.obj"),
        ("folder", "folder"),
        ("folder/", "directory"),
        ("sphear?n=8", "sphere"),
        ("sphere?n=x", "whole number"),
        ("sphere?n=8&frob=1", "frob"),
        ("torus?n=8", "closed"),
    ] {
        for command in ["info", "map"] {
            if (source, command) == ("torus?n=8", "info") {
                continue;
            }
            let message = shell.refused(&[command, source]);
            assert!(message.contains(words), "{source}: {message}");
        }
    }
}

#[test]
fn a_backend_that_does_not_suit_says_what_would() {
    let shell = Shell::new();
    shell.write("t.obj", hill(5, 1.0, false));
    for (options, words) in [
        (&["--solver", "lu"][..], &["`lu`", "--hold primal"][..]),
        (&["--solver", "cotan"], &["`cotan`", "--dual circumcentre"]),
        (&["--solver", "cotan", "--dual", "circumcentre", "--hold", "whole"], &["`cotan`", "--hold primal"]),
        (&["--solver", "cholesky-real", "--hold", "primal"], &["`cholesky-real`", "--hold whole"]),
        (&["--solver", "cholesky-real", "--weight", "unit"], &["`cholesky-real`", "--weight integral"]),
        (&["--dual", "circumcentre", "--hold", "whole"], &["Re ρ", "--weight unit", "--dual barycentre"]),
        (&["--rho", "normals"], &["--rho", "quad"]),
        (&["--normals", "hat"], &["--normals", "quad"]),
    ] {
        let message = shell.refused(&[&["map", "t.obj"], &FIXED, options, &FILES[..]].concat());
        assert!(words.iter().all(|word| message.contains(word)), "{options:?}: {message}");
    }
    shell.write("q.obj", hill(5, 1.0, true));
    assert!(shell.refused(&["map", "q.obj", "--rho", "normals"]).contains("--normals auto"));
}
