use std::f64::consts::TAU;

use num_complex::Complex64;

use super::{Fixed, Line};
use crate::quad_graph::QuadGraph;
use crate::sparse::dissect;

/// Below this number of unknowns they are eliminated by minimum degree.
const DISSECTED: usize = 100_000;

/// The real unknowns y of a map, `x = x(y)`.
///
/// A free vertex has both coordinates as unknowns, a vertex on a line its position along the line,
/// a vertex on the unit circle its angle, and a pinned vertex none. Without angles x is affine: `x
/// = Z y + x0`.
#[derive(Clone, Debug, PartialEq)]
pub struct Freedoms {
    /// The first unknown of each vertex in y (`nv + 1`).
    pub offset: Vec<u32>,
    /// The vertices with unknowns in the order in which a factor eliminates them; if empty, minimum
    /// degree is used.
    pub elimination: Vec<u32>,
    /// The vertices on lines, ascending.
    lines: Vec<(u32, Line)>,
    /// The pinned values; 0 elsewhere (`nv`).
    z0: Vec<Complex64>,
    /// The vertices on the unit circle, in order; if some are pinned, the list begins with one of
    /// these.
    circle: Vec<Sliding>,
}

/// A vertex on the unit circle.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Sliding {
    vertex: u32,
    /// The angle if the vertex is pinned; ascending along the circle.
    held: Option<f64>,
}

impl Freedoms {
    /// Returns the freedoms that `fixed` leaves to a map of `vertices` vertices.
    pub fn new(vertices: usize, fixed: &Fixed) -> Self {
        Self::sliding(vertices, fixed, &[])
    }

    /// As [`Freedoms::new`], but the vertices of `boundary` that are not pinned slide along the
    /// unit circle and keep their order.
    pub fn sliding(vertices: usize, fixed: &Fixed, boundary: &[u32]) -> Self {
        let mut slides = vec![false; vertices];
        for &v in boundary {
            slides[v as usize] = true;
        }
        let mut offset = Vec::with_capacity(vertices + 1);
        let mut z0 = vec![Complex64::ZERO; vertices];
        let mut lines = Vec::new();
        let mut next = 0;
        for v in 0..vertices as u32 {
            offset.push(next);
            match (fixed.place(v), fixed.line(v)) {
                (Some(place), _) => z0[v as usize] = place,
                (None, _) if slides[v as usize] => next += 1,
                (None, Some(line)) => {
                    lines.push((v, line));
                    next += 1;
                }
                (None, None) => next += 2,
            }
        }
        offset.push(next);
        let first = boundary.iter().position(|&v| fixed.holds(v)).unwrap_or(0);
        let mut last: Option<f64> = None;
        let in_order = boundary[first..].iter().chain(&boundary[..first]).map(|&vertex| {
            let held = fixed.place(vertex).map(|place| ahead_of(last, place));
            last = held.or(last);
            Sliding { vertex, held }
        });
        let circle = in_order.collect();
        Freedoms { offset, elimination: Vec::new(), lines, z0, circle }
    }

    /// As [`Freedoms::new`], for factors of Hessians that couple the vertices of each quad: large
    /// ones are ordered by nested dissection ([`dissect`]).
    pub fn for_factor(graph: &QuadGraph, fixed: &Fixed) -> Self {
        let mut freedoms = Freedoms::new(graph.vertices, fixed);
        if freedoms.unknowns() >= DISSECTED {
            freedoms.elimination = dissect(&graph.quads, &graph.places, |v| freedoms.width(v as usize) > 0);
        }
        freedoms
    }

    /// Number of real unknowns.
    pub fn unknowns(&self) -> usize {
        self.offset[self.offset.len() - 1] as usize
    }

    /// Number of unknowns of vertex `v`: 0, 1 or 2.
    pub fn width(&self, v: usize) -> usize {
        (self.offset[v + 1] - self.offset[v]) as usize
    }

    /// Whether some unknowns are angles, so that x is not an affine function of y.
    pub fn slides(&self) -> bool {
        self.angles().next().is_some()
    }

    /// The vertices whose unknown is an angle, each with its position in y.
    pub fn angles(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        let sliding = self.circle.iter().filter(|s| s.held.is_none());
        sliding.map(|s| (s.vertex as usize, self.offset[s.vertex as usize] as usize))
    }

    /// ∂x/∂y at y for the vertices with one unknown; 1 elsewhere (`nv`).
    pub fn directions(&self, y: &[f64]) -> Vec<Complex64> {
        let mut directions = vec![Complex64::ONE; self.z0.len()];
        for &(v, line) in &self.lines {
            directions[v as usize] = line.direction;
        }
        for (v, at) in self.angles() {
            directions[v] = Complex64::I * Complex64::cis(y[at]);
        }
        directions
    }

