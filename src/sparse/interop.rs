//! nalgebra-sparse holds the assembled systems, faer factorises them: the same arrays, seen from both.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use nalgebra_sparse::CscMatrix;

/// faer's view of a nalgebra-sparse matrix; nothing is copied.
pub fn faer_view<T>(matrix: &CscMatrix<T>) -> SparseColMatRef<'_, usize, T> {
    let (offsets, rows, values) = matrix.csc_data();
    SparseColMatRef::new(
        SymbolicSparseColMatRef::new_checked(matrix.nrows(), matrix.ncols(), offsets, None, rows),
        values,
    )
}
