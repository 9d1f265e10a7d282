//! A boundary that closes up smoothly: what the free map starts from.

use num_complex::Complex64;

use super::conjugate::project;
use super::{FreeProblem, Reduction};
use crate::quad_graph::QuadGraph;

/// A start for the free map, after Sawhney and Crane (Boundary First Flattening, 2017): the curvature of the inside is moved to
/// the boundary, as a conformal map of the lowest scaling there does it, which tells how the boundary turns; edges keep
/// the lengths asked for but for what closes the polygon; then the projection to ker M.
///
pub(super) fn start(problem: &FreeProblem) -> Vec<Complex64> {
    let FreeProblem { reduction, curvature, lengths, log_factors, .. } = *problem;
    let mut turning = turning(reduction, curvature);
    if let Some(log_factors) = log_factors {
        add_normal_derivative(reduction, log_factors, &mut turning);
    }
    let n = turning.len();
    let mut angle = 0.0;
    let directions: Vec<Complex64> = (0..n)
        .map(|k| {
            // The edge from k leaves in the direction that vertex k turns to.
            angle += turning[k];
            Complex64::cis(angle)
        })
        .collect();
    let lengths = closed(lengths, &directions);
    let mut z = Vec::with_capacity(n);
    let mut place = Complex64::ZERO;
    for k in 0..n {
        z.push(place);
        place += lengths[k] * directions[k];
    }
    project(reduction, &z)
}

/// `κ + f / 2` at every boundary vertex, f the flux of the curvature inside. H sees each colour for itself: each carries all
/// of it, its own and what it takes over from its neighbours of the other.
fn turning(reduction: &Reduction, curvature: &[f64]) -> Vec<f64> {
    let graph = reduction.graph;
    let inside = |v: usize| reduction.is_inside(v as u32);
    let mut doubled: Vec<f64> =
        curvature.iter().enumerate().map(|(v, &omega)| if inside(v) { omega } else { 0.0 }).collect();
    // Inside, every neighbour is the next vertex in one quad.
    let degrees = next_counts(graph);
    for quad in &graph.quads {
        for k in 0..4 {
            let (v, w) = (quad[k] as usize, quad[(k + 1) % 4] as usize);
            if inside(v) {
                doubled[w] += curvature[v] / f64::from(degrees[v]);
            }
        }
    }
    let flux = reduction.whole_flux(&doubled);
    graph.boundary.iter().zip(flux).map(|(&v, f)| curvature[v as usize] + 0.5 * f).collect()
}

/// Adds to the turning `∂u/∂n ds = 2 S u`, u the harmonic function that is `ln |z'|` on the boundary, for the curvature of the
/// boundary under the metric `|z'|²` (Sawhney and Crane, Cherrier's formula). Equal factors turn nothing.
fn add_normal_derivative(reduction: &Reduction, log_factors: &[f64], turning: &mut [f64]) {
    let n = log_factors.len();
    if log_factors.iter().all(|u| *u == log_factors[0]) {
        return;
    }
    let mean = |v: usize| Complex64::new(0.5 * (log_factors[(v + n - 1) % n] + log_factors[v]), 0.0);
    let flux = reduction.s(&(0..n).map(mean).collect::<Vec<_>>());
    turning.iter_mut().zip(flux).for_each(|(turning, flux)| *turning += 2.0 * flux.re);
}

/// The number of quads around each vertex.
fn next_counts(graph: &QuadGraph) -> Vec<u32> {
    let mut counts = vec![0; graph.vertices];
    for &v in graph.quads.iter().flatten() {
        counts[v as usize] += 1;
    }
    counts
}

/// The lengths nearest to these, `Σ (l' − l)² / l` the least, with which edges of these directions close up.
fn closed(lengths: &[f64], directions: &[Complex64]) -> Vec<f64> {
    let (mut gap, mut matrix) = (Complex64::ZERO, [0.0; 3]);
    for (&l, d) in lengths.iter().zip(directions) {
        gap += l * d;
        matrix = [matrix[0] + l * d.re * d.re, matrix[1] + l * d.re * d.im, matrix[2] + l * d.im * d.im];
    }
    let [p, q, r] = matrix;
    let determinant = p * r - q * q;
    let pull = Complex64::new(r * gap.re - q * gap.im, p * gap.im - q * gap.re) / determinant;
    if !pull.is_finite() {
        return lengths.to_vec();
    }
    let share = |d: &Complex64| 1.0 - (d.re * pull.re + d.im * pull.im);
    lengths.iter().zip(directions).map(|(l, d)| l * share(d)).collect()
}
