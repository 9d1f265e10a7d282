//! The regular grid of the square [−1, 1]²: `cells × cells` cells, vertices row by row.

use super::random::Random;
use crate::surface::Faces;

/// The rule by which quads are split into two triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Diagonal {
    /// Directions alternate as on a chessboard.
    Alternate,
    /// All diagonals are parallel to (1, 1).
    Same,
    /// The direction of each diagonal is random.
    Random,
}

/// The index of the vertex in column `i`, row `j`.
fn vertex(cells: usize, i: usize, j: usize) -> u32 {
    (j * (cells + 1) + i) as u32
}

/// The four corners of a cell, counter-clockwise from the lower left.
fn cell(cells: usize, i: usize, j: usize) -> [u32; 4] {
    let v = |i, j| vertex(cells, i, j);
    [v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1)]
}

/// Returns the `(cells + 1)²` vertices, exactly symmetric in floating point.
pub(super) fn points(cells: usize) -> Vec<[f64; 2]> {
    let line: Vec<f64> = (0..=cells).map(|i| (2.0 * i as f64 - cells as f64) / cells as f64).collect();
    line.iter().flat_map(|&t| line.iter().map(move |&s| [s, t])).collect()
}

/// Moves every interior vertex by up to `amount` cells in s and in t, then applies `chart`.
///
/// A displacement is halved until the corner triangles of the quads around the vertex have positive
/// area in the chart. Every quad then stays strictly convex there, so that either diagonal splits
/// it into two positive triangles.
pub(super) fn jitter(
    cells: usize,
    amount: f64,
    random: &mut Random,
    chart: impl Fn([f64; 2]) -> [f64; 2],
) -> Vec<[f64; 2]> {
    let flat = points(cells);
    let mut moved: Vec<[f64; 2]> = flat.iter().map(|&p| chart(p)).collect();
    if amount == 0.0 {
        return moved;
    }
    for j in 1..cells {
        for i in 1..cells {
            let v = vertex(cells, i, j) as usize;
            let (start, home) = (flat[v], moved[v]);
            let mut step = random.square().map(|x| x * amount * 2.0 / cells as f64);
            // After 50 halvings the displacement is negligible; the vertex then stays in place.
            for attempt in 0..50 {
                moved[v] = chart([start[0] + step[0], start[1] + step[1]]);
                if around_is_convex(cells, i, j, &moved) {
                    break;
                }
                step = step.map(|x| 0.5 * x);
                if attempt == 49 {
                    moved[v] = home;
                }
            }
        }
    }
    moved
}

/// Whether the four quads around an interior vertex are strictly convex.
fn around_is_convex(cells: usize, i: usize, j: usize, points: &[[f64; 2]]) -> bool {
    [(i - 1, j - 1), (i, j - 1), (i - 1, j), (i, j)].iter().all(|&(i, j)| {
        let corners = cell(cells, i, j).map(|v| points[v as usize]);
        (0..4).all(|k| twice_area(corners[k], corners[(k + 1) % 4], corners[(k + 2) % 4]) > 0.0)
    })
}

/// Twice the signed area of a triangle.
pub(super) fn twice_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

/// Returns all cells as quads.
pub(super) fn quads(cells: usize) -> Faces {
    let mut faces = Faces::with_capacity(cells * cells, 4 * cells * cells);
    for j in 0..cells {
        for i in 0..cells {
            faces.push(&cell(cells, i, j));
        }
    }
    faces
}

/// Returns all cells as two triangles each.
///
/// With `into_corners` the diagonals of the four corner cells end in the corners of the grid,
/// whatever the rule: on a disc the other diagonal would cut off a triangle with all vertices on
/// the circle.
pub(super) fn triangles(cells: usize, diagonal: Diagonal, into_corners: bool, random: &mut Random) -> Faces {
    let mut faces = Faces::with_capacity(2 * cells * cells, 6 * cells * cells);
    let (first, last) = (0, cells - 1);
    for j in 0..cells {
        for i in 0..cells {
            let rule = split_along_first(diagonal, i, j, random);
            let corner = into_corners && [first, last].contains(&i) && [first, last].contains(&j);
            let main = if corner { (i == first) == (j == first) } else { rule };
            push_split(&mut faces, cell(cells, i, j), main);
        }
    }
    faces
}

/// Whether the cell is split along its first diagonal, the one from its lower left corner.
pub(super) fn split_along_first(diagonal: Diagonal, i: usize, j: usize, random: &mut Random) -> bool {
    match diagonal {
        Diagonal::Alternate => (i + j).is_multiple_of(2),
        Diagonal::Same => true,
        Diagonal::Random => random.bits() >> 63 == 0,
    }
}

/// Appends the two triangles of a quad.
pub(super) fn push_split(faces: &mut Faces, [a, b, c, d]: [u32; 4], first_diagonal: bool) {
    let halves = if first_diagonal { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
    faces.push(&halves[0]);
    faces.push(&halves[1]);
}
