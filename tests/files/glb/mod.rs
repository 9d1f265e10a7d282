//! Binary glTF: what is in the file is the surface, its map, and the checkerboard that this lays on it.
mod file;

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use file::File;
use riemap::app::experiment::{Checkerboard, stage_model};
use riemap::figure::Checker;
use riemap::input::Input;
use riemap::io::glb::{Affine, Glb, GlbError, Model};
use riemap::io::{self, Uv, WriteError};
use riemap::map::{self, Boundary, MapOptions, Mapped};
use riemap::solver::Silent;
use riemap::surface::Faces;

fn written(input: &Input, options: &MapOptions) -> (Mapped, File) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.glb");
    let mapped = map::map_input(input, options, &mut Silent).unwrap();
    stage_model(&path, input, &mapped, Checkerboard::default()).unwrap().publish().unwrap();
    (mapped, File::parse(&fs::read(path).unwrap()))
}

fn of_name(name: &str, boundary: Boundary, cut: bool) -> (Input, Mapped, File) {
    let input = Input::open(name).unwrap();
    let (mapped, file) = written(&input, &MapOptions { boundary: boundary.clone(), cut, ..MapOptions::default() });
    (input, mapped, file)
}

const CASES: [(&str, Boundary, bool); 5] = [
    ("graph:cos+cos?n=9", Boundary::CIRCLE, false),
    ("sphere?n=8&mesh=delaunay", Boundary::FREE, false),
    ("digital-torus?R=5&r=2", Boundary::FREE, true),
    ("digital-torus?R=8&r=3.2", Boundary::Periodic, false),
    ("torus?R=2&r=0.8&n=12&mesh=triangle", Boundary::Periodic, false),
];

/// 2⁻²⁴ of the largest number, once for rounding to a float.
fn rounding<const N: usize>(points: &[[f64; N]]) -> f64 {
    points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs())) * 2f64.powi(-24)
}

#[test]
fn every_triangle_is_a_part_of_its_face_with_the_places_that_the_map_gives() {
    for (name, boundary, cut) in CASES {
        let (input, mapped, file) = of_name(name, boundary.clone(), cut);
        let (disc, image) = (&mapped.domain.disc, mapped.image());
        let (positions, map, triangles) = (file.positions(), file.map(), file.triangles());
        // The map comes back from texture coordinates by one affine map more, each rounded: 4 for the longer of its rows.
        let texture = rounding(&file.floats::<2>("TEXCOORD_0"));
        let matrix = &file.json["meshes"][0]["extras"]["map"]["matrix"];
        let scale = (0..4).map(|k| matrix[k / 2][k % 2].as_f64().unwrap().abs()).fold(0.0, f64::max);
        let (near, near_map) = (2.0 * rounding(&file.floats::<3>("POSITION")), 4.0 * texture * scale);
        let mut next = triangles.iter();
        for f in 0..disc.source_faces() {
            let corners = disc.faces.corner_range(f);
            let mut seen = vec![0; corners.len()];
            for triangle in next.by_ref().take(corners.len() - 2) {
                let mut order = Vec::new();
                for &v in triangle {
                    let same = |c: usize| {
                        let z = image.corner(disc, c);
                        let source = disc.source_vertex[disc.faces.corners()[c] as usize];
                        let p = input.surface.positions()[source as usize];
                        (0..3).all(|k| (positions[v][k] - p[k]).abs() <= near)
                            && (map[v][0] - z.re).abs() <= near_map
                            && (map[v][1] - z.im).abs() <= near_map
                    };
                    let corner = corners.clone().position(same);
                    order.push(corner.unwrap_or_else(|| panic!("{name}: vertex {v} at no corner of face {f}")));
                }
                order.iter().for_each(|&k| seen[k] += 1);
                let turns = (0..3).filter(|&k| order[k] > order[(k + 1) % 3]).count();
                assert_eq!(turns, 1, "{name}: face {f} is run through in its order");
            }
            assert_eq!(seen.iter().sum::<usize>(), 3 * (corners.len() - 2));
            assert!(seen.iter().all(|&count| count > 0), "{name}: face {f} has all its corners");
        }
        assert_eq!(next.next(), None);
    }
}

