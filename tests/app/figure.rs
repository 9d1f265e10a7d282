//! The flat picture of a map.
use std::path::Path;

use proptest::prelude::*;
use riemap::figure::{ALARM, Colour, FigureError, FlatMap, Format, OVER, Scale, error_colour};
use riemap::surface::Faces;

const LABEL: &str = "quasi-conformal error σ₁/σ₂";

/// n × n quads on the unit square, each with its own value.
fn grid(n: u32) -> (Vec<[f64; 2]>, Faces, Vec<f64>) {
    let points = (0..=n).flat_map(|j| (0..=n).map(move |i| [f64::from(i) / f64::from(n), f64::from(j) / f64::from(n)]));
    let quad = |j: u32, i: u32| {
        let v = j * (n + 1) + i;
        [v, v + 1, v + n + 2, v + n + 1]
    };
    let faces: Faces = (0..n * n).map(|f| quad(f / n, f % n)).collect();
    let values = (0..n * n).map(|f| 1.0 + f64::from(f) / f64::from(n * n)).collect();
    (points.collect(), faces, values)
}

fn map<'a>(points: &'a [[f64; 2]], faces: &'a Faces, values: &'a [f64], flipped: &'a [usize]) -> FlatMap<'a> {
    FlatMap { points, faces, values, flipped, mark: None, title: "A < B & \"C\" > D", scale_label: LABEL }
}

fn svg(map: &FlatMap) -> String {
    String::from_utf8(map.render(Format::Svg).unwrap()).unwrap()
}

struct Pixels {
    width: usize,
    rgb: Vec<u8>,
}

impl Pixels {
    fn of(map: &FlatMap) -> Pixels {
        let bytes = map.render(Format::Png).unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb).unwrap();
        assert_eq!(info.color_type, png::ColorType::Rgb);
        Pixels { width: info.width as usize, rgb }
    }

    fn at(&self, [x, y]: [f64; 2]) -> Colour {
        let i = 3 * (y as usize * self.width + x as usize);
        Colour([self.rgb[i], self.rgb[i + 1], self.rgb[i + 2]])
    }

    /// Width and height of the bounding box of the pixels of a colour with x < `before`.
    fn extent(&self, colour: Colour, before: usize) -> [usize; 2] {
        let of_colour = self.rgb.chunks(3).enumerate().filter(|(_, c)| *c == colour.0);
        let places = of_colour.map(|(i, _)| [i % self.width, i / self.width]).filter(|[x, _]| *x < before);
        let (low, high) = places.fold(([usize::MAX; 2], [0; 2]), |(low, high), p| {
            ([low[0].min(p[0]), low[1].min(p[1])], [high[0].max(p[0]), high[1].max(p[1])])
        });
        [high[0] + 1 - low[0], high[1] + 1 - low[1]]
    }
}

/// Fill and corners of the first `count` polygons of an SVG: the faces in the order in which they are drawn.
fn polygons(svg: &str, count: usize) -> Vec<(String, Vec<[f64; 2]>)> {
    let document = roxmltree::Document::parse(svg).unwrap();
    let polygons = document.descendants().filter(|n| n.has_tag_name("polygon")).take(count);
    let number = |s: &str| s.parse::<f64>().unwrap();
    let corner = |pair: &str| {
        let (x, y) = pair.split_once(' ').unwrap();
        [number(x), number(y)]
    };
    polygons
        .map(|p| {
            let points = p.attribute("points").unwrap().split(',').map(corner).collect();
            (p.attribute("fill").unwrap().to_owned(), points)
        })
        .collect()
}

fn centroid(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64)
}

#[test]
fn a_face_has_the_colour_of_its_value_in_both_formats() {
    let (points, faces, values) = grid(10);
    let map = map(&points, &faces, &values, &[]);
    let (scale, pixels) = (Scale::for_errors(values.iter().copied()), Pixels::of(&map));
    let drawn = polygons(&svg(&map), 100);
    for ((fill, corners), value) in drawn.iter().zip(&values) {
        let expected = error_colour(scale.position(*value).unwrap());
        assert_eq!(*fill, expected.to_string());
        assert_eq!(pixels.at(centroid(corners)), expected);
    }
}

