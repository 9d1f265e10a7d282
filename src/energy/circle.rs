use std::f64::consts::TAU;

use num_complex::Complex64;

use super::conformal::Weight;
use super::{Block, LocalMap, Polynomial, Rest, SquareSum};
use crate::quad_graph::QuadGraph;
use crate::sparse::Stencils;

/// The circle energy C: `C = Σ w (|z|² − 1)²` over the boundary vertices that are not pinned.
///
/// Unit weights: w = 1. Integral weights: w = 2π ℓ/P, where ℓ is half the length of the adjacent
/// boundary edges and P the perimeter.
pub struct Circle {
    vertices: Stencils,
    root_weight: Vec<f64>,
}

impl Circle {
    /// Makes C of the boundary of the graph.
    pub fn new(rest: Rest) -> Self {
        Circle::of_free(rest.graph, rest.weight, |v| !rest.held[v as usize])
    }

    /// C of the boundary vertices for which `is_free` holds.
    pub fn of_free(graph: &QuadGraph, weight: Weight, is_free: impl Fn(u32) -> bool) -> Self {
        let n = graph.boundary.len();
        let perimeter = graph.perimeter();
        let free = || (0..n).filter(|&k| is_free(graph.boundary[k]));
        let weight = |k: usize| match weight {
            Weight::Unit => 1.0,
            Weight::Integral => {
                let adjacent = graph.boundary_length[k] + graph.boundary_length[(k + n - 1) % n];
                TAU * 0.5 * adjacent / perimeter
            }
        };
        Circle {
            vertices: Stencils::new(&free().map(|k| [graph.boundary[k]]).collect::<Vec<_>>()),
            root_weight: free().map(|k| weight(k).sqrt()).collect(),
        }
    }
}

impl SquareSum for Circle {
    fn name(&self) -> &'static str {
        "C"
    }

    fn stencils(&self) -> &Stencils {
        &self.vertices
    }

    fn residuals(&self, e: usize, z: &LocalMap) -> [f64; 2] {
        [self.root_weight[e] * (z[0].norm_sqr() - 1.0), 0.0]
    }

    fn jacobian(&self, e: usize, z: &LocalMap) -> [[f64; 8]; 2] {
        let g = 2.0 * self.root_weight[e] * z[0];
        [[g.re, g.im, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 8]]
    }

    fn curvature(&self, e: usize, z: &LocalMap) -> Option<Block> {
        let s = self.root_weight[e];
        let mut block = [[0.0; 8]; 8];
        for (i, row) in block.iter_mut().enumerate().take(2) {
            row[i] = 2.0 * s * s * (z[0].norm_sqr() - 1.0);
        }
        Some(block)
    }

    fn residuals_along(&self, e: usize, z: &LocalMap, d: &LocalMap) -> [Polynomial; 2] {
        let dot = |a: Complex64, b: Complex64| (a.conj() * b).re;
        let r = Polynomial::quadratic(z[0].norm_sqr() - 1.0, 2.0 * dot(z[0], d[0]), d[0].norm_sqr());
        [r.scaled(self.root_weight[e]), Polynomial::ZERO]
    }
}
