//! Conversion from nalgebra-sparse, which holds the assembled systems, to faer, which factorises
//! them.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use nalgebra_sparse::CscMatrix;

/// Returns faer's view of a nalgebra-sparse matrix, without copying.
pub fn faer_view<T>(matrix: &CscMatrix<T>) -> SparseColMatRef<'_, usize, T> {
    let (offsets, rows, values) = matrix.csc_data();
    SparseColMatRef::new(
        SymbolicSparseColMatRef::new_checked(matrix.nrows(), matrix.ncols(), offsets, None, rows),
        values,
    )
}