#[test]
fn a_unit_is_as_long_across_as_it_is_up() {
    for (width, height) in [(1.0, 1.0), (5.0, 1.0), (1.0, 20.0), (3e-8, 1e-8), (1e200, 2e200)] {
        let points = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]];
        let faces: Faces = [[0u32, 1, 2, 3]].iter().collect();
        let map = map(&points, &faces, &[1.0], &[0]);
        let drawn = &polygons(&svg(&map), 1)[0].1;
        let (across, up) = (drawn[1][0] - drawn[0][0], drawn[0][1] - drawn[3][1]);
        // Coordinates are rounded to hundredths of a pixel, the shorter side measures at least 57 pixels.
        assert!((across / up * (height / width) - 1.0).abs() < 5e-4, "{across} {up}");
        // On pixels: edges are anti-aliased and widened by half the stroke of flipped faces.
        let [w, h] = Pixels::of(&map).extent(ALARM, drawn[1][0] as usize + 10);
        assert!((w as f64 - across - 2.0).abs() <= 2.0 && (h as f64 - up - 2.0).abs() <= 2.0, "{w} {h}");
    }
}

#[test]
fn the_map_fills_the_plot_area() {
    let (points, faces, values) = grid(4);
    let document = svg(&map(&points, &faces, &values, &[]));
    let corners: Vec<_> = polygons(&document, 16).into_iter().flat_map(|p| p.1).collect();
    let width = corners.iter().map(|p| p[0]).fold(0.0, f64::max) - corners.iter().map(|p| p[0]).fold(1e9, f64::min);
    assert!(width > 1100.0, "{width}");
}

#[test]
fn flipped_faces_carry_the_alarm_colour_and_a_legend() {
    let (points, faces, mut values) = grid(10);
    values[7] = -1.5;
    let map = map(&points, &faces, &values, &[42]);
    let document = svg(&map);
    let drawn = polygons(&document, 100);
    // Face 7 by its sign, face 42 by the list; both after all others.
    let pixels = Pixels::of(&map);
    for (fill, corners) in &drawn[98..] {
        assert_eq!(*fill, ALARM.to_string());
        assert_eq!(pixels.at(centroid(corners)), ALARM);
    }
    assert!(drawn[..98].iter().all(|(fill, _)| *fill != ALARM.to_string()));
    assert!(document.contains(">2 flipped faces</text>"));
}

#[test]
fn without_flipped_faces_there_is_no_legend() {
    let (points, faces, values) = grid(3);
    let document = svg(&map(&points, &faces, &values, &[]));
    assert!(!document.contains("flipped") && !document.contains(&ALARM.to_string()));
}

#[test]
fn a_collapsed_face_has_the_colour_beyond_the_scale() {
    let (points, faces, mut values) = grid(10);
    values[55] = f64::INFINITY;
    let document = svg(&map(&points, &faces, &values, &[]));
    assert_eq!(polygons(&document, 100)[55].0, OVER.to_string());
    assert!(document.contains(">&gt; 2.0</text>"), "the arrow head is labelled");
}

#[test]
fn the_same_map_gives_the_same_bytes() {
    let (points, faces, values) = grid(20);
    let map = map(&points, &faces, &values, &[3]);
    for format in [Format::Png, Format::Svg] {
        assert!(map.render(format).unwrap() == map.render(format).unwrap());
    }
}

#[test]
fn an_svg_is_well_formed_with_one_polygon_a_face_and_escaped_text() {
    let (points, faces, values) = grid(30);
    let mut odd = map(&points, &faces, &values, &[]);
    let text = svg(&odd);
    let document = roxmltree::Document::parse(&text).unwrap();
    let on_faces = |n: &roxmltree::Node| n.has_tag_name("polygon") && n.attribute("stroke").is_some();
    assert_eq!(document.descendants().filter(on_faces).count(), 900);
    let texts: Vec<_> = document.descendants().filter(|n| n.has_tag_name("text")).map(|n| n.text()).collect();
    assert!(texts.contains(&Some("A < B & \"C\" > D")) && texts.contains(&Some(LABEL)));
    odd.title = "bell \u{7} nul \0 <";
    assert!(roxmltree::Document::parse(&svg(&odd)).is_ok());
    assert!(odd.render(Format::Png).is_ok());
}