#[test]
fn a_vertex_is_there_once_where_map_and_light_allow_it_and_in_the_order_of_the_source() {
    let (input, _, file) = of_name("graph:cos+cos?n=33", Boundary::CIRCLE, false);
    let far = |(p, q): (&[f64; 3], &[f64; 3])| (0..3).map(|k| (p[k] - q[k]).abs()).fold(0.0, f64::max);
    let positions = file.positions();
    assert_eq!(positions.len(), input.surface.positions().len());
    assert!(positions.iter().zip(input.surface.positions()).map(far).fold(0.0, f64::max) < 1e-6);
    // A surfel is lit by its own normal.
    let (input, mapped, file) = of_name("digital-torus?R=8&r=3.2", Boundary::Periodic, false);
    assert_eq!(file.positions().len(), input.surface.faces().corners().len());
    let normals = file.floats::<3>("NORMAL");
    let expected = &mapped.domain.planes.as_ref().unwrap().normals;
    for (k, triangle) in file.triangles().iter().enumerate() {
        assert!(triangle.iter().all(|&v| far((&normals[v], &expected[k / 2])) < 1e-6));
    }
}

#[test]
fn the_picture_has_the_squares_of_the_checkerboard_upright() {
    let (_, mapped, file) = of_name("enneper?n=8", Boundary::CIRCLE, false);
    let picture = file.view(&file.json["images"][0]["bufferView"]);
    let mut reader = png::Decoder::new(std::io::Cursor::new(picture)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height, info.color_type), (512, 512, png::ColorType::Rgb));
    let light = |[s, t]: [f64; 2]| {
        // Repeated; t points down.
        let [column, row] = [s, t].map(|x| ((x - x.floor()) * 512.0) as usize);
        pixels[3 * (512 * row + column)] > 128
    };
    let image = mapped.image();
    let disc = &mapped.domain.disc;
    let all: Vec<[f64; 2]> =
        (0..disc.faces.corners().len()).map(|c| image.corner(disc, c)).map(|z| [z.re, z.im]).collect();
    let board = Checker::across(all, 32).unwrap();
    let (map, texture) = (file.map(), file.floats::<2>("TEXCOORD_0"));
    let mut colours = [0, 0];
    for (z, st) in map.iter().zip(&texture) {
        let squares = board.at(*z);
        // Not on a border, where rounding decides.
        if squares.iter().all(|x| (x - x.round()).abs() > 1e-3) {
            let is_light = (squares[0].floor() + squares[1].floor()) % 2.0 == 0.0;
            assert_eq!(light(*st), is_light, "{squares:?}");
            colours[usize::from(is_light)] += 1;
        }
    }
    assert!(colours.iter().all(|&count| count > 10), "both colours were met: {colours:?}");
    let sampler = &file.json["samplers"][0];
    assert_eq!([&sampler["wrapS"], &sampler["wrapT"]].map(|wrap| wrap.as_u64()), [Some(10497); 2]);
    assert_eq!(file.json["materials"][0]["doubleSided"], true);
}

#[test]
fn the_checkerboard_of_a_periodic_map_has_no_seam() {
    for (name, boundary, cut) in CASES.into_iter().filter(|case| case.1 == Boundary::Periodic) {
        let (_, _, file) = of_name(name, boundary.clone(), cut);
        let mut first: HashMap<[u64; 3], [f64; 2]> = HashMap::new();
        let mut apart = 0;
        for (p, st) in file.positions().iter().zip(file.floats::<2>("TEXCOORD_0")) {
            let known = *first.entry(p.map(f64::to_bits)).or_insert(st);
            // In squares: whole numbers of an even sum, to some roundings of numbers below 100.
            let [a, b] = [0, 1].map(|k| 2.0 * (st[k] - known[k]));
            assert!((a - a.round()).abs() < 1e-4 && (b - b.round()).abs() < 1e-4, "{name}: {a} {b}");
            assert_eq!((a.round() + b.round()).rem_euclid(2.0), 0.0, "{name}");
            apart += usize::from(a.round() != 0.0 || b.round() != 0.0);
        }
        assert!(apart > 0, "{name}: some vertex lies on two sides");
    }
}

