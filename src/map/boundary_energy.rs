//! C and L' with integral weights, of a map that was not found by minimising them.

use num_complex::Complex64;

use crate::constraint::Fixed;
use crate::energy::conformal::Weight;
use crate::energy::{Circle, Energy, Metric};
use crate::quad_graph::QuadGraph;

/// L' of a map; where its boundary edges have their rest lengths, it is rounding.
pub(super) fn length_energy(graph: &QuadGraph, z: &[Complex64]) -> f64 {
    Metric::of_boundary(graph, Weight::Integral).value(z)
}

/// C of a map; where its boundary is on the unit circle, it is rounding.
pub(super) fn circle_energy(graph: &QuadGraph, fixed: &Fixed, z: &[Complex64]) -> f64 {
    Circle::of_free(graph, Weight::Integral, |v| !fixed.holds(v)).value(z)
}