#[test]
fn many_faces_become_a_picture_inside_a_small_svg() {
    let (points, faces, values) = grid(260);
    let text = svg(&map(&points, &faces, &values, &[]));
    let document = roxmltree::Document::parse(&text).unwrap();
    assert_eq!(document.descendants().filter(|n| n.has_tag_name("image")).count(), 1);
    assert!(text.len() < 15_000_000);
    // Just below the limit: vectors.
    let (points, faces, values) = grid(244);
    let text = svg(&map(&points, &faces, &values, &[]));
    assert!(!text.contains("<image") && text.len() < 15_000_000, "{}", text.len());
}

#[test]
fn mesh_edges_are_drawn_only_where_faces_have_room() {
    // The outline and, with room, the edges are the only strokes with round ends.
    let strokes = |n| {
        let (points, faces, values) = grid(n);
        svg(&map(&points, &faces, &values, &[])).matches("stroke-linecap=\"round\"").count()
    };
    assert_eq!(strokes(20), 2);
    assert_eq!(strokes(200), 1);
}

#[test]
fn faces_that_share_no_vertices_are_not_hidden_by_their_outlines() {
    let (points, faces, values) = grid(200);
    let apart: Vec<[f64; 2]> = faces.corners().iter().map(|v| points[*v as usize]).collect();
    let soup: Faces = (0..faces.len() as u32).map(|f| [0, 1, 2, 3].map(|k| 4 * f + k)).collect();
    assert!(!svg(&map(&apart, &soup, &values, &[])).contains("stroke-linecap=\"round\""));
}

#[test]
fn values_of_one_up_to_rounding_get_a_readable_scale() {
    let scale = Scale::for_errors([1.0, 1.0 + 1e-15, 1.0 - 1e-15]);
    let labels: Vec<_> = scale.ticks().into_iter().map(|t| t.1).collect();
    assert_eq!(labels, ["1.0000", "1.0002", "1.0004", "1.0006", "1.0008", "1.0010"]);
    assert!(!scale.exceeded());
    assert_eq!(scale.position(1.0 - 1e-15), Some(0.0));
}

#[test]
fn a_few_bad_faces_do_not_stretch_the_scale() {
    let scale = Scale::for_errors((0..1000).map(|i| if i < 5 { 40.0 } else { 1.0 + f64::from(i) * 3e-4 }));
    assert!((scale.upper() - 1.3).abs() < 1e-12);
    assert_eq!(scale.upper_label(), "1.30");
    assert!(scale.exceeded());
    assert_eq!(scale.position(40.0), None);
}

#[test]
fn large_errors_get_a_logarithmic_scale() {
    let scale = Scale::for_errors([1.0, 10.0, 100.0, 1000.0]);
    assert!((scale.position(10.0).unwrap() - 1.0 / 3.0).abs() < 1e-12);
    assert_eq!(scale.upper(), 1000.0);
}

proptest! {
    #[test]
    fn any_values_get_a_finite_scale_with_few_ordered_ticks(
        values in prop::collection::vec(
            prop_oneof![3 => 1.0..1.01, 2 => 1.0..20.0, 1 => 1.0..1e300, 1 => Just(f64::INFINITY)], 0..300)
    ) {
        let scale = Scale::for_errors(values.iter().copied());
        prop_assert!(scale.upper().is_finite() && scale.upper() > 1.0);
        let ticks = scale.ticks();
        prop_assert!((3..=12).contains(&ticks.len()), "{ticks:?}");
        prop_assert!(ticks.windows(2).all(|t| t[1].0 - t[0].0 > 0.01 && t[0].1 != t[1].1), "{ticks:?}");
        prop_assert!(ticks[0].0 == 0.0 && (ticks[ticks.len() - 1].0 - 1.0).abs() < 1e-9);
        let beyond = values.iter().filter(|v| scale.position(**v).is_none()).count();
        // One in a hundred of the finite ones; all of the infinite ones.
        let infinite = values.iter().filter(|v| v.is_infinite()).count();
        prop_assert!(beyond >= infinite && beyond - infinite <= values.len() / 100);
        prop_assert_eq!(beyond > 0, scale.exceeded());
    }

    #[test]
    fn any_finite_points_are_drawn_or_refused(
        points in prop::collection::vec(prop::array::uniform2(-1e3f64..1e3), 4),
        power in -330i32..330, offset in -1e6f64..1e6
    ) {
        let scale = 10f64.powi(power);
        let points: Vec<_> = points.iter().map(|p| p.map(|c| (c + offset) * scale)).collect();
        let faces: Faces = [[0u32, 1, 2, 3]].iter().collect();
        match map(&points, &faces, &[1.0], &[]).render(Format::Svg) {
            Ok(svg) => {
                let svg = String::from_utf8(svg).unwrap();
                prop_assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", svg);
            }
            Err(FigureError::Point { .. } | FigureError::NoExtent { .. } | FigureError::Extent { .. }) => {}
            Err(e) => prop_assert!(false, "{}", e),
        }
    }
}

