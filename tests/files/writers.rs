//! What is written, that it reads back bit for bit, and that a failed write leaves no trace.

use std::fs;
use std::io::Write;
use std::path::Path;

use crate::mesh_files::{SQUARE_OBJ, SQUARE_OFF, SQUARE_PLY, good, square};
use proptest::prelude::*;
use riemap::io::{self, Format, ReadError, Uv, WriteError};
use riemap::surface::Surface;

#[test]
fn paths_that_are_no_mesh_files_are_told_so() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    assert!(matches!(io::read(&at("none.obj")), Err(ReadError::Io { .. })));
    assert!(matches!(io::read(folder.path()), Err(ReadError::Directory { .. })));
    fs::write(at("mesh.OBJ"), SQUARE_OBJ).unwrap();
    assert_eq!(io::read(&at("mesh.OBJ")).unwrap().format, Format::Obj);
    fs::write(at("mesh.fbx"), SQUARE_OBJ).unwrap();
    let message = io::read(&at("mesh.fbx")).unwrap_err().to_string();
    assert!(message.ends_with("unknown mesh format; known extensions: .obj, .off, .ply, .stl"), "{message}");
    let error = io::write(&at("out.stl"), &square(), None, None).unwrap_err().to_string();
    assert!(error.ends_with("known extensions: .obj, .ply, .glb"), "{error}");
}

#[test]
fn the_vertex_lines_of_an_obj_survive_untouched() {
    let lines =
        ["v  0.10000000000000000000  +1e0 -0", "v 1 2 3 1.0 0.5 0.5 0.5 # red\t", "v\t.5 5. 0x".trim_end_matches('x')];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.obj");
    let mesh = good(Format::Obj, format!("{}\r\nf 1 2 3\r\n", lines.join("\r\n")));
    let uv = [[0.1, 0.2], [1e-300, -0.0], [1.0 / 3.0, 1e22]];
    io::write(&path, &mesh.surface, mesh.vertex_text.as_ref(), Some(Uv::PerVertex(&uv))).unwrap();
    let expected =
        format!("{}\nvt 0.1 0.2\nvt 1e-300 -0.0\nvt 0.3333333333333333 1e22\nf 1/1 2/2 3/3\n", lines.join("\n"));
    assert_eq!(fs::read_to_string(&path).unwrap(), expected);
    let joined = good(Format::Obj, "v 1.0 \\\n 2.0 3.0\nv 1 0 0\nv 0 0 1\nf 1 2 3");
    assert_eq!(joined.vertex_text.unwrap().line(0), Some(&b"v 1.0 2.0 3.0"[..]));
    let off = good(Format::Off, SQUARE_OFF.replace("1 1 0", "1.0  1e0\n 0 # c"));
    assert_eq!(off.vertex_text.unwrap().line(2), Some(&b"v 1.0 1e0 0"[..]));
}

#[test]
fn a_failed_write_leaves_everything_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.json");
    let fail = |out: &mut dyn Write| out.write_all(b"half").and(Err(std::io::ErrorKind::StorageFull.into()));
    let names = || fs::read_dir(folder.path()).unwrap().count();
    assert!(io::atomically(&path, fail).is_err());
    assert_eq!(names(), 0);
    io::atomically(&path, |out| out.write_all(b"whole")).unwrap();
    assert!(io::atomically(&path, fail).is_err());
    assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names()), ("whole", 1));
    io::atomically(&path, |out| out.write_all(b"new")).unwrap();
    assert_eq!((fs::read_to_string(&path).unwrap().as_str(), names()), ("new", 1));
    assert!(matches!(io::atomically(folder.path(), |_| Ok(())), Err(WriteError::Io { .. })));
    assert!(io::atomically(&folder.path().join("no/such/folder.obj"), |_| Ok(())).is_err());
    let surface = square();
    let write = |uv: Uv| io::write(&folder.path().join("out.obj"), &surface, None, Some(uv)).unwrap_err();
    assert!(matches!(write(Uv::PerVertex(&[[0.0; 2]; 3])), WriteError::Mismatch { found: 3, expected: 4, .. }));
    assert!(matches!(write(Uv::PerVertex(&[[f64::NAN; 2]; 4])), WriteError::NotFinite { index: 0, .. }));
    let corners = Uv::PerCorner { coordinates: &[[0.0; 2]], corners: &[0, 0, 0, 0, 1, 0] };
    assert!(matches!(write(corners), WriteError::CornerOutOfRange { corner: 4, index: 1, .. }));
    assert_eq!(names(), 1);
}

