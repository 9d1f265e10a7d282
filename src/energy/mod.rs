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

pub use crate::sparse::Stencils;
pub use affine::{Derivatives, Triangles};
pub use authalic::Authalic;
pub use barrier::{Clearance, Gaps, Order};
pub use circle::Circle;
pub use conformal::Conformal;
pub use error::EnergyError;
pub use expression::{Expression, ExpressionError, Standard, Term};
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

/// What an energy sees of a map. From these follow the gauge, the start and the methods that suit; no code outside this module
/// asks for the name of an energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Properties {
    /// It sees lengths or areas, and so fixes the scale of the map.
    pub fixes_scale: bool,
    /// It sees only differences along diagonals of quads, so that the two diagonal classes of vertices may move against each other.
    pub diagonals_only: bool,
    /// It sees the boundary alone.
    pub boundary_only: bool,
    /// It draws the boundary to the unit circle.
    pub on_circle: bool,
    /// It has one minimum, or isolated ones, once the boundary or a gauge is held: it alone says where inner vertices are.
    pub determines_interior: bool,
    /// It is +∞ where a face is flipped, and sees the vertices of the mesh alone: a minimisation must start from a map without flipped faces.
    pub flip_free: bool,
}

/// An energy before it is made for a surface: a row of [`ENERGIES`], or one's own, handed to a map by [`Expression::plus`].
pub trait EnergyKind: Send + Sync {
    /// Its name in expressions and reports.
    fn name(&self) -> &'static str;

    /// One line for `riemap list`.
    fn about(&self) -> &'static str;

    /// What it sees of a map.
    fn properties(&self) -> Properties;

    /// The energy on a surface.
    ///
    /// # Errors
    /// Weights or rest areas that are undefined.
    fn make(&self, rest: Rest) -> Result<Box<dyn Energy>, EnergyError>;
}

/// An energy of the table.
#[derive(Clone, Copy)]
pub struct EnergyRow {
    name: &'static str,
    about: &'static str,
    properties: Properties,
    make: fn(Rest) -> Result<Box<dyn Energy>, EnergyError>,
}

impl EnergyKind for EnergyRow {
    fn name(&self) -> &'static str {
        self.name
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn properties(&self) -> Properties {
        self.properties
    }

    fn make(&self, rest: Rest) -> Result<Box<dyn Energy>, EnergyError> {
        (self.make)(rest)
    }
}

/// Of no energy.
const NONE: Properties = Properties {
    fixes_scale: false,
    diagonals_only: false,
    boundary_only: false,
    on_circle: false,
    determines_interior: false,
    flip_free: false,
};

/// The table of all energies.
pub static ENERGIES: &[EnergyRow] = &[
    EnergyRow {
        name: "H",
        about: "conformal: Σ w |z3 − z1 − iρ(z2 − z0)|²",
        properties: Properties { diagonals_only: true, determines_interior: true, ..NONE },
        make: |rest| Ok(Box::new(Conformal::new(rest)?)),
    },
    EnergyRow {
        name: "C",
        about: "circle: Σ over free boundary vertices (|z|² − 1)²",
        properties: Properties { boundary_only: true, on_circle: true, ..NONE },
        make: |rest| Ok(Box::new(Circle::new(rest))),
    },
    EnergyRow {
        name: "A",
        about: "authalic: Σ over quads (area² − rest area²)²",
        properties: Properties { fixes_scale: true, diagonals_only: true, ..NONE },
        make: |rest| Ok(Box::new(Authalic::new(rest)?)),
    },
    EnergyRow {
        name: "L",
        about: "metric: Σ over edges of the quad graph (|zi − zj|² − |vi − vj|²)²",
        properties: Properties { fixes_scale: true, determines_interior: true, ..NONE },
        make: |rest| Ok(Box::new(Metric::all_edges(rest)?)),
    },
    EnergyRow {
        name: "Lb",
        about: "L': as L, over the boundary edges (of triangle meshes their halves, as in the paper)",
        properties: Properties { fixes_scale: true, boundary_only: true, ..NONE },
        make: |rest| Ok(Box::new(Metric::boundary_edges(rest))),
    },
    EnergyRow {
        name: "MIPS",
        about: "conformal without folds: Σ over triangles (quads: their corners) ½(σ1/σ2 + σ2/σ1) − 1; +∞ where one is turned over",
        properties: Properties { determines_interior: true, flip_free: true, ..NONE },
        make: |rest| Ok(Box::new(Mips::new(rest)?)),
    },
    EnergyRow {
        name: "SD",
        about: "isometric without folds: Σ over triangles (quads: their corners) σ1² + σ2² + σ1⁻² + σ2⁻² − 4, the symmetric Dirichlet energy",
        properties: Properties { fixes_scale: true, determines_interior: true, flip_free: true, ..NONE },
        make: |rest| Ok(Box::new(SymmetricDirichlet::new(rest)?)),
    },
];

/// Returns the table entry of the energy with this name.
pub fn energy(name: &str) -> Option<&'static EnergyRow> {
    ENERGIES.iter().find(|row| row.name == name)
}
