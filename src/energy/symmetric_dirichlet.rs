use num_complex::Complex64;

use super::Derivatives;
use super::triangle_sum::{Density, TriangleSum};

/// The density of the symmetric Dirichlet energy: `f = σ1² + σ2² + σ1⁻² + σ2⁻² − 4 = 2(|a|² +
/// |b|²)(1 + 1/(|a|² − |b|²)²) − 4`.
///
/// It is 0 if the triangle keeps its lengths (Smith, Schaefer, *Bijective parameterization with
/// free boundaries*, 2015). SLIM minimises it without the constant.
pub struct SymmetricDirichletDensity;

/// SD: `Σ w (σ1² + σ2² + σ1⁻² + σ2⁻² − 4)`.
pub type SymmetricDirichlet = TriangleSum<SymmetricDirichletDensity>;

impl SymmetricDirichlet {
    /// The factor s for which SD(s z) is least: `SD(s z) = P s² + Q s⁻² − 4 Σ w`, so `s⁴ = Q/P`.
    pub fn best_scale(&self, z: &[Complex64]) -> f64 {
        let (mut p, mut q) = (0.0, 0.0);
        for (piece, corners) in self.triangles.at(z) {
            let local = piece.map_of_any(corners);
            p += piece.weight * local.stretch();
            q += piece.weight * (local.stretch() / local.j) / local.j;
        }
        (q / p).sqrt().sqrt()
    }
}

impl Density for SymmetricDirichletDensity {
    const NAME: &'static str = "SD";

    // 2(A + B) − 2J = 4B and J + 1/J − 2 = (J − 1)²/J: there is no cancellation near an isometry.
    fn value(_a: f64, b: f64, j: f64) -> f64 {
        // 2(A + B)(1 + J⁻²) − 4 = 4B(1 + J⁻²) + 2(J − 1)²/J
        4.0 * b * (1.0 + 1.0 / (j * j)) + 2.0 * (j - 1.0) * (j - 1.0) / j
    }

    fn derivatives(a: f64, b: f64, j: f64) -> Derivatives {
        let (both, slope) = (2.0 * (1.0 + 1.0 / (j * j)), 4.0 * ((a + b) / j) / (j * j));
        let (cube, bend) = (8.0 / (j * j * j), 12.0 * ((a + b) / j) / (j * j * j));
        Derivatives {
            a: both - slope,
            b: both + slope,
            aa: a * (bend - cube),
            ab: -bend * (a * b).sqrt(),
            bb: b * (bend + cube),
        }
    }
}