    /// Returns x(y).
    pub fn expand(&self, y: &[f64]) -> Vec<Complex64> {
        let mut z = self.z0.clone();
        self.write(y, &mut z);
        for &(v, line) in &self.lines {
            z[v as usize] += line.point;
        }
        for (v, at) in self.angles() {
            z[v] = Complex64::cis(y[at]);
        }
        z
    }

    /// Returns (∂x/∂y) p, the derivative of x at y in the direction p.
    pub fn expand_direction(&self, y: &[f64], p: &[f64]) -> Vec<Complex64> {
        let mut z = vec![Complex64::ZERO; self.z0.len()];
        self.write(p, &mut z);
        for (v, at) in self.angles() {
            z[v] = Complex64::I * Complex64::cis(y[at]) * p[at];
        }
        z
    }

    fn write(&self, y: &[f64], z: &mut [Complex64]) {
        for (v, z) in z.iter_mut().enumerate() {
            let at = self.offset[v] as usize;
            if self.width(v) == 2 {
                *z = Complex64::new(y[at], y[at + 1]);
            }
        }
        for &(v, line) in &self.lines {
            z[v as usize] = y[self.offset[v as usize] as usize] * line.direction;
        }
    }

    /// Returns the y closest to a map z. Angles ascend along the circle, by less than 2π in total
    /// if z has them in order.
    pub fn restrict(&self, z: &[Complex64]) -> Vec<f64> {
        let mut y = vec![0.0; self.unknowns()];
        let mut from_point = z.to_vec();
        for &(v, line) in &self.lines {
            from_point[v as usize] -= line.point;
        }
        self.project(&from_point, &mut y);
        let mut last = None;
        for s in &self.circle {
            let angle = s.held.unwrap_or_else(|| ahead_of(last, z[s.vertex as usize]));
            if s.held.is_none() {
                y[self.offset[s.vertex as usize] as usize] = angle;
            }
            last = Some(angle);
        }
        y
    }

    /// Returns (∂x/∂y)ᵀ g, the gradient with respect to y at y; g = ∂/∂Re z + i ∂/∂Im z is the one
    /// with respect to x.
    pub fn restrict_gradient(&self, y: &[f64], g: &[Complex64]) -> Vec<f64> {
        let mut gradient = vec![0.0; self.unknowns()];
        self.project(g, &mut gradient);
        for (v, at) in self.angles() {
            gradient[at] = ((Complex64::I * Complex64::cis(y[at])).conj() * g[v]).re;
        }
        gradient
    }

    /// Computes Zᵀ g, except for angles.
    fn project(&self, g: &[Complex64], y: &mut [f64]) {
        for (v, g) in g.iter().enumerate() {
            let at = self.offset[v] as usize;
            if self.width(v) == 2 {
                (y[at], y[at + 1]) = (g.re, g.im);
            }
        }
        for &(v, line) in &self.lines {
            y[self.offset[v as usize] as usize] = (line.direction.conj() * g[v as usize]).re;
        }
    }

    /// Whether the vertices on the circle are in order, each ahead of the previous one.
    pub fn is_in_order(&self, y: &[f64]) -> bool {
        self.gaps(y).all(|gap| gap > 0.0)
    }

    /// The largest step from y along p before a vertex on the circle meets the next; +∞ if none
    /// does.
    pub fn largest_step(&self, y: &[f64], p: &[f64]) -> f64 {
        let moves = |k: usize| {
            self.circle[k].held.map_or_else(|| p[self.offset[self.circle[k].vertex as usize] as usize], |_| 0.0)
        };
        let n = self.circle.len();
        let steps = self.gaps(y).enumerate().map(|(k, gap)| {
            let closing = moves(k) - moves((k + 1) % n);
            if closing > 0.0 { gap / closing } else { f64::INFINITY }
        });
        steps.fold(f64::INFINITY, f64::min)
    }

    /// The angles from each vertex on the circle to the next.
    fn gaps<'a>(&'a self, y: &'a [f64]) -> impl Iterator<Item = f64> + 'a {
        let angle =
            |k: usize| self.circle[k].held.unwrap_or_else(|| y[self.offset[self.circle[k].vertex as usize] as usize]);
        let n = self.circle.len();
        (0..n).map(move |k| if k + 1 < n { angle(k + 1) - angle(k) } else { angle(0) + TAU - angle(k) })
    }
}

/// Returns the angle of a point, ahead of the last angle by less than a turn.
fn ahead_of(last: Option<f64>, place: Complex64) -> f64 {
    match last {
        None => place.arg(),
        Some(last) => last + (place * Complex64::cis(-last)).arg().rem_euclid(TAU),
    }
}
