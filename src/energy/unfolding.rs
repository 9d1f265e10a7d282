use num_complex::Complex64;

use super::affine::{Derivatives, Local, Triangles};
use super::{Block, Curvature, Energy, EnergyError, Polynomial, Rest};
use crate::sparse::Stencils;

/// MIPS for maps that fold, `Σ w ((|a|² + |b|²)/χ(J) − 1)` with `χ(J) = ½(J + √(ε² + J²)) > 0` in the place of J = |a|² − |b|²: finite
/// everywhere, the higher the more a triangle is turned over, and MIPS itself as ε goes to 0 (Garanzha et al., *Foldover-free maps in 50
/// lines of code*, 2021). No energy of the table: it leads to a map without folds, and says nothing of the map.
pub struct Unfolding {
    triangles: Triangles,
    /// ε of each.
    epsilon: Vec<f64>,
}

impl Unfolding {
    /// The triangles of the rest metric.
    ///
    /// # Errors
    /// One without area at rest.
    pub fn triangles(rest: Rest) -> Result<Triangles, EnergyError> {
        Triangles::new(rest, "MIPS")
    }

    /// Over the triangles of the rest metric, ε that share of `scale`, the area of a triangle about where the map is to come to over its area
    /// at rest.
    ///
    /// # Errors
    /// A triangle without area at rest.
    pub fn new(rest: Rest, scale: &[f64], share: f64) -> Result<Self, EnergyError> {
        Ok(Unfolding { triangles: Self::triangles(rest)?, epsilon: scale.iter().map(|s| share * s).collect() })
    }

    /// χ and √(ε² + J²).
    fn chi(&self, e: usize, j: f64) -> (f64, f64) {
        let epsilon = self.epsilon[e];
        let root = epsilon.hypot(j);
        // Without cancellation where J < 0.
        let chi = if j > 0.0 { 0.5 * (j + root) } else { 0.5 * epsilon * epsilon / (root - j) };
        (chi, root)
    }

    fn derivatives(&self, e: usize, at: &Local) -> Derivatives {
        let (a, b) = (at.a.norm_sqr(), at.b.norm_sqr());
        let (chi, root) = self.chi(e, at.j);
        // 1/χ, its derivatives, and those times |a|² + |b|².
        let g = 1.0 / chi;
        let slope = -g / root;
        let bend = 2.0 * g / (root * root) - 0.5 * (self.epsilon[e] * g / root).powi(2) / root;
        let (slope_both, bend_both) = ((a + b) * slope, (a + b) * bend);
        Derivatives {
            a: g + slope_both,
            b: g - slope_both,
            aa: a * (2.0 * slope + bend_both),
            ab: -(a * b).sqrt() * bend_both,
            bb: b * (bend_both - 2.0 * slope),
        }
    }
}

impl Energy for Unfolding {
    fn name(&self) -> &'static str {
        "unfolding"
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        let terms = self.triangles.at(z).enumerate().map(|(e, (piece, corners))| {
            let at = piece.map_of_any(corners);
            piece.weight * (at.stretch() / self.chi(e, at.j).0 - 1.0)
        });
        let sum: f64 = terms.sum();
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        let of_corners = self.triangles.at(z).enumerate().map(|(e, (piece, corners))| {
            let at = piece.map_of_any(corners);
            piece.gradient(t, &at, &self.derivatives(e, &at))
        });
        self.triangles.scatter(of_corners, gradient);
    }

    fn add_bending(&self, _t: f64, _z: &[Complex64], _d: &[Complex64], _gradient: &mut [Complex64]) {}

    fn stencils(&self) -> Stencils {
        self.triangles.stencils()
    }

    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        for (e, (piece, corners)) in self.triangles.at(z).enumerate() {
            let at = piece.map_of_any(corners);
            add(e, &piece.block(&at, &self.derivatives(e, &at), curvature));
        }
    }

    fn residual_count(&self) -> usize {
        0
    }

    fn along(&self, _z: &[Complex64], _d: &[Complex64]) -> Option<Polynomial> {
        None
    }
}
