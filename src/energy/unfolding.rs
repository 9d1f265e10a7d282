use num_complex::Complex64;

use super::affine::{Derivatives, Local, Triangles};
use super::{Block, Curvature, Energy, EnergyError, Polynomial, Rest};
use crate::sparse::Stencils;

/// A modification of MIPS that is finite for flipped faces: `Σ w ((|a|² + |b|²)/χ(J) − 1)` with
/// `χ(J) = ½(J + √(ε² + J²)) > 0` instead of J = |a|² − |b|².
///
/// The more a triangle is flipped, the larger is its term; as ε → 0 it becomes MIPS (Garanzha et
/// al., *Foldover-free maps in 50 lines of code*, 2021). It is not in the table of energies,
/// because it serves only to reach a map without flipped faces.
pub struct Unfolding {
    triangles: Triangles,
    /// The ε of each triangle.
    epsilon: Vec<f64>,
}

impl Unfolding {
    /// Makes the triangles of the rest metric.
    ///
    /// # Errors
    /// A triangle without area at rest.
    pub fn triangles(rest: Rest) -> Result<Triangles, EnergyError> {
        Triangles::new(rest, "MIPS")
    }

    /// Makes the sum over the triangles of the rest metric with ε = `share` × `scale`, where
    /// `scale` is the approximate area that each triangle will have in the map, relative to its
    /// area at rest.
    ///
    /// # Errors
    /// A triangle without area at rest.
    pub fn new(rest: Rest, scale: &[f64], share: f64) -> Result<Self, EnergyError> {
        Ok(Unfolding { triangles: Self::triangles(rest)?, epsilon: scale.iter().map(|s| share * s).collect() })
    }

    /// Returns χ and √(ε² + J²).
    fn chi(&self, e: usize, j: f64) -> (f64, f64) {
        let epsilon = self.epsilon[e];
        let root = epsilon.hypot(j);
        // Avoids cancellation for J < 0.
        let chi = if j > 0.0 { 0.5 * (j + root) } else { 0.5 * epsilon * epsilon / (root - j) };
        (chi, root)
    }

    fn derivatives(&self, e: usize, at: &Local) -> Derivatives {
        let (a, b) = (at.a.norm_sqr(), at.b.norm_sqr());
        let (chi, root) = self.chi(e, at.j);
        // 1/χ and its derivatives, then these multiplied by |a|² + |b|².
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
