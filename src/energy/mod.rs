//! The energies of a map, `E = α H + β C + δ A + γ L + γ' L'`, and those of maps without folds. A new one is one file and one row
//! of [`ENERGIES`].
//!
//! Most are sums of squares of residuals, each a polynomial of a few vertices: they implement [`SquareSum`], and have
//! value, gradient, both Hessians and the exact polynomial along a line from it. MIPS and SD are sums of a [`Density`] over triangles.

mod affine;
mod authalic;
mod barrier;
mod circle;
pub mod conformal;
mod error;
mod expression;
mod metric;
mod mips;
mod polynomial;
mod square_sum;
mod symmetric_dirichlet;
mod triangle_sum;
mod unfolding;

pub use affine::{Derivatives, Triangles};
pub use authalic::Authalic;
pub use barrier::{Clearance, Gaps, Order};
pub use circle::Circle;
pub use conformal::Conformal;
pub use error::EnergyError;
pub use expression::{Expression, ExpressionError, Term};
pub use metric::Metric;
pub use mips::{Mips, MipsDensity};
pub use polynomial::Polynomial;
pub use square_sum::{LocalMap, SquareSum, jacobian};
pub use symmetric_dirichlet::{SymmetricDirichlet, SymmetricDirichletDensity};
pub use triangle_sum::{Density, TriangleSum};
pub use unfolding::Unfolding;

use num_complex::Complex64;

use crate::quad_graph::QuadGraph;
use crate::quad_graph::metric::RestMetric;
use crate::sparse::Stencils;
use conformal::Weight;

/// Second derivatives of a piece with respect to (Re z, Im z) of its vertices, one behind the other; rows and columns
/// past twice its number of vertices are 0.
pub type Block = [[f64; 8]; 8];

/// Which second derivatives are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curvature {
    /// A positive semi-definite model of them: of squares `2 Jᵀ J`, right where the residuals vanish; of others that are not convex
    /// all of them, without the negative eigenvalues of each piece.
    GaussNewton,
    /// All of them.
    Exact,
}

/// A function of a map z (`nv` complex values) that is a sum over pieces of at most four vertices.
pub trait Energy: Sync {
    /// Its name in expressions: H, C, A, L, Lb, MIPS, SD.
    fn name(&self) -> &'static str;

    /// E(z); +∞ where z is not admitted.
    fn value(&self, z: &[Complex64]) -> f64;

    /// Adds `t (∂E/∂x + i ∂E/∂y)` at z to `gradient` (`nv`).
    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]);

    /// Adds `t Σ_k 2 r_k″ ∇r_k` at z to `gradient`, r″ the second derivatives of the residuals along d: what bends the
    /// path of steps that keep the residuals small. Nothing where there are no residuals.
    fn add_bending(&self, t: f64, z: &[Complex64], d: &[Complex64], gradient: &mut [Complex64]);

    /// The vertices of each piece.
    fn stencils(&self) -> Stencils;

    /// Calls `add(piece, block)` with the second derivatives of every piece at z.
    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block));

    /// |J d|², J the derivatives of all residuals at z; `None` where there are no residuals. Summed from J d itself: where this is
    /// small, dᵀ(JᵀJ)d is lost in rounding.
    fn stretch(&self, _z: &[Complex64], _d: &[Complex64]) -> Option<f64> {
        None
    }

    /// Number of squares it is a sum of; 0 where it is none.
    fn residual_count(&self) -> usize;

    /// Whether the second derivatives are the same everywhere.
    fn is_quadratic(&self) -> bool {
        false
    }

    /// The coefficients of `t ↦ E(z + t d)`, where that is a polynomial.
    fn along(&self, z: &[Complex64], d: &[Complex64]) -> Option<Polynomial>;

    /// How far one may go from z, where E is finite, along d before E is not: the supremum of the t up to which z + t d is admitted, but
    /// for rounding. +∞ where all of the line is.
    fn largest_step(&self, _z: &[Complex64], _d: &[Complex64]) -> f64 {
        f64::INFINITY
    }
}

/// What an energy is made from.
#[derive(Clone, Copy)]
pub struct Rest<'a> {
    /// Quads and ρ.
    pub graph: &'a QuadGraph,
    /// Rest lengths and areas.
    pub metric: &'a RestMetric,
    /// How the pieces are weighted.
    pub weight: Weight,
    /// `held[v]`: the vertex does not move (`nv`).
    pub held: &'a [bool],
}

/// An energy by name.
pub struct Row {
    /// Its name in expressions.
    pub name: &'static str,
    /// One line for `riemap list`.
    pub about: &'static str,
    /// Whether it sees lengths or areas, and so fixes the scale of the map.
    pub metric: bool,
    /// Whether it is +∞ where a face is turned over: a minimisation must start from a map without folds.
    pub flip_free: bool,
    /// Makes it.
    pub make: fn(Rest) -> Result<Box<dyn Energy>, EnergyError>,
}

/// All energies.
pub static ENERGIES: &[Row] = &[
    Row {
        name: "H",
        about: "conformal: Σ w |z3 − z1 − iρ(z2 − z0)|²",
        metric: false,
        flip_free: false,
        make: |rest| Ok(Box::new(Conformal::new(rest)?)),
    },
    Row {
        name: "C",
        about: "circle: Σ over free boundary vertices (|z|² − 1)²",
        metric: false,
        flip_free: false,
        make: |rest| Ok(Box::new(Circle::new(rest))),
    },
    Row {
        name: "A",
        about: "authalic: Σ over quads (area² − rest area²)²",
        metric: true,
        flip_free: false,
        make: |rest| Ok(Box::new(Authalic::new(rest)?)),
    },
    Row {
        name: "L",
        about: "metric: Σ over edges of the quad graph (|zi − zj|² − |vi − vj|²)²",
        metric: true,
        flip_free: false,
        make: |rest| Ok(Box::new(Metric::all_edges(rest)?)),
    },
    Row {
        name: "Lb",
        about: "L': as L, over the boundary edges",
        metric: true,
        flip_free: false,
        make: |rest| Ok(Box::new(Metric::boundary_edges(rest))),
    },
    Row {
        name: "MIPS",
        about: "conformal without folds: Σ over triangles (quads: their corners) ½(σ1/σ2 + σ2/σ1) − 1; +∞ where one is turned over",
        metric: false,
        flip_free: true,
        make: |rest| Ok(Box::new(Mips::new(rest)?)),
    },
    Row {
        name: "SD",
        about: "isometric without folds: Σ over triangles (quads: their corners) σ1² + σ2² + σ1⁻² + σ2⁻² − 4, the symmetric Dirichlet energy",
        metric: true,
        flip_free: true,
        make: |rest| Ok(Box::new(SymmetricDirichlet::new(rest)?)),
    },
];

/// The row of the energy of that name.
pub fn energy(name: &str) -> Option<&'static Row> {
    ENERGIES.iter().find(|row| row.name == name)
}
