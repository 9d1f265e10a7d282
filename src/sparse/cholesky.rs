//! faer's sparse Cholesky factorisation of lower triangles with 32-bit indices.
//!
//! Symbolic and numeric factorisation are separate, so that a pattern is analysed once.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltError;
use faer::perm::PermRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::traits::ComplexField;
use faer::{Conj, MatMut, Par, Side};

use super::Columns;

/// A factorisation failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Breakdown {
    /// A pivot is not positive.
    #[error("the matrix is not positive definite to rounding")]
    NotPositiveDefinite,
    /// A pivot is 0 or not finite.
    #[error("the matrix is singular to rounding")]
    Singular,
    /// The factor does not fit into memory or its indices.
    #[error("the factor does not fit into memory or its indices")]
    TooLarge,
}

/// The order in which unknowns are eliminated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Order {
    /// An order by approximate minimum degree.
    #[default]
    Amd,
    /// The order in which they are numbered, for example by [`dissect`](super::dissect).
    AsGiven,
}

/// The elimination tree and fill of a pattern.
pub struct Analysis<'a> {
    columns: &'a Columns,
    symbolic: SymbolicCholesky<u32>,
}

/// A numeric factor L with `P M Pᵀ = L Lᴴ`.
pub struct Cholesky<'b, T> {
    symbolic: &'b SymbolicCholesky<u32>,
    values: Vec<T>,
}

impl<'a> Analysis<'a> {
    /// Analyses a pattern.
    ///
    /// # Errors
    /// [`Breakdown::TooLarge`].
    pub fn new(columns: &'a Columns) -> Result<Self, Breakdown> {
        Analysis::ordered(columns, Order::Amd)
    }

    /// Analyses a pattern with the given order.
    ///
    /// # Errors
    /// [`Breakdown::TooLarge`].
    pub fn ordered(columns: &'a Columns, order: Order) -> Result<Self, Breakdown> {
        Analysis::with(columns, order, Default::default())
    }

    /// Analyses a pattern with parameters of faer.
    pub(super) fn with(
        columns: &'a Columns,
        order: Order,
        parameters: CholeskySymbolicParams,
    ) -> Result<Self, Breakdown> {
        match order {
            Order::Amd => Analysis::made(columns, SymmetricOrdering::Amd, parameters),
            Order::AsGiven => {
                // faer's `Identity` is not used, because it needs the upper triangle.
                let same: Vec<u32> = (0..columns.size() as u32).collect();
                let custom = SymmetricOrdering::Custom(PermRef::new_checked(&same, &same, columns.size()));
                Analysis::made(columns, custom, parameters)
            }
        }
    }

    /// Analyses a pattern; `order` lists each unknown once, in the order of elimination.
    ///
    /// # Errors
    /// [`Breakdown::TooLarge`].
    pub fn permuted(columns: &'a Columns, order: &[u32]) -> Result<Self, Breakdown> {
        let mut place = vec![0; order.len()];
        for (k, &u) in order.iter().enumerate() {
            place[u as usize] = k as u32;
        }
        let custom = SymmetricOrdering::Custom(PermRef::new_checked(order, &place, columns.size()));
        Analysis::made(columns, custom, Default::default())
    }

    fn made(
        columns: &'a Columns,
        ordering: SymmetricOrdering<'_, u32>,
        parameters: CholeskySymbolicParams,
    ) -> Result<Self, Breakdown> {
        let symbolic = factorize_symbolic_cholesky(view(columns), Side::Lower, ordering, parameters)
            .map_err(|_| Breakdown::TooLarge)?;
        Ok(Analysis { columns, symbolic })
    }

    /// Returns the analysis without the pattern.
    pub(super) fn into_symbolic(self) -> SymbolicCholesky<u32> {
        self.symbolic
    }

    /// Factorises the matrix with these values on the pattern. The memory of `spare`, an earlier
    /// factor, is reused.
    ///
    /// # Errors
    /// A pivot that is not positive; insufficient memory.
    pub fn factorise<T: ComplexField>(
        &self,
        values: &[T],
        spare: Option<Cholesky<'_, T>>,
    ) -> Result<Cholesky<'_, T>, Breakdown> {
        let mut factor =
            Cholesky { symbolic: &self.symbolic, values: spare.map(|spare| spare.values).unwrap_or_default() };
        self.refactorise(values, &mut factor)?;
        Ok(factor)
    }

    /// Returns an empty factor for [`Analysis::refactorise`].
    pub fn unfactorised<T: ComplexField>(&self) -> Cholesky<'_, T> {
        Cholesky { symbolic: &self.symbolic, values: Vec::new() }
    }

    /// Factorises the matrix with these values on the pattern in the memory of `factor`, which is
    /// kept on failure.
    ///
    /// # Errors
    /// A pivot that is not positive; insufficient memory.
    pub fn refactorise<T: ComplexField>(&self, values: &[T], factor: &mut Cholesky<'_, T>) -> Result<(), Breakdown> {
        let length = self.symbolic.len_val();
        factor.values.try_reserve_exact(length.saturating_sub(factor.values.len())).map_err(|_| Breakdown::TooLarge)?;
        // Existing values are overwritten.
        factor.values.resize(length, faer::traits::math_utils::zero());
        let scratch = self.symbolic.factorize_numeric_llt_scratch::<T>(Par::Seq, Default::default());
        let mut memory = MemBuffer::try_new(scratch).map_err(|_| Breakdown::TooLarge)?;
        let factorised = self.symbolic.factorize_numeric_llt(
            &mut factor.values,
            SparseColMatRef::new(view(self.columns), values),
            Side::Lower,
            Default::default(),
            Par::Seq,
            MemStack::new(&mut memory),
            Default::default(),
        );
        match factorised {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { .. }) => Err(Breakdown::NotPositiveDefinite),
        }
    }
}

impl<T: ComplexField> Cholesky<'_, T> {
    /// Returns the values of the factor, in faer's order.
    pub(super) fn into_values(self) -> Vec<T> {
        self.values
    }

    /// Overwrites the columns of `right` (concatenated, each of the size of the matrix) with the
    /// solutions.
    pub fn solve_in_place(&self, right: &mut [T]) {
        let size = self.symbolic.nrows();
        if size == 0 {
            return;
        }
        let columns = right.len() / size;
        let mut memory = MemBuffer::new(self.symbolic.solve_in_place_scratch::<T>(columns, Par::Seq));
        LltRef::new(self.symbolic, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right, size, columns),
            Par::Seq,
            MemStack::new(&mut memory),
        );
    }
}

fn view(columns: &Columns) -> SymbolicSparseColMatRef<'_, u32> {
    SymbolicSparseColMatRef::new_checked(columns.size(), columns.size(), &columns.offsets, None, &columns.rows)
}
