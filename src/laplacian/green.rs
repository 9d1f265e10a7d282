//! The complex Green's function of an inner black vertex.

use num_complex::Complex64;

use super::{ConformalLaplacian, Work};
use crate::quad_graph::QuadGraph;
use crate::sparse::Lists;

/// The Green's function G of an inner black vertex: `L G = 1` there and 0 at the other inner black
/// vertices, G = 0 on the boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Green {
    /// The inner black vertex, at the largest distance from the boundary in black diagonals.
    pub pole: u32,
    /// `−L_BI L_II⁻¹ e` (n), the flux through the black boundary vertices. Its sum is 1.
    pub flux: Vec<Complex64>,
}

impl ConformalLaplacian {
    /// Returns the Green's function of an inner black vertex far from the boundary; `None` if there
    /// is no such vertex or no boundary.
    pub fn green(&self, graph: &QuadGraph, work: &mut Work) -> Option<Green> {
        let pole = self.far_inside(graph)?;
        let mut y = work.take();
        y[self.inner_index(pole)?] = Complex64::ONE;
        self.factor.solve(&mut y, work);
        let mut flux = vec![Complex64::ZERO; self.len()];
        self.rows.subtract_outward(&y, &mut flux);
        work.give_back(y);
        Some(Green { pole, flux })
    }

    /// Returns the inner black vertex that a breadth-first search from the boundary reaches last.
    fn far_inside(&self, graph: &QuadGraph) -> Option<u32> {
        let quads = self.colouring.quads(graph).zip(0..);
        let around = Lists::new(graph.vertices, quads.flat_map(|(quad, q)| quad.black.map(|v| (v, q))));
        let mut reached = vec![false; graph.vertices];
        let mut queue = self.loops.black.clone();
        queue.iter().for_each(|&v| reached[v as usize] = true);
        let mut head = 0;
        while head < queue.len() {
            for &q in around.of(queue[head]) {
                for v in self.colouring.quad(graph, q as usize).black {
                    if !std::mem::replace(&mut reached[v as usize], true) {
                        queue.push(v);
                    }
                }
            }
            head += 1;
        }
        queue.last().copied().filter(|&v| self.inner_index(v).is_some() && !self.is_empty())
    }
}
