use num_complex::Complex64;

use crate::energy::{Block, Curvature, Energy, Polynomial};
use crate::quad_graph::QuadGraph;
use crate::sparse::Stencils;

/// A barrier that separates neighbours on the boundary: `−Σ (l/P) log|zₖ₊₁ − zₖ|` over the boundary
/// edges, where l are their lengths at rest and P is the perimeter. It is not a sum of squares.
pub struct Gaps {
    edges: Stencils,
    weight: Vec<f64>,
}

impl Gaps {
    /// Makes the barrier of the boundary of the graph.
    pub fn new(graph: &QuadGraph) -> Self {
        let n = graph.boundary.len();
        let edges: Vec<[u32; 2]> = (0..n).map(|k| [graph.boundary[k], graph.boundary[(k + 1) % n]]).collect();
        Self::of(&edges, &graph.boundary_length, graph.perimeter())
    }

    /// Makes the barrier of some edges with given lengths, on a boundary of the given perimeter.
    pub fn of(edges: &[[u32; 2]], lengths: &[f64], perimeter: f64) -> Self {
        Gaps { edges: Stencils::new(edges), weight: lengths.iter().map(|l| l / perimeter).collect() }
    }

    fn edge(&self, e: usize, z: &[Complex64]) -> Complex64 {
        let ends = self.edges.get(e);
        z[ends[1] as usize] - z[ends[0] as usize]
    }
}

impl Energy for Gaps {
    fn name(&self) -> &'static str {
        "gaps"
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        // log 0 = −∞
        let sum: f64 = self.weight.iter().enumerate().map(|(e, w)| -w * self.edge(e, z).norm().ln()).sum();
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        for (e, w) in self.weight.iter().enumerate() {
            let d = self.edge(e, z);
            // ∇ log|d| = d/|d|² = 1/d̄
            let pull = t * w / d.conj();
            let ends = self.edges.get(e);
            gradient[ends[0] as usize] += pull;
            gradient[ends[1] as usize] -= pull;
        }
    }

    fn add_bending(&self, _t: f64, _z: &[Complex64], _d: &[Complex64], _gradient: &mut [Complex64]) {}

    fn stencils(&self) -> Stencils {
        self.edges.clone()
    }

    /// The second derivatives `(2 u uᵀ − 1)/|d|²`, where u is the direction of d; without the
    /// negative eigenvalue `u uᵀ/|d|²`.
    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        for (e, w) in self.weight.iter().enumerate() {
            let d = self.edge(e, z);
            let size = w / d.norm_sqr();
            let u = d / d.norm();
            let (square, identity) = match curvature {
                Curvature::Exact => (2.0, -1.0),
                Curvature::GaussNewton => (1.0, 0.0),
            };
            let part = [
                [size * (square * u.re * u.re + identity), size * square * u.re * u.im],
                [size * square * u.re * u.im, size * (square * u.im * u.im + identity)],
            ];
            let mut block = [[0.0; 8]; 8];
            for i in 0..2 {
                for j in 0..2 {
                    (block[i][j], block[i + 2][j + 2]) = (part[i][j], part[i][j]);
                    (block[i][j + 2], block[i + 2][j]) = (-part[i][j], -part[i][j]);
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
