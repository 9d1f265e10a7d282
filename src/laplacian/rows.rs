//! The rows of L at the boundary: L_BB and L_BI.

use num_complex::Complex64;

use super::Colouring;
use super::matrix::Numbering;
use crate::quad_graph::QuadGraph;

/// The entries of L_BB and L_BI; an entry can be split into several terms.
#[derive(Debug)]
pub(super) struct BoundaryRows {
    /// The diagonal of L_BB (n).
    diagonal: Vec<Complex64>,
    /// Pairs of boundary positions coupled by a quad: (k, l, −ρ) for the entries (k, l) and (l, k).
    pairs: Vec<(u32, u32, Complex64)>,
    /// Entries of L_BI: (boundary position, inner number, −ρ).
    outward: Vec<(u32, u32, Complex64)>,
}

impl BoundaryRows {
    pub fn new(graph: &QuadGraph, colouring: &Colouring, numbering: &Numbering, boundary: usize) -> Self {
        let mut rows =
            BoundaryRows { diagonal: vec![Complex64::ZERO; boundary], pairs: Vec::new(), outward: Vec::new() };
        for quad in colouring.quads(graph) {
            match quad.black.map(|v| numbering.position(v)) {
                [None, None] => {}
                [Some(k), Some(l)] => {
                    rows.diagonal[k] += quad.rho;
                    rows.diagonal[l] += quad.rho;
                    rows.pairs.push((k as u32, l as u32, -quad.rho));
                }
                [Some(k), None] => rows.add_outward(k, numbering.of_vertex[quad.black[1] as usize], quad.rho),
                [None, Some(k)] => rows.add_outward(k, numbering.of_vertex[quad.black[0] as usize], quad.rho),
            }
        }
        rows.outward.sort_unstable_by_key(|&(k, i, _)| (k, i));
        rows
    }

    fn add_outward(&mut self, position: usize, inner: u32, rho: Complex64) {
        self.diagonal[position] += rho;
        self.outward.push((position as u32, inner, -rho));
    }

    /// The inner numbers that are coupled to the boundary, possibly repeated.
    pub fn ports(&self) -> impl Iterator<Item = u32> {
        self.outward.iter().map(|&(_, inner, _)| inner)
    }

    /// Computes `out = L_BB b`.
    pub fn along(&self, b: &[Complex64], out: &mut [Complex64]) {
        for ((out, d), b) in out.iter_mut().zip(&self.diagonal).zip(b) {
            *out = d * b;
        }
        for &(k, l, value) in &self.pairs {
            out[k as usize] += value * b[l as usize];
            out[l as usize] += value * b[k as usize];
        }
    }

    /// Computes `y += L_IB b`.
    pub fn inward(&self, b: &[Complex64], y: &mut [Complex64]) {
        for &(k, i, value) in &self.outward {
            y[i as usize] += value * b[k as usize];
        }
    }

    /// Computes `out −= L_BI y`.
    pub fn subtract_outward(&self, y: &[Complex64], out: &mut [Complex64]) {
        for &(k, i, value) in &self.outward {
            out[k as usize] -= value * y[i as usize];
        }
    }
}
