//! Free maps: H = 0 exactly, boundary edges of given lengths, least mismatch of white against black.
//!
//! Maps with H = 0 are given by the black boundary values b and one number w_0 ([`crate::laplacian`]). Among them, with
//! `e_k = b_{k+1} − b_k` and w the white boundary values, the free map minimises
//!
//! ```text
//! R = Σ_k |w_k − (b_k + κ_k e_k)|² / l_k      subject to |e_k| = l_k
//! ```
//!
//! over b and w_0, where l_k is the length from b_k to b_{k+1} along the surface and κ_k says where w_k lies beside it. The edges are
//! written `e_k = l_k exp(s_k + iθ_k)`: with s = 0 the lengths are kept exactly whatever θ is, and what is left is a
//! least-squares problem in θ without constraints but that every loop closes. Loops whose lengths are *drawn* to l instead have s
//! for unknowns too, and `λ² Σ l_k s_k²` is added to R.
//!
//! Gauss–Newton's method; its linear problems are solved by conjugate gradients on the normal equations with two products with
//! T for each iteration.

mod layout;
mod least_squares;
mod mismatch;
mod precondition;
mod start;
mod state;

pub use layout::Layout;

use num_complex::Complex64;

use super::BoundaryError;
use crate::laplacian::ConformalLaplacian;
use crate::solver::{Iteration, Observer, Status};
use least_squares::{Linearised, norm};
use mismatch::Mismatch;
use state::State;

/// Gauss–Newton steps at most, where nothing else is said.
const MAX_ITERATIONS: usize = 60;
/// Products with the matrix in all. More mean that the boundary is too hard for this method.
const MOST_PRODUCTS: usize = 1500;
/// A gradient of this share of the residual gains nothing more.
const FLAT: f64 = 1e-8;
/// A step is the last one where the linear model says that it lowers the residual by this share of it, ...
const SMALL_GAIN: f64 = 1e-5;
/// ... or by this much, relative to lengths: the step after it would be at rounding.
const TINY_GAIN: f64 = 1e-7;
/// The residual, relative to lengths, at which only rounding is left.
const ROUNDING: f64 = 1e-13;
/// The largest relative change of an edge in one step.
const LONGEST_STEP: f64 = 0.5;
/// Steps shorter than this share of an edge change nothing.
const SHORTEST_STEP: f64 = 1e-12;

/// How the lengths of one boundary loop are kept.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Keep {
    /// Exactly.
    Exactly,
    /// By the term `λ² Σ l_k s_k²`, with this λ.
    Drawn(f64),
}

/// What is asked.
pub struct MeshEdgeProblem<'a> {
    /// The conformal Laplacian of the surface, a triangle mesh: the vertices of the mesh are black.
    pub laplacian: &'a ConformalLaplacian,
    /// What the angles around each vertex lack of 2π, on the boundary of π (`nv`); dual vertices 0.
    pub curvature: &'a [f64],
    /// The black boundary edges.
    pub layout: &'a Layout,
    /// Where lengths are not those at rest: ln (length / length at rest) along the quad graph's boundary (`nb`).
    pub log_factors: Option<&'a [f64]>,
    /// How the lengths of every loop are kept.
    pub keep: &'a [Keep],
    /// Gauss–Newton steps at most.
    pub max_iterations: Option<usize>,
}

/// A free map.
#[derive(Clone, Debug)]
pub struct MeshEdgeMap {
    /// `s_k + iθ_k` of the black boundary edges (n).
    logs: Vec<Complex64>,
    /// Black boundary values (n), up to a rigid motion.
    pub b: Vec<Complex64>,
    /// The mean of w over the first loop.
    pub w_0: Complex64,
    /// `√(R / Σ l)`: how far, in units of their edges, white vertices are from where the black ones want them.
    pub mismatch: f64,
    /// The gradient of the residual's norm, over that norm: the share of it that a step could still gain.
    pub gradient_norm: f64,
    /// Gauss–Newton steps.
    pub iterations: usize,
    /// How it ended: `MaxIterations` also where no step lowers R though its gradient is not 0. (2) and the lengths hold all the same.
    pub status: Status,
}

