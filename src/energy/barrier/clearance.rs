use std::f64::consts::TAU;

use num_complex::Complex64;

use super::overlap::{BoundingBox, overlapping};
use super::point_edge::{Nearest, PointEdge, first_contact};
use crate::energy::{Block, Curvature, Energy, Polynomial};
use crate::geometry::polygon::boundary_crossing;
use crate::quad_graph::QuadGraph;
use crate::sparse::Stencils;

/// A barrier that keeps the boundary from meeting itself:
///
/// ```text
/// Σ (r l)² max(0, ε/d − 1)³
/// ```
///
/// The sum is over pairs of a boundary vertex of the mesh and a boundary edge that does not contain
/// it; d is their distance through the exterior of the image. The value is +∞ if the boundary meets
/// itself, by an exact predicate. For each pair ε is a share r of the length of the shortest edge
/// at both, measured in the map for which the barrier is made, and l is the same length at rest:
/// small parts of a map need only small clearance.
///
/// After Smith, Schaefer, *Bijective parameterization with free boundaries* (2015). They use a
/// square instead of the cube, which has no second derivative at ε, a single ε, and also distances
/// through the interior, which triangles keep positive anyway.
///
/// The set of close pairs changes with the map. Value and gradient include all pairs. The Hessian
/// includes those that were closer than 2ε in the map for which the barrier was made, so the
/// barrier must be made anew after some steps. It is not a sum of squares.
pub struct Clearance {
    /// The boundary vertices of the mesh, counter-clockwise; edge k joins vertex k to the next.
    boundary: Vec<u32>,
    /// The clearance of vertices and of edges.
    at_vertex: Vec<Reach>,
    at_edge: Vec<Reach>,
    /// The pairs in the Hessian: positions of a vertex and of an edge.
    pairs: Vec<[usize; 2]>,
    stencils: Stencils,
}

#[derive(Clone, Copy)]
struct Reach {
    epsilon: f64,
    at_rest: f64,
}

impl Reach {
    fn or_less(self, other: Reach) -> Reach {
        Reach { epsilon: self.epsilon.min(other.epsilon), at_rest: self.at_rest.min(other.at_rest) }
    }
}

/// The share of an edge's length that is kept clear.
const SHARE: f64 = 0.25;

/// Pairs closer than this multiple of ε are included in the Hessian.
const SEEN: f64 = 2.0;

/// `max(0, ε/d − 1)³` and its derivatives with respect to d.
struct Barrier {
    value: f64,
    first: f64,
    second: f64,
}

impl Barrier {
    fn new(epsilon: f64, d: f64) -> Self {
        let (q, x) = (epsilon / d, (epsilon / d - 1.0).max(0.0));
        let second = 6.0 * x * (q / d) * (q / d) + 6.0 * x * x * (q / d) / d;
        Barrier { value: x * x * x, first: -3.0 * x * x * q / d, second }
    }
}

impl Clearance {
    /// Makes the barrier for maps near z, whose boundary must be simple and counter-clockwise.
    pub fn new(graph: &QuadGraph, z: &[Complex64]) -> Self {
        let n = graph.boundary.len();
        let mesh: Vec<usize> = (0..n).filter(|&k| !graph.is_dual(graph.boundary[k])).collect();
        let boundary: Vec<u32> = mesh.iter().map(|&k| graph.boundary[k]).collect();
        let edge = |i: usize| {
            let (k, next) = (mesh[i], mesh[(i + 1) % mesh.len()]);
            let steps = (next + n - k - 1) % n + 1;
            let at_rest: f64 = (k..k + steps).map(|k| graph.boundary_length[k % n]).sum();
            let length = (z[graph.boundary[next] as usize] - z[graph.boundary[k] as usize]).norm();
            Reach { epsilon: SHARE * length, at_rest: SHARE * at_rest }
        };
        let at_edge: Vec<Reach> = (0..mesh.len()).map(edge).collect();
        let before = |k: usize| at_edge[(k + mesh.len() - 1) % mesh.len()];
        let at_vertex = (0..mesh.len()).map(|k| at_edge[k].or_less(before(k))).collect();
        let mut clearance =
            Clearance { boundary, at_vertex, at_edge, pairs: Vec::new(), stencils: Stencils::new::<3>(&[]) };
        let mut pairs = Vec::new();
        clearance.near(z, SEEN, &mut |pair, _| pairs.push(pair));
        let corners = |&[v, k]: &[usize; 2]| clearance.corners(v, k).map(|k| clearance.boundary[k]);
        clearance.stencils = Stencils::new(&pairs.iter().map(corners).collect::<Vec<_>>());
        clearance.pairs = pairs;
        clearance
    }

    /// The positions of a vertex and of the ends of an edge.
    fn corners(&self, v: usize, k: usize) -> [usize; 3] {
        [v, k, (k + 1) % self.boundary.len()]
    }

    fn places(&self, z: &[Complex64]) -> Vec<Complex64> {
        self.boundary.iter().map(|&v| z[v as usize]).collect()
    }

    fn reach(&self, [v, k]: [usize; 2]) -> Reach {
        self.at_vertex[v].or_less(self.at_edge[k])
    }

