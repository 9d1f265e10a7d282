//! A surfel of a digital surface, its estimated normal, and its projection on the tangent plane.

use num_complex::Complex64;
use serde_json::json;

use super::{
    BLUE, DiagramError, Drawn, GREY, INK, PALE_BLUE, PALE_ORANGE, Point, Subject, VERMILION, arrow, closed, dashed,
    label, line,
};
use crate::app::experiment::RunError;
use crate::figure::{Colour, Diagram, Form, Item, Panel};
use crate::geometry::vector::{add, cross, dot, norm, scale, sub};
use crate::quad_graph::rho::with_normal;
use crate::surface::Surface;
use crate::surface::edges::Edges;
use crate::surface::normals::Facets;

/// Distance up to which neighbouring surfels are drawn, in voxels.
const NEAR: f64 = 3.3;
/// How far the tangent plane is lifted off the surface so that it can be seen, in voxels.
const LIFT: f64 = 2.1;
/// Half the side of the piece of the tangent plane, in voxels.
const PLANE: f64 = 1.25;

pub(super) fn draw(subject: &Subject) -> Result<Drawn, RunError> {
    let (input, face) = (subject.input, subject.face);
    let surface = &input.surface;
    if input.digital.is_none() {
        let source_name = input.source.clone();
        return Err(DiagramError::Surface { diagram: "surfel", wanted: "surfels", source_name }.into());
    }
    let edges = Edges::new(&surface.faces, surface.positions.len());
    let facets = Facets::new(surface, &edges, input.digital.as_ref())?;
    let normal = subject.options.normals.clone().unwrap_or_default().estimate(&facets)?[face];
    let (own, centre) = (facets.normal[face], facets.centre[face]);
    let corners = [0, 1, 2, 3].map(|k| sub(surface.positions[surface.faces.get(face)[k] as usize], centre));
    let (d02, d13) = (sub(corners[2], corners[0]), sub(corners[3], corners[1]));
    let source_name = || input.source.clone();
    let rho = with_normal(d02, d13, normal)
        .ok_or_else(|| DiagramError::Surface {
            diagram: "surfel",
            wanted: "surfels that their normals see",
            source_name: source_name(),
        })?
        .rho;
    // The frame of the surfel: its edges from corner 0, its axis.
    let frame = [sub(corners[1], corners[0]), sub(corners[3], corners[0]), own];
    let n = frame.map(|axis| dot(axis, normal));

    let view = View::of(normal, own);
    let space = Panel {
        title: "surfel, normal, tangent plane".to_owned(),
        items: space(surface, &facets, face, normal, &view),
    };
    let projected = corners.map(|p| sub(p, scale(dot(p, normal), normal)));
    let flat = Panel { title: "projected along the normal".to_owned(), items: flat(projected, normal) };
    let numbers = json!({
        "rho": { "re": rho.re, "im": rho.im },
        "rho_closed": closed_form(n),
        "normal": n,
        "cosine": n[2],
    });
    Ok((Diagram { panels: vec![space, flat], columns: 2, caption: String::new() }, numbers))
}

/// ρ = (2 n3 − i (n1² − n2²)) / (2 − (n1 + n2)²), for a normal in the frame of the surfel.
fn closed_form([n1, n2, n3]: [f64; 3]) -> [f64; 2] {
    let rho = Complex64::new(2.0 * n3, -(n1 * n1 - n2 * n2)) / (2.0 - (n1 + n2).powi(2));
    [rho.re, rho.im]
}

/// Space → paper in parallel projection.
struct View {
    right: [f64; 3],
    up: [f64; 3],
    towards: [f64; 3],
}

impl View {
    /// The normal upright and a little towards the eye; the surfel's own axis to its right.
    fn of(normal: [f64; 3], own: [f64; 3]) -> View {
        let unit = |v: [f64; 3]| scale(1.0 / norm(v), v);
        let across = cross(own, normal);
        // A normal that is the surfel's own has no such side.
        let across = if norm(across) > 1e-6 { unit(across) } else { unit(cross(normal, [0.3, 0.5, 0.8])) };
        let aside = cross(normal, across);
        // 25° above the tangent plane, turned by 30° out of the plane of both normals.
        let (sin, cos) = 25f64.to_radians().sin_cos();
        let (turn_sin, turn_cos) = 30f64.to_radians().sin_cos();
        let level = add(scale(turn_cos, across), scale(turn_sin, aside));
        let towards = unit(add(scale(cos, level), scale(sin, normal)));
        let right = unit(cross(normal, towards));
        View { right, up: cross(towards, right), towards }
    }

    fn place(&self, p: [f64; 3]) -> Point {
        [dot(p, self.right), dot(p, self.up)]
    }
}

