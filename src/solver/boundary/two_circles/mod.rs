//! Circle maps with H = 0: black and white boundary points on two concentric circles.
//!
//! Unknowns are the black boundary values b (n), the mean w_0 of the white ones, and one real number ε. With three boundary
//! points p at given angles α_p there are as many equations as unknowns, 2n + 3:
//!
//! ```text
//! |b_k|² = 1 + ε      |w_k|² = 1 − ε      arg z_p = α_p
//! ```
//!
//! # Rationale
//! In the smooth limit the boundary values of maps with H = 0 are `p + q̄` on black and `p − q̄` on white vertices, p and q
//! holomorphic. Linearised at the identity, the two circles ask for `Re(z̄ p)` and `Re(z q)`. The first has a kernel of
//! dimension three, the Möbius maps of the disc, which the three points take. The second has none, and its values have mean 0:
//! a cokernel of dimension one, which ε takes. Two points without ε would leave one of each.

mod riemann_hilbert;
mod singular_values;
mod start;

pub use singular_values::{Linearised, singular_values};

use std::f64::consts::TAU;

use num_complex::Complex64;

use super::gmres::gmres;
use super::norm::norm;
use crate::laplacian::{ConformalLaplacian, Work};
use crate::quad_graph::QuadGraph;
use crate::solver::{Iteration, Observer, Status, StopRule};
use riemann_hilbert::RiemannHilbert;
pub use start::centred_pins;
use start::start_angles;

/// Newton steps, unless the caller says otherwise.
const MAX_ITERATIONS: usize = 60;

/// Products with T in one Newton step.
const MAX_PRODUCTS: usize = 100;

/// The residual that Newton's method goes on to, since the step that reaches it costs little. Errors of solves with the factor
/// of L_II are about 1e-13 relative to the map on 10⁶ vertices.
const TARGET: f64 = 1e-13;

/// A residual that cannot be brought down further counts as rounding below this.
const ROUNDING: f64 = 1e-9;

/// Halvings of a step before the search along it ends.
const HALVINGS: usize = 20;

/// A boundary point at a given angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CirclePin {
    /// Its position in [`QuadGraph::boundary`].
    pub position: usize,
    /// Its angle.
    pub angle: f64,
}

/// The map on the boundary, and how it was found.
#[derive(Clone, Debug)]
pub struct TwoCircleMap {
    /// The black boundary values (n), `|b_k|² = 1 + ε`.
    pub b: Vec<Complex64>,
    /// The mean of the white boundary values.
    pub w_0: Complex64,
    /// Half the difference of the squared radii.
    pub epsilon: f64,
    /// The three points that were fixed, by position in [`QuadGraph::boundary`].
    pub pins: Vec<CirclePin>,
    /// The largest residual of the equations.
    pub residual: f64,
    /// Newton steps.
    pub iterations: usize,
    /// Products with T.
    pub products: usize,
    /// How it ended.
    pub status: Status,
}

/// The map was not found.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TwoCirclesError {
    /// A number of pins that the equations cannot meet.
    #[error("{pins} boundary points are pinned; the two circles leave room for one, two or three")]
    Pins {
        /// Their number.
        pins: usize,
    },
    /// The surface has several boundary loops, or none.
    #[error("the surface has {loops} boundary loops; the two circles are those of one")]
    Loops {
        /// Their number.
        loops: usize,
    },
    /// No further progress short of rounding.
    #[error("Newton's method for the two circles stalled after {iterations} steps with a residual of {residual:.1e}")]
    Stalled {
        /// Newton steps.
        iterations: usize,
        /// The largest residual.
        residual: f64,
    },
}

