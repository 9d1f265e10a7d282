//! L_II as a sparse lower triangle, and the order of its unknowns.

use num_complex::Complex64;

use super::Colouring;
use crate::quad_graph::QuadGraph;
use crate::sparse::{Columns, Pattern, Stencils, dissect};

/// The inner black vertices in the order in which they are eliminated.
#[derive(Debug)]
pub(super) struct Numbering {
    pub inner: Vec<u32>,
    /// The place of every vertex in `inner`, or [`Numbering::OUTSIDE`].
    pub of_vertex: Vec<u32>,
    /// The black vertex that is held where there is no boundary.
    pub held: Option<u32>,
}

impl Numbering {
    pub const OUTSIDE: u32 = u32::MAX;

    /// Numbers the black vertices that are not on the boundary by nested dissection.
    pub fn new(graph: &QuadGraph, colouring: &Colouring, boundary: &[u32]) -> Self {
        let mut is_inner: Vec<bool> = (0..graph.vertices as u32).map(|v| colouring.is_black(v)).collect();
        let held = match boundary {
            [] => (0..graph.vertices as u32).find(|&v| colouring.is_black(v)),
            _ => None,
        };
        boundary.iter().chain(&held).for_each(|&v| is_inner[v as usize] = false);
        let diagonals: Vec<[u32; 4]> =
            colouring.quads(graph).map(|q| [q.black[0], q.black[1], q.black[0], q.black[1]]).collect();
        let inner = dissect(&diagonals, &graph.places, |v| is_inner[v as usize]);
        let mut of_vertex = vec![Self::OUTSIDE; graph.vertices];
        for (k, &v) in inner.iter().enumerate() {
            of_vertex[v as usize] = k as u32;
        }
        Numbering { inner, of_vertex, held }
    }

    /// The number of vertex `v`, where it is an inner black one.
    pub fn index(&self, v: u32) -> Option<usize> {
        Some(self.of_vertex[v as usize]).filter(|&k| k != Self::OUTSIDE).map(|k| k as usize)
    }
}

/// The lower triangle of L_II.
pub(super) struct InnerMatrix {
    pub columns: Columns,
    pub values: Vec<Complex64>,
}

/// Assembles L_II: every quad adds ρ to the diagonal at i and j, −ρ between them.
pub(super) fn inner_matrix(graph: &QuadGraph, colouring: &Colouring, numbering: &Numbering) -> InnerMatrix {
    let diagonals: Vec<[u32; 2]> = colouring.quads(graph).map(|quad| quad.black).collect();
    let pattern = Pattern::new(&[&Stencils::new(&diagonals)], &numbering.of_vertex, numbering.inner.len());
    let mut values = vec![Complex64::ZERO; pattern.columns.rows.len()];
    for (q, quad) in colouring.quads(graph).enumerate() {
        for (&slot, value) in pattern.slots(0, q, 2).iter().zip([quad.rho, -quad.rho, quad.rho]) {
            if slot != Pattern::NONE {
                values[slot as usize] += value;
            }
        }
    }
    InnerMatrix { columns: pattern.into_columns(), values }
}
