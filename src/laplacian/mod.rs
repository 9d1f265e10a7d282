//! The conformal Laplacian: a complex symmetric matrix on the black vertices of a quad graph.
//!
//! Write every quad as `(v_i, g, v_j, f)` with the black diagonal `v_i v_j` and the white vertices
//! g and f, f on the left. Equation (2) is `z_f − z_g = iρ (z_j − z_i)`. Around an inner black
//! vertex the left sides cancel, and
//!
//! ```text
//! (L z)_i = Σ_j ρ_ij (z_i − z_j) = 0
//! ```
//!
//! L is complex *symmetric*, and Re L is positive semidefinite if Re ρ > 0. White values follow by
//! summing (2) from quad to quad; no equation remains. Hence the maps with H = 0 are parametrised
//! by the black boundary values b and one number w_0. With `T = L_BB − L_BI L_II⁻¹ L_IB` the white
//! boundary vertices, w_k between b_k and b_{k+1} with the surface on the left, satisfy
//!
//! ```text
//! w_k − w_{k−1} = i (T b)_k
//! ```

mod colouring;
mod extension;
mod factor;
mod green;
mod loops;
mod matrix;
mod outflow;
mod rows;

pub use colouring::{BlackQuad, Colouring};
pub use factor::Work;
pub use green::Green;

use std::ops::Range;

use num_complex::Complex64;

use crate::quad_graph::QuadGraph;
use crate::sparse::Breakdown;
use factor::Factor;
use loops::Loops;
use matrix::{LowerTriangle, Numbering};
use rows::BoundaryRows;

/// The conformal Laplacian or its factor does not exist.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum LaplacianError {
    /// The vertices do not fall into two classes between which the edges of the quads alternate.
    #[error(
        "the vertices of the quads cannot be coloured black and white ({classes} classes instead of 2): some loop has an \
         odd number of edges; split the quads into triangles"
    )]
    NotTwoColoured {
        /// Number of classes of vertices connected by diagonals.
        classes: usize,
    },
    /// Black and white do not alternate along a boundary loop.
    #[error("black and white vertices do not alternate along boundary loop {boundary}")]
    NotAlternating {
        /// Index of the loop.
        boundary: usize,
    },
    /// L_II cannot be factorised.
    #[error("the conformal Laplacian of {unknowns} vertices cannot be factorised: {reason}")]
    Factorisation {
        /// Number of inner black vertices.
        unknowns: usize,
        /// The reason.
        reason: Breakdown,
    },
}

/// Up to this number of black boundary vertices T is formed as a dense matrix, by not eliminating
/// the boundary.
pub const DENSE: usize = 1000;

/// The conformal Laplacian L of a quad graph, with a factor of `L_II`.
///
/// I are the inner black vertices and B the black boundary vertices. On a closed surface B is
/// empty, and one black vertex is *pinned*: it is not in I, and its value is 0.
///
/// Boundary positions count the black boundary vertices loop by loop, n in total, in the order of
/// [`QuadGraph::boundary`]. The white boundary vertex of position k follows the black one along its
/// loop.
#[derive(Debug)]
pub struct ConformalLaplacian {
    colouring: Colouring,
    numbering: Numbering,
    loops: Loops,
    rows: BoundaryRows,
    factor: Factor,
    /// For every loop but the first, c (n) with `w_k − w_l = c·b`, where k is the first position of
    /// the loop and l that of the first loop.
    shifts: Vec<Vec<Complex64>>,
}

/// The unknowns of the conformal Laplacian in elimination order, before any matrix is assembled.
#[derive(Debug)]
pub struct Ordered {
    colouring: Colouring,
    loops: Loops,
    numbering: Numbering,
}

impl Ordered {
    /// Orders the black vertices of `graph` by nested dissection.
    ///
    /// # Errors
    /// [`LaplacianError::NotAlternating`].
    pub fn new(graph: &QuadGraph, colouring: Colouring) -> Result<Self, LaplacianError> {
        let loops = Loops::new(graph, &colouring)?;
        let numbering = Numbering::new(graph, &colouring, &loops.black);
        Ok(Ordered { colouring, loops, numbering })
    }

    /// Assembles L of the same graph and factorises L_II. `factoring` is called when the
    /// factorisation begins. T is a dense matrix for at most `dense` black boundary vertices
    /// ([`DENSE`] by default); use 0 if T is not needed.
    ///
    /// # Errors
    /// [`LaplacianError::Factorisation`].
    pub fn factorise(
        self,
        graph: &QuadGraph,
        dense: usize,
        factoring: impl FnOnce(),
    ) -> Result<ConformalLaplacian, LaplacianError> {
        let Ordered { colouring, loops, numbering } = self;
        let rows = BoundaryRows::new(graph, &colouring, &numbering, loops.black.len());
        let is_dense = loops.black.len() <= dense && Factor::is_symmetric(graph);
        let border = if is_dense { loops.black.len() } else { 0 };
        let triangle = LowerTriangle::new(graph, &colouring, &numbering, numbering.inner.len() + border);
        factoring();
        let factor = Factor::new(graph, &triangle, border, &rows)?;
        let mut laplacian = ConformalLaplacian { colouring, numbering, loops, rows, factor, shifts: Vec::new() };
        laplacian.shifts = laplacian.shifts_between_loops(graph);
        Ok(laplacian)
    }
}