/// Computes the map with H = 0 whose black and white boundary points lie on two concentric circles, by Newton's method with
/// GMRES from the Green's function start. Fewer than three pins are completed by points at the angles of arc length.
///
/// # Errors
/// [`TwoCirclesError`]
pub fn two_circle_map(
    laplacian: &ConformalLaplacian,
    graph: &QuadGraph,
    pins: &[CirclePin],
    rule: StopRule,
    watch: &mut dyn Observer,
) -> Result<TwoCircleMap, TwoCirclesError> {
    let mut work = laplacian.work();
    let system = System::new(laplacian, graph, pins)?;
    let theta = start_angles(laplacian, graph, &system.boundary_index, &system.anchors, &mut work);
    let mut newton =
        Newton { system, work, iterations: 0, products: 0, has_dual_points: graph.primal < graph.vertices };
    let mut state = newton.start(&theta);
    let max_iterations = rule.max_iterations.unwrap_or(MAX_ITERATIONS);
    let status = loop {
        newton.announce(&state, watch);
        if state.largest() <= TARGET {
            break Status::Converged;
        }
        if watch.stop_requested() {
            break Status::Interrupted;
        }
        if newton.iterations >= max_iterations {
            break Status::MaxIterations;
        }
        match newton.step(&state) {
            Some(next) => state = next,
            None => break Status::Precision,
        }
        newton.iterations += 1;
    };
    let residual = state.largest();
    let stalled = match status {
        Status::Precision => residual > ROUNDING.max(rule.tolerance),
        Status::MaxIterations => rule.max_iterations.is_none(),
        Status::Converged | Status::Interrupted => false,
    };
    if stalled {
        return Err(TwoCirclesError::Stalled { iterations: newton.iterations, residual });
    }
    let status = if residual <= ROUNDING.max(rule.tolerance) { Status::Converged } else { status };
    let n = laplacian.len();
    Ok(TwoCircleMap {
        b: (0..n).map(|k| state.z[2 * k]).collect(),
        w_0: (0..n).map(|k| state.z[2 * k + 1]).sum::<Complex64>() / n as f64,
        epsilon: state.epsilon,
        pins: newton.system.pins(),
        residual,
        iterations: newton.iterations,
        products: newton.products,
        status,
    })
}

/// The equations, in the order of the boundary: black and white points alternate.
pub(super) struct System<'a> {
    laplacian: &'a ConformalLaplacian,
    /// Pinned points: positions among the 2n interleaved points, and angles.
    anchors: Vec<(usize, f64)>,
    /// For each of the 2n points its position in [`QuadGraph::boundary`].
    boundary_index: Vec<u32>,
    /// The weights of C (2n), 0 at pins that were asked for.
    weight: Vec<f64>,
}

/// Boundary values and their residuals.
pub(super) struct State {
    /// b_0, w_0, b_1, w_1, … (2n)
    z: Vec<Complex64>,
    epsilon: f64,
    /// `(|z|² − 1 ∓ ε)/2`, then `Im(e^{−iα} z_p)`.
    residual: Vec<f64>,
    /// The Euclidean norm of the step that led here.
    step: f64,
}

impl State {
    fn largest(&self) -> f64 {
        // A NaN must not be passed over.
        self.residual.iter().fold(0.0, |worst, r| if r.abs() <= worst { worst } else { r.abs() })
    }
}

/// A change of the unknowns, and of the white values that follows from it.
struct Step {
    /// (2n)
    z: Vec<Complex64>,
    epsilon: f64,
}

/// +1 for black, −1 for white points.
fn sign(v: usize) -> f64 {
    if v.is_multiple_of(2) { 1.0 } else { -1.0 }
}

impl<'a> System<'a> {
    fn new(laplacian: &'a ConformalLaplacian, graph: &QuadGraph, pins: &[CirclePin]) -> Result<Self, TwoCirclesError> {
        if laplacian.loops().len() != 1 {
            return Err(TwoCirclesError::Loops { loops: laplacian.loops().len() });
        }
        if pins.is_empty() || pins.len() > 3 {
            return Err(TwoCirclesError::Pins { pins: pins.len() });
        }
        let mut system = System::at(laplacian, graph, pins);
        system.anchors = start::three_anchors(graph, &system.boundary_index, &system.anchors);
        Ok(system)
    }

    /// With these pins and no others.
    fn at(laplacian: &'a ConformalLaplacian, graph: &QuadGraph, pins: &[CirclePin]) -> Self {
        let pairs = laplacian.black_index().iter().zip(laplacian.white_index());
        let boundary_index: Vec<u32> = pairs.flat_map(|(&black, &white)| [black, white]).collect();
        let mut place = vec![0; graph.boundary.len()];
        boundary_index.iter().enumerate().for_each(|(v, &k)| place[k as usize] = v);
        let mut anchors: Vec<(usize, f64)> = pins.iter().map(|pin| (place[pin.position], pin.angle)).collect();
        anchors.sort_unstable_by_key(|&(v, _)| v);
        // The last white point may be first in the boundary.
        for p in 1..anchors.len() {
            if anchors[p].1 <= anchors[p - 1].1 {
                anchors[p].1 += TAU;
            }
        }
        let nb = graph.boundary.len();
        let length = |k: usize| 0.5 * (graph.boundary_length[k] + graph.boundary_length[(k + nb - 1) % nb]);
        let scale = TAU / graph.perimeter();
        let mut weight: Vec<f64> = boundary_index.iter().map(|&k| scale * length(k as usize)).collect();
        anchors.iter().for_each(|&(v, _)| weight[v] = 0.0);
        System { laplacian, anchors, boundary_index, weight }
    }

