//! Circle maps and length-preserving free maps on the boundary alone.
//!
//! With integral weights the interior is eliminated by one real factorisation ([`Reduction`]); what remains are nb unknowns
//! on the boundary, and each product with the reduced operator costs a part of one solve.
//!
//! - [`circle_map`]: the boundary exactly *on* the unit circle, H the lowest. H + βC only pulls it there: its minimum comes to
//!   this one as β grows, and is the same where H + C can vanish.
//! - [`free_map`]: the boundary edges *exactly* of given lengths. H + γ'L' comes to this as γ' grows, and is the same where it
//!   can vanish.

mod angles;
mod barrier;
mod cg;
mod circle;
mod conjugate;
mod free;
mod gmres;
mod green;
mod operator;
mod precondition;
mod spectrum;
mod start;
mod turning;

pub use circle::{CircleMap, CircleProblem, circle_map};
pub use free::{FreeMap, FreeProblem, FreeStalled, free_map};
pub use operator::Reduction;

use crate::energy::conformal::NonPositiveRho;
use crate::sparse::Breakdown;

/// Name for `--solver` and the report.
pub const NAME: &str = "reduced";

/// One line for `riemap list`.
pub const DESCRIPTION: &str =
    "circle and free maps with integral weights: interior eliminated once, Newton on the boundary, exactly on it";

/// A problem that the backend did not solve.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Unreduced {
    /// Integral weights that are undefined.
    #[error("backend `reduced` eliminates the interior with integral weights")]
    NonPositiveRho(#[from] NonPositiveRho),
    /// A request that the reduction cannot meet.
    #[error("backend `reduced` does not take this problem: {reason}; use --solver levenberg-marquardt")]
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
    /// No further progress, short of the tolerance.
    #[error(
        "backend `reduced` stalled after {iterations} iterations with a residual of {residual:.1e}: use \
         --solver levenberg-marquardt"
    )]
    Stalled {
        /// Newton steps made.
        iterations: usize,
        /// What is left of |g|, or of the boundary's log lengths.
        residual: f64,
    },
}
