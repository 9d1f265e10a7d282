//! Volumes, cuts and periods on the command line.

use super::shell::{FIXED, Shell};

/// A `.vol` of version 2 with these voxels inside.
fn volume(size: [usize; 3], inside: impl Fn([usize; 3]) -> bool) -> Vec<u8> {
    let [x, y, z] = size;
    let header = "Voxel-Size: 1\nInt-Endian: 0123\nVoxel-Endian: 0\nVersion: 2\n.\n";
    let mut bytes = format!("X: {x}\nY: {y}\nZ: {z}\n{header}").into_bytes();
    for k in 0..z {
        for j in 0..y {
            bytes.extend((0..x).map(|i| 7 * u8::from(inside([i, j, k]))));
        }
    }
    bytes
}

/// A ring of 3 × 3 − 1 voxels and, apart from it, a single one.
fn ring() -> Vec<u8> {
    volume([5, 3, 1], |[i, j, _]| (i < 3 && (i, j) != (1, 1)) || (i, j) == (4, 0))
}

/// `vt` lines and, for every corner of every face, (vertex, texture coordinate), from 0.
type Written = (Vec<[f64; 2]>, Vec<Vec<(usize, usize)>>);

fn parse(obj: &str) -> Written {
    let numbers = |line: &str| -> [f64; 2] {
        let mut words = line.split_whitespace().skip(1).map(|word| word.parse().unwrap());
        [words.next().unwrap(), words.next().unwrap()]
    };
    let corner = |word: &str| {
        let (v, vt) = word.split_once('/').unwrap();
        (v.parse::<usize>().unwrap() - 1, vt.parse::<usize>().unwrap() - 1)
    };
    let uv = obj.lines().filter(|line| line.starts_with("vt ")).map(numbers).collect();
    let faces = obj.lines().filter(|line| line.starts_with("f "));
    (uv, faces.map(|line| line.split_whitespace().skip(1).map(corner).collect()).collect())
}

#[test]
fn a_volume_is_described_with_the_components_of_its_boundary() {
    let shell = Shell::new();
    shell.write("ring.vol", ring());
    let all = shell.run(&["info", "ring.vol"]).out;
    for words in
        ["digital surface", "9 voxels in a box of 5 × 3 × 1", "interior adjacency 6", "32, 6 surfels", "genus 1"]
    {
        assert!(all.contains(words), "{words}: {all}");
    }
    let single = shell.run(&["info", "ring.vol", "--component", "1", "--adjacency", "18"]).out;
    assert!(single.contains("6 faces") && single.contains("interior adjacency 18"), "{single}");
}

#[test]
fn volumes_that_bound_nothing_and_options_for_other_files_are_refused() {
    let shell = Shell::new();
    shell.write("ring.vol", ring());
    shell.write("short.vol", &ring()[..ring().len() - 1]);
    shell.write("bytes.raw", [0u8, 9, 0, 9]);
    for (arguments, words) in [
        (&["ring.vol", "--threshold", "7"][..], &["ring.vol", "7", "threshold"][..]),
        (&["ring.vol", "--component", "2"], &["component 2", "32, 6"]),
        (&["ring.vol", "--size", "5x3x1"], &["--size", "ring.vol"]),
        (&["short.vol"], &["short.vol"]),
        (&["bytes.raw"], &["--size"]),
        (&["bytes.raw", "--size", "3x1x1"], &["bytes.raw", "3"]),
        (&["sphere", "--threshold", "1"], &["sphere", "no volume file"]),
    ] {
        let message = shell.refused(&[&["info"], arguments].concat());
        assert!(words.iter().all(|word| message.contains(word)), "{arguments:?}: {message}");
    }
    let raw = shell.run(&["info", "bytes.raw", "--size", "2x1x1", "--type", "u16"]).out;
    assert!(raw.contains("2 voxels in a box of 2 × 1 × 1"), "{raw}");
}

#[test]
fn a_cut_surface_is_written_with_one_texture_coordinate_per_corner() {
    let shell = Shell::new();
    shell.done(&["map", "torus?n=12", "--cut", "-o", "torus.obj", "--report", "r.json"]);
    let (uv, faces) = parse(&shell.read("torus.obj"));
    assert_eq!(faces.len(), 144);
    // 144 vertices, two loops of 12 edges on the cut: their vertices are there twice, the one in common four times.
    assert_eq!(uv.len(), 144 + 12 + 12 + 1);
    let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert_eq!((&report["cut"]["cut_edges"], &report["cut"]["genus"]), (&24.into(), &1.into()));
    assert_eq!(report["distortion"]["flipped"], 0);
}

