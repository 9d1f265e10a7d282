use num_complex::Complex64;

use super::conformal::{NonPositiveRho, Weight, weights};
use super::{Block, LocalMap, Polynomial, Rest, SquareSum};
use crate::sparse::Stencils;

/// The authalic energy A: `A = Σ w (m² − k²)²` with `m = Im(conj(z2 − z0)(z3 − z1))`, twice the
/// signed area of a quad.
///
/// Unit weights: w = 1 and k = |(v3−v0)×(v2−v0)| + |(v2−v0)×(v1−v0)| at rest. Integral weights: `A
/// = Σ area ((m/2 area)² − 1)²`, that is, `k = 2 area` and `w = area/k⁴`.
pub struct Authalic {
    quads: Stencils,
    rest: Vec<f64>,
    root_weight: Vec<f64>,
}

impl Authalic {
    /// Makes A of the quads of the graph.
    ///
    /// # Errors
    /// [`NonPositiveRho`] with integral weights.
    pub fn new(rest: Rest) -> Result<Self, NonPositiveRho> {
        let Rest { graph, metric, weight, .. } = rest;
        weights(graph, weight)?;
        let (k, root_weight) = match weight {
            Weight::Unit => (metric.folded_area.iter().map(|a| 2.0 * a).collect(), vec![1.0; graph.quads.len()]),
            Weight::Integral => {
                let areas = || (0..graph.quads.len()).map(|q| graph.area(q));
                (areas().map(|a| 2.0 * a).collect(), areas().map(|a| a.sqrt() / (4.0 * a * a)).collect())
            }
        };
        Ok(Authalic { quads: Stencils::new(&graph.quads), rest: k, root_weight })
    }
}

/// `Im(conj(a) b)`, the signed area of the parallelogram spanned by a and b.
fn cross(a: Complex64, b: Complex64) -> f64 {
    (a.conj() * b).im
}

/// ∇m: with `m = a × b`, a = z2 − z0, b = z3 − z1, the gradient for a is −ib and for b it is ia.
fn gradient(a: Complex64, b: Complex64) -> [f64; 8] {
    [-b.im, b.re, a.im, -a.re, b.im, -b.re, -a.im, a.re]
}

/// The non-zero entries of ∇²m, which is constant, as (row, column, sign) above the diagonal.
const SECOND: [(usize, usize, f64); 8] =
    [(0, 3, 1.0), (0, 7, -1.0), (1, 2, -1.0), (1, 6, 1.0), (2, 5, 1.0), (3, 4, -1.0), (4, 7, 1.0), (5, 6, -1.0)];

impl SquareSum for Authalic {
    fn name(&self) -> &'static str {
        "A"
    }

    fn stencils(&self) -> &Stencils {
        &self.quads
    }

    fn residuals(&self, e: usize, z: &LocalMap) -> [f64; 2] {
        let m = cross(z[2] - z[0], z[3] - z[1]);
        [self.root_weight[e] * (m * m - self.rest[e] * self.rest[e]), 0.0]
    }

    fn jacobian(&self, e: usize, z: &LocalMap) -> [[f64; 8]; 2] {
        let (a, b) = (z[2] - z[0], z[3] - z[1]);
        let t = 2.0 * self.root_weight[e] * cross(a, b);
        [gradient(a, b).map(|g| t * g), [0.0; 8]]
    }

    fn curvature(&self, e: usize, z: &LocalMap) -> Option<Block> {
        let (a, b) = (z[2] - z[0], z[3] - z[1]);
        let [r, _] = self.residuals(e, z);
        let t = 2.0 * self.root_weight[e] * r;
        let (g, m) = (gradient(a, b), cross(a, b));
        let mut block = g.map(|gi| g.map(|gj| t * gi * gj));
        for (i, j, sign) in SECOND {
            block[i][j] += t * m * sign;
            block[j][i] += t * m * sign;
        }
        Some(block)
    }

    fn residuals_along(&self, e: usize, z: &LocalMap, d: &LocalMap) -> [Polynomial; 2] {
        let (a, b) = (z[2] - z[0], z[3] - z[1]);
        let (da, db) = (d[2] - d[0], d[3] - d[1]);
        let mut r = Polynomial::quadratic(cross(a, b), cross(da, b) + cross(a, db), cross(da, db)).squared();
        r.0[0] -= self.rest[e] * self.rest[e];
        [r.scaled(self.root_weight[e]), Polynomial::ZERO]
    }
}
