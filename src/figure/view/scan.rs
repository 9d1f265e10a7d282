use std::ops::Range;

use super::super::raster::first_centre;

/// The nearness as an affine function on a triangle, clamped to the range of its corners.
pub(super) struct Nearness {
    origin: [f64; 3],
    slope: [f64; 2],
    least: f64,
    most: f64,
}

impl Nearness {
    fn over(t: &[[f64; 3]; 3]) -> Nearness {
        let [a, b, c] = *t;
        let (ux, uy, un) = (b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        let (vx, vy, vn) = (c[0] - a[0], c[1] - a[1], c[2] - a[2]);
        let area = ux * vy - uy * vx;
        let slope = [(un * vy - uy * vn) / area, (ux * vn - un * vx) / area];
        // Slivers can have no area up to rounding; then the value at any corner is good enough.
        let slope = if slope.iter().all(|s| s.is_finite()) { slope } else { [0.0; 2] };
        Nearness { origin: a, slope, least: a[2].min(b[2]).min(c[2]), most: a[2].max(b[2]).max(c[2]) }
    }

    /// Evaluates the nearness at the centre of a cell.
    pub(super) fn at(&self, column: usize, row: usize) -> f64 {
        let (x, y) = (column as f64 + 0.5 - self.origin[0], row as f64 + 0.5 - self.origin[1]);
        (self.origin[2] + self.slope[0] * x + self.slope[1] * y).clamp(self.least, self.most)
    }
}

/// Calls `paint(row, columns, nearness)` for every run of unit cells of `rows` whose centres lie in
/// a triangle, clipped to `width` columns. A centre on an edge belongs to exactly one of its two
/// sides.
pub(super) fn scan(
    t: [[f64; 3]; 3],
    rows: Range<usize>,
    width: usize,
    mut paint: impl FnMut(usize, Range<usize>, &Nearness),
) {
    let low = t[0][1].min(t[1][1]).min(t[2][1]);
    let high = t[0][1].max(t[1][1]).max(t[2][1]);
    let rows = first_centre(low, rows.end).max(rows.start)..first_centre(high, rows.end);
    if rows.is_empty() {
        return;
    }
    let nearness = Nearness::over(&t);
    for row in rows {
        let y = row as f64 + 0.5;
        let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
        for (p, q) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            // Computed from the lower end, so that both triangles of an edge get exactly the same
            // crossing.
            let (a, b) = if p[1] <= q[1] { (p, q) } else { (q, p) };
            if a[1] <= y && y < b[1] {
                let x = a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]));
                (left, right) = (left.min(x), right.max(x));
            }
        }
        let columns = first_centre(left, width)..first_centre(right, width);
        if !columns.is_empty() {
            paint(row, columns, &nearness);
        }
    }
}
