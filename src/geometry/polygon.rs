//! Closed polygons, such as the boundary of a map: whether they are simple, and whether they are in
//! order around 0.

use std::cmp::Ordering;
use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::ops::Bound;

use num_complex::Complex64;

use crate::geometry::predicate::orientation;

/// Returns two edges of a closed polygon that cross or touch, or `None` if the polygon is simple;
/// edge k runs from vertex k to the next. The result is exact.
///
/// This is the sweep of Shamos and Hoey: edges enter at their left ends and leave at their right
/// ends, the active ones are kept in order, and only neighbours in this order are compared. The
/// leftmost intersection is found before the order could be wrong. The sweep takes O(n log n)
/// predicates for n edges of any polygon.
pub fn boundary_crossing(polygon: &[Complex64]) -> Option<[usize; 2]> {
    let n = polygon.len();
    if let Some(k) = polygon.iter().position(|z| !z.is_finite()) {
        return Some([k.min((k + n - 1) % n), k.max((k + n - 1) % n)]);
    }
    let before = |a: &usize, b: &usize| lexicographic(polygon[*a], polygon[*b]);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| before(a, b).then(a.cmp(b)));
    // Coincident vertices would not be found if their edges have already left the sweep.
    if let Some(pair) = order.windows(2).find(|pair| polygon[pair[0]] == polygon[pair[1]]) {
        return Some([pair[0].min(pair[1]), pair[0].max(pair[1])]);
    }
    let mut active: BTreeSet<Edge> = BTreeSet::new();
    let edge = |k: usize| Edge { polygon, k };
    let meet = |a: usize, b: usize| edges_meet(polygon, a.min(b), a.max(b)).then_some([a.min(b), a.max(b)]);
    for v in order {
        let [left, right] = [(v + n - 1) % n, v];
        let leaves = |k: usize| edge(k).ends().1 == polygon[v];
        for k in [left, right].into_iter().filter(|&k| leaves(k)) {
            let (below, above) = neighbours(&active, edge(k));
            active.remove(&edge(k));
            if let (Some(a), Some(b)) = (below, above)
                && let Some(pair) = meet(a, b)
            {
                return Some(pair);
            }
        }
        for k in [left, right].into_iter().filter(|&k| !leaves(k)) {
            // An edge that compares as equal to this one touches it.
            if let Some(other) = active.get(&edge(k)) {
                return Some([k.min(other.k), k.max(other.k)]);
            }
            let (below, above) = neighbours(&active, edge(k));
            if let Some(pair) = [below, above].into_iter().flatten().find_map(|other| meet(k, other)) {
                return Some(pair);
            }
            active.insert(edge(k));
        }
    }
    None
}

/// Compares real parts, then imaginary parts.
fn lexicographic(a: Complex64, b: Complex64) -> Ordering {
    let order = |x: f64, y: f64| x.partial_cmp(&y).unwrap_or(Ordering::Equal);
    order(a.re, b.re).then(order(a.im, b.im))
}

/// An edge of a polygon in the order along the sweep line.
///
/// The sweep line is tilted to the left by an infinitesimal angle, so that it meets a vertical edge
/// in one point.
#[derive(Clone, Copy)]
struct Edge<'a> {
    polygon: &'a [Complex64],
    k: usize,
}

impl Edge<'_> {
    /// The left and the right end.
    fn ends(&self) -> (Complex64, Complex64) {
        let (a, b) = (self.polygon[self.k], self.polygon[(self.k + 1) % self.polygon.len()]);
        if lexicographic(a, b) == Ordering::Greater { (b, a) } else { (a, b) }
    }
}

impl Ord for Edge<'_> {
    /// Compares by the side of the other edge on which the later of the two left ends lies; equal
    /// if it lies on that edge.
    fn cmp(&self, other: &Self) -> Ordering {
        if self.k == other.k {
            return Ordering::Equal;
        }
        let ((a, b), (c, d)) = (self.ends(), other.ends());
        let side = |s: f64| s.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        match lexicographic(a, c) {
            Ordering::Greater => side(orientation(c, d, a)),
            Ordering::Less => side(orientation(a, b, c)).reverse(),
            Ordering::Equal => side(orientation(c, d, b)),
        }
    }
}

impl PartialOrd for Edge<'_> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Edge<'_> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Edge<'_> {}

/// The edges directly below and above.
fn neighbours(active: &BTreeSet<Edge>, edge: Edge) -> (Option<usize>, Option<usize>) {
    let below = active.range((Bound::Unbounded, Bound::Excluded(edge))).next_back();
    let above = active.range((Bound::Excluded(edge), Bound::Unbounded)).next();
    (below.map(|e| e.k), above.map(|e| e.k))
}

