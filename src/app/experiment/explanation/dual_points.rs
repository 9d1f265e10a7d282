//! The dual points of a triangle, and the quads that they make of a triangle mesh.

use std::f64::consts::TAU;

use serde_json::{Map, Value, json};

use super::{BLUE, DiagramError, Drawn, GREEN, GREY, INK, ORANGE, Point, Subject, arc, closed, dashed, line};
use crate::app::experiment::RunError;
use crate::figure::{Colour, Diagram, Form, Item, Panel};
use crate::map::{Domain, MapOptions};
use crate::quad_graph::QuadGraph;
use crate::quad_graph::dual::DUAL_POINTS;
use crate::surface::oriented_mesh::OrientedMesh;

pub(super) fn draw(subject: &Subject) -> Result<Drawn, RunError> {
    let input = subject.input;
    let flat = input.surface.positions.windows(2).all(|pair| pair[0][2] == pair[1][2]);
    if input.surface.faces.arity() != Some(3) || !flat {
        let source_name = input.source.clone();
        return Err(DiagramError::Surface {
            diagram: "dual-points",
            wanted: "triangles in a plane z = c",
            source_name,
        }
        .into());
    }
    let disc = OrientedMesh::new(&input.surface, &input.diagnosis()).map_err(DiagramError::from)?;
    let corners = [0, 1, 2].map(|k| plane(&disc, disc.faces.get(subject.face)[k]));
    let mut panels = vec![Panel { title: "one triangle".to_owned(), items: triangle(corners) }];
    let mut numbers = Map::new();
    for (dual, look) in DUAL_POINTS.iter().zip(looks()) {
        let options = MapOptions { dual: dual.name().to_owned(), ..subject.options.clone() };
        let graph = Domain::of_positions(disc.clone(), &options)?.graph;
        let largest = graph.rho.iter().map(|rho| rho.im.abs()).fold(0.0, f64::max);
        numbers.insert(dual.name().to_owned(), json!({ "min_re_rho": graph.min_re_rho(), "max_im_rho": largest }));
        let places = places(&disc, &graph, dual.name());
        panels.push(Panel { title: format!("{}s", dual.name()), items: quads(&disc, &graph, &places, look) });
    }
    Ok((Diagram { panels, columns: 2, caption: String::new() }, Value::Object(numbers)))
}

/// Form and colour of each row of [`DUAL_POINTS`].
fn looks() -> impl Iterator<Item = (Form, Colour)> {
    [(Form::Square, ORANGE), (Form::Disc, BLUE), (Form::Triangle, GREEN)].into_iter().cycle()
}

fn plane(disc: &OrientedMesh, v: u32) -> Point {
    let [x, y, _] = disc.positions[v as usize];
    [x, y]
}

fn distance(a: Point, b: Point) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn between(a: Point, b: Point, t: f64) -> Point {
    [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
}

/// The dual point of that name of a triangle.
fn dual_place(corners: [Point; 3], name: &str) -> Point {
    let [a, b, c] = corners;
    let lengths = [distance(b, c), distance(c, a), distance(a, b)];
    let weights = DUAL_POINTS.iter().find(|dual| dual.name() == name).map_or([1.0; 3], |dual| dual.weights(lengths));
    let total: f64 = weights.iter().sum();
    [0, 1].map(|k| (weights[0] * a[k] + weights[1] * b[k] + weights[2] * c[k]) / total)
}

/// Where all vertices of a quad graph are: those of the mesh, the dual points of its faces, the
/// midpoints of its boundary.
fn places(disc: &OrientedMesh, graph: &QuadGraph, name: &str) -> Vec<Point> {
    let mut places: Vec<Point> = (0..graph.primal as u32).map(|v| plane(disc, v)).collect();
    places.extend(disc.faces.iter().map(|face| dual_place([0, 1, 2].map(|k| plane(disc, face[k])), name)));
    let next = disc.boundary.iter().cycle().skip(1);
    places.extend(disc.boundary.iter().zip(next).map(|(v, w)| between(plane(disc, *v), plane(disc, *w), 0.5)));
    places
}

/// A triangle with its three points and what makes each.
fn triangle(corners: [Point; 3]) -> Vec<Item> {
    let [circum, bary, inner] = ["circumcentre", "barycentre", "incentre"].map(|name| dual_place(corners, name));
    let area = (corners[1][0] - corners[0][0]) * (corners[2][1] - corners[0][1])
        - (corners[1][1] - corners[0][1]) * (corners[2][0] - corners[0][0]);
    let perimeter: f64 = (0..3).map(|k| distance(corners[k], corners[(k + 1) % 3])).sum();
    let mut items = vec![
        line(arc(circum, distance(circum, corners[0]), 0.0, TAU), BLUE, 2.5),
        line(arc(inner, area.abs() / perimeter, 0.0, TAU), GREEN, 2.5),
    ];
    for k in 0..3 {
        let middle = between(corners[(k + 1) % 3], corners[(k + 2) % 3], 0.5);
        items.push(dashed(vec![middle, circum], BLUE, 2.0));
        items.push(line(vec![corners[k], middle], ORANGE, 1.6));
        items.push(dashed(vec![corners[k], inner], GREEN, 2.0));
    }
    items.push(line(closed(corners.to_vec()), INK, 4.0));
    let named = [("circumcentre", circum), ("barycentre", bary), ("incentre", inner)];
    for (name, at) in named {
        let row = DUAL_POINTS.iter().position(|dual| dual.name() == name).unwrap_or_default();
        let (form, colour) = looks().nth(row).unwrap_or((Form::Disc, INK));
        items.push(Item::Dot { at, form, colour, size: 13.0 });
    }
    // Beside the points, away from their middle: the lowest, the middle one, the highest.
    let middle = (circum[0] + bary[0] + inner[0]) / 3.0;
    let mut rows = named;
    rows.sort_by(|a, b| a.1[1].total_cmp(&b.1[1]));
    for ((text, at), up) in rows.into_iter().zip([-26.0, 0.0, 26.0]) {
        let side = if at[0] < middle { -1.0 } else { 1.0 };
        items.push(Item::Label { at, shift: [side * 120.0, up], text: text.to_owned(), covering: true });
    }
    items
}

/// A triangle mesh, grey, under the quads of its quad graph.
fn quads(disc: &OrientedMesh, graph: &QuadGraph, places: &[Point], (form, colour): (Form, Colour)) -> Vec<Item> {
    let at = |v: u32| places[v as usize];
    let mut items: Vec<Item> =
        disc.faces.iter().map(|face| line(closed(face.iter().map(|v| at(*v)).collect()), GREY, 2.0)).collect();
    for quad in &graph.quads {
        items.push(line(closed(quad.iter().map(|v| at(*v)).collect()), colour, 3.2));
    }
    for v in 0..graph.vertices as u32 {
        items.push(if graph.is_dual(v) {
            Item::Dot { at: at(v), form, colour, size: 8.0 }
        } else {
            Item::Dot { at: at(v), form: Form::Disc, colour: INK, size: 7.0 }
        });
    }
    items
}