impl ConformalLaplacian {
    /// Orders the unknowns, assembles L and factorises L_II. `factoring` is called when the
    /// factorisation begins. [`Ordered`] does it in two steps.
    ///
    /// # Errors
    /// [`LaplacianError`].
    pub fn new(graph: &QuadGraph, factoring: impl FnOnce()) -> Result<Self, LaplacianError> {
        Ordered::new(graph, Colouring::new(graph)?)?.factorise(graph, DENSE, factoring)
    }

    /// The colours of the vertices.
    pub fn colouring(&self) -> &Colouring {
        &self.colouring
    }

    /// Number n of black boundary vertices, equal to that of white ones.
    pub fn len(&self) -> usize {
        self.loops.black.len()
    }

    /// Whether there is no boundary.
    pub fn is_empty(&self) -> bool {
        self.loops.black.is_empty()
    }

    /// The boundary positions of every loop, the outer one first.
    pub fn loops(&self) -> &[Range<usize>] {
        &self.loops.ranges
    }

    /// The black boundary vertices (n).
    pub fn black_boundary(&self) -> &[u32] {
        &self.loops.black
    }

    /// The white boundary vertices (n): number k lies between the black ones k and k + 1 of its
    /// loop.
    pub fn white_boundary(&self) -> &[u32] {
        &self.loops.white
    }

    /// The positions of the black boundary vertices in [`QuadGraph::boundary`] (n).
    pub fn black_index(&self) -> &[u32] {
        &self.loops.black_index
    }

    /// The positions of the white boundary vertices in [`QuadGraph::boundary`] (n).
    pub fn white_index(&self) -> &[u32] {
        &self.loops.white_index
    }

    /// The inner black vertices I in elimination order (m).
    pub fn inner(&self) -> &[u32] {
        &self.numbering.inner
    }

    /// The number of vertex `v` in [`ConformalLaplacian::inner`], if it is an inner black vertex.
    pub fn inner_index(&self, v: u32) -> Option<usize> {
        self.numbering.index(v)
    }

    /// The pinned black vertex of a closed surface.
    pub fn held(&self) -> Option<u32> {
        self.numbering.held
    }

    /// Returns working memory for solves, which can be reused.
    pub fn work(&self) -> Work {
        self.factor.work(self.numbering.inner.len())
    }

    /// Overwrites y (m) with `L_II⁻¹ y`.
    pub fn inner_solve(&self, y: &mut [Complex64], work: &mut Work) {
        self.factor.solve(y, work);
    }

    /// Computes the flux `T b = L_BB b − L_BI L_II⁻¹ L_IB b` (n) of black boundary values b (n).
    ///
    /// T is complex symmetric: its Hermitian transpose takes x to the conjugate of `T x̄`.
    pub fn flux(&self, b: &[Complex64], flux: &mut [Complex64], work: &mut Work) {
        self.factor.flux(&self.rows, b, flux, work);
    }

    /// Computes the white boundary values w (n) from the black ones b and their
    /// [flux](ConformalLaplacian::flux).
    ///
    /// `w_k − w_{k−1} = i (T b)_k` along each loop. The mean of w over the first loop is w_0, and
    /// the other loops follow by summing (2) along a path of quads.
    pub fn white(&self, b: &[Complex64], flux: &[Complex64], w_0: Complex64, w: &mut [Complex64]) {
        for range in &self.loops.ranges {
            let mut sum = Complex64::ZERO;
            for k in range.clone() {
                if k > range.start {
                    sum += Complex64::I * flux[k];
                }
                w[k] = sum;
            }
        }
        let Some(first) = self.loops.ranges.first() else { return };
        let mean = w[first.clone()].iter().sum::<Complex64>() / first.len() as f64;
        w[first.clone()].iter_mut().for_each(|w| *w += w_0 - mean);
        for (range, shift) in self.loops.ranges[1..].iter().zip(&self.shifts) {
            let step: Complex64 = shift.iter().zip(b).map(|(c, b)| c * b).sum();
            let start = w[first.start] + step;
            w[range.clone()].iter_mut().for_each(|w| *w += start);
        }
    }

    /// For every loop but the first, the vector c (n) with `w_k − w_l = c·b` (no conjugate), where
    /// k is the first position of that loop and l that of the first loop.
    pub fn shifts(&self) -> &[Vec<Complex64>] {
        &self.shifts
    }
}