    fn pins(&self) -> Vec<CirclePin> {
        let pin = |&(v, angle): &(usize, f64)| CirclePin { position: self.boundary_index[v] as usize, angle };
        self.anchors.iter().map(pin).collect()
    }

    fn residual(&self, z: &[Complex64], epsilon: f64) -> Vec<f64> {
        let circles = z.iter().enumerate().map(|(v, z)| 0.5 * (z.norm_sqr() - 1.0 - sign(v) * epsilon));
        let pins = self.anchors.iter().map(|&(v, angle)| (Complex64::cis(-angle) * z[v]).im);
        circles.chain(pins).collect()
    }

    /// C of boundary values divided by `scale`.
    fn circle_energy(&self, z: &[Complex64], scale: f64) -> f64 {
        let square = |z: &Complex64| z.norm_sqr() / (scale * scale) - 1.0;
        self.weight.iter().zip(z).map(|(weight, z)| weight * square(z).powi(2)).sum()
    }

    /// The derivative of the residual along a step.
    fn derivative(&self, z: &[Complex64], step: &Step) -> Vec<f64> {
        let points = z.iter().zip(&step.z).enumerate();
        let circles = points.map(|(v, (z, dz))| (z.conj() * dz).re - 0.5 * sign(v) * step.epsilon);
        let pins = self.anchors.iter().map(|&(v, angle)| (Complex64::cis(-angle) * step.z[v]).im);
        circles.chain(pins).collect()
    }

    /// Replaces the white values of z by those that belong to the black ones, their mean kept. One product with T.
    fn complete(&self, z: &mut [Complex64], work: &mut Work) {
        let n = self.laplacian.len();
        let b: Vec<Complex64> = z.iter().step_by(2).copied().collect();
        let w_0 = z.iter().skip(1).step_by(2).sum::<Complex64>() / n as f64;
        let (mut flux, mut w) = (vec![Complex64::ZERO; n], vec![Complex64::ZERO; n]);
        self.laplacian.flux(&b, &mut flux, work);
        self.laplacian.white(&b, &flux, w_0, &mut w);
        for (k, w) in w.into_iter().enumerate() {
            z[2 * k + 1] = w;
        }
    }
}

struct Newton<'a> {
    system: System<'a>,
    work: Work,
    iterations: usize,
    products: usize,
    has_dual_points: bool,
}

impl Newton<'_> {
    fn start(&mut self, theta: &[f64]) -> State {
        let mut z: Vec<Complex64> = theta.iter().map(|&angle| Complex64::cis(angle)).collect();
        self.products += 1;
        self.system.complete(&mut z, &mut self.work);
        let residual = self.system.residual(&z, 0.0);
        State { z, epsilon: 0.0, residual, step: 0.0 }
    }

    fn announce(&self, state: &State, watch: &mut dyn Observer) {
        // The energy of the map as it would be returned; H is 0.
        let scale = if self.has_dual_points { (1.0 + state.epsilon).sqrt() } else { 1.0 };
        let total = self.system.circle_energy(&state.z, scale);
        let terms = if watch.wants_terms() { vec![("H", 0.0), ("C", total)] } else { Vec::new() };
        let (number, gradient_norm) = (self.iterations, norm(&state.residual));
        watch.iteration(&Iteration { number, total, terms, gradient_norm, step: state.step });
    }

    /// One Newton step, shortened until the residual falls; `None` where no part of it does that.
    fn step(&mut self, state: &State) -> Option<State> {
        let Newton { system, work, products, .. } = self;
        let hilbert = RiemannHilbert::new(&state.z, &system.anchors)?;
        let mut correction = |q: &[f64]| {
            let mut step = hilbert.solve(q);
            *products += 1;
            system.complete(&mut step.z, work);
            step
        };
        let size = norm(&state.residual);
        let right: Vec<f64> = state.residual.iter().map(|r| -r).collect();
        let forcing = size.clamp(1e-3, 0.1);
        let apply = |q: &[f64]| system.derivative(&state.z, &correction(q));
        let (q, _, _) = gmres(apply, &right, forcing, MAX_PRODUCTS);
        let step = correction(&q);
        let mut t = 1.0;
        for _ in 0..HALVINGS {
            let z: Vec<Complex64> = state.z.iter().zip(&step.z).map(|(z, dz)| z + t * dz).collect();
            let epsilon = state.epsilon + t * step.epsilon;
            let residual = system.residual(&z, epsilon);
            if norm(&residual) < (1.0 - 1e-4 * t) * size {
                let length = t * step.z.iter().map(|dz| dz.norm_sqr()).sum::<f64>().sqrt();
                return Some(State { z, epsilon, residual, step: length });
            }
            t *= 0.5;
        }
        None
    }
}