/// Whether edges `i < j` share a point other than the common vertex of neighbours.
fn edges_meet(polygon: &[Complex64], i: usize, j: usize) -> bool {
    let n = polygon.len();
    let (a, b) = (polygon[i], polygon[(i + 1) % n]);
    let (c, d) = (polygon[j], polygon[(j + 1) % n]);
    let between = |p: f64, q: f64, t: f64| p.min(q) <= t && t <= p.max(q);
    // Assumes that t lies on the line through p and q.
    let on = |p: Complex64, q: Complex64, t: Complex64| between(p.re, q.re, t.re) && between(p.im, q.im, t.im);
    if j == i + 1 || (i == 0 && j + 1 == n) {
        let (previous, shared, next) = if j == i + 1 { (a, b, d) } else { (c, a, b) };
        // Neighbours meet again only if the second runs back along the first.
        return orientation(previous, shared, next) == 0.0
            && (on(previous, shared, next) || on(shared, next, previous));
    }
    let [abc, abd, cda, cdb] = [orientation(a, b, c), orientation(a, b, d), orientation(c, d, a), orientation(c, d, b)];
    let separates = |s: f64, t: f64| (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0);
    (separates(abc, abd) && separates(cda, cdb))
        || (abc == 0.0 && on(a, b, c))
        || (abd == 0.0 && on(a, b, d))
        || (cda == 0.0 && on(c, d, a))
        || (cdb == 0.0 && on(c, d, b))
}

/// Returns the number of vertices of a closed polygon, on or near a circle around 0, that do not
/// follow their predecessor counter-clockwise.
pub fn out_of_order(polygon: &[Complex64]) -> usize {
    let next = |k: usize| polygon[(k + 1) % polygon.len()];
    let behind = (0..polygon.len()).filter(|&k| orientation(Complex64::ZERO, polygon[k], next(k)) <= 0.0).count();
    // If all of them lie on one half of the circle, the last step turns by more than half a turn
    // and does not count.
    let turns = || (0..polygon.len()).map(|k| (next(k) * polygon[k].conj()).arg()).sum::<f64>();
    if behind == 1 && turns() < PI { 0 } else { behind }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn polygon(points: &[(f64, f64)]) -> Vec<Complex64> {
        points.iter().map(|&(x, y)| Complex64::new(x, y)).collect()
    }

    #[test]
    fn points_on_one_half_of_a_circle_are_in_order_and_points_past_each_other_are_not() {
        let on_circle = |angles: &[f64]| angles.iter().map(|&t| Complex64::cis(t)).collect::<Vec<_>>();
        assert_eq!(out_of_order(&on_circle(&[0.0, 2.0, 4.0])), 0);
        assert_eq!(out_of_order(&on_circle(&[0.0, 0.1, 0.2, 3.0])), 0);
        assert_eq!(out_of_order(&on_circle(&[0.0, 2.0, 1.9, 4.0])), 1);
        assert_eq!(out_of_order(&on_circle(&[0.0, 0.2, 0.1, 0.3])), 2);
        assert_eq!(out_of_order(&on_circle(&[0.3, 0.2, 0.1])), 2);
    }

    #[test]
    fn simple_polygons_do_not_cross() {
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.5), (1.0, 2.0)])), None);
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])), None);
        // Collinear neighbours in the same direction.
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0)])), None);
        // Vertical edges.
        let comb =
            polygon(&[(0.0, 0.0), (5.0, 0.0), (5.0, 3.0), (4.0, 3.0), (4.0, 1.0), (3.0, 1.0), (3.0, 3.0), (0.0, 3.0)]);
        assert_eq!(boundary_crossing(&comb), None);
        assert_eq!(boundary_crossing(&[]), None);
    }

    #[test]
    fn crossings_touches_and_spikes_are_found() {
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])), Some([0, 2]));
        // A vertex on another edge.
        assert!(boundary_crossing(&polygon(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 0.0), (0.0, 1.0)])).is_some());
        // An edge that runs back.
        assert!(boundary_crossing(&polygon(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0)])).is_some());
        // Two coincident vertices.
        assert!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)])).is_some());
    }

    #[test]
    fn long_polygons_take_no_longer_than_their_length() {
        // A comb of 50 000 long horizontal teeth: each vertical line meets all of them.
        let mut comb = vec![Complex64::new(-1.0, 0.0)];
        for k in 0..50_000 {
            let y = f64::from(k);
            comb.extend(
                [(1e3, y), (1e3, y + 0.25), (0.0, y + 0.25), (0.0, y + 1.0)].map(|(x, y)| Complex64::new(x, y)),
            );
        }
        comb.push(Complex64::new(-1.0, 5e4));
        assert_eq!(boundary_crossing(&comb), None);
        let last = comb.len() - 3;
        comb[last].re = -2.0;
        assert!(boundary_crossing(&comb).is_some());
    }

    proptest! {
        /// Few positions for many vertices: touching, overlapping and vertical edges are common.
        /// The reference tests all pairs.
        #[test]
        fn sweep_agrees_with_all_pairs(points in prop::collection::vec((0u8..9, 0u8..9), 3..9)) {
            let points: Vec<_> = points.iter().map(|&(x, y)| Complex64::new(x.into(), y.into())).collect();
            let n = points.len();
            let pairs = || (0..n).flat_map(|j| (0..j).map(move |i| (i, j)));
            let meets = pairs().any(|(i, j)| edges_meet(&points, i, j)) || (0..n).any(|k| points[k] == points[(k + 1) % n]);
            match boundary_crossing(&points) {
                None => prop_assert!(!meets),
                Some([i, j]) => prop_assert!(meets && i < j && j < n),
            }
        }
    }
}
