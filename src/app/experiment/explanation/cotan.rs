//! The cotan weight of an edge: two triangles unfolded into a plane, their circumcentres, and the
//! dual edge.

use std::f64::consts::TAU;

use serde_json::json;

use super::{BLUE, DiagramError, Drawn, GREY, INK, PALE_BLUE, Point, Subject, VERMILION, arc, closed, label, line};
use crate::app::experiment::RunError;
use crate::figure::{Diagram, Form, Item, Panel};
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::map::{Domain, MapOptions};
use crate::quad_graph::dual::{Circumcentre, DualPoint};
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;

pub(super) fn draw(subject: &Subject) -> Result<Drawn, RunError> {
    let input = subject.input;
    if input.surface.faces.arity() != Some(3) {
        let source_name = input.source.clone();
        return Err(DiagramError::Surface { diagram: "cotan", wanted: "triangles", source_name }.into());
    }
    let disc = OrientedMesh::new(&input.surface, &input.diagnosis()).map_err(DiagramError::from)?;
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let (face, corner) = (subject.face, subject.corner);
    let no_edge = || DiagramError::Edge { face, corner };
    let c = disc.faces.corner_range(face).nth(corner).ok_or_else(no_edge)?;
    let d = edges.opposite(c).ok_or_else(no_edge)?;
    let (left, right) = (Side::of(&disc, face, c), Side::of(&disc, edges.face_of_corner[d] as usize, d));

    let options = MapOptions { dual: Circumcentre.name().to_owned(), ..subject.options.clone() };
    let graph = Domain::of_positions(disc, &options)?.graph;
    // Quads are numbered as edges.
    let rho = graph.rho[edges.of_corner[c] as usize];
    let half_cotangents = 0.5 * (1.0 / left.angle.tan() + 1.0 / right.angle.tan());
    let numbers = json!({
        "alpha": left.angle.to_degrees(),
        "beta": right.angle.to_degrees(),
        "rho": { "re": rho.re, "im": rho.im },
        "half_cotangents": half_cotangents,
        "dual_length": left.centre[1] + right.centre[1],
    });
    Ok((Diagram { panels: vec![panel(&left, &right)], columns: 1, caption: String::new() }, numbers))
}

/// A triangle seen from one of its edges, as 0 → 1, in the upper half plane.
struct Side {
    third: Point,
    centre: Point,
    /// Opposite the edge.
    angle: f64,
}

impl Side {
    fn of(disc: &OrientedMesh, face: usize, corner: usize) -> Side {
        let corners = disc.faces.corners();
        let after = next_in(&disc.faces, face, corner);
        let last = next_in(&disc.faces, face, after);
        let [a, b, c] = [corner, after, last].map(|k| disc.positions[corners[k] as usize]);
        let (edge, third) = (sub(b, a), sub(c, a));
        let (t, u) = (dot(edge, third) / dot(edge, edge), norm(cross(edge, third)) / dot(edge, edge));
        let (s, h) = Circumcentre.place(t, u);
        let (to_a, to_b) = (sub(a, c), sub(b, c));
        Side { third: [t, u], centre: [s, h], angle: norm(cross(to_a, to_b)).atan2(dot(to_a, to_b)) }
    }
}

fn panel(left: &Side, right: &Side) -> Panel {
    // The right triangle sees the edge from its other end.
    let turned = |[x, y]: Point| [1.0 - x, -y];
    let ends: [Point; 2] = [[0.0, 0.0], [1.0, 0.0]];
    let (up, down) = (left.third, turned(right.third));
    let (c_f, c_g) = (left.centre, turned(right.centre));
    let mut items = vec![Item::Area { points: vec![ends[0], c_g, ends[1], c_f], fill: PALE_BLUE, outline: None }];
    for centre in [c_f, c_g] {
        let radius = centre[0].hypot(centre[1]);
        items.push(line(arc(centre, radius, 0.0, TAU), GREY, 1.8));
    }
    // The angle at a third vertex, and half of it at the circumcentre, between the bisector and an end.
    for (third, centre, name) in [(up, c_f, "α"), (down, c_g, "β")] {
        for (at, ends, radius) in [(third, ends, 0.15), (centre, [ends[1], [centre[0], 0.0]], 0.11)] {
            let mut angles = ends.map(|p| (p[1] - at[1]).atan2(p[0] - at[0]));
            angles.sort_by(f64::total_cmp);
            items.push(line(arc(at, radius, angles[0], angles[1]), VERMILION, 3.0));
            let middle: f64 = (angles[0] + angles[1]) / 2.0;
            let reach = radius + 0.035;
            items.push(label([at[0] + reach * middle.cos(), at[1] + reach * middle.sin()], [0.0, 0.0], name));
        }
        items.push(line(vec![ends[1], centre, ends[0]], BLUE, 1.8));
    }
    items.push(line(closed(vec![ends[0], ends[1], up]), INK, 4.0));
    items.push(line(vec![ends[0], down, ends[1]], INK, 4.0));
    items.push(line(vec![c_f, c_g], BLUE, 5.0));
    let dots = [(ends[0], INK), (ends[1], INK), (up, INK), (down, INK)];
    items.extend(dots.map(|(at, colour)| Item::Dot { at, form: Form::Disc, colour, size: 9.0 }));
    items.extend([c_f, c_g].map(|at| Item::Dot { at, form: Form::Square, colour: BLUE, size: 10.0 }));
    items.push(label(ends[0], [-38.0, 0.0], "v₀"));
    items.push(label(ends[1], [38.0, 0.0], "v₂"));
    items.push(label(c_f, [-34.0, 18.0], "v₃"));
    items.push(label(c_g, [-34.0, -18.0], "v₁"));
    Panel { title: String::new(), items }
}
