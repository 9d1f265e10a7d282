//! Holes closed for the sake of a map.
//!
//! Triangle meshes get a fan around a new vertex in the middle of the hole, quad meshes one of quads, (middle, v0, v1, v2),
//! (middle, v2, v3, v4) …; a hole of as many edges as the faces have gets one face, and one of two edges is sewn up.

use crate::geometry::vector::{add, cross, dot, norm, scale, sub};
use crate::surface::Faces;
use crate::surface::cut::{CutError, CutRecord, Sheet};
use crate::surface::oriented_mesh::OrientedMesh;

/// A middle point will do where every new face has a sine of at least this between base and spoke, or diagonals.
const GOOD: f64 = 0.05;

/// Below this, doubles give such a face no ρ worth the name.
const FLAT: f64 = 1e-6;

/// How far above the hole the middle is tried where in the plane faces would be flat, in units of the hole's radius.
const HEIGHTS: [f64; 7] = [0.0, 0.25, -0.25, 0.5, -0.5, 1.0, -1.0];

/// Fills the holes that `loops` are, given as the corners along them.
///
/// # Errors
/// A hole of an odd number of edges in a quad mesh; one that no faces of positive area fill.
pub(super) fn fill(sheet: &mut Sheet, loops: &[Vec<u32>], record: &mut CutRecord) -> Result<(), CutError> {
    for along in loops {
        let before = sheet.source_face.len();
        fill_one(sheet, along)?;
        record.holes_filled += 1;
        record.faces_added += sheet.source_face.len() - before;
    }
    Ok(())
}

fn fill_one(sheet: &mut Sheet, along: &[u32]) -> Result<(), CutError> {
    let vertices: Vec<u32> = along.iter().map(|&c| sheet.corners[c as usize]).collect();
    let vertex = vertices.iter().map(|&v| sheet.source_vertex[v as usize]).min().unwrap_or(OrientedMesh::NEW);
    let edges = along.len();
    if let &[c, d] = along {
        sheet.twins[c as usize] = d;
        sheet.twins[d as usize] = c;
        return Ok(());
    }
    let places: Vec<[f64; 3]> = vertices.iter().map(|&v| sheet.positions[v as usize]).collect();
    let step = sheet.arity - 2;
    if !edges.is_multiple_of(step) {
        return Err(CutError::OddHole { vertex, edges });
    }
    if edges == sheet.arity && !is_a_face(sheet, along, &vertices) && sine(&places) >= GOOD {
        push_face(sheet, vertices.iter().rev().copied());
        let base = (sheet.corners.len() - edges) as u32;
        for k in 0..edges {
            pair(sheet, base + k as u32, along[(2 * edges - 2 - k) % edges]);
        }
        return Ok(());
    }
    let (first, middle, quality) = middle(&places, step);
    if quality < FLAT {
        return Err(CutError::FlatHole { vertex, edges });
    }
    let centre = sheet.positions.len() as u32;
    sheet.positions.push(middle);
    sheet.source_vertex.push(OrientedMesh::NEW);
    let base = sheet.corners.len();
    let around = |k: usize| (first + k) % edges;
    let faces = edges / step;
    for j in 0..faces {
        let rim = (0..=step).rev().map(|i| vertices[around(j * step + i)]);
        push_face(sheet, std::iter::once(centre).chain(rim));
        let corner = base + j * sheet.arity;
        for i in 0..step {
            pair(sheet, (corner + 1 + i) as u32, along[around((j + 1) * step - 1 - i)]);
        }
        // The last spoke of each face is the first of the one before.
        let before = base + (j + faces - 1) % faces * sheet.arity;
        if j > 0 {
            pair(sheet, (corner + step + 1) as u32, before as u32);
        }
    }
    pair(sheet, (base + step + 1) as u32, (base + (faces - 1) * sheet.arity) as u32);
    Ok(())
}