#[cfg(unix)]
#[test]
fn written_files_have_ordinary_permissions_and_links_stay_links() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode() & 0o777;
    fs::write(at("ordinary"), "").unwrap();
    io::atomically(&at("new"), |_| Ok(())).unwrap();
    assert_eq!(mode(&at("new")), mode(&at("ordinary")));
    fs::set_permissions(at("new"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink(at("new"), at("link")).unwrap();
    io::atomically(&at("link"), |out| out.write_all(b"x")).unwrap();
    assert!(fs::symlink_metadata(at("link")).unwrap().is_symlink());
    assert_eq!((fs::read(at("new")).unwrap(), mode(&at("new"))), (b"x".to_vec(), 0o640));
    io::atomically(Path::new("/dev/null"), |out| out.write_all(b"x")).unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
}

fn finite() -> impl Strategy<Value = f64> {
    any::<f64>().prop_filter("finite", |x| x.is_finite())
}

fn meshes() -> impl Strategy<Value = (Surface, Vec<[f64; 2]>)> {
    (3usize..20).prop_flat_map(|n| {
        let polygon = proptest::collection::vec(0..n as u32, 3..300);
        let faces = proptest::collection::vec(polygon, 1..12);
        let positions = proptest::collection::vec([finite(), finite(), finite()], n);
        let uv = proptest::collection::vec([finite(), finite()], n);
        (positions, faces, uv).prop_map(|(positions, faces, uv)| (crate::common::surface(positions, faces), uv))
    })
}

fn bits(surface: &Surface) -> Vec<[u64; 3]> {
    surface.positions().iter().map(|p| p.map(f64::to_bits)).collect()
}

proptest! {
    #[test]
    fn what_is_written_reads_back_bit_for_bit((surface, uv) in meshes()) {
        let folder = tempfile::tempdir().unwrap();
        let corners = surface.faces().corners();
        for uv in [None, Some(Uv::PerVertex(&uv)), Some(Uv::PerCorner { coordinates: &uv, corners })] {
            for name in ["a.obj", "a.ply"] {
                let path = folder.path().join(name);
                io::write(&path, &surface, None, uv).unwrap();
                let back = io::read(&path).unwrap();
                prop_assert_eq!(&back.surface.faces(), &surface.faces());
                prop_assert_eq!(bits(&back.surface), bits(&surface));
                if let Some(text) = &back.vertex_text {
                    io::write(&path, &back.surface, Some(text), uv).unwrap();
                    prop_assert_eq!(bits(&io::read(&path).unwrap().surface), bits(&surface));
                }
            }
        }
        io::write(&folder.path().join("a.obj"), &surface, None, Some(Uv::PerVertex(&uv))).unwrap();
        let obj = fs::read_to_string(folder.path().join("a.obj")).unwrap();
        let numbers = obj.lines().filter_map(|l| l.strip_prefix("vt ")).flat_map(|l| l.split(' '));
        let back: Vec<u64> = numbers.map(|x| x.parse::<f64>().unwrap().to_bits()).collect();
        prop_assert_eq!(back, uv.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>());
    }

    #[test]
    fn text_off_ply_and_stl_keep_every_bit((surface, _) in meshes()) {
        let faces: String = surface.faces().iter().map(|p| format!("{} {}\n", p.len(),
            p.iter().map(u32::to_string).collect::<Vec<_>>().join(" "))).collect();
        let vertices: String = surface.positions().iter().map(|[x, y, z]| format!("{x:?} {y:e} {z}\n")).collect();
        let (nv, nf) = (surface.positions().len(), surface.faces().len());
        let off = good(Format::Off, format!("OFF\n{nv} {nf} 0\n{vertices}{faces}"));
        let header = SQUARE_PLY.split_inclusive("end_header\n").next().unwrap();
        let header = header.replace("vertex 4", &format!("vertex {nv}")).replace("face 2", &format!("face {nf}"));
        let ply = good(Format::Ply, format!("{header}{vertices}{faces}"));
        for mesh in [off, ply] {
            prop_assert_eq!(&mesh.surface.faces(), &surface.faces());
            prop_assert_eq!(bits(&mesh.surface), bits(&surface));
        }
        let facets: String = surface.faces().iter().map(|p| {
            let v = |i: usize| surface.positions()[p[i] as usize].map(|x| format!("{x:?}")).join(" ");
            format!("facet normal 0 0 0 outer loop vertex {} vertex {} vertex {} endloop endfacet\n", v(0), v(1), v(2))
        }).collect();
        let stl = good(Format::Stl, format!("solid\n{facets}endsolid")).surface;
        for (welded, polygon) in stl.faces().iter().zip(surface.faces().iter()) {
            for (&a, &b) in welded.iter().zip(polygon) {
                prop_assert_eq!(stl.positions()[a as usize], surface.positions()[b as usize]);
            }
        }
    }
}
