//! The energies of a map, `E = α H + β C + δ A + γ L + γ' L'`, and the energies MIPS and SD of maps
//! without flipped faces. A new energy is one file and one entry of [`ENERGIES`].
//!
//! Most are sums of squares of residuals, each a polynomial of the values at a few vertices. They
//! implement [`SquareSum`], which gives value, gradient, both Hessians and the exact polynomial
//! along a line. MIPS and SD are sums of a [`Density`] over triangles.

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

/// The second derivatives of a piece with respect to (Re z, Im z) of its vertices in turn. Rows and
/// columns beyond twice its number of vertices are 0.
pub type Block = [[f64; 8]; 8];

/// The choice of second derivatives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Curvature {
    /// A positive semi-definite model: `2 Jᵀ J` for sums of squares, which is exact where the
    /// residuals vanish; for other energies the exact ones without the negative eigenvalues of each
    /// piece.
    GaussNewton,
    /// The exact second derivatives.
    Exact,
}

/// A function of a map z (`nv` complex values) that is a sum over pieces of at most four vertices.
pub trait Energy: Sync {
    /// The name in expressions: H, C, A, L, Lb, MIPS, SD.
    fn name(&self) -> &'static str;

    /// The value E(z); +∞ if z is not admissible.
    fn value(&self, z: &[Complex64]) -> f64;

    /// Adds `t (∂E/∂x + i ∂E/∂y)` at z to `gradient` (`nv`).
    fn add_gradient(&self, t: f64, z: &[Complex64], gradient: &mut [Complex64]);

    /// Adds `t Σ_k 2 r_k″ ∇r_k` at z to `gradient`, where r″ are the second derivatives of the
    /// residuals along d: the term for geodesic acceleration. Adds nothing if there are no
    /// residuals.
    fn add_bending(&self, t: f64, z: &[Complex64], d: &[Complex64], gradient: &mut [Complex64]);

    /// The vertices of each piece.
    fn stencils(&self) -> Stencils;

    /// Calls `add(piece, block)` with the second derivatives of every piece at z.
    fn hessian(&self, z: &[Complex64], curvature: Curvature, add: &mut dyn FnMut(usize, &Block));

    /// J d|², where J are the derivatives of all residuals at z; `None` if there are no residuals.
    ///
    /// It is summed from J d itself, because dᵀ(JᵀJ)d is lost in rounding where it is small.
    fn stretch(&self, _z: &[Complex64], _d: &[Complex64]) -> Option<f64> {
        None
    }

    /// Number of squares of which the energy is a sum; 0 if it is not a sum of squares.
    fn residual_count(&self) -> usize;

    /// Whether the second derivatives are constant.
    fn is_quadratic(&self) -> bool {
        false
    }

    /// The coefficients of `t ↦ E(z + t d)`, if it is a polynomial.
    fn along(&self, z: &[Complex64], d: &[Complex64]) -> Option<Polynomial>;

    /// The largest step: the supremum, up to rounding, of the t up to which E(z + t d) is finite,
    /// given that E(z) is; +∞ if there is no bound.
    fn largest_step(&self, _z: &[Complex64], _d: &[Complex64]) -> f64 {
        f64::INFINITY
    }
}

/// The rest geometry and settings from which energies are made.
#[derive(Clone, Copy)]
pub struct Rest<'a> {
    /// The quads and ρ.
    pub graph: &'a QuadGraph,
    /// Rest lengths and areas.
    pub metric: &'a RestMetric,
    /// The weights of the pieces.
    pub weight: Weight,
    /// For each vertex whether it is pinned (`nv`).
    pub held: &'a [bool],
}

/// An entry of the table of energies.
pub struct EnergyRow {
    /// The name in expressions.
    pub name: &'static str,
    /// A description of one line.
    pub about: &'static str,
    /// Whether it depends on lengths or areas and thus fixes the scale of the map.
    pub metric: bool,
    /// Whether it is +∞ for maps with flipped faces; a minimisation must then start from a map
    /// without any.
    pub flip_free: bool,
    /// Makes the energy.
    pub make: fn(Rest) -> Result<Box<dyn Energy>, EnergyError>,
}

/// The table of all energies.
pub static ENERGIES: &[EnergyRow] = &[
    EnergyRow {
        name: "H",
        about: "conformal: Σ w |z3 − z1 − iρ(z2 − z0)|²",
        metric: false,
        flip_free: false,
        make: |rest| Ok(Box::new(Conformal::new(rest)?)),
    },
    EnergyRow {
        name: "C",
        about: "circle: Σ over free boundary vertices (|z|² − 1)²",
        metric: false,
        flip_free: false,
        make: |rest| Ok(Box::new(Circle::new(rest))),
    },
    EnergyRow {
        name: "A",
        about: "authalic: Σ over quads (area² − rest area²)²",
        metric: true,
        flip_free: false,
        make: |rest| Ok(Box::new(Authalic::new(rest)?)),
    },
    EnergyRow {
        name: "L",
        about: "metric: Σ over edges of the quad graph (|zi − zj|² − |vi − vj|²)²",
        metric: true,
        flip_free: false,
        make: |rest| Ok(Box::new(Metric::all_edges(rest)?)),
    },
    EnergyRow {
        name: "Lb",
        about: "L': as L, over the boundary edges",
        metric: true,
        flip_free: false,
        make: |rest| Ok(Box::new(Metric::boundary_edges(rest))),
    },
    EnergyRow {
        name: "MIPS",
        about: "conformal without folds: Σ over triangles (quads: their corners) ½(σ1/σ2 + σ2/σ1) − 1; +∞ where one is turned over",
        metric: false,
        flip_free: true,
        make: |rest| Ok(Box::new(Mips::new(rest)?)),
    },
    EnergyRow {
        name: "SD",
        about: "isometric without folds: Σ over triangles (quads: their corners) σ1² + σ2² + σ1⁻² + σ2⁻² − 4, the symmetric Dirichlet energy",
        metric: true,
        flip_free: true,
        make: |rest| Ok(Box::new(SymmetricDirichlet::new(rest)?)),
    },
];

/// Returns the table entry of the energy with this name.
pub fn energy(name: &str) -> Option<&'static EnergyRow> {
    ENERGIES.iter().find(|row| row.name == name)
}
