use nalgebra_sparse::{CooMatrix, CsrMatrix};
use num_complex::Complex64;

use super::{Block, Curvature, Energy, Polynomial};
use crate::sparse::Stencils;

/// The map at the vertices of one piece, in the order of its stencil; unused entries are 0.
pub type LocalMap = [Complex64; 4];

/// An energy `E = Σ_pieces r1² + r2²` whose residuals are polynomials of the values at the piece's
/// vertices, weights being included as square roots. Pieces with one residual have r2 = 0.
pub trait SquareSum: Sync {
    /// The name in expressions.
    fn name(&self) -> &'static str;

    /// The vertices of each piece.
    fn stencils(&self) -> &Stencils;

    /// Number of residuals of a piece, 1 or 2.
    fn residuals_per_piece(&self) -> usize {
        1
    }

    /// The residuals of piece `e`.
    fn residuals(&self, e: usize, z: &LocalMap) -> [f64; 2];

    /// The derivatives of the residuals with respect to (Re, Im) of each vertex.
    fn jacobian(&self, e: usize, z: &LocalMap) -> [[f64; 8]; 2];

    /// Returns `Σ_k r_k ∇²r_k`, or `None` if the residuals are linear.
    fn curvature(&self, e: usize, z: &LocalMap) -> Option<Block>;

    /// The residuals of piece `e` along `t ↦ z + t d`, exactly.
    fn residuals_along(&self, e: usize, z: &LocalMap, d: &LocalMap) -> [Polynomial; 2];

    /// Whether all residuals are linear.
    fn is_linear(&self) -> bool {
        false
    }
}

fn local(stencil: &[u32], z: &[Complex64]) -> LocalMap {
    let mut values = [Complex64::ZERO; 4];
    for (value, &v) in values.iter_mut().zip(stencil) {
        *value = z[v as usize];
    }
    values
}

/// Adds the rows of a piece's Jacobian, multiplied by the residuals, to a gradient.
fn add_rows(stencil: &[u32], [r, s]: [f64; 2], [j, k]: &[[f64; 8]; 2], gradient: &mut [Complex64]) {
    for (i, &v) in stencil.iter().enumerate() {
        let (re, im) = (2 * i, 2 * i + 1);
        gradient[v as usize] += Complex64::new(r * j[re] + s * k[re], r * j[im] + s * k[im]);
    }
}

impl<S: SquareSum> Energy for S {
    fn name(&self) -> &'static str {
        SquareSum::name(self)
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        let stencils = SquareSum::stencils(self);
        (0..stencils.len())
            .map(|e| {
                let [r, s] = self.residuals(e, &local(stencils.get(e), z));
                r * r + s * s
            })
            .sum()
    }

    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        let stencils = SquareSum::stencils(self);
        for e in 0..stencils.len() {
            let here = local(stencils.get(e), z);
            let r = self.residuals(e, &here).map(|r| 2.0 * t * r);
            add_rows(stencils.get(e), r, &self.jacobian(e, &here), gradient);
        }
    }

    fn add_bending(&self, t: f64, z: &[Complex64], d: &[Complex64], gradient: &mut [Complex64]) {
        if self.is_linear() {
            return;
        }
        let stencils = SquareSum::stencils(self);
        for e in 0..stencils.len() {
            let stencil = stencils.get(e);
            let here = local(stencil, z);
            let bend = self.residuals_along(e, &here, &local(stencil, d)).map(|r| 4.0 * t * r.0[2]);
            add_rows(stencil, bend, &self.jacobian(e, &here), gradient);
        }
    }

    fn stencils(&self) -> Stencils {
        SquareSum::stencils(self).clone()
    }

    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        let stencils = SquareSum::stencils(self);
        let size = 2 * stencils.arity;
        for e in 0..stencils.len() {
            let here = local(stencils.get(e), z);
            let jacobian = self.jacobian(e, &here);
            let exact = if curvature == Curvature::Exact { self.curvature(e, &here) } else { None };
            let mut block = exact.unwrap_or([[0.0; 8]; 8]);
            for row in &jacobian[..self.residuals_per_piece()] {
                for i in 0..size {
                    for j in 0..size {
                        block[i][j] += row[i] * row[j];
                    }
                }
            }
            for entry in block.as_flattened_mut() {
                *entry *= 2.0;
            }
            add(e, &block);
        }
    }

    fn stretch(&self, z: &[Complex64], d: &[Complex64]) -> Option<f64> {
        let stencils = SquareSum::stencils(self);
        let along = (0..stencils.len()).map(|e| {
            let stencil = stencils.get(e);
            self.residuals_along(e, &local(stencil, z), &local(stencil, d))
        });
        Some(along.flat_map(|r| r.into_iter().take(self.residuals_per_piece())).map(|r| r.0[1] * r.0[1]).sum())
    }

    fn residual_count(&self) -> usize {
        self.residuals_per_piece() * SquareSum::stencils(self).len()
    }

    fn is_quadratic(&self) -> bool {
        self.is_linear()
    }

    fn along(&self, z: &[Complex64], d: &[Complex64]) -> Option<Polynomial> {
        let stencils = SquareSum::stencils(self);
        let mut sum = Polynomial::ZERO;
        for e in 0..stencils.len() {
            let stencil = stencils.get(e);
            let residuals = self.residuals_along(e, &local(stencil, z), &local(stencil, d));
            for r in &residuals[..self.residuals_per_piece()] {
                sum.add_square(r);
            }
        }
        Some(sum)
    }
}

/// Returns the Jacobian of all residuals with respect to x = (Re z0, Im z0, Re z1, …) (`residuals ×
/// 2 nv`).
pub fn jacobian(energy: &dyn SquareSum, z: &[Complex64]) -> CsrMatrix<f64> {
    let stencils = energy.stencils();
    let per_piece = energy.residuals_per_piece();
    let mut matrix = CooMatrix::new(per_piece * stencils.len(), 2 * z.len());
    for e in 0..stencils.len() {
        let stencil = stencils.get(e);
        let rows = energy.jacobian(e, &local(stencil, z));
        for (k, row) in rows.iter().take(per_piece).enumerate() {
            for (i, &v) in stencil.iter().enumerate() {
                matrix.push(per_piece * e + k, 2 * v as usize, row[2 * i]);
                matrix.push(per_piece * e + k, 2 * v as usize + 1, row[2 * i + 1]);
            }
        }
    }
    CsrMatrix::from(&matrix)
}
