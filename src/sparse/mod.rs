//! Sparse symmetric matrices assembled from small blocks, and their Cholesky factors.

mod cholesky;
mod pattern;
mod pruned;

pub use cholesky::{Analysis, Breakdown, Cholesky};
pub(crate) use pattern::pairs_of;
pub use pattern::{Columns, Pattern, Stencils};
pub use pruned::{Columns2, PrunedCholesky};
