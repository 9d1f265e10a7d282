//! The distance of a point from an edge and its derivatives.

use num_complex::Complex64;

/// Number of real coordinates: (Re, Im) of the point and of the two ends of the edge.
const N: usize = 6;

/// The position of a point v relative to an edge from a to b.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct PointEdge {
    /// d = |v − p|, where p is the point of the edge nearest to v.
    pub distance: f64,
    /// The part of the edge that contains p.
    pub nearest: Nearest,
    /// (v − p)/d.
    normal: Complex64,
    /// b − a.
    edge: Complex64,
}

/// The part of an edge that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Nearest {
    /// The first end.
    First,
    /// The second end.
    Second,
    /// The interior point a + λ (b − a).
    Between(f64),
}

impl PointEdge {
    pub fn new([v, a, b]: [Complex64; 3]) -> Self {
        let edge = b - a;
        let along = ((v - a) * edge.conj()).re / edge.norm_sqr();
        let (nearest, from) = match along {
            t if t <= 0.0 => (Nearest::First, v - a),
            t if t >= 1.0 => (Nearest::Second, v - b),
            t => (Nearest::Between(t), v - (a + t * edge)),
        };
        let distance = from.norm();
        PointEdge { distance, nearest, normal: from / distance, edge }
    }

    /// Whether the point is to the right of the line through the edge.
    pub fn is_right(&self) -> bool {
        (self.edge.conj() * self.normal).im < 0.0
    }

    /// The unit vector from the nearest point to v.
    pub fn direction(&self) -> Complex64 {
        self.normal
    }

    /// The weight of each end in the nearest point.
    fn shares(&self) -> [f64; 2] {
        match self.nearest {
            Nearest::First => [1.0, 0.0],
            Nearest::Second => [0.0, 1.0],
            Nearest::Between(t) => [1.0 - t, t],
        }
    }

    /// ∂d for the three points: n, −(1 − λ) n, −λ n.
    pub fn gradient(&self) -> [Complex64; 3] {
        let [s, t] = self.shares();
        [self.normal, -s * self.normal, -t * self.normal]
    }

    /// The second derivatives of d.
    ///
    /// For a nearest point between the ends, let u be the direction and l the length of the edge,
    /// `ω = n·(δb − δa)/l` its rotation towards v, and `τ = u·(δv − (1 − λ) δa − λ δb)`. Then
    ///
    /// ```text
    /// δ²d = −2 ω τ − d ω²
    /// ```
    ///
    /// For a nearest end it is `τ²/d` with τ perpendicular to n.
    pub fn hessian(&self) -> [[f64; N]; N] {
        let [s, t] = self.shares();
        let n = self.normal;
        let rows = |x: [Complex64; 3]| [x[0].re, x[0].im, x[1].re, x[1].im, x[2].re, x[2].im];
        let mut h = [[0.0; N]; N];
        match self.nearest {
            Nearest::Between(_) => {
                let length = self.edge.norm();
                let u = self.edge / length;
                let turn = rows([Complex64::ZERO, -n / length, n / length]);
                let slide = rows([u, -s * u, -t * u]);
                for i in 0..N {
                    for j in 0..N {
                        h[i][j] = -turn[i] * slide[j] - slide[i] * turn[j] - self.distance * turn[i] * turn[j];
                    }
                }
            }
            _ => {
                let u = Complex64::I * n;
                let across = rows([u, -s * u, -t * u]);
                for i in 0..N {
                    for j in 0..N {
                        h[i][j] = across[i] * across[j] / self.distance;
                    }
                }
            }
        }
        h
    }
}

/// Returns the smallest t in [0, 1] at which the point v + t v' lies on the edge from a + t a' to b
/// + t b', or +∞.
pub(super) fn first_contact([v, a, b]: [Complex64; 3], [dv, da, db]: [Complex64; 3]) -> f64 {
    let cross = |x: Complex64, y: Complex64| (x.conj() * y).im;
    let (e, w, de, dw) = (b - a, v - a, db - da, dv - da);
    let (p, q, r) = (cross(de, dw), cross(e, dw) + cross(de, w), cross(e, w));
    let on_the_edge = |t: &f64| {
        let (e, w) = (e + *t * de, w + *t * dw);
        let along = (w * e.conj()).re;
        (0.0..=1.0).contains(t) && along >= 0.0 && along <= e.norm_sqr()
    };
    roots(p, q, r).into_iter().filter(on_the_edge).fold(f64::INFINITY, f64::min)
}

/// Returns the real roots of `p t² + q t + r`, computed without cancellation; missing roots are NaN
/// or infinite.
fn roots(p: f64, q: f64, r: f64) -> [f64; 2] {
    let half = -0.5 * (q + (q * q - 4.0 * p * r).sqrt().copysign(q));
    [half / p, r / half]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(x: [f64; 6]) -> [Complex64; 3] {
        [0, 2, 4].map(|k| Complex64::new(x[k], x[k + 1]))
    }

    #[test]
    fn derivatives_are_those_of_the_distance() {
        // The nearest point is in between, on both sides of the edge; then it is at either end.
        for x in [
            [0.4, 0.7, 0.0, 0.1, 1.3, -0.2],
            [0.4, -0.7, 0.0, 0.1, 1.3, -0.2],
            [-0.5, 0.3, 0.0, 0.1, 1.3, -0.2],
            [1.9, 0.4, 0.0, 0.1, 1.3, -0.2],
        ] {
            let at = |k: usize, h: f64| {
                let mut x = x;
                x[k] += h;
                PointEdge::new(points(x))
            };
            let flat = |g: [Complex64; 3]| [g[0].re, g[0].im, g[1].re, g[1].im, g[2].re, g[2].im];
            let here = PointEdge::new(points(x));
            let (gradient, hessian, h) = (flat(here.gradient()), here.hessian(), 1e-5);
            for k in 0..N {
                let slope = (at(k, h).distance - at(k, -h).distance) / (2.0 * h);
                assert!((slope - gradient[k]).abs() < 1e-9, "{k}");
                let (ahead, behind) = (flat(at(k, h).gradient()), flat(at(k, -h).gradient()));
                for i in 0..N {
                    let bend = (ahead[i] - behind[i]) / (2.0 * h);
                    assert!((bend - hessian[i][k]).abs() < 1e-8, "{i} {k}: {bend} {}", hessian[i][k]);
                }
            }
        }
    }

    #[test]
    fn contacts_are_where_a_point_comes_onto_an_edge() {
        let zero = Complex64::ZERO;
        let at = Complex64::new;
        let edge = |v: Complex64| [v, at(0.0, 0.0), at(2.0, 0.0)];
        let moves = |d: Complex64| [d, zero, zero];
        assert_eq!(first_contact(edge(at(1.0, 1.0)), moves(at(0.0, -4.0))), 0.25);
        // The point stops before the edge, passes it, moves away, moves beside it, or moves along
        // it.
        assert_eq!(first_contact(edge(at(1.0, 1.0)), moves(at(0.0, -0.5))), f64::INFINITY);
        assert_eq!(first_contact(edge(at(1.0, 1.0)), moves(at(0.0, 4.0))), f64::INFINITY);
        assert_eq!(first_contact(edge(at(3.0, 1.0)), moves(at(0.0, -4.0))), f64::INFINITY);
        assert_eq!(first_contact(edge(at(1.0, 1.0)), moves(at(1.0, 0.0))), f64::INFINITY);
        // An edge rotates onto a fixed point.
        let contact = first_contact([at(1.0, 1.0), zero, at(2.0, 0.0)], [zero, zero, at(0.0, 4.0)]);
        assert_eq!(contact, 0.5);
    }
}