fn push_face(sheet: &mut Sheet, polygon: impl Iterator<Item = u32>) {
    let base = sheet.corners.len();
    sheet.corners.extend(polygon);
    sheet.twins.resize(sheet.corners.len(), Faces::NO_TWIN);
    sheet.source_face.push(OrientedMesh::NEW);
    let places: Vec<[f64; 3]> = sheet.corners[base..].iter().map(|&v| sheet.positions[v as usize]).collect();
    if let Some(normals) = &mut sheet.face_normals {
        let normal = spans(&places).2;
        normals.push(scale(1.0 / norm(normal), normal));
    }
}

fn pair(sheet: &mut Sheet, c: u32, d: u32) {
    sheet.twins[c as usize] = d;
    sheet.twins[d as usize] = c;
}

/// Whether a face at the hole has just its vertices.
fn is_a_face(sheet: &Sheet, along: &[u32], vertices: &[u32]) -> bool {
    along.iter().any(|&c| {
        let first = c as usize / sheet.arity * sheet.arity;
        sheet.corners[first..first + sheet.arity].iter().all(|v| vertices.contains(v))
    })
}

/// Two vectors that span a triangle (the longer two of its edges at the first corner's base) or a quad (its diagonals), and
/// their cross product.
fn spans(places: &[[f64; 3]]) -> ([f64; 3], [f64; 3], [f64; 3]) {
    let (a, b) = match *places {
        [x0, x1, x2] => {
            let base = sub(x2, x1);
            let [left, right] = [sub(x1, x0), sub(x2, x0)];
            (if norm(left) > norm(right) { left } else { right }, base)
        }
        [x0, x1, x2, x3] => (sub(x2, x0), sub(x3, x1)),
        _ => ([0.0; 3], [0.0; 3]),
    };
    (a, b, cross(a, b))
}

/// The sine of the angle between them; 0 where one has no length.
fn sine(places: &[[f64; 3]]) -> f64 {
    let (a, b, across) = spans(places);
    let product = norm(a) * norm(b);
    if product > 0.0 { norm(across) / product } else { 0.0 }
}

/// Where the fan begins, its middle, and the smallest sine of its faces.
///
/// The middle is the mean of the edges' midpoints, weighted by length, moved out of the hole's mean plane only where a
/// face would be flat: an edge may point at it.
fn middle(places: &[[f64; 3]], step: usize) -> (usize, [f64; 3], f64) {
    let n = places.len();
    let edge = |k: usize| (places[k], places[(k + 1) % n]);
    let (mut weight, mut moment) = (0.0, [0.0; 3]);
    for (a, b) in (0..n).map(edge) {
        let length = norm(sub(b, a));
        weight += length;
        moment = add(moment, scale(0.5 * length, add(a, b)));
    }
    let centroid = if weight > 0.0 { scale(1.0 / weight, moment) } else { places[0] };
    let spokes = || places.iter().map(|&x| sub(x, centroid));
    let radius = spokes().map(norm).sum::<f64>() / n as f64;
    let area = (0..n).map(edge).fold([0.0; 3], |sum, (a, b)| add(sum, cross(sub(a, centroid), sub(b, centroid))));
    let up = if norm(area) > FLAT * radius * radius {
        scale(1.0 / norm(area), area)
    } else {
        let longest = spokes().max_by(|a, b| norm(*a).total_cmp(&norm(*b))).unwrap_or([1.0, 0.0, 0.0]);
        across(longest)
    };
    let mut best = (0, centroid, -1.0);
    for first in 0..step {
        for height in HEIGHTS {
            let middle = add(centroid, scale(height * radius, up));
            let face = |j: usize| {
                let mut face = vec![middle];
                face.extend((0..=step).rev().map(|i| places[(first + j * step + i) % n]));
                face
            };
            let quality = (0..n / step).map(|j| sine(&face(j))).fold(f64::INFINITY, f64::min);
            if quality > best.2 {
                best = (first, middle, quality);
            }
            if quality >= GOOD {
                break;
            }
        }
    }
    best
}

/// A unit vector at right angles to `a`.
fn across(a: [f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|&i, &j| a[i].abs().total_cmp(&a[j].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let b = sub(scale(dot(a, a), axis), scale(a[least], a));
    if norm(b) > 0.0 { scale(1.0 / norm(b), b) } else { axis }
}
