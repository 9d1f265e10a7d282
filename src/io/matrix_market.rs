use std::io::{self, Write};

use nalgebra_sparse::CscMatrix;
use num_complex::Complex64;

/// Writes a complex matrix in Matrix Market coordinate format, with `comments` in its header, one
/// per line.
///
/// Entries are in column-major order with 17 significant digits.
///
/// # Errors
/// Errors of `out`.
pub fn write_matrix_market(out: &mut dyn Write, matrix: &CscMatrix<Complex64>, comments: &[String]) -> io::Result<()> {
    writeln!(out, "%%MatrixMarket matrix coordinate complex general")?;
    for comment in comments {
        writeln!(out, "% {comment}")?;
    }
    writeln!(out, "{} {} {}", matrix.nrows(), matrix.ncols(), matrix.nnz())?;
    for (row, column, value) in matrix.triplet_iter() {
        writeln!(out, "{} {} {:?} {:?}", row + 1, column + 1, value.re, value.im)?;
    }
    Ok(())
}