    /// Calls `found` with every pair whose distance through the exterior is less than `times` its
    /// clearance.
    fn near(&self, z: &[Complex64], times: f64, found: &mut dyn FnMut([usize; 2], &PointEdge)) {
        let (at, n) = (self.places(z), self.boundary.len());
        let vertices: Vec<BoundingBox> =
            (0..n).map(|v| BoundingBox::of(&[at[v]]).grown(times * self.at_vertex[v].epsilon)).collect();
        let edges: Vec<BoundingBox> = (0..n).map(|k| BoundingBox::of(&[at[k], at[(k + 1) % n]])).collect();
        overlapping(&vertices, &edges, &mut |v, k| {
            if let Some(place) = self.outside(&at, [v, k])
                && place.distance < times * self.reach([v, k]).epsilon
            {
                found([v, k], &place);
            }
        });
    }

    /// Returns the position of a vertex relative to an edge that does not contain it, if the
    /// nearest point is visible through the exterior.
    fn outside(&self, at: &[Complex64], [v, k]: [usize; 2]) -> Option<PointEdge> {
        let n = self.boundary.len();
        let [v, a, b] = self.corners(v, k);
        if v == a || v == b {
            return None;
        }
        let place = PointEdge::new([at[v], at[a], at[b]]);
        let sees = |corner: usize| {
            let [before, after] = [(corner + n - 1) % n, (corner + 1) % n];
            let from_next = |d: Complex64| (d / (at[after] - at[corner])).arg().rem_euclid(TAU);
            // The nearest point to a neighbour of a corner is never that corner.
            v != before && v != after && from_next(place.direction()) > from_next(at[before] - at[corner])
        };
        let is_outside = match place.nearest {
            Nearest::Between(_) => place.is_right(),
            Nearest::First => sees(a),
            Nearest::Second => sees(b),
        };
        is_outside.then_some(place)
    }
}

impl Energy for Clearance {
    fn name(&self) -> &'static str {
        "clearance"
    }

    fn value(&self, z: &[Complex64]) -> f64 {
        if boundary_crossing(&self.places(z)).is_some() {
            return f64::INFINITY;
        }
        let mut sum = 0.0;
        self.near(z, 1.0, &mut |pair, place| {
            let Reach { epsilon, at_rest } = self.reach(pair);
            sum += at_rest * at_rest * Barrier::new(epsilon, place.distance).value;
        });
        if sum.is_nan() { f64::INFINITY } else { sum }
    }

    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]) {
        self.near(z, 1.0, &mut |pair, place| {
            let Reach { epsilon, at_rest } = self.reach(pair);
            let slope = t * at_rest * at_rest * Barrier::new(epsilon, place.distance).first;
            for (corner, along) in self.corners(pair[0], pair[1]).into_iter().zip(place.gradient()) {
                gradient[self.boundary[corner] as usize] += slope * along;
            }
        });
    }

    fn add_bending(&self, _t: f64, _z: &[Complex64], _d: &[Complex64], _gradient: &mut [Complex64]) {}

    fn stencils(&self) -> Stencils {
        self.stencils.clone()
    }

    /// The second derivatives `b″ ∇d ∇dᵀ + b′ ∇²d`, where b is the barrier of a pair and b′ < 0 <
    /// b″; without the second term they are positive semi-definite.
    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block)) {
        let at = self.places(z);
        for (e, &pair) in self.pairs.iter().enumerate() {
            let mut block = [[0.0; 8]; 8];
            let Reach { epsilon, at_rest } = self.reach(pair);
            if let Some(place) = self.outside(&at, pair).filter(|place| place.distance < epsilon) {
                let barrier = Barrier::new(epsilon, place.distance);
                let [v, a, b] = place.gradient();
                let (g, bend) = ([v.re, v.im, a.re, a.im, b.re, b.im], place.hessian());
                for i in 0..6 {
                    for j in 0..6 {
                        let exact = if curvature == Curvature::Exact { barrier.first * bend[i][j] } else { 0.0 };
                        block[i][j] = at_rest * at_rest * (barrier.second * g[i] * g[j] + exact);
                    }
                }
            }
            add(e, &block);
        }
    }

    fn residual_count(&self) -> usize {
        0
    }

    fn along(&self, _z: &[Complex64], _d: &[Complex64]) -> Option<Polynomial> {
        None
    }

    /// The first contact of a boundary vertex with a boundary edge between z and z + d.
    fn largest_step(&self, z: &[Complex64], d: &[Complex64]) -> f64 {
        let (at, moves, n) = (self.places(z), self.places(d), self.boundary.len());
        let end: Vec<Complex64> = at.iter().zip(&moves).map(|(z, d)| z + d).collect();
        let vertices: Vec<BoundingBox> = (0..n).map(|v| BoundingBox::of(&[at[v], end[v]])).collect();
        let swept = |k: usize| BoundingBox::of(&[at[k], at[(k + 1) % n], end[k], end[(k + 1) % n]]);
        let edges: Vec<BoundingBox> = (0..n).map(swept).collect();
        let mut first = f64::INFINITY;
        overlapping(&vertices, &edges, &mut |v, k| {
            let [v, a, b] = self.corners(v, k);
            if v != a && v != b {
                first = first.min(first_contact([v, a, b].map(|k| at[k]), [v, a, b].map(|k| moves[k])));
            }
        });
        first
    }
}