#[test]
fn lightness_falls_steadily_along_the_scale() {
    let luminance = |t: f64| {
        let Colour(c) = error_colour(t);
        let linear = c.map(|c| (f64::from(c) / 255.0).powf(2.2));
        0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
    };
    let steps: Vec<f64> = (0..=50).map(|i| luminance(f64::from(i) / 50.0)).collect();
    assert!(steps.windows(2).all(|s| s[1] < s[0]));
}

#[test]
fn bad_data_is_refused_by_index() {
    let (good, faces, values) = grid(2);
    let refused = |points: &[[f64; 2]], faces: &Faces, values: &[f64], flipped: &[usize]| {
        let svg = map(points, faces, values, flipped).render(Format::Svg).unwrap_err().to_string();
        assert_eq!(svg, map(points, faces, values, flipped).render(Format::Png).unwrap_err().to_string());
        svg
    };
    let with = |v: usize, p: [f64; 2]| {
        let mut points = good.clone();
        points[v] = p;
        points
    };
    assert_eq!(
        refused(&with(8, [f64::NAN, 0.0]), &faces, &values, &[]),
        "vertex 8 of face 3 (0-based) is mapped to (NaN, 0), which is no point of the plane"
    );
    assert!(refused(&with(4, [f64::INFINITY, 0.0]), &faces, &values, &[]).starts_with("vertex 4 of face 0"));
    assert!(refused(&with(4, [1e308, -1e308]), &faces, &values, &[]).contains("too large"));
    assert!(refused(&good, &Faces::default(), &[], &[]).contains("no faces"));
    assert!(refused(&good, &faces, &values[1..], &[]).starts_with("3 values for 4 faces"));
    assert!(refused(&good, &faces, &[1.0, 1.0, f64::NAN, 1.0], &[]).contains("face 2 (0-based)"));
    assert!(refused(&good, &faces, &values, &[4]).contains("face 4"));
    assert!(refused(&[[1.0, 2.0]; 9], &faces, &values, &[]).contains("all vertices are mapped to (1, 2)"));
    let beyond: Faces = [[0u32, 1, 4, 3], [1, 2, 99, 4]].iter().collect();
    assert!(refused(&good, &beyond, &[1.0; 2], &[]).starts_with("face 1 has vertex 99, but there are only 9 points"));
}

#[test]
fn vertices_without_a_face_do_not_matter() {
    let (mut points, faces, values) = grid(2);
    let before = map(&points, &faces, &values, &[]).render(Format::Png).unwrap();
    points.push([f64::NAN, f64::INFINITY]);
    assert!(map(&points, &faces, &values, &[]).render(Format::Png).unwrap() == before);
}

#[test]
fn the_extension_decides_the_format() {
    assert_eq!(Format::from_path(Path::new("a/b.PNG")).unwrap(), Format::Png);
    assert_eq!(Format::from_path(Path::new("map.svg")).unwrap(), Format::Svg);
    for path in ["map", "map.pdf", ".png", "png"] {
        assert!(matches!(Format::from_path(Path::new(path)), Err(FigureError::UnknownFormat { .. })), "{path}");
    }
}
