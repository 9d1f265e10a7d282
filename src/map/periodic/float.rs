//! The place of the white vertices, which H does not see where they are a diagonal class of their own.

use num_complex::Complex64;

use crate::geometry::vector::{add, cross, dot, scale, sub};
use crate::quad_graph::{Periods, QuadGraph};
use crate::surface::oriented_mesh::OrientedMesh;

/// Shifts the vertices that are not connected with vertex 0 by diagonals by the one offset that fits the mesh best.
///
/// Quad meshes: in the rest plane of a quad the midpoints of its diagonals are apart by `m = s d02 + t d13` (m projected, where
/// the quad is not planar), so that `(z1 + z3)/2 − (z0 + z2)/2 − s (z2 − z0) − t (z3 − z1)` would be 0; its mean, weighted by area,
/// is taken out. Parallelograms, such as surfels seen along any direction, have s = t = 0. Triangle meshes: the mean
/// of dual vertex − barycentre of its face is taken out, weighted by the area of the image.
pub(super) fn white(
    disc: &OrientedMesh,
    graph: &QuadGraph,
    periods: &Periods,
    omega: [Complex64; 2],
    z: &mut [Complex64],
) {
    let (class, classes) = graph.diagonal_classes();
    if classes < 2 {
        return;
    }
    let black = |v: u32| class[v as usize] == class[0];
    let offset = match graph.primal == graph.vertices {
        true => of_quads(disc, graph, periods, omega, z, black),
        false => of_triangles(disc, periods, omega, z),
    };
    if offset.is_finite() {
        for (z, _) in z.iter_mut().zip(&class).filter(|(_, k)| **k != class[0]) {
            *z -= offset;
        }
    }
}

fn of_quads(
    disc: &OrientedMesh,
    graph: &QuadGraph,
    periods: &Periods,
    omega: [Complex64; 2],
    z: &[Complex64],
    black: impl Fn(u32) -> bool,
) -> Complex64 {
    let (mut sum, mut total) = (Complex64::ZERO, 0.0);
    for q in 0..graph.quads.len() {
        let [x0, x1, x2, x3] = graph.quads[q].map(|v| disc.positions[v as usize]);
        let (d02, d13) = (sub(x2, x0), sub(x3, x1));
        let m = scale(0.5, sub(add(x1, x3), add(x0, x2)));
        let normal = cross(d02, d13);
        let squared = dot(normal, normal);
        let (s, t) = (dot(cross(m, d13), normal) / squared, dot(cross(d02, m), normal) / squared);
        let [z0, z1, z2, z3] = periods.lifted(graph, q, z, omega);
        let apart = 0.5 * (z1 + z3 - z0 - z2) - s * (z2 - z0) - t * (z3 - z1);
        let area = graph.area(q);
        // From black to white.
        let apart = if black(graph.quads[q][0]) { apart } else { -apart };
        if apart.is_finite() && area > 0.0 {
            sum += area * apart;
            total += area;
        }
    }
    sum / total
}

fn of_triangles(disc: &OrientedMesh, periods: &Periods, omega: [Complex64; 2], z: &[Complex64]) -> Complex64 {
    let (mut sum, mut total) = (Complex64::ZERO, 0.0);
    for (f, polygon) in disc.faces.iter().enumerate() {
        let &[i, j, k] = polygon else { continue };
        let first = disc.faces.corner_range(f).start;
        let at = |k: usize, v: u32| z[v as usize] + Periods::translation(periods.corners[first + k], omega);
        let [a, b, c] = [at(0, i), at(1, j), at(2, k)];
        let area = 0.5 * ((b - a).conj() * (c - a)).im.abs();
        sum += area * (z[disc.positions.len() + f] - (a + b + c) / 3.0);
        total += area;
    }
    sum / total
}
