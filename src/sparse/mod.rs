//! Sparse symmetric matrices assembled from small blocks, and their Cholesky factors.

mod cholesky;
mod dissection;
pub mod interop;
mod panel;
mod pattern;
mod pruned;
mod separator;
mod symmetric;

pub use cholesky::{Analysis, Breakdown, Cholesky, Order};
pub use dissection::dissect;
pub(crate) use pattern::pairs_of;
pub use pattern::{Columns, Pattern, Stencils};
pub use pruned::{PrunedCholesky, SplitColumns};
pub use symmetric::SymmetricFactor;
