//! Sparse symmetric matrices assembled from small blocks, and their Cholesky factors.

mod cholesky;
mod dissection;
mod entry;
pub mod interop;
mod lists;
mod panel;
mod pattern;
mod piece;
mod pruned;
mod separator;
mod supernodes;
mod symmetric;
mod symmetric_panel;

pub use cholesky::{Analysis, Breakdown, Cholesky, Order};
pub use dissection::dissect;
pub use entry::Entry;
pub use lists::Lists;
pub(crate) use pattern::pairs_of;
pub use pattern::{Columns, Pattern, Stencils};
pub use pruned::{PrunedCholesky, SplitColumns};
pub use symmetric::SymmetricFactor;
pub use symmetric_panel::SolveWork;
