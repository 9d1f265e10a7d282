//! Conformal maps by Newton's method on the boundary values alone, the interior eliminated by one factorisation.
//!
//! - [`two_circle_map`]: circle maps with H = 0, black and white boundary points on two concentric circles, over the
//!   [conformal Laplacian](crate::laplacian).
//! - [`mesh_edge_map`]: free maps of triangle meshes with H = 0. The boundary edges of the mesh have exactly their prescribed
//!   lengths, and white vertices are as near as possible to the positions that black ones suggest, over the same matrix.
//! - [`free_map`]: free maps of quad meshes. All boundary edges of the quad graph have exactly their prescribed lengths, and
//!   H is minimal: the limit of H + γ'L' as γ' grows.
//! - [`Differentials`]: holomorphic differentials and period matrices of closed surfaces.

mod angles;
mod conjugate;
mod free;
mod gmres;
mod mesh_edges;
mod norm;
mod operator;
mod periods;
mod turning;
mod two_circles;

pub use free::{FreeMap, FreeProblem, FreeStalled, free_map};
pub use mesh_edges::{Keep, Layout, MeshEdgeMap, MeshEdgeProblem, mesh_edge_map};
pub use operator::Reduction;
pub use periods::{Differentials, DifferentialsError, PERIODS_NAME};
pub use two_circles::{
    CirclePin, Linearised, TwoCircleMap, TwoCirclesError, centred_pins, singular_values, two_circle_map,
};

use crate::energy::conformal::NonPositiveRho;
use crate::laplacian::LaplacianError;
use crate::sparse::Breakdown;

/// Name for `--solver` and the report.
pub const NAME: &str = "reduced";

/// One line for `riemap list`.
pub const DESCRIPTION: &str =
    "exactly conformal circle maps, free maps of exact lengths: interior eliminated once, Newton on the boundary";

/// A problem that the backend did not solve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BoundaryError {
    /// Integral weights that are undefined.
    #[error("backend `reduced` eliminates the interior with integral weights")]
    NonPositiveRho(#[from] NonPositiveRho),
    /// A request that the reduction cannot meet.
    #[error("solver `reduced` does not take this problem: {reason}")]
    Unsuitable {
        /// Why.
        reason: &'static str,
    },
    /// No factor of the interior.
    #[error("backend `reduced`: the Laplacian of {unknowns} interior vertices cannot be factorised: {reason}")]
    Factorisation {
        /// Interior vertices.
        unknowns: usize,
        /// Why.
        reason: Breakdown,
    },
    /// No conformal Laplacian, or no factor of it.
    #[error(transparent)]
    Laplacian(#[from] LaplacianError),
    /// No circle map.
    #[error(transparent)]
    TwoCircles(#[from] TwoCirclesError),
    /// No further progress, short of the tolerance.
    #[error("backend `reduced` stalled after {iterations} iterations with a residual of {residual:.1e}")]
    Stalled {
        /// Newton steps made.
        iterations: usize,
        /// What is left of |g|, or of the boundary's log lengths.
        residual: f64,
    },
}
