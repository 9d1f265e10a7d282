//! What `riemap map` writes.

use super::shell::{Shell, hill, numbers, texture};

#[test]
fn obj_output_keeps_digits_order_and_polygons() {
    let shell = Shell::new();
    for quads in [false, true] {
        let odd = |text: String| text.replace("v 1.0 ", "v  +1.000000000000000000 ").replace("f ", "f  ");
        let mesh = format!("# mine\no thing\n{}vn 0 0 1\n", odd(hill(5, 1.0, quads)));
        shell.write("m.obj", &mesh);
        shell.done(&["map", "m.obj", "--boundary", "fixed", "-o", "out.obj"]);
        let out = shell.read("out.obj");
        let of = |text: &str, key: &str| -> Vec<String> {
            text.lines().filter(|line| line.starts_with(key)).map(str::to_owned).collect()
        };
        assert_eq!(of(&mesh, "v "), of(&out, "v "));
        assert_eq!(of(&out, "vt ").len(), 25);
        // f v/v: one texture coordinate a vertex.
        let doubled = |line: &String| {
            let corners = line.split_whitespace().skip(1).map(|i| format!(" {i}/{i}"));
            format!("f{}", corners.collect::<String>())
        };
        assert_eq!(of(&mesh, "f ").iter().map(doubled).collect::<Vec<_>>(), of(&out, "f "));
        // On the unit circle, to the rounding of sin and cos, or inside it.
        let radius: Vec<f64> = texture(&out).iter().map(|uv| uv[0].hypot(uv[1])).collect();
        assert!(radius.iter().all(|r| *r <= 1.0 + 1e-15));
        assert_eq!(radius.iter().filter(|r| **r > 1.0 - 1e-15).count(), 16);
    }
}

#[test]
fn vertices_of_no_face_stay_in_the_output_at_0_0() {
    let shell = Shell::new();
    let mesh = format!("{}v 7 7 7\n", hill(3, 1.0, true));
    shell.write("m.obj", mesh);
    let ran = shell.run(&["map", "m.obj", "-o", "out.obj", "--quiet"]);
    assert!(ran.code == 0 && ran.out.is_empty() && ran.err.contains("vertex 9"), "{}", ran.err);
    let out = shell.read("out.obj");
    assert_eq!((numbers(&out, "v ").count(), texture(&out)[9]), (10, [0.0, 0.0]));
}

#[test]
fn ply_output_says_the_same_as_obj_and_can_be_mapped_again() {
    let shell = Shell::new();
    shell.write("m.obj", hill(5, 1.0, true));
    shell.done(&["map", "m.obj", "-o", "out.obj"]);
    shell.done(&["map", "m.obj", "-o", "out.ply"]);
    let [obj, ply] = ["out.obj", "out.ply"].map(|name| riemap::io::read(&shell.path(name)).unwrap().surface);
    assert_eq!(obj, ply);
    let bytes = std::fs::read(shell.path("out.ply")).unwrap();
    let header = String::from_utf8_lossy(&bytes);
    assert!(header.contains("property double s\nproperty double t\n"));
    // Five doubles a vertex after the header.
    let start = header.find("end_header\n").unwrap() + "end_header\n".len();
    let double = |k: usize| f64::from_le_bytes(bytes[start + 8 * k..start + 8 * k + 8].try_into().unwrap());
    let st: Vec<[f64; 2]> = (0..25).map(|v| [double(5 * v + 3), double(5 * v + 4)]).collect();
    assert_eq!(st, texture(&shell.read("out.obj")));
    shell.done(&["map", "out.ply", "-o", "again.obj"]);
    assert_eq!(texture(&shell.read("again.obj")), st);
}

#[test]
fn quiet_prints_nothing_and_otherwise_every_file_is_named() {
    let shell = Shell::new();
    shell.write("m.obj", hill(4, 1.0, false));
    let files = ["-o", "o.obj", "--report", "r.json", "--system", "a.mtx", "--picture", "p.svg"];
    let ran = shell.run(&[&["map", "m.obj", "--quiet"], &files[..]].concat());
    assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
    let out = shell.done(&[&["map", "m.obj"], &files[..]].concat());
    for name in ["o.obj", "r.json", "a.mtx", "p.svg"] {
        assert!(out.contains(&format!("wrote {name}\n")) && shell.path(name).is_file());
    }
    assert_eq!(shell.files().len(), 5, "nothing else is left");
}

#[test]
fn pictures_are_what_their_extension_says() {
    let shell = Shell::new();
    shell.done(&["map", "enneper?n=6", "--picture", "p.png"]);
    shell.done(&["map", "enneper?n=6", "--picture", "p.SVG", "--texture", "t.png"]);
    assert!(std::fs::read(shell.path("t.png")).unwrap().starts_with(b"\x89PNG\r\n"));
    assert!(std::fs::read(shell.path("p.png")).unwrap().starts_with(b"\x89PNG\r\n"));
    assert!(shell.read("p.SVG").contains("<svg"));
}

#[test]
fn paths_may_have_spaces_and_any_letters() {
    let shell = Shell::new();
    let mesh = "mesh à la carte – 網目?x=1&y=2.obj";
    shell.write(mesh, hill(4, 1.0, false));
    let out = shell.done(&["map", mesh, "-o", "größe 1.obj", "--report", "протокол.json"]);
    assert!(out.contains(mesh) && out.contains("größe 1.obj"));
    let report: serde_json::Value = serde_json::from_str(&shell.read("протокол.json")).unwrap();
    assert_eq!(report["input"]["path"], mesh);
    std::fs::create_dir(shell.path("a folder")).unwrap();
    shell.done(&["map", mesh, "-o", "./a folder/-o.obj"]);
    shell.done(&["info", "a folder/-o.obj"]);
}

#[test]
#[cfg(unix)]
fn report_and_system_can_go_to_standard_output() {
    let shell = Shell::new();
    shell.write("m.obj", hill(4, 1.0, false));
    let report = shell.done(&["map", "m.obj", "--quiet", "--report", "/dev/stdout"]);
    assert_eq!(serde_json::from_str::<serde_json::Value>(&report).unwrap()["input"]["path"], "m.obj");
    let system = shell.done(&["map", "m.obj", "--quiet", "--system", "/dev/stdout"]);
    assert!(system.starts_with("%%MatrixMarket matrix coordinate complex general\n"));
}

#[test]
fn the_input_can_be_replaced_by_the_output() {
    let shell = Shell::new();
    shell.write("m.obj", hill(4, 1.0, false));
    let uv = shell.uv("m.obj", &[]);
    shell.done(&["map", "m.obj", "--boundary", "fixed", "-o", "m.obj"]);
    assert_eq!(texture(&shell.read("m.obj")), uv);
    // Mapped again, from the output: the same map.
    assert_eq!(shell.uv("m.obj", &[]), uv);
}
