//! L as a sparse lower triangle, and the order of its unknowns.

use num_complex::Complex64;

use super::Colouring;
use crate::quad_graph::QuadGraph;
use crate::sparse::{Columns, Lists, dissect};

/// The numbers of the black vertices: first the inner ones in elimination order, then those on the
/// boundary.
#[derive(Debug)]
pub(super) struct Numbering {
    pub inner: Vec<u32>,
    /// The number of every vertex, or [`Numbering::NONE`].
    pub of_vertex: Vec<u32>,
    /// The black vertex that is pinned if there is no boundary.
    pub held: Option<u32>,
}

impl Numbering {
    /// Marks white vertices and the pinned one.
    pub const NONE: u32 = u32::MAX;

    /// Numbers the black vertices that are not on the boundary by nested dissection.
    pub fn new(graph: &QuadGraph, colouring: &Colouring, boundary: &[u32]) -> Self {
        let mut is_inner: Vec<bool> = (0..graph.vertices as u32).map(|v| colouring.is_black(v)).collect();
        let held = match boundary {
            [] => (0..graph.vertices as u32).find(|&v| colouring.is_black(v)),
            _ => None,
        };
        boundary.iter().chain(&held).for_each(|&v| is_inner[v as usize] = false);
        let diagonals: Vec<[u32; 4]> =
            colouring.quads(graph).map(|quad| [quad.black[0], quad.black[1], quad.black[0], quad.black[1]]).collect();
        let inner = dissect(&diagonals, &graph.places, |v| is_inner[v as usize]);
        let mut of_vertex = vec![Self::NONE; graph.vertices];
        for (k, &v) in inner.iter().chain(boundary).enumerate() {
            of_vertex[v as usize] = k as u32;
        }
        Numbering { inner, of_vertex, held }
    }

    /// Whether a number belongs to an inner vertex.
    pub fn is_inner(&self, number: u32) -> bool {
        (number as usize) < self.inner.len()
    }

    /// The number of vertex `v` if it is an inner black vertex.
    pub fn index(&self, v: u32) -> Option<usize> {
        Some(self.of_vertex[v as usize]).filter(|&k| self.is_inner(k)).map(|k| k as usize)
    }

    /// The boundary position of vertex `v` if it is a black boundary vertex.
    pub fn position(&self, v: u32) -> Option<usize> {
        Some(self.of_vertex[v as usize])
            .filter(|&k| k != Self::NONE && !self.is_inner(k))
            .map(|k| k as usize - self.inner.len())
    }
}

/// The lower triangle of L_II or of the whole L.
pub(super) struct LowerTriangle {
    pub columns: Columns,
    pub values: Vec<Complex64>,
}

impl LowerTriangle {
    /// Assembles L on the first `size` numbers: every quad adds ρ to the diagonal at i and j and −ρ
    /// between them.
    ///
    /// Quads are sorted by the larger number of i and j by counting; in that order they fill the
    /// columns from top to bottom.
    pub fn new(graph: &QuadGraph, colouring: &Colouring, numbering: &Numbering, size: usize) -> Self {
        let number = |v: u32| Some(numbering.of_vertex[v as usize]).filter(|&k| (k as usize) < size);
        let coupled = |q: usize| {
            let [i, j] = colouring.quad(graph, q).black.map(number);
            // An edge from a vertex to itself, which is possible on a closed surface, cancels.
            Some((i?.min(j?), i?.max(j?))).filter(|(i, j)| i != j)
        };
        let rows = Lists::new(size, (0..graph.quads.len()).filter_map(|q| Some((coupled(q)?.1, q as u32))));
        let mut offsets = vec![0u32; size + 1];
        (0..graph.quads.len()).filter_map(coupled).for_each(|(column, _)| offsets[column as usize + 1] += 1);
        for k in 0..size {
            // One more for the diagonal.
            offsets[k + 1] += offsets[k] + 1;
        }
        let entries = offsets[size] as usize;
        let mut triangle = LowerTriangle {
            columns: Columns { offsets, rows: vec![0; entries] },
            values: vec![Complex64::ZERO; entries],
        };
        let Columns { offsets, rows: row_of } = &mut triangle.columns;
        let mut next: Vec<u32> = offsets[..size].iter().map(|first| first + 1).collect();
        let mut repeated = 0;
        for row in 0..size as u32 {
            row_of[offsets[row as usize] as usize] = row;
            for &q in rows.of(row) {
                let quad = colouring.quad(graph, q as usize);
                let [i, j] = quad.black.map(|v| numbering.of_vertex[v as usize]);
                let column = i.min(j) as usize;
                let here = next[column] as usize;
                // Several quads may have the same black diagonal.
                if row_of[here - 1] == row {
                    triangle.values[here - 1] -= quad.rho;
                    repeated += 1;
                } else {
                    row_of[here] = row;
                    triangle.values[here] = -quad.rho;
                    next[column] += 1;
                }
            }
        }
        for quad in colouring.quads(graph).filter(|quad| quad.black[0] != quad.black[1]) {
            for k in quad.black.into_iter().filter_map(number) {
                triangle.values[offsets[k as usize] as usize] += quad.rho;
            }
        }
        if repeated > 0 {
            triangle.close_gaps(&next);
        }
        triangle
    }

    /// Removes the unused space of columns, after their last entries at `end`.
    fn close_gaps(&mut self, end: &[u32]) {
        let Columns { offsets, rows } = &mut self.columns;
        let mut kept = 0;
        for (column, &end) in end.iter().enumerate() {
            let first = offsets[column] as usize;
            offsets[column] = kept as u32;
            for entry in first..end as usize {
                rows[kept] = rows[entry];
                self.values[kept] = self.values[entry];
                kept += 1;
            }
        }
        offsets[end.len()] = kept as u32;
        rows.truncate(kept);
        self.values.truncate(kept);
    }
}
