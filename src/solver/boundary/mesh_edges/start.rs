//! Where the free map begins: how the boundary of a conformal map turns.

use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use std::f64::consts::TAU;

use super::mismatch::Mismatch;
use super::state::State;
use super::{Keep, MeshEdgeProblem};

/// A start after Sawhney and Crane (Boundary First Flattening, 2017): the curvature inside is moved to the boundary, as the conformal
/// map that scales nothing there does it; for lengths that are not those at rest `∂u/∂n` is added (Cherrier's formula), u the
/// harmonic function that is ln (length / length at rest) on the boundary. That tells how loops turn; holes get the
/// scale with which they turn by −2π, and the rotation that fits white to black best.
pub(super) fn start(problem: &MeshEdgeProblem, mismatch: &mut Mismatch) -> Option<State> {
    let MeshEdgeProblem { laplacian, layout, keep, .. } = *problem;
    let loops = laplacian.loops();
    let mut turning = turning(problem);
    let scales = close_turning(problem, mismatch, &mut turning);
    let mut logs = vec![Complex64::ZERO; laplacian.len()];
    for (c, range) in loops.iter().enumerate() {
        let scale = match (c, keep[c]) {
            (1.., Keep::Drawn(_)) => scales[c - 1],
            _ => 0.0,
        };
        let mut angle = 0.0;
        for k in range.clone() {
            angle += turning[k];
            logs[k] = Complex64::new(scale, angle);
        }
    }
    let state = State::new(layout, loops, keep, logs.clone())?;
    if loops.len() == 1 {
        return Some(state);
    }
    for (range, z) in loops[1..].iter().zip(mismatch.turn_holes(&state.edges)) {
        logs[range.clone()].iter_mut().for_each(|log| log.im += z.arg());
    }
    State::new(layout, loops, keep, logs)
}

/// How the polygon of black vertices turns at each of them (n).
fn turning(problem: &MeshEdgeProblem) -> Vec<f64> {
    let MeshEdgeProblem { laplacian, curvature, layout, log_factors, .. } = *problem;
    let n = laplacian.len();
    let mut work = laplacian.work();
    let mut turning = layout.turning.clone();
    let sources: Vec<Complex64> =
        laplacian.inner().iter().map(|&v| Complex64::new(curvature[v as usize], 0.0)).collect();
    let mut flux = vec![Complex64::ZERO; n];
    laplacian.outflow(&sources, &mut flux, &mut work);
    turning.iter_mut().zip(&flux).for_each(|(turning, flux)| *turning += flux.re);
    if let Some(log_factors) = log_factors.filter(|u| u.iter().any(|f| *f != u[0])) {
        // The factors of the edges on both sides of a vertex.
        let ahead = |k: usize| log_factors[laplacian.black_index()[k] as usize];
        let mut u = vec![Complex64::ZERO; n];
        for range in laplacian.loops() {
            for k in range.clone() {
                let last = if k == range.start { range.end - 1 } else { k - 1 };
                u[k] = Complex64::new(0.5 * (ahead(last) + ahead(k)), 0.0);
            }
        }
        laplacian.flux(&u, &mut flux, &mut work);
        turning.iter_mut().zip(&flux).for_each(|(turning, flux)| *turning += flux.re);
    }
    turning
}

/// Scales the holes so that each turns by −2π, adds to the turning what that does to it, and returns the logarithms of the scales.
fn close_turning(problem: &MeshEdgeProblem, mismatch: &Mismatch, turning: &mut [f64]) -> Vec<f64> {
    let holes = problem.laplacian.loops().get(1..).unwrap_or_default();
    let flux = &mismatch.hole_flux;
    let m = holes.len();
    if m == 0 {
        return Vec::new();
    }
    let matrix = DMatrix::from_fn(m, m, |c, d| flux[d][holes[c].clone()].iter().map(|f| f.re).sum::<f64>());
    let right = DVector::from_fn(m, |c, _| -TAU - turning[holes[c].clone()].iter().sum::<f64>());
    let Some(scales) = matrix.lu().solve(&right) else { return vec![0.0; m] };
    for (flux, scale) in flux.iter().zip(scales.iter()) {
        turning.iter_mut().zip(flux).for_each(|(turning, f)| *turning += scale * f.re);
    }
    scales.iter().copied().collect()
}
