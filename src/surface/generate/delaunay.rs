//! Irregular meshes: evenly spaced boundary vertices, random interior vertices, Delaunay triangles.

use std::f64::consts::{PI, TAU};

use super::grid::{self, twice_area};
use super::random::Random;
use super::{GenerateError, Patch};
use crate::surface::Faces;

/// The distribution of the interior points.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PointDistribution {
    /// One point in each cell of a grid, displaced from its centre by up to 0.35 cells along each
    /// axis.
    Jittered,
    /// Independent uniform random points: the mesh has small angles and neighbours of very
    /// different size.
    Random,
}

/// Largest displacement of a jittered point, in cells. Boundary edges have the length of a cell,
/// and interior points stay outside of the circles that have them as diameters, so that the
/// Delaunay triangulation contains the boundary edges.
const DISPLACEMENT: f64 = 0.35;

/// Smallest distance of a random point from the boundary, in cells.
const MARGIN: f64 = 0.1;

/// Triangulates the square [−1, 1]² with as many vertices, and the same boundary vertices, as the
/// grid.
pub(super) fn square(cells: usize, points: PointDistribution, random: &mut Random) -> Result<Patch, GenerateError> {
    let h = 2.0 / cells as f64;
    let inner = grid::points(cells).into_iter().filter(|p| p[0].abs() < 1.0 && p[1].abs() < 1.0);
    let moved = inner.map(|[s, t]| match points {
        PointDistribution::Jittered => random.square_around([s, t], DISPLACEMENT * h),
        PointDistribution::Random => random.square().map(|x| x * (1.0 - MARGIN * h)),
    });
    let mut all: Vec<[f64; 2]> = moved.collect();
    let interior = all.len();
    let line: Vec<f64> = (0..cells).map(|i| (2.0 * i as f64 - cells as f64) / cells as f64).collect();
    for side in 0..4 {
        // Counter-clockwise from (−1, −1). Quarter turns are exact, so the sides are exactly
        // straight.
        all.extend(line.iter().map(|&x| [[x, -1.0], [1.0, x], [-x, 1.0], [-1.0, -x]][side]));
    }
    triangulate(all, interior)
}

/// Triangulates the unit disc with about `(cells + 1)²` vertices; those on the boundary are evenly
/// spaced.
pub(super) fn disc(cells: usize, points: PointDistribution, random: &mut Random) -> Result<Patch, GenerateError> {
    // As for a square, a mesh of spacing h has area/h² + perimeter/2h + 1 vertices; this is solved
    // for 1/h.
    let vertices = ((cells + 1) * (cells + 1)) as f64;
    let per_unit = ((PI * PI + 4.0 * PI * (vertices - 1.0)).sqrt() - PI) / TAU;
    let h = 1.0 / per_unit;
    let boundary = (TAU * per_unit).round();
    let mut all = Vec::with_capacity((cells + 1) * (cells + 1));
    match points {
        PointDistribution::Jittered => {
            let reach = per_unit.ceil() as i64;
            for j in -reach..reach {
                for i in -reach..reach {
                    let middle = [(i as f64 + 0.5) * h, (j as f64 + 0.5) * h];
                    let p = random.square_around(middle, DISPLACEMENT * h);
                    if p[0].hypot(p[1]) < 1.0 - 0.55 * h {
                        all.push(p);
                    }
                }
            }
        }
        PointDistribution::Random => {
            let wanted = (vertices - boundary).max(0.0) as usize;
            // Inside the polygon of the boundary points, not only inside the circle.
            let reach = (PI / boundary).cos() - MARGIN * h;
            // More than half of the points of the square are accepted, so few draws are needed.
            while all.len() < wanted {
                let p = random.square();
                if p[0].hypot(p[1]) < reach {
                    all.push(p);
                }
            }
        }
    }
    let interior = all.len();
    all.extend((0..boundary as usize).map(|k| (TAU * k as f64 / boundary).sin_cos()).map(|(y, x)| [x, y]));
    triangulate(all, interior)
}

/// Triangulates `points`, of which those from `interior` on are the boundary of the convex hull.
fn triangulate(points: Vec<[f64; 2]>, interior: usize) -> Result<Patch, GenerateError> {
    let sites: Vec<delaunator::Point> = points.iter().map(|&[x, y]| delaunator::Point { x, y }).collect();
    let triangulation = delaunator::triangulate(&sites);
    let mut faces = Faces::with_capacity(triangulation.len(), 3 * triangulation.len());
    for t in triangulation.triangles.chunks_exact(3) {
        let (a, b, c) = (t[0], t[1], t[2]);
        let area = twice_area(points[a], points[b], points[c]);
        if area > 0.0 {
            faces.push(&[a as u32, b as u32, c as u32]);
        } else if area < 0.0 {
            faces.push(&[a as u32, c as u32, b as u32]);
        }
    }
    // Euler's formula for a disc; it fails if a point was omitted or the hull was missed.
    let expected = (2 * points.len()).saturating_sub(2 + points.len() - interior);
    if faces.len() != expected {
        return Err(GenerateError::Triangulation { points: points.len(), expected, found: faces.len() });
    }
    Ok(Patch { points, faces })
}
