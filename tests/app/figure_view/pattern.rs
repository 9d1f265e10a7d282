//! The checkerboard is where it should be.

use riemap::figure::{Camera, Colour, SurfaceView};
use riemap::surface::Faces;

use super::shared::{Sheet, draw, is_light, torus};
use crate::common::Random;

#[test]
fn a_plane_seen_from_above_shows_exactly_the_checker() {
    for triangles in [false, true] {
        let sheet = Sheet::new(3, 8.0, triangles, |_, _| 0.0);
        let camera = Camera { towards: Some([0.0, 0.0, 1.0]), ..Camera::default() };
        let pixels = draw(&SurfaceView { camera, ..sheet.view() }, [700, 700]);
        let rows = pixels.rows();
        let (top, bottom, left, right) = (rows[0].0, rows[rows.len() - 1].0, rows[5].1, rows[5].2);
        let (width, height) = ((right - left) as f64, (bottom - top) as f64);
        // A square, but for the outline around it.
        assert!((width - height).abs() <= 2.0, "{width} × {height}");
        let mut checked = 0;
        for (y, x) in (top..bottom).flat_map(|y| (left..right).map(move |x| (y, x))) {
            let u = (x as f64 + 0.5 - left as f64) / width * 8.0;
            let v = (bottom as f64 - y as f64 - 0.5) / height * 8.0;
            // Two pixels from the squares' edges: their outline may lie between pixels.
            let far = |u: f64| (u - u.round()).abs() * width / 8.0 > 3.0;
            if far(u) && far(v) {
                checked += 1;
                assert_eq!(is_light(pixels.at(x, y)), (u.floor() + v.floor()) % 2.0 == 0.0, "{u} {v}");
            }
        }
        assert!(checked > 200_000, "{checked}");
    }
}

#[test]
fn the_pattern_is_correct_in_perspective() {
    // Two triangles, so that interpolation that is affine on paper would be far off; seen flatly, at a wide angle.
    let squares = 10.0;
    let sheet = Sheet::new(1, squares, true, |_, _| 0.0);
    let elevation = 25f64.to_radians();
    let camera =
        Camera { towards: Some([0.0, -elevation.cos(), elevation.sin()]), field_of_view: 70.0, ..Camera::default() };
    let pixels = draw(&SurfaceView { camera, ..sheet.view() }, [1000, 1000]);
    // The same projection, written down independently: eye, picture's axes.
    let radius = 0.5f64.sqrt();
    let distance = radius / 35f64.to_radians().sin();
    let project = |x: f64, y: f64| {
        let (x, y) = (x - 0.5, y - 0.5);
        let depth = distance + y * elevation.cos();
        [x / depth, y * elevation.sin() / depth]
    };
    let rows = pixels.rows();
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let (near, far) = (project(0.0, 0.0), project(1.0, 1.0));
    // The near edge spans the picture's width.
    let scale = (last.2 - last.1) as f64 / (-2.0 * near[0]);
    let middle = (last.1 + last.2 + 1) as f64 / 2.0;
    let height = (far[1] - near[1]) * scale;
    assert!((height - (last.0 - first.0) as f64).abs() < 6.0, "{height}");
    let mut checked = 0;
    for (j, i) in (0..10).flat_map(|j| (0..10).map(move |i| (j, i))) {
        // In each square points a sixth of its side from its edges: 2 pixels and more, at the far end.
        for (s, t) in [(0.17, 0.17), (0.83, 0.17), (0.5, 0.5), (0.17, 0.83), (0.83, 0.83)] {
            let [x, y] = project((f64::from(i) + s) / squares, (f64::from(j) + t) / squares);
            let (column, row) = (middle + x * scale, last.0 as f64 - (y - near[1]) * scale);
            let colour = pixels.at(column as usize, row as usize);
            assert_eq!(is_light(colour), (i + j) % 2 == 0, "square {i} {j} at {column} {row}: {colour:?}");
            checked += 1;
        }
    }
    assert_eq!(checked, 500);
}

#[test]
fn there_are_no_cracks_between_faces() {
    let mut random = Random(7);
    for triangles in [false, true] {
        let mut sheet = Sheet::new(40, 0.0, triangles, |_, _| 0.0);
        for v in (0..41 * 41).filter(|v| (1..40).contains(&(v % 41)) && (1..40).contains(&(v / 41))) {
            let shift = [random.real(), random.real()].map(|x| x / 100.0);
            sheet.positions[v] = [sheet.positions[v][0] + shift[0], sheet.positions[v][1] + shift[1], 0.0];
        }
        sheet.uv.iter_mut().for_each(|uv| *uv = [0.5; 2]);
        let pixels = draw(&sheet.view(), [900, 900]);
        let rows = pixels.rows();
        assert!(rows.len() > 400);
        let colour = pixels.at(pixels.width / 2, pixels.height / 2);
        let (mut inner, mut other) = (0, 0);
        for (y, left, right) in rows {
            // The outline's own rim, blended with paper, is three pixels wide where it runs aslant.
            for x in left + 6..(right + 1).saturating_sub(6) {
                let Colour(here) = pixels.at(x, y);
                // Paper is brighter, the outline darker.
                assert!(here.iter().zip(colour.0).all(|(a, b)| *a <= b), "at {x} {y}: {here:?}");
                inner += 1;
                other += usize::from(here != colour.0);
            }
        }
        assert!(other * 100 < inner, "{other} of {inner} pixels are blended");
    }
}

