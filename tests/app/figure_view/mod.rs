//! The shaded picture of a surface under a checkerboard.
mod pattern;
mod refusals;
mod shared;

use riemap::app::experiment::{Checkerboard, checkerboard, checkerboard_pair};
use riemap::figure::{ALARM, Camera, Colour, FlatMap, Pair, Shading, SurfaceView};
use riemap::input::Input;
use riemap::map::{self, Boundary, MapOptions};
use riemap::solver::Silent;
use riemap::surface::Faces;

use shared::{PAPER, Pixels, Point, Sheet, draw, torus};

#[test]
fn an_open_surface_is_seen_from_the_side_of_its_normals() {
    let sheet = Sheet::new(8, 0.0, false, |x, y| 0.3 * (x * x + y * y));
    let mut turned = Sheet { faces: sheet.faces.clone(), ..Sheet::new(8, 0.0, false, |x, y| 0.3 * (x * x + y * y)) };
    (0..turned.faces.len()).for_each(|f| turned.faces.flip(f));
    let brightness = |view: SurfaceView| {
        let pixels = draw(&view, [500, 500]);
        let Colour(c) = pixels.at(pixels.width / 2, pixels.height / 2);
        c[0]
    };
    let (front, back) = (brightness(sheet.view()), brightness(turned.view()));
    assert!(front > 150 && back > 150, "{front} {back}");
    // From the other side it is darker.
    let below = Camera { towards: Some([0.3, -0.4, -1.0]), ..Camera::default() };
    let inner = brightness(SurfaceView { camera: below, ..sheet.view() });
    assert!(inner < 150, "{inner}");
}

#[test]
fn a_closed_surface_looks_the_same_inside_out() {
    let outside = torus(24, [8.0, 4.0], [0, 0]);
    let mut faces = Faces::default();
    let mut uv = Vec::new();
    for (f, polygon) in outside.faces.iter().enumerate() {
        let reversed: Vec<u32> = polygon.iter().rev().copied().collect();
        faces.push(&reversed);
        uv.extend(outside.uv[4 * f..4 * f + 4].iter().rev());
    }
    let inside = draw(&SurfaceView::new(&outside.positions, &faces, &uv), [500, 500]);
    let outside = draw(&outside.view(), [500, 500]);
    let differ = inside.rgb.iter().zip(&outside.rgb).filter(|(a, b)| a.abs_diff(**b) > 1).count();
    assert_eq!(differ, 0);
}

#[test]
fn marked_faces_carry_the_alarm_colour_and_seams_are_drawn() {
    let sheet = Sheet::new(6, 6.0, false, |_, _| 0.0);
    let camera = Camera { towards: Some([0.0, 0.0, 1.0]), ..Camera::default() };
    let plain = SurfaceView { camera, ..sheet.view() };
    let count = |pixels: &Pixels, colour: Colour| pixels.rgb.chunks(3).filter(|c| *c == colour.0).count();
    let marked = draw(&SurfaceView { marked: &[7, 14], ..plain }, [600, 600]);
    let face = ((600.0 - 76.0) / 6.0_f64).powi(2);
    // Two faces, less the blended pixels around them.
    let found = count(&marked, ALARM) as f64;
    assert!((found / face - 2.0).abs() < 0.1, "{found} of {face}");
    assert_eq!(count(&draw(&plain, [600, 600]), ALARM), 0);

    let seam = [[8u32, 9], [9, 10]];
    let red = |pixels: &Pixels| pixels.rgb.chunks(3).filter(|c| c[0] > 150 && c[1] < 80).count();
    assert_eq!(red(&draw(&plain, [600, 600])), 0);
    // Two edges, 87 pixels each, at least three whole pixels wide.
    let found = red(&draw(&SurfaceView { seams: &seam, ..plain }, [600, 600]));
    assert!((2 * 87 * 3..2 * 92 * 4).contains(&found), "{found}");
}

#[test]
fn edges_of_the_mesh_are_drawn_where_there_is_room() {
    let changed = |n| {
        let sheet = Sheet::new(n, 4.0, false, |_, _| 0.0);
        let plain = draw(&sheet.view(), [500, 500]);
        let edges = draw(&SurfaceView { edges: true, ..sheet.view() }, [500, 500]);
        plain.rgb != edges.rgb
    };
    assert!(changed(10) && !changed(200));
}

#[test]
fn the_same_view_gives_the_same_bytes() {
    let sheet = torus(20, [8.0, 4.0], [3, 5]);
    let view = SurfaceView { title: "Torus", ..sheet.view() };
    assert_eq!(view.render([400, 300]).unwrap(), view.render([400, 300]).unwrap());
}

#[test]
fn shading_by_given_normals_is_that_of_faces_when_they_are_the_same() {
    let sheet = Sheet::new(5, 5.0, true, |x, y| x * x - y * y);
    let normal = |polygon: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|k| sheet.positions[polygon[k] as usize]);
        crate::common::cross(crate::common::sub(b, a), crate::common::sub(c, a))
    };
    let normals: Vec<Point> = sheet.faces.iter().map(normal).collect();
    let given = draw(&SurfaceView { shading: Shading::Normals(&normals), ..sheet.view() }, [400, 400]);
    let flat = draw(&SurfaceView { shading: Shading::Flat, ..sheet.view() }, [400, 400]);
    let smooth = draw(&sheet.view(), [400, 400]);
    assert!(given.rgb.iter().zip(&flat.rgb).all(|(a, b)| a.abs_diff(*b) <= 1));
    assert_ne!(flat.rgb, smooth.rgb);
}

#[test]
fn a_map_and_its_surface_stand_side_by_side() {
    let sheet = Sheet::new(4, 4.0, false, |_, _| 0.0);
    let points: Vec<[f64; 2]> = sheet.positions.iter().map(|p| [p[0], p[1]]).collect();
    let values = [1.0; 16];
    let flat = FlatMap {
        points: &points,
        faces: &sheet.faces,
        values: &values,
        flipped: &[],
        mark: None,
        title: "",
        scale_label: "σ₁/σ₂",
    };
    let pair =
        |caption| Pixels::of(&Pair { flat: &flat, view: &sheet.view(), side: Pair::SIDE, caption }.render().unwrap());
    let (bare, captioned) = (pair(""), pair("A caption"));
    assert!(bare.width > 2 * bare.height && captioned.height > bare.height && captioned.width == bare.width);
    // As strong a blue is on the right alone, where the checkerboard is.
    let blue = |x: usize| (0..bare.height).any(|y| bare.at(x, y).0[2] > bare.at(x, y).0[0].saturating_add(85));
    let first = (0..bare.width).find(|x| blue(*x)).unwrap();
    assert!(first > bare.width / 2, "{first} of {}", bare.width);
}

#[test]
fn maps_of_all_kinds_have_a_checkerboard() {
    for (source, boundary) in [
        ("sphere?n=12", Boundary::CIRCLE),
        ("graph:cos+cos?n=13&mesh=triangle", Boundary::FREE),
        ("torus?n=12", Boundary::Periodic),
    ] {
        let input = Input::open(source).unwrap();
        let mapped = map::map_input(&input, &MapOptions { boundary, ..MapOptions::default() }, &mut Silent).unwrap();
        let picture = Pixels::of(&checkerboard(&input, &mapped, Checkerboard::default(), source).unwrap());
        let inked = picture.rgb.chunks(3).filter(|c| *c != PAPER.0).count();
        assert!(inked as f64 > 0.3 * (picture.width * picture.height) as f64, "{source}: {inked}");
        checkerboard_pair(&input, &mapped, Checkerboard::default(), None, source).unwrap();
    }
}
