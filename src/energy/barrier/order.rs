use num_complex::Complex64;

use crate::energy::{Block, Curvature, Energy, Polynomial};
use crate::quad_graph::QuadGraph;
use crate::sparse::Stencils;

/// A barrier that keeps the boundary in order around 0: `−Σ log(zₖ × zₖ₊₁)` over the boundary
/// edges, +∞ if some zₖ × zₖ₊₁ ≤ 0. It is not a sum of squares.
pub struct Order {
    edges: Stencils,
}

impl Order {
    /// Makes the barrier of the boundary of the graph.
    pub fn new(graph: &QuadGraph) -> Self {
        let n = graph.boundary.len();
        let edges: Vec<[u32; 2]> = (0..n).map(|k| [graph.boundary[k], graph.boundary[(k + 1) % n]]).collect();
        Order { edges: Stencils::new(&edges) }
    }

    /// The ends a, b of an edge and their cross product a × b.
    fn piece(&self, e: usize, z: &[Complex64]) -> (Complex64, Complex64, f64) {
        let ends = self.edges.get(e);
        let (a, b) = (z[ends[0] as usize], z[ends[1] as usize]);
        (a, b, (a.conj() * b).im)
    }
}

impl Energy for Order {
    fn name(&self) -> &'static str {
        "order"
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        let mut sum = 0.0;
        for e in 0..self.edges.len() {
            let (_, _, m) = self.piece(e, z);
            if m.is_nan() || m <= 0.0 {
                return f64::INFINITY;
            }
            sum -= m.ln();
        }
        sum
    }

    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        for e in 0..self.edges.len() {
            let (a, b, m) = self.piece(e, z);
            let ends = self.edges.get(e);
            // ∇(a × b) = (−ib, ia)
            gradient[ends[0] as usize] += t / m * Complex64::I * b;
            gradient[ends[1] as usize] -= t / m * Complex64::I * a;
        }
    }

    fn add_bending(&self, _t: f64, _z: &[Complex64], _d: &[Complex64], _gradient: &mut [Complex64]) {}

    fn stencils(&self) -> Stencils {
        self.edges.clone()
    }

    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        for e in 0..self.edges.len() {
            let (a, b, m) = self.piece(e, z);
            let g = [b.im, -b.re, -a.im, a.re];
            let mut block = [[0.0; 8]; 8];
            for i in 0..4 {
                for j in 0..4 {
                    block[i][j] = g[i] * g[j] / (m * m);
                }
            }
            if curvature == Curvature::Exact {
                // m = a.re b.im − a.im b.re
                for (i, j, sign) in [(0, 3, -1.0), (1, 2, 1.0)] {
                    block[i][j] += sign / m;
                    block[j][i] += sign / m;
                }
            }
            add(e, &block);
        }
    }

    fn residual_count(&self) -> usize {
        0
    }

    fn along(&self, _z: &[Complex64], _d: &[Complex64]) -> Option<Polynomial> {
        None
    }
}
