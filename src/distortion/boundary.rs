use num_complex::Complex64;

use super::predicate::orientation;

/// Two edges of a closed polygon that meet where they should not: edge k runs from vertex k to the next. `None`: the
/// polygon is simple. Exact.
///
/// Sweeps over the edges in the order of their left ends, comparing each with those whose extents overlap.
pub fn boundary_crossing(polygon: &[Complex64]) -> Option<[usize; 2]> {
    let n = polygon.len();
    let ends = |k: usize| (polygon[k], polygon[(k + 1) % n]);
    let left = |k: usize| ends(k).0.re.min(ends(k).1.re);
    let right = |k: usize| ends(k).0.re.max(ends(k).1.re);
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|&a, &b| left(a).total_cmp(&left(b)));
    let mut active: Vec<usize> = Vec::new();
    for &k in &order {
        active.retain(|&other| right(other) >= left(k));
        for &other in &active {
            if edges_meet(polygon, k.min(other), k.max(other)) {
                return Some([k.min(other), k.max(other)]);
            }
        }
        active.push(k);
    }
    None
}

/// Whether edges `i < j` share a point, other than the vertex that neighbours have in common.
fn edges_meet(polygon: &[Complex64], i: usize, j: usize) -> bool {
    let n = polygon.len();
    let (a, b) = (polygon[i], polygon[(i + 1) % n]);
    let (c, d) = (polygon[j], polygon[(j + 1) % n]);
    let between = |p: f64, q: f64, t: f64| p.min(q) <= t && t <= p.max(q);
    // With the line through p and q known to hold t.
    let on = |p: Complex64, q: Complex64, t: Complex64| between(p.re, q.re, t.re) && between(p.im, q.im, t.im);
    if j == i + 1 || (i == 0 && j + 1 == n) {
        let (previous, shared, next) = if j == i + 1 { (a, b, d) } else { (c, a, b) };
        // Neighbours meet again only when the second runs back along the first.
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

/// The number of vertices of a closed polygon around 0 that do not follow their predecessor counter-clockwise. Exact.
pub fn out_of_order(polygon: &[Complex64]) -> usize {
    let next = |k: usize| polygon[(k + 1) % polygon.len()];
    (0..polygon.len()).filter(|&k| orientation(Complex64::ZERO, polygon[k], next(k)) <= 0.0).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[(f64, f64)]) -> Vec<Complex64> {
        points.iter().map(|&(x, y)| Complex64::new(x, y)).collect()
    }

    #[test]
    fn simple_polygons_do_not_cross() {
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.5), (1.0, 2.0)])), None);
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])), None);
        // Collinear neighbours that go on straight.
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (1.0, 1.0)])), None);
    }

    #[test]
    fn crossings_touches_and_spikes_are_found() {
        assert_eq!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 1.0), (1.0, 0.0), (0.0, 1.0)])), Some([0, 2]));
        // A vertex on another edge.
        assert!(boundary_crossing(&polygon(&[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 0.0), (0.0, 1.0)])).is_some());
        // An edge that runs back.
        assert!(boundary_crossing(&polygon(&[(0.0, 0.0), (2.0, 0.0), (1.0, 0.0), (1.0, 1.0)])).is_some());
        // Two vertices at one place.
        assert!(boundary_crossing(&polygon(&[(0.0, 0.0), (1.0, 0.0), (1.0, 0.0), (0.0, 1.0)])).is_some());
    }
}