#[test]
fn what_is_far_from_the_origin_loses_nothing() {
    let near = Input::open("graph:cos+cos?n=33").unwrap();
    let moved = |p: &[f64; 3]| [p[0] + 1048576.0, p[1] - 8388608.0, p[2] + 524288.0];
    let mut surface = near.surface.clone();
    surface.positions_mut().iter_mut().for_each(|p| *p = moved(p));
    let far = Input::of("far.obj".to_owned(), surface);
    let (_, file) = written(&far, &MapOptions::default());
    for (p, q) in file.positions().iter().zip(far.surface.positions()) {
        // A float of at most 4 has half an ulp of 2⁻²³; floats at 8388608 would be 1 apart.
        assert!((0..3).all(|k| (p[k] - q[k]).abs() <= 2f64.powi(-23)), "{p:?} {q:?}");
    }
    // Meshes have y up, as glTF has; generated surfaces z, and are turned.
    assert!(file.json["nodes"][0].get("rotation").is_none());
    let (_, file) = written(&near, &MapOptions::default());
    assert!(file.json["nodes"][0]["rotation"][0].as_f64().unwrap() < 0.0);
}

#[test]
fn a_surface_can_be_written_without_a_picture_or_a_map() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.GLB");
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [1.5, 1.0, 0.0], [0.5, 2.0, 0.0], [0.0, 1.0, 0.0]];
    let faces: Faces = [[0, 1, 2, 3, 4]].into_iter().collect();
    let surface = crate::common::surface(positions, faces.iter());
    let uv: Vec<[f64; 2]> = (0..5).map(|k| [f64::from(k), 0.25]).collect();
    io::write(&path, &surface, None, Some(Uv::PerVertex(&uv))).unwrap();
    let file = File::parse(&fs::read(&path).unwrap());
    assert_eq!(file.triangles(), [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
    assert_eq!((file.map(), file.floats::<2>("TEXCOORD_0")[1]), (uv, [1.0, 0.75]));
    io::write(&path, &surface, None, None).unwrap();
    let file = File::parse(&fs::read(&path).unwrap());
    assert_eq!(file.positions(), surface.positions());
    assert!(file.json.get("images").is_none() && file.json["meshes"][0].get("extras").is_none());
}

#[test]
fn a_quad_is_split_along_its_shorter_diagonal() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.glb");
    let faces: Faces = [[0, 1, 2, 3]].into_iter().collect();
    for (corner, expected) in [([2.0, 2.0, 0.0], [[1, 2, 3], [1, 3, 0]]), ([0.9, 0.9, 0.0], [[0, 1, 2], [0, 2, 3]])] {
        let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], corner, [0.0, 1.0, 0.0]];
        io::write(&path, &crate::common::surface(positions, faces.iter()), None, None).unwrap();
        assert_eq!(File::parse(&fs::read(&path).unwrap()).triangles(), expected);
    }
}

#[test]
fn what_a_file_has_no_place_for_is_refused() {
    let faces: Faces = [[0, 1, 2]].into_iter().collect();
    let write = |scale: f64, faces: Faces| {
        let positions = vec![[0.0; 3], [scale, 0.0, 0.0], [0.0, scale, 0.0]];
        io::write(Path::new("no.glb"), &crate::common::surface(positions, faces.iter()), None, None).unwrap_err()
    };
    for scale in [0.0, 1e-300, 1e300, f64::MAX] {
        let error = write(scale, faces.clone());
        assert!(matches!(error, WriteError::Glb { source: GlbError::Size { .. }, .. }), "{error}");
        assert!(error.to_string().starts_with("cannot write no.glb: the surface is "), "{error}");
    }
    assert!(matches!(write(1.0, Faces::default()), WriteError::Glb { source: GlbError::NoFaces, .. }));
    // The length is known before anything is written; the picture is never read.
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let model = Model {
        positions: &positions,
        faces: &faces,
        z_up: false,
        normals: None,
        map: None,
        texture: Affine::UPRIGHT,
        picture: None,
    };
    let glb = Glb::new(&model).unwrap();
    let mut bytes = Vec::new();
    glb.write(&mut bytes).unwrap();
    assert_eq!(glb.bytes(), bytes.len() as u64);
    assert!(!Path::new("no.glb").exists());
}