fn space(surface: &Surface, facets: &Facets, face: usize, normal: [f64; 3], view: &View) -> Vec<Item> {
    let origin = facets.centre[face];
    let place = |p: [f64; 3]| view.place(sub(p, origin));
    let outline = |f: usize| -> Vec<Point> {
        surface.faces.get(f).iter().map(|v| place(surface.positions[*v as usize])).collect()
    };
    // From behind to the front: surfels of a convex piece hide each other in this order.
    let mut near: Vec<usize> = (0..surface.faces.len())
        .filter(|&f| norm(sub(facets.centre[f], origin)) < NEAR && dot(facets.normal[f], view.towards) > 0.0)
        .collect();
    near.sort_by(|&f, &g| dot(facets.centre[f], view.towards).total_cmp(&dot(facets.centre[g], view.towards)));
    let mut items: Vec<Item> = near
        .into_iter()
        .map(|f| {
            // A lamp over the left shoulder.
            let lamp = add(scale(-0.45, view.right), add(scale(0.8, view.up), scale(0.4, view.towards)));
            let light = 0.74 + 0.26 * dot(facets.normal[f], lamp);
            let base = if f == face { [168.0, 208.0, 244.0] } else { [250.0, 250.0, 252.0] };
            let fill = Colour(base.map(|c: f64| (c * light.clamp(0.0, 1.0)) as u8));
            Item::Area { points: outline(f), fill, outline: Some((GREY, 1.6)) }
        })
        .collect();
    items.push(line(closed(outline(face)), BLUE, 4.0));

    let lifted = add(origin, scale(LIFT, normal));
    let axis = cross(view.right, normal);
    let axis = scale(1.0 / norm(axis), axis);
    let across = cross(axis, normal);
    // Turned, so that it is seen as a plane.
    let (sin, cos) = 55f64.to_radians().sin_cos();
    let (axis, across) = (add(scale(cos, axis), scale(sin, across)), add(scale(cos, across), scale(-sin, axis)));
    let plane = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
        .map(|[s, t]| place(add(lifted, add(scale(s * PLANE, axis), scale(t * PLANE, across)))));
    let corners = surface.faces.get(face).iter().map(|v| surface.positions[*v as usize]);
    let shadow: Vec<[f64; 3]> = corners.clone().map(|p| sub(p, scale(dot(sub(p, lifted), normal), normal))).collect();
    items.push(Item::Area { points: plane.to_vec(), fill: Colour([255, 249, 240]), outline: Some((VERMILION, 2.4)) });
    items.push(Item::Area {
        points: shadow.iter().map(|p| place(*p)).collect(),
        fill: PALE_ORANGE,
        outline: Some((VERMILION, 4.0)),
    });
    items.extend(corners.zip(&shadow).map(|(p, q)| dashed(vec![place(p), place(*q)], INK, 2.0)));
    let tip = add(lifted, scale(1.3, normal));
    items.push(arrow(place(lifted), place(tip), VERMILION, 5.0));
    items.push(label(place(tip), [30.0, 0.0], "n"));
    let own = add(origin, scale(1.15, facets.normal[face]));
    items.push(arrow(place(origin), place(own), BLUE, 5.0));
    items.push(label(place(own), [34.0, 6.0], "e₃"));
    items
}

/// The projected surfel in its plane, with its diagonals.
fn flat(projected: [[f64; 3]; 4], normal: [f64; 3]) -> Vec<Item> {
    // d02 to the right.
    let d02 = sub(projected[2], projected[0]);
    let right = scale(1.0 / norm(d02), d02);
    let up = cross(normal, right);
    let z: [Point; 4] = projected.map(|p| [dot(p, right), dot(p, up)]);
    let mut items = vec![
        Item::Area { points: z.to_vec(), fill: PALE_BLUE, outline: None },
        line(closed(z.to_vec()), BLUE, 4.0),
        arrow(z[0], z[2], INK, 3.6),
        arrow(z[1], z[3], VERMILION, 3.6),
    ];
    for (k, name) in ["v₀", "v₁", "v₂", "v₃"].iter().enumerate() {
        items.push(Item::Dot { at: z[k], form: Form::Disc, colour: INK, size: 8.0 });
        let away = z[k][0].hypot(z[k][1]).max(1e-9);
        items.push(label(z[k], [36.0 * z[k][0] / away, 36.0 * z[k][1] / away], *name));
    }
    items.push(label([0.55 * z[2][0], 0.55 * z[2][1]], [0.0, -26.0], "d₀₂"));
    items.push(label([0.55 * z[3][0], 0.55 * z[3][1]], [-40.0, 0.0], "d₁₃"));
    items
}
