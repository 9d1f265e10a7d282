//! The initial map: boundary on the circle by arc length, interior at the origin, then where H is
//! least.

use num_complex::Complex64;
use serde_json::json;

use super::{Drawn, GREY, INK, Point, Subject, VERMILION, closed, label, line};
use crate::app::experiment::RunError;
use crate::figure::{Colour, Diagram, Form, Item, Panel};
use crate::map::{self, Boundary, MapOptions, Mapped, PinnedPoints, Valid};
use crate::solver::Silent;
use crate::surface::edges::Edges;

/// Numbers of fixed points.
const FIXED: [PinnedPoints; 2] = [PinnedPoints::Two, PinnedPoints::Three];

pub(super) fn draw(subject: &Subject) -> Result<Drawn, RunError> {
    let (mut panels, mut numbers) = (Vec::new(), serde_json::Map::new());
    for (pinned, word) in FIXED.into_iter().zip(["two", "three"]) {
        // What the minimisation begins with is its map after no iteration.
        let boundary = Boundary::Circle { pinned, ordered: false };
        let options = MapOptions { boundary, max_iterations: Some(0), valid: Valid::Off, ..subject.options.clone() };
        let mapped = map::map_input(subject.input, &options, &mut Silent)?;
        if panels.is_empty() {
            panels
                .push(Panel { title: "interior at the origin".to_owned(), items: mesh(&mapped, &at_origin(&mapped)) });
        }
        let items = mesh(&mapped, &mapped.map.z).into_iter().chain(held(&mapped)).collect();
        panels.push(Panel { title: format!("H minimised, {word} held"), items });
        let angles: Vec<f64> = mapped.map.fixed.iter().map(|(_, z)| z.arg().to_degrees()).collect();
        let h = mapped.map.energies.iter().find(|(name, _)| *name == "H").map(|(_, value)| *value);
        numbers.insert(word.to_owned(), json!({ "H": h, "angles": angles }));
    }
    Ok((Diagram { panels, columns: 3, caption: String::new() }, numbers.into()))
}

/// The map before H is minimised.
fn at_origin(mapped: &Mapped) -> Vec<Complex64> {
    let mut z = vec![Complex64::default(); mapped.map.z.len()];
    mapped.domain.graph.boundary.iter().for_each(|&v| z[v as usize] = mapped.map.z[v as usize]);
    z
}

/// The edges of the mesh, its boundary, and the vertices there.
fn mesh(mapped: &Mapped, z: &[Complex64]) -> Vec<Item> {
    let disc = &mapped.domain.disc;
    let at = |v: u32| -> Point { [z[v as usize].re, z[v as usize].im] };
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let seen = edges.ends.iter().filter(|ends| at(ends[0]) != at(ends[1]));
    let mut items: Vec<Item> = seen.map(|ends| line(ends.map(at).to_vec(), GREY, 1.6)).collect();
    items.push(line(closed(disc.boundary.iter().map(|v| at(*v)).collect()), INK, 3.0));
    items.extend(disc.boundary.iter().map(|v| dot(at(*v), 5.0, INK)));
    items
}

/// The fixed points.
fn held(mapped: &Mapped) -> Vec<Item> {
    let numbered = mapped.map.fixed.iter().zip(["z₁", "z₂", "z₃"]);
    let marked = numbered.flat_map(|((_, z), name)| {
        let at = [z.re, z.im];
        [dot(at, 13.0, VERMILION), label(at, [-44.0 * z.re, -44.0 * z.im], name)]
    });
    marked.collect()
}

fn dot(at: Point, size: f64, colour: Colour) -> Item {
    Item::Dot { at, form: Form::Disc, colour, size }
}