#[test]
fn periodic_maps_are_written_so_that_every_seam_is_a_period() {
    let shell = Shell::new();
    for (name, tiling) in [
        ("torus?n=12&mesh=triangle", "conformal"),
        ("digital-torus?R=6&r=2.5&x=0.3&y=0.2&z=0.1", "conformal"),
        ("torus?n=12", "whole"),
    ] {
        shell.done(&["map", name, "--boundary", "periodic", "-o", "t.obj", "--report", "r.json", "--tiling", tiling]);
        let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
        let number = |k: usize| report["periods"]["tau"][k].as_f64().unwrap();
        let (re, im) = (number(0), number(1));
        assert!(re.abs() <= 0.5 + 1e-9 && re * re + im * im >= 1.0 - 1e-9, "{name}: not reduced");
        assert!(
            report["periods"]["error"].as_f64().unwrap() < 0.05
                && report["periods"]["loops"].as_array().unwrap().len() == 2
        );
        let (uv, faces) = parse(&shell.read("t.obj"));
        let mut edges = std::collections::BTreeMap::new();
        let mut seams = 0;
        for face in &faces {
            for k in 0..face.len() {
                let ((v, a), (w, b)) = (face[k], face[(k + 1) % face.len()]);
                let Some((c, d)) = edges.insert((v.min(w), v.max(w)), (b, a)) else { continue };
                // The neighbour runs along the edge the other way.
                let jump = |p: usize, q: usize| [uv[p][0] - uv[q][0], uv[p][1] - uv[q][1]];
                let (one, other) = (jump(a, c), jump(b, d));
                assert!((0..2).all(|k| (one[k] - other[k]).abs() < 1e-9), "{name}: the seam is no translation");
                let (m, n) = match tiling {
                    "whole" => (one[0], one[1]),
                    _ => (one[0] - one[1] / im * re, one[1] / im),
                };
                assert!((m - m.round()).abs() + (n - n.round()).abs() < 1e-9, "{name}: {one:?} is no period");
                seams += usize::from(m.round() != 0.0 || n.round() != 0.0);
            }
        }
        assert!(seams > 0 && seams < faces.len(), "{name}: {seams}");
    }
}

#[test]
fn what_periodic_maps_do_not_have_is_refused() {
    let shell = Shell::new();
    for (arguments, words) in [
        (&["torus", "--cut"][..], &["--cut"][..]),
        (&["torus", "--energy", "H + L"], &["H + L"]),
        (&["torus", "--pin", "0=0,0"], &["--pin"]),
        (&["torus", "--solver", "lu"], &["lu"]),
        (&["torus", "--keep-order"], &["--keep-order"]),
        (&["torus", "--trace", "s.csv"], &["--trace", "leave it out"]),
        (&["sphere"], &["boundary"]),
        (&["digital-ball?R=4"], &["genus 0"]),
    ] {
        let message = shell.refused(&[&["map"], arguments, &["--boundary", "periodic"]].concat());
        assert!(words.iter().all(|word| message.contains(word)), "{arguments:?}: {message}");
    }
}

#[test]
fn closed_and_pierced_surfaces_say_how_they_can_be_mapped() {
    let shell = Shell::new();
    assert!(shell.refused(&["map", "torus"]).contains("--boundary periodic"));
    assert!(shell.refused(&["map", "digital-ball?R=4"]).contains("--cut"));
    let ball =
        shell.done(&[&["map", "digital-ball?R=4", "--remove-face", "3", "--report", "r.json"], &FIXED[..]].concat());
    assert!(ball.contains("1 face removed"), "{ball}");
    let message = shell.refused(&["map", "digital-ball?R=4", "--remove-face", "100000"]);
    assert!(message.contains("100000") && message.contains("faces"), "{message}");
}

#[test]
fn faces_that_are_left_out_have_no_place_in_the_map() {
    let shell = Shell::new();
    shell.done(&["map", "plane?n=8", "--remove-face", "3", "-o", "a.obj", "--report", "r.json"]);
    let (uv, faces) = parse(&shell.read("a.obj"));
    assert!(faces[3].iter().all(|&(_, vt)| uv[vt] == [0.0, 0.0]), "{:?}", faces[3]);
    let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert_eq!((&report["cut"]["faces_removed"], &report["error"]), (&1.into(), &serde_json::Value::Null));
}

#[test]
fn unsuitable_normals_say_what_would_do() {
    let shell = Shell::new();
    for (arguments, word) in [
        (&["map", "sphere", "--normals", "exact"][..], "--normals auto"),
        (&["map", "sphere", "--normals", "integral-invariant"], "--normals auto"),
        (&["map", "sphere", "--normals", "file"], "normals"),
        (&["map", "sphere?mesh=triangle", "--normals", "hat"], "quad meshes"),
    ] {
        let message = shell.refused(arguments);
        assert!(message.contains(word), "{arguments:?}: {message}");
    }
    let usage = shell.run(&["map", "sphere", "--normals", "frob"]);
    assert!(usage.code == 2 && usage.err.contains("integral-invariant"), "{}", usage.err);
}

#[test]
fn tilted_normals_are_counted_in_the_report() {
    let shell = Shell::new();
    shell.done(&["map", "digital-ball?R=12&x=0.1", "--cut", "--boundary", "free", "--report", "r.json"]);
    let report: serde_json::Value = serde_json::from_str(&shell.read("r.json")).unwrap();
    assert_eq!(report["input"]["kind"], "digital");
    assert!(report["quad_graph"]["clamped"].as_u64().unwrap() > 0);
    assert!(report["quad_graph"]["min_re_rho"].as_f64().unwrap() > 0.04);
}
