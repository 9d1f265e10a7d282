//! The two circles on which a circle map with H = 0 has its boundary: the map, and the same with
//! radii stretched about 1.

use num_complex::Complex64;
use serde_json::json;

use super::{BLUE, Drawn, GREY, INK, Subject, VERMILION, arc, line};
use crate::app::experiment::RunError;
use crate::figure::{Diagram, Form, Item, Panel};
use crate::laplacian::ConformalLaplacian;
use crate::map::{self, MapError, MapOptions, Valid};
use crate::solver::Silent;
use crate::solver::boundary::{BoundaryError, NAME};
use crate::surface::edges::Edges;

/// How far from 1 the radii of the circles are drawn.
const APART: f64 = 0.12;

pub(super) fn draw(subject: &Subject) -> Result<Drawn, RunError> {
    let options = MapOptions { solver: NAME.into(), valid: Valid::Off, ..subject.options.clone() };
    let mapped = map::map_input(subject.input, &options, &mut Silent)?;
    let (disc, graph, map) = (&mapped.domain.disc, &mapped.domain.graph, &mapped.map);
    let laplacian =
        ConformalLaplacian::new(graph, || ()).map_err(|error| MapError::from(BoundaryError::from(error)))?;
    let epsilon = map.epsilon.unwrap_or_default();
    let scale = if graph.primal < graph.vertices { (1.0 + epsilon).sqrt() } else { 1.0 };
    let of = |vertices: &[u32]| vertices.iter().map(|&v| scale * map.z[v as usize]).collect::<Vec<Complex64>>();
    let (black, white) = (of(laplacian.black_boundary()), of(laplacian.white_boundary()));
    let radii = [(1.0 + epsilon).sqrt(), (1.0 - epsilon).sqrt()];
    let stretch = APART / (0.5 * epsilon.abs()).max(f64::MIN_POSITIVE);

    let edges = Edges::new(&disc.faces, disc.positions.len());
    let mesh = edges.ends.iter().map(|ends| of(ends).into_iter().map(|z| [z.re, z.im]).collect());
    let mut plain: Vec<Item> = mesh.map(|points| line(points, GREY, 1.6)).collect();
    plain.push(line(arc([0.0, 0.0], 1.0, 0.0, std::f64::consts::TAU), INK, 1.6));
    plain.extend(dots(&white, |z| z, Form::Square));
    plain.extend(dots(&black, |z| z, Form::Disc));

    let away = |r: f64| 1.0 + stretch * (r - 1.0);
    let colours = [INK, BLUE];
    let circle = |(r, colour): (f64, _)| line(arc([0.0, 0.0], away(r), 0.0, std::f64::consts::TAU), colour, 2.0);
    let mut stretched: Vec<Item> = radii.into_iter().zip(colours).map(circle).collect();
    stretched.push(line(arc([0.0, 0.0], 1.0, 0.0, std::f64::consts::TAU), GREY, 1.0));
    let moved = |z: Complex64| z * away(z.norm()) / z.norm();
    stretched.extend(dots(&white, moved, Form::Square));
    stretched.extend(dots(&black, moved, Form::Disc));
    stretched.extend(map.fixed.iter().map(|(_, z)| {
        let z = moved(scale * z);
        Item::Dot { at: [z.re, z.im], form: Form::Disc, colour: VERMILION, size: 11.0 }
    }));

    let panels = vec![
        Panel { title: "the map".to_owned(), items: plain },
        Panel { title: format!("its boundary, |z| − 1 times {stretch:.0}"), items: stretched },
    ];
    let off = |points: &[Complex64], r: f64| points.iter().map(|z| (z.norm() - r).abs()).fold(0.0, f64::max);
    let result = json!({
        "epsilon": epsilon,
        "radii": radii,
        "off_circles": off(&black, radii[0]).max(off(&white, radii[1])),
        "residual": laplacian.residual(graph, &map.z),
    });
    Ok((Diagram { panels, columns: 2, caption: String::new() }, result))
}

/// Marks at boundary points: black discs, blue squares for white.
fn dots(points: &[Complex64], moved: impl Fn(Complex64) -> Complex64, form: Form) -> Vec<Item> {
    let colour = if form == Form::Disc { INK } else { BLUE };
    let mark = |&z: &Complex64| {
        let z = moved(z);
        Item::Dot { at: [z.re, z.im], form, colour, size: 6.0 }
    };
    points.iter().map(mark).collect()
}
