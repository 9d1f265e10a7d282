//! C and L' with integral weights, of a map alone.

use num_complex::Complex64;
use std::f64::consts::TAU;

use crate::constraint::Fixed;
use crate::quad_graph::QuadGraph;

/// L'; of maps by the reduction it is rounding.
pub(super) fn length_energy(graph: &QuadGraph, z: &[Complex64]) -> f64 {
    let n = graph.boundary.len();
    let at = |k: usize| z[graph.boundary[k % n] as usize];
    let terms = graph.boundary_length.iter().enumerate();
    let sum: f64 = terms.map(|(k, l)| l * ((at(k + 1) - at(k)).norm_sqr() / (l * l) - 1.0).powi(2)).sum();
    sum * graph.perimeter() / TAU
}

/// C; where the boundary is on the circle it is rounding.
pub(super) fn circle_energy(graph: &QuadGraph, fixed: &Fixed, z: &[Complex64]) -> f64 {
    let n = graph.boundary.len();
    let free = (0..n).filter(|&k| !fixed.holds(graph.boundary[k]));
    let terms = free.map(|k| {
        let length = 0.5 * (graph.boundary_length[k] + graph.boundary_length[(k + n - 1) % n]);
        length * (z[graph.boundary[k] as usize].norm_sqr() - 1.0).powi(2)
    });
    terms.sum::<f64>() * TAU / graph.perimeter()
}
