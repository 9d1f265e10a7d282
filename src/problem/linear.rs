//! The linear problem: system (2), weights and constraints.

use nalgebra_sparse::{CooMatrix, CscMatrix};
use num_complex::Complex64;

use crate::constraint::{ConstraintError, Elimination, Fixed};
use crate::energy::conformal::{self, NonPositiveRho, Weight};
use crate::geometry::maximum::max_or_nan;
use crate::quad_graph::QuadGraph;

/// The problem of minimising H over the maps with some vertices pinned. If just enough are pinned,
/// the minimum is H = 0, that is, (2) holds.
#[derive(Clone, Debug)]
pub struct LinearProblem<'a> {
    /// The quad graph with its ρ.
    pub graph: &'a QuadGraph,
    /// The weights of the quads in H.
    pub weight: Weight,
    /// The elimination of pinned vertices, z = Z y + z0.
    pub elimination: Elimination,
}

impl<'a> LinearProblem<'a> {
    /// Makes the problem in which the vertices in `fixed` are pinned.
    ///
    /// # Errors
    /// Constraints that do not determine the map, or pinned vertices that do not exist.
    pub fn new(graph: &'a QuadGraph, weight: Weight, fixed: &Fixed) -> Result<Self, ConstraintError> {
        fixed.determine(graph)?;
        Ok(LinearProblem { graph, weight, elimination: Elimination::for_factor(graph, fixed) })
    }

    /// Whether (2) has as many equations as unknowns, so that its solution has H = 0.
    pub fn is_square(&self) -> bool {
        self.graph.quads.len() == self.elimination.unknowns()
    }

    /// Whether every boundary vertex is pinned. K, which involves only boundary vertices, then does
    /// not enter, and with integral weights the normal equations are real.
    pub fn holds_whole_boundary(&self) -> bool {
        self.graph.boundary.iter().all(|&v| !self.elimination.is_free(v))
    }

    /// Returns the weight of every quad.
    ///
    /// If (2) is square, its solution is the minimum for any positive weights, and unit weights
    /// replace integral ones that are undefined.
    ///
    /// # Errors
    /// Integral weights if some Re ρ ≤ 0 and (2) is not square.
    pub fn weights(&self) -> Result<Vec<f64>, NonPositiveRho> {
        match conformal::weights(self.graph, self.weight) {
            Err(_) if self.is_square() => conformal::weights(self.graph, Weight::Unit),
            weights => weights,
        }
    }

    /// Returns system (2) on the free unknowns, `A Z y = −A z0`: the matrix (`nf × m`) and the
    /// right-hand side (`nf`).
    pub fn reduced_system(&self) -> (CscMatrix<Complex64>, Vec<Complex64>) {
        let elimination = &self.elimination;
        let mut a_z = CooMatrix::new(self.graph.quads.len(), elimination.unknowns());
        for (q, quad) in self.graph.quads.iter().enumerate() {
            for (&v, a) in quad.iter().zip(conformal::row(self.graph.rho[q])) {
                if elimination.is_free(v) {
                    a_z.push(q, elimination.unknown[v as usize] as usize, a);
                }
            }
        }
        let right = (0..self.graph.quads.len()).map(|q| -conformal::residual(self.graph, q, &elimination.z0));
        (CscMatrix::from(&a_z), right.collect())
    }

    /// Returns the residual of `z` relative to the size of the terms that cancel.
    ///
    /// If (2) is square, this is the largest `|r| / (|z3| + |z1| + |ρ|(|z2| + |z0|))` over the
    /// quads. Otherwise it is the largest entry of the normal equations `Aᴴ W A z` at a free
    /// vertex, relative to `|Aᴴ| W |A| |z|`.
    ///
    /// # Errors
    /// Integral weights if some Re ρ ≤ 0.
    pub fn residual(&self, z: &[Complex64]) -> Result<f64, NonPositiveRho> {
        let graph = self.graph;
        let worst = |ratios: &mut dyn Iterator<Item = f64>| ratios.fold(0.0, max_or_nan);
        if self.is_square() {
            return Ok(worst(&mut (0..graph.quads.len()).map(|q| {
                let [z0, z1, z2, z3] = graph.quads[q].map(|v| z[v as usize].norm());
                relative(conformal::residual(graph, q, z).norm(), z3 + z1 + graph.rho[q].norm() * (z2 + z0))
            })));
        }
        let w = self.weights()?;
        let product = conformal::normal_product(graph, &w, z);
        let scale = conformal::normal_product_scale(graph, &w, z);
        let free = self.elimination.free.iter().map(|&v| v as usize);
        Ok(worst(&mut free.map(|v| relative(product[v].norm(), scale[v]))))
    }
}

/// a / b, where 0 / 0 is 0.
fn relative(a: f64, b: f64) -> f64 {
    if a == 0.0 { 0.0 } else { a / b }
}

/// Returns the matrix A of system (2), `A z = 0` for conformal z (`nf × nv`, complex).
pub fn system(graph: &QuadGraph) -> CscMatrix<Complex64> {
    let mut a = CooMatrix::new(graph.quads.len(), graph.vertices);
    for (q, quad) in graph.quads.iter().enumerate() {
        for (&v, coefficient) in quad.iter().zip(conformal::row(graph.rho[q])) {
            a.push(q, v as usize, coefficient);
        }
    }
    CscMatrix::from(&a)
}
