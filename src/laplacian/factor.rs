//! Factors of L_II.

use faer::Conj;
use faer::MatMut;
use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use num_complex::Complex64;

use super::LaplacianError;
use super::matrix::InnerMatrix;
use crate::quad_graph::QuadGraph;
use crate::sparse::{Breakdown, SymmetricFactor};

/// A factorisation of L_II.
#[derive(Debug)]
pub(super) enum Factor {
    /// There are no inner black vertices.
    Nothing,
    /// C Cᵀ, where every Re ρ > 0: Re L is positive definite, so that no pivot comes near 0.
    Symmetric(Box<SymmetricFactor>),
    /// Sparse LU with partial pivoting, for any ρ.
    Lu(Box<Lu<usize, Complex64>>),
}

/// Memory for solves.
#[derive(Debug)]
pub struct Work {
    size: usize,
    column: Vec<Complex64>,
}

impl Work {
    pub(super) fn new(size: usize) -> Self {
        Work { size, column: vec![Complex64::ZERO; size] }
    }

    /// A column of zeros (m), to be given back.
    pub(super) fn take(&mut self) -> Vec<Complex64> {
        let mut column = std::mem::take(&mut self.column);
        column.clear();
        column.resize(self.size, Complex64::ZERO);
        column
    }

    pub(super) fn give_back(&mut self, column: Vec<Complex64>) {
        self.column = column;
    }
}

impl Factor {
    pub fn new(graph: &QuadGraph, matrix: &InnerMatrix) -> Result<Self, LaplacianError> {
        let unknowns = matrix.columns.size();
        if unknowns == 0 {
            return Ok(Factor::Nothing);
        }
        if graph.rho.iter().all(|rho| rho.re > 0.0) {
            let broken = |reason| LaplacianError::Factorisation { unknowns, reason };
            let factor = SymmetricFactor::new(&matrix.columns, &matrix.values).map_err(broken)?;
            return Ok(Factor::Symmetric(Box::new(factor)));
        }
        lu(matrix)
    }

    /// Overwrites y with `L_II⁻¹ y`.
    pub fn solve(&self, y: &mut [Complex64], _work: &mut Work) {
        match self {
            Factor::Nothing => {}
            Factor::Symmetric(factor) => factor.solve_in_place(y),
            Factor::Lu(factor) => {
                let n = y.len();
                factor.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(y, n, 1));
            }
        }
    }
}

fn lu(matrix: &InnerMatrix) -> Result<Factor, LaplacianError> {
    let unknowns = matrix.columns.size();
    let broken = |reason| LaplacianError::Factorisation { unknowns, reason };
    let too_large = broken(Breakdown::TooLarge);
    let mut entries = Vec::with_capacity(2 * matrix.values.len());
    for column in 0..unknowns {
        for entry in matrix.columns.entries(column) {
            let (row, value) = (matrix.columns.rows[entry] as usize, matrix.values[entry]);
            entries.push(Triplet::new(row, column, value));
            if row != column {
                entries.push(Triplet::new(column, row, value));
            }
        }
    }
    let whole = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries).map_err(|_| too_large)?;
    let symbolic = SymbolicLu::try_new(whole.symbolic()).map_err(|_| too_large)?;
    let factor = Lu::try_new_with_symbolic(symbolic, whole.as_ref()).map_err(|error| match error {
        LuError::SymbolicSingular { .. } => broken(Breakdown::Singular),
        LuError::Generic(_) => too_large,
    })?;
    Ok(Factor::Lu(Box::new(factor)))
}