#[test]
fn a_torus_has_no_visible_seam_wherever_it_is_cut() {
    let picture = |cut| draw(&torus(48, [24.0, 10.0], cut).view(), [700, 600]);
    let reference = picture([0, 0]);
    for cut in [[11, 0], [0, 29], [17, 40]] {
        let other = picture(cut);
        assert_eq!(reference.width, other.width);
        // Coordinates differ by whole numbers, hence in their last digits.
        let differ = reference.rgb.iter().zip(&other.rgb).filter(|(a, b)| a.abs_diff(**b) > 1).count();
        assert_eq!(differ, 0, "cut at {cut:?}");
    }
    // An odd step is seen: the test can fail.
    let odd = draw(&torus(48, [23.0, 10.0], [11, 0]).view(), [700, 600]);
    let even = draw(&torus(48, [23.0, 10.0], [0, 0]).view(), [700, 600]);
    assert!(odd.rgb.iter().zip(&even.rgb).filter(|(a, b)| a != b).count() > 1000);
}

#[test]
fn squares_below_a_pixel_fade_to_one_tone() {
    // 100 000 squares across 600 pixels, seen in perspective: point samples would make moiré of full contrast.
    for squares in [1_000.0, 3_333.3, 1e5, 1e18] {
        let sheet = Sheet::new(4, squares, false, |_, _| 0.0);
        let pixels = draw(&sheet.view(), [640, 640]);
        let inner = pixels.rows().into_iter().flat_map(|(y, left, right)| {
            let pixels = &pixels;
            (left + 8..(right + 1).saturating_sub(8)).map(move |x| pixels.at(x, y).0[0])
        });
        let (low, high) = inner.fold((255, 0), |(low, high), r| (r.min(low), r.max(high)));
        // The outline's ends reach into the first rows; there its ink is darker.
        assert!(high < 215 && high > 150, "{squares}: {low} to {high}");
        let middle = (pixels.width / 4..3 * pixels.width / 4).map(|x| pixels.at(x, pixels.height / 2).0[0]);
        let (low, high) = middle.fold((255, 0), |(low, high), r| (r.min(low), r.max(high)));
        assert!(high - low <= 3, "{squares}: {low} to {high}");
    }
}

#[test]
fn nearer_faces_hide_farther_ones_in_any_order() {
    let square = |z: f64, size: f64| {
        let s = size / 2.0;
        [[-s, -s, z], [s, -s, z], [s, s, z], [-s, s, z]]
    };
    let camera = Camera { towards: Some([0.0, 0.0, 1.0]), ..Camera::default() };
    let mut pictures = Vec::new();
    for first in [0, 1] {
        let (wide, narrow) = (square(0.0, 2.0), square(0.5, 1.0));
        let squares = if first == 0 { [wide, narrow] } else { [narrow, wide] };
        let positions = squares.concat();
        let faces: Faces = [[0u32, 1, 2, 3], [4, 5, 6, 7]].iter().collect();
        // The wide one is light, the narrow one dark.
        let uv: Vec<[f64; 2]> = (0..8).map(|c| if (c < 4) == (first == 0) { [0.5, 0.5] } else { [1.5, 0.5] }).collect();
        let view = SurfaceView { camera, ..SurfaceView::new(&positions, &faces, &uv) };
        let pixels = draw(&view, [500, 500]);
        assert!(!is_light(pixels.at(250, 250)) && is_light(pixels.at(60, 250)));
        pictures.push(pixels.rgb);
    }
    assert_eq!(pictures[0], pictures[1]);
}

#[test]
fn size_and_place_of_the_surface_do_not_matter() {
    let reference = draw(&Sheet::new(6, 6.0, false, |x, y| x * y).view(), [500, 400]);
    // Powers of two: the same numbers up to exponents.
    for factor in [2f64.powi(-330), 2f64.powi(330), 1.0] {
        let mut sheet = Sheet::new(6, 6.0, false, |x, y| x * y);
        sheet.positions.iter_mut().for_each(|p| *p = p.map(|x| x * factor));
        assert_eq!(draw(&sheet.view(), [500, 400]).rgb, reference.rgb, "{factor:e}");
    }
}
