use num_complex::Complex64;
use std::f64::consts::TAU;

use super::{ConstraintError, Fixed};
use crate::quad_graph::QuadGraph;

/// The curve on which the boundary is pinned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Shape {
    /// The unit circle, by arc length from (1, 0).
    #[default]
    Circle,
    /// The square [−1, 1]², by arc length along each side. Its corners are the images of the mesh
    /// vertices closest to the quarters of the boundary's length.
    Square,
}

impl Shape {
    /// All shapes with their names and descriptions.
    pub const ALL: [(&'static str, &'static str, Shape); 2] = [
        ("circle", "the unit circle, by arc length", Shape::Circle),
        ("square", "the square [−1, 1]², by arc length along each side", Shape::Square),
    ];
}

/// Pins the whole boundary of `graph` on `shape` by arc length, counter-clockwise from
/// `graph.boundary[0]`.
///
/// # Errors
/// Neighbours on the boundary that coincide at rest; too few mesh vertices for the corners of the
/// shape.
pub fn on_shape(graph: &QuadGraph, shape: Shape) -> Result<Fixed, ConstraintError> {
    let arc = arc_lengths(graph, &graph.boundary_length)?;
    let length = arc[arc.len() - 1];
    let mut fixed = Fixed::default();
    match shape {
        Shape::Circle => return on_circle(graph, 1.0, &[(0, 0.0)]),
        Shape::Square => {
            let corners = square_corners(graph, &arc)?;
            let n = graph.boundary.len();
            for (side, &first) in corners.iter().enumerate() {
                let last = corners.get(side + 1).copied().unwrap_or(corners[0] + n);
                let arc_at = |k: usize| if k < n { arc[k] } else { length + arc[k - n] };
                let (from, to) = (CORNERS[side], CORNERS[(side + 1) % 4]);
                for k in first..last {
                    let t = (arc_at(k) - arc_at(first)) / (arc_at(last) - arc_at(first));
                    fixed.hold(graph.boundary[k % n], from * (1.0 - t) + to * t);
                }
            }
        }
    }
    Ok(fixed)
}

/// Pins the whole boundary on a circle around 0.
///
/// `anchors` are positions on the boundary, ascending, with angles that increase by less than 2π in
/// total; between them angles are proportional to arc length.
///
/// # Errors
/// Neighbours on the boundary that coincide at rest.
pub fn on_circle(graph: &QuadGraph, radius: f64, anchors: &[(usize, f64)]) -> Result<Fixed, ConstraintError> {
    Ok(by_arc(graph, &arc_lengths(graph, &graph.boundary_length)?, radius, anchors))
}

/// Pins the whole boundary on the unit circle, from the angle 0, with distinct positions.
///
/// Edges shorter than 10⁻⁸ of the mean edge are treated as having that length, so that rounding
/// cannot give two neighbours the same position.
///
/// # Errors
/// An edge without length.
pub fn on_circle_apart(graph: &QuadGraph) -> Result<Fixed, ConstraintError> {
    let n = graph.boundary.len();
    if let Some(k) = (0..n).find(|&k| graph.boundary_length[k] <= 0.0) {
        return Err(ConstraintError::NoArcLength(graph.boundary[k], graph.boundary[(k + 1) % n]));
    }
    let least = APART * graph.perimeter() / n as f64;
    let lengths: Vec<f64> = graph.boundary_length.iter().map(|l| l.max(least)).collect();
    Ok(by_arc(graph, &arc_lengths(graph, &lengths)?, 1.0, &[(0, 0.0)]))
}

/// With 10⁶ vertices neighbours have a distance of 1e-13, a thousand times the resolution of double
/// precision.
const APART: f64 = 1e-8;

/// Pins the boundary at angles interpolated by arc length (`nb + 1`) between anchors.
fn by_arc(graph: &QuadGraph, arc: &[f64], radius: f64, anchors: &[(usize, f64)]) -> Fixed {
    let n = graph.boundary.len();
    let mut fixed = Fixed::default();
    for (i, &(first, angle)) in anchors.iter().enumerate() {
        let (last, last_angle) = match anchors.get(i + 1) {
            Some(&next) => next,
            None => (anchors[0].0 + n, anchors[0].1 + TAU),
        };
        let arc_at = |k: usize| if k < n { arc[k] } else { arc[n] + arc[k - n] };
        for k in first..last {
            let t = (arc_at(k) - arc_at(first)) / (arc_at(last) - arc_at(first));
            fixed.hold(graph.boundary[k % n], Complex64::from_polar(radius, angle + t * (last_angle - angle)));
        }
    }
    fixed
}

/// Returns the arc length from `boundary[0]` to each boundary vertex and the total length (`nb +
/// 1`).
fn arc_lengths(graph: &QuadGraph, lengths: &[f64]) -> Result<Vec<f64>, ConstraintError> {
    let mut arc = Vec::with_capacity(graph.boundary.len() + 1);
    let mut length = 0.0;
    for (k, &l) in lengths.iter().enumerate() {
        arc.push(length);
        length += l;
        if length <= arc[k] {
            let next = graph.boundary[(k + 1) % graph.boundary.len()];
            return Err(ConstraintError::NoArcLength(graph.boundary[k], next));
        }
    }
    arc.push(length);
    Ok(arc)
}

const CORNERS: [Complex64; 4] =
    [Complex64::new(-1.0, -1.0), Complex64::new(1.0, -1.0), Complex64::new(1.0, 1.0), Complex64::new(-1.0, 1.0)];

/// Returns the positions along the boundary, ascending, of the four mesh vertices closest to 0, ¼,
/// ½, ¾ of its length.
fn square_corners(graph: &QuadGraph, arc: &[f64]) -> Result<[usize; 4], ConstraintError> {
    let mesh: Vec<usize> = (0..graph.boundary.len()).filter(|&k| !graph.is_dual(graph.boundary[k])).collect();
    if mesh.len() < 4 {
        return Err(ConstraintError::TooFewBoundaryVertices { vertices: mesh.len(), needed: 4 });
    }
    let length = arc[arc.len() - 1];
    let mut corners = [mesh[0]; 4];
    let mut taken = 0;
    for (side, corner) in corners.iter_mut().enumerate().skip(1) {
        let wanted = length * side as f64 / 4.0;
        // Leaves vertices for the remaining corners.
        let candidates = taken + 1..=mesh.len() - (4 - side);
        let distance = |i: &usize| (arc[mesh[*i]] - wanted).abs();
        taken = candidates.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(taken + 1);
        *corner = mesh[taken];
    }
    Ok(corners)
}
