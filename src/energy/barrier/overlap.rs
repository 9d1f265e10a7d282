//! Intersections between two lists of boxes, by a sweep from left to right.

use num_complex::Complex64;

/// An axis-parallel box.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BoundingBox {
    low: Complex64,
    high: Complex64,
}

impl BoundingBox {
    /// The bounding box of points.
    pub fn of(points: &[Complex64]) -> Self {
        let nothing = Complex64::new(f64::INFINITY, f64::INFINITY);
        points.iter().fold(BoundingBox { low: nothing, high: -nothing }, |bounds, z| BoundingBox {
            low: Complex64::new(bounds.low.re.min(z.re), bounds.low.im.min(z.im)),
            high: Complex64::new(bounds.high.re.max(z.re), bounds.high.im.max(z.im)),
        })
    }

    /// Returns the box enlarged by a margin on all sides.
    pub fn grown(self, margin: f64) -> Self {
        let margin = Complex64::new(margin, margin);
        BoundingBox { low: self.low - margin, high: self.high + margin }
    }

    fn meets_in_height(&self, other: &BoundingBox) -> bool {
        self.low.im <= other.high.im && other.low.im <= self.high.im
    }
}

/// Calls `found(i, j)` for every box i of `first` that intersects box j of `second`.
///
/// The cost is O(n log n) for n boxes plus the number of pairs whose horizontal extents overlap;
/// there are few along a curve whose boxes are small relative to it.
pub(super) fn overlapping(first: &[BoundingBox], second: &[BoundingBox], found: &mut dyn FnMut(usize, usize)) {
    let lists = [first, second];
    let mut order: Vec<(usize, usize)> =
        (0..2).flat_map(|list| (0..lists[list].len()).map(move |k| (list, k))).collect();
    order.sort_by(|a, b| lists[a.0][a.1].low.re.total_cmp(&lists[b.0][b.1].low.re));
    let mut open: [Vec<usize>; 2] = [Vec::new(), Vec::new()];
    for (list, k) in order {
        let bounds = &lists[list][k];
        let other = 1 - list;
        open[other].retain(|&i| lists[other][i].high.re >= bounds.low.re);
        for &i in open[other].iter().filter(|&&i| lists[other][i].meets_in_height(bounds)) {
            match list {
                0 => found(k, i),
                _ => found(i, k),
            }
        }
        open[list].push(k);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn boxes() -> impl Strategy<Value = Vec<BoundingBox>> {
        let corner = || (0u8..12, 0u8..12).prop_map(|(x, y)| Complex64::new(x.into(), y.into()));
        prop::collection::vec((corner(), corner()).prop_map(|(a, b)| BoundingBox::of(&[a, b])), 0..12)
    }

    proptest! {
        /// Coordinates take few values, so that touching boxes are common. The reference tests all
        /// pairs.
        #[test]
        fn the_sweep_finds_what_all_pairs_find(first in boxes(), second in boxes()) {
            let mut found = Vec::new();
            overlapping(&first, &second, &mut |i, j| found.push((i, j)));
            found.sort_unstable();
            let meets = |a: &BoundingBox, b: &BoundingBox| a.meets_in_height(b) && a.low.re <= b.high.re && b.low.re <= a.high.re;
            let pairs = (0..first.len()).flat_map(|i| (0..second.len()).map(move |j| (i, j)));
            let all: Vec<_> = pairs.filter(|&(i, j)| meets(&first[i], &second[j])).collect();
            prop_assert_eq!(found, all);
        }
    }
}