/// Finds the free map, from the free map `from` of the same surface where there is one.
///
/// # Errors
/// [`BoundaryError::Unsuitable`] where a boundary edge has no length; [`BoundaryError::Stalled`] where the start does not close up.
pub fn mesh_edge_map(
    problem: &MeshEdgeProblem,
    from: Option<&MeshEdgeMap>,
    watch: &mut dyn Observer,
) -> Result<MeshEdgeMap, BoundaryError> {
    let MeshEdgeProblem { laplacian, layout, keep, .. } = *problem;
    if !layout.length.iter().all(|l| *l > 0.0 && l.is_finite()) {
        return Err(BoundaryError::Unsuitable { reason: "a boundary edge has no length" });
    }
    let mut mismatch = Mismatch::new(laplacian, layout)?;
    let begun = match from {
        Some(map) => State::new(layout, laplacian.loops(), keep, map.logs.clone()),
        None => start::start(problem, &mut mismatch),
    };
    let mut state = begun.ok_or(BoundaryError::Stalled { iterations: 0, residual: 1.0 })?;
    let mut linearised = Linearised::new(&mut mismatch, layout, laplacian.loops(), keep);
    let mut residual = linearised.residual(&state);
    let (mut iterations, mut first, mut moved, mut radius) = (0, None, 0.0, LONGEST_STEP);
    let (mut last, mut products) = (false, 0);
    let (status, gradient_norm) = loop {
        linearised.at(&state);
        let gradient = linearised.transposed(&residual);
        let (size, slope) = (norm(&residual), norm(&gradient));
        if !(size.is_finite() && slope.is_finite()) {
            return Err(BoundaryError::Stalled { iterations, residual: size });
        }
        let total = size * size;
        watch.iteration(&Iteration { number: iterations, total, terms: Vec::new(), gradient_norm: slope, step: moved });
        let share = if size > 0.0 { slope / size } else { 0.0 };
        match () {
            () if last || size <= ROUNDING || share <= FLAT => break (Status::Converged, share),
            () if watch.stop_requested() => break (Status::Interrupted, share),
            () if iterations >= problem.max_iterations.unwrap_or(MAX_ITERATIONS) || products > MOST_PRODUCTS => {
                break (Status::MaxIterations, share);
            }
            () => {}
        }
        let forcing = (slope / *first.get_or_insert(slope)).clamp(1e-3, 0.1);
        let step = linearised.solve(&residual, &gradient, forcing, radius);
        products += step.products;
        let is_small = !step.is_cut && step.gain <= (SMALL_GAIN * size).max(TINY_GAIN).powi(2);
        let mut t = 1.0;
        let next = loop {
            if let Some(next) = state.moved(layout, laplacian.loops(), keep, &step.change, t) {
                let there = linearised.residual(&next);
                let gained = total - norm(&there).powi(2);
                if gained >= 1e-4 * t * step.gain {
                    break Some((next, there, gained / step.gain));
                }
            }
            t *= 0.5;
            if t * step.largest < SHORTEST_STEP {
                break None;
            }
        };
        let Some((next, there, ratio)) = next else {
            break (if is_small { Status::Precision } else { Status::MaxIterations }, share);
        };
        (state, residual) = (next, there);
        moved = t * step.largest;
        last = is_small;
        radius = match ratio {
            r if r < 0.25 => 0.5 * moved.min(radius),
            r if r > 0.75 => LONGEST_STEP.min(2.0 * radius),
            _ => radius,
        };
        iterations += 1;
    };
    drop(linearised);
    let (b, w_0) = mismatch.boundary(&state.edges);
    Ok(MeshEdgeMap { logs: state.logs, b, w_0, mismatch: norm(&residual), gradient_norm, iterations, status })
}
