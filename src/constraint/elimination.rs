use num_complex::Complex64;

use super::Fixed;
use crate::quad_graph::QuadGraph;
use crate::sparse::{Order, dissect};

/// Below this number of unknowns they are numbered by ascending vertices and eliminated by minimum
/// degree; above, computing that order begins to cost more than the factor.
const DISSECTED: usize = 150_000;

/// Above this number of unknowns dissection is always used: minimum degree, which looks only at
/// neighbours, then gives much more fill.
const ALWAYS_DISSECTED: usize = 3_000_000;

/// A mesh counts as numbered row by row if the indices of a quad's vertices differ, on average, by
/// at most this multiple of √nv. On such meshes minimum degree finds an order that is as good in
/// less time.
const ROWS: f64 = 4.0;

/// The elimination of pinned vertices: `z = Z y + z0`, where y are the values of the free vertices
/// and z0 has the pinned values and is 0 elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Elimination {
    /// The vertex of each unknown (`m`).
    pub free: Vec<u32>,
    /// The unknown of each vertex (`nv`), or [`Elimination::HELD`].
    pub unknown: Vec<u32>,
    /// The pinned values, 0 at free vertices (`nv`).
    pub z0: Vec<Complex64>,
    /// The order in which a Cholesky factor eliminates the unknowns.
    pub order: Order,
}

impl Elimination {
    /// Marks a pinned vertex, which is not an unknown.
    pub const HELD: u32 = u32::MAX;

    /// Eliminates the pinned vertices from a graph of `vertices` vertices. The unknowns are
    /// numbered by ascending vertices.
    pub fn new(vertices: usize, fixed: &Fixed) -> Self {
        let mut z0 = vec![Complex64::ZERO; vertices];
        let mut unknown = vec![0; vertices];
        for (v, place) in fixed.iter() {
            z0[v as usize] = place;
            unknown[v as usize] = Self::HELD;
        }
        let free: Vec<u32> = (0..vertices as u32).filter(|&v| unknown[v as usize] != Self::HELD).collect();
        for (k, &v) in free.iter().enumerate() {
            unknown[v as usize] = k as u32;
        }
        Elimination { free, unknown, z0, order: Order::Amd }
    }

    /// Eliminates the pinned vertices for factors of matrices that couple the vertices of each
    /// quad.
    ///
    /// Large numbers of unknowns are ordered by nested dissection ([`dissect`]), unless the mesh is
    /// numbered row by row.
    pub fn for_factor(graph: &QuadGraph, fixed: &Fixed) -> Self {
        let mut elimination = Elimination::new(graph.vertices, fixed);
        let unknowns = elimination.unknowns();
        if unknowns >= ALWAYS_DISSECTED || unknowns >= DISSECTED && !is_row_by_row(graph) {
            elimination.free = dissect(&graph.quads, &graph.places, |v| elimination.is_free(v));
            elimination.order = Order::AsGiven;
            for (k, &v) in elimination.free.iter().enumerate() {
                elimination.unknown[v as usize] = k as u32;
            }
        }
        elimination
    }

    /// Number of complex unknowns.
    pub fn unknowns(&self) -> usize {
        self.free.len()
    }

    /// Whether vertex `v` is an unknown.
    pub fn is_free(&self, v: u32) -> bool {
        self.unknown[v as usize] != Self::HELD
    }

    /// Returns z = Z y + z0.
    pub fn expand(&self, y: &[Complex64]) -> Vec<Complex64> {
        let mut z = self.z0.clone();
        for (&v, &value) in self.free.iter().zip(y) {
            z[v as usize] = value;
        }
        z
    }
}

fn is_row_by_row(graph: &QuadGraph) -> bool {
    let apart = |quad: &[u32; 4]| f64::from(quad.iter().max().unwrap_or(&0) - quad.iter().min().unwrap_or(&0));
    let sum: f64 = graph.quads.iter().map(apart).sum();
    sum <= ROWS * (graph.vertices as f64).sqrt() * graph.quads.len() as f64
}
