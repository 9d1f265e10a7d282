//! Fills holes with faces, so that a surface with several boundary loops can be mapped.
//!
//! A hole in a triangle mesh gets a fan of triangles around a new central vertex. A hole in a quad
//! mesh gets the quads (centre, v0, v1, v2), (centre, v2, v3, v4), …. A hole with as many edges as
//! a face is filled by one face, and a hole of two edges is closed by identifying them.

use crate::geometry::vector::{add, cross, dot, norm, scale, sub};
use crate::surface::Faces;
use crate::surface::cut::{CutError, CutMesh, CutRecord};
use crate::surface::oriented_mesh::OrientedMesh;

/// A position of the central vertex is accepted at once if the sine of the angle that measures the
/// quality of a face (see [`sine`]) is at least this for all new faces.
const GOOD: f64 = 0.05;

/// Faces with a smaller sine are too flat for ρ to be computed in double precision.
const FLAT: f64 = 1e-6;

/// Heights above the mean plane of the hole at which the central vertex is tried, in units of the
/// hole's radius. Heights other than 0 are needed where the faces in the plane would be flat.
const HEIGHTS: [f64; 7] = [0.0, 0.25, -0.25, 0.5, -0.5, 1.0, -1.0];

/// Fills the holes whose boundary loops are `loops`, each given by the corners along it.
///
/// # Errors
/// [`CutError::OddHole`] in quad meshes; [`CutError::FlatHole`] if no faces of positive area fill
/// it.
pub(super) fn fill(sheet: &mut CutMesh, loops: &[Vec<u32>], record: &mut CutRecord) -> Result<(), CutError> {
    for along in loops {
        let before = sheet.source_face.len();
        fill_one(sheet, along)?;
        record.holes_filled += 1;
        record.faces_added += sheet.source_face.len() - before;
    }
    Ok(())
}

fn fill_one(sheet: &mut CutMesh, along: &[u32]) -> Result<(), CutError> {
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
        // The last spoke of each face is the first spoke of the face before it.
        let before = base + (j + faces - 1) % faces * sheet.arity;
        if j > 0 {
            pair(sheet, (corner + step + 1) as u32, before as u32);
        }
    }
    pair(sheet, (base + step + 1) as u32, (base + (faces - 1) * sheet.arity) as u32);
    Ok(())
}

fn push_face(sheet: &mut CutMesh, polygon: impl Iterator<Item = u32>) {
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

fn pair(sheet: &mut CutMesh, c: u32, d: u32) {
    sheet.twins[c as usize] = d;
    sheet.twins[d as usize] = c;
}

/// Whether some face at the hole has exactly the vertices of the hole.
fn is_a_face(sheet: &CutMesh, along: &[u32], vertices: &[u32]) -> bool {
    along.iter().any(|&c| {
        let first = c as usize / sheet.arity * sheet.arity;
        sheet.corners[first..first + sheet.arity].iter().all(|v| vertices.contains(v))
    })
}

/// Returns two vectors that span a face, and their cross product.
///
/// The vectors of a triangle are the edge opposite its first corner and the longer of the two other
/// edges; those of a quad are its diagonals.
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

/// The sine of the angle between the two vectors of [`spans`]; 0 if one of them vanishes.
fn sine(places: &[[f64; 3]]) -> f64 {
    let (a, b, across) = spans(places);
    let product = norm(a) * norm(b);
    if product > 0.0 { norm(across) / product } else { 0.0 }
}

/// Chooses the vertex at which the fan of a hole begins and the position of its central vertex.
///
/// Returns both and the smallest [`sine`] of the new faces. The central vertex is the mean of the
/// midpoints of the edges, weighted by their lengths. It leaves the mean plane of the hole only if
/// a face would be flat in the plane, which happens when an edge points at the centre.
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

/// Returns a unit vector perpendicular to `a`.
fn across(a: [f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|&i, &j| a[i].abs().total_cmp(&a[j].abs())).unwrap_or(0);
    let mut axis = [0.0; 3];
    axis[least] = 1.0;
    let b = sub(scale(dot(a, a), axis), scale(a[least], a));
    if norm(b) > 0.0 { scale(1.0 / norm(b), b) } else { axis }
}
