use std::f64::consts::TAU;

use num_complex::Complex64;

use super::conformal::{NonPositiveRho, Weight, weights};
use super::{Block, LocalMap, Polynomial, Rest, SquareSum};
use crate::quad_graph::QuadGraph;
use crate::sparse::Stencils;

/// The metric energies L and L': `Σ w (|zi − zj|² − l²)²` over edges with rest lengths l.
///
/// Unit weights: w = 1. Integral weights: `w = area/l⁴` for L, where area is half the area of the
/// adjacent quads, and `w = (P/2π) l/l⁴` for L', where P is the perimeter.
pub struct Metric {
    name: &'static str,
    edges: Stencils,
    length_squared: Vec<f64>,
    root_weight: Vec<f64>,
}

impl Metric {
    /// Makes L, over all edges of the quad graph.
    ///
    /// # Errors
    /// [`NonPositiveRho`] with integral weights.
    pub fn all_edges(rest: Rest) -> Result<Self, NonPositiveRho> {
        // The areas are positive if Re ρ is.
        weights(rest.graph, rest.weight)?;
        let metric = rest.metric;
        let pieces = metric.edges.iter().zip(&metric.length).zip(&metric.area);
        Ok(Self::new("L", rest.weight, pieces.map(|((&edge, &length), &area)| (edge, length, area))))
    }

    /// Makes L', over the boundary edges of the quad graph.
    pub fn boundary_edges(rest: Rest) -> Self {
        Metric::of_boundary(rest.graph, rest.weight)
    }

    /// L' of a quad graph.
    pub fn of_boundary(graph: &QuadGraph, weight: Weight) -> Self {
        let n = graph.boundary.len();
        let radius = graph.perimeter() / TAU;
        let edges = (0..n).map(|k| {
            let length = graph.boundary_length[k];
            ([graph.boundary[k], graph.boundary[(k + 1) % n]], length, radius * length)
        });
        Self::new("Lb", weight, edges)
    }

    /// Makes L' over the boundary edges of the mesh; on triangle meshes each consists of two edges
    /// of the quad graph.
    pub fn mesh_boundary_edges(rest: Rest) -> Self {
        let graph = rest.graph;
        let n = graph.boundary.len();
        let radius = graph.perimeter() / TAU;
        let is_mesh = |k: usize| !graph.is_dual(graph.boundary[k % n]);
        let edges = (0..n).filter(|&k| is_mesh(k)).map(|k| {
            let to = if is_mesh(k + 1) { k + 1 } else { k + 2 };
            let length = (k..to).map(|k| graph.boundary_length[k]).sum();
            ([graph.boundary[k], graph.boundary[to % n]], length, radius * length)
        });
        Self::new("Lb", rest.weight, edges)
    }

    /// Makes L' over some edges with given lengths, on a boundary of the given perimeter.
    pub fn of_boundary_edges(edges: &[[u32; 2]], lengths: &[f64], perimeter: f64, weight: Weight) -> Self {
        let radius = perimeter / TAU;
        let pieces = edges.iter().zip(lengths).map(|(&edge, &length)| (edge, length, radius * length));
        Self::new("Lb", weight, pieces)
    }

    fn new(name: &'static str, weight: Weight, pieces: impl Iterator<Item = ([u32; 2], f64, f64)>) -> Self {
        let (mut edges, mut length_squared, mut root_weight) = (Vec::new(), Vec::new(), Vec::new());
        for (edge, length, area) in pieces {
            edges.push(edge);
            length_squared.push(length * length);
            root_weight.push(match weight {
                Weight::Unit => 1.0,
                Weight::Integral => area.sqrt() / (length * length),
            });
        }
        Metric { name, edges: Stencils::new(&edges), length_squared, root_weight }
    }
}

impl SquareSum for Metric {
    fn name(&self) -> &'static str {
        self.name
    }

    fn stencils(&self) -> &Stencils {
        &self.edges
    }

    fn residuals(&self, e: usize, z: &LocalMap) -> [f64; 2] {
        [self.root_weight[e] * ((z[1] - z[0]).norm_sqr() - self.length_squared[e]), 0.0]
    }

    fn jacobian(&self, e: usize, z: &LocalMap) -> [[f64; 8]; 2] {
        let g = 2.0 * self.root_weight[e] * (z[1] - z[0]);
        [[-g.re, -g.im, g.re, g.im, 0.0, 0.0, 0.0, 0.0], [0.0; 8]]
    }

    fn curvature(&self, e: usize, z: &LocalMap) -> Option<Block> {
        let [r, _] = self.residuals(e, z);
        let c = 2.0 * self.root_weight[e] * r;
        let mut block = [[0.0; 8]; 8];
        for i in 0..2 {
            (block[i][i], block[i + 2][i + 2]) = (c, c);
            (block[i][i + 2], block[i + 2][i]) = (-c, -c);
        }
        Some(block)
    }

    fn residuals_along(&self, e: usize, z: &LocalMap, d: &LocalMap) -> [Polynomial; 2] {
        let (edge, step): (Complex64, Complex64) = (z[1] - z[0], d[1] - d[0]);
        let r = Polynomial::quadratic(
            edge.norm_sqr() - self.length_squared[e],
            2.0 * (edge.conj() * step).re,
            step.norm_sqr(),
        );
        [r.scaled(self.root_weight[e]), Polynomial::ZERO]
    }
}
