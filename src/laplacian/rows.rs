//! The rows of L at the boundary: L_BB and L_BI.

use num_complex::Complex64;

use super::Colouring;
use super::matrix::Numbering;
use crate::quad_graph::QuadGraph;

/// L_BB and L_BI by entries; an entry may be there in several parts.
#[derive(Debug)]
pub(super) struct BoundaryRows {
    /// The diagonal of L_BB (n).
    diagonal: Vec<Complex64>,
    /// Pairs of boundary positions that a quad couples: (k, l, −ρ) for the entries (k, l) and (l, k).
    pairs: Vec<(u32, u32, Complex64)>,
    /// Entries of L_BI: (boundary position, inner number, −ρ).
    outward: Vec<(u32, u32, Complex64)>,
}

impl BoundaryRows {
    pub fn new(graph: &QuadGraph, colouring: &Colouring, numbering: &Numbering, black: &[u32]) -> Self {
        let mut position = vec![u32::MAX; graph.vertices];
        for (k, &v) in black.iter().enumerate() {
            position[v as usize] = k as u32;
        }
        let mut rows =
            BoundaryRows { diagonal: vec![Complex64::ZERO; black.len()], pairs: Vec::new(), outward: Vec::new() };
        for quad in colouring.quads(graph) {
            let [k, l] = quad.black.map(|v| position[v as usize]);
            let [i, j] = quad.black.map(|v| numbering.of_vertex[v as usize]);
            for k in [k, l].into_iter().filter(|&k| k != u32::MAX) {
                rows.diagonal[k as usize] += quad.rho;
            }
            match (k != u32::MAX, l != u32::MAX) {
                (true, true) => rows.pairs.push((k, l, -quad.rho)),
                (true, false) => rows.outward.push((k, j, -quad.rho)),
                (false, true) => rows.outward.push((l, i, -quad.rho)),
                (false, false) => {}
            }
        }
        rows.outward.sort_unstable_by_key(|&(k, i, _)| (k, i));
        rows
    }

    /// `out = L_BB b`
    pub fn along(&self, b: &[Complex64], out: &mut [Complex64]) {
        for ((out, d), b) in out.iter_mut().zip(&self.diagonal).zip(b) {
            *out = d * b;
        }
        for &(k, l, value) in &self.pairs {
            out[k as usize] += value * b[l as usize];
            out[l as usize] += value * b[k as usize];
        }
    }

    /// `y += L_IB b`
    pub fn inward(&self, b: &[Complex64], y: &mut [Complex64]) {
        for &(k, i, value) in &self.outward {
            y[i as usize] += value * b[k as usize];
        }
    }

    /// `out −= L_BI y`
    pub fn subtract_outward(&self, y: &[Complex64], out: &mut [Complex64]) {
        for &(k, i, value) in &self.outward {
            out[k as usize] -= value * y[i as usize];
        }
    }
}
