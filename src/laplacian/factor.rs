//! Factors of L_II, and products with T.

use faer::linalg::solvers::SolveCore;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::sparse::{SparseColMat, Triplet};
use faer::{Conj, MatMut};
use num_complex::Complex64;

use super::LaplacianError;
use super::matrix::LowerTriangle;
use super::rows::BoundaryRows;
use crate::quad_graph::QuadGraph;
use crate::sparse::{Breakdown, Entry, SolveWork, SymmetricFactor};

/// A factorisation of L_II.
#[derive(Debug)]
pub(super) enum Factor {
    /// There are no inner black vertices.
    Nothing,
    /// A real factor, if every ρ is real.
    Real(Box<Symmetric<f64>>),
    /// C Cᵀ, if every Re ρ > 0: Re L is then positive definite, and no pivot is close to 0.
    Complex(Box<Symmetric<Complex64>>),
    /// Sparse LU with partial pivoting, for any ρ.
    Lu(Box<Lu<usize, Complex64>>),
}

/// `L_II = C Cᵀ`.
#[derive(Debug)]
pub(super) struct Symmetric<T> {
    factor: SymmetricFactor<T>,
    flux: Flux,
}

/// The method for products with T.
#[derive(Debug)]
enum Flux {
    /// T is stored as a dense matrix.
    Dense,
    /// A solve in the supernodes that involve the boundary.
    Pruned(Vec<u32>),
}

/// Working memory for solves.
#[derive(Clone, Debug)]
pub struct Work {
    solve: Option<SolveWork>,
    column: Vec<Complex64>,
}

impl Work {
    /// Takes a column of zeros (m), which must be given back.
    pub(super) fn take(&mut self) -> Vec<Complex64> {
        let mut column = std::mem::take(&mut self.column);
        column.fill(Complex64::ZERO);
        column
    }

    pub(super) fn give_back(&mut self, column: Vec<Complex64>) {
        self.column = column;
    }
}

impl<T: Entry> Symmetric<T> {
    /// Factorises L_II; with a border, `triangle` is that of the whole L.
    fn new(triangle: &LowerTriangle, values: &[T], border: usize, rows: &BoundaryRows) -> Result<Self, Breakdown> {
        let factor = SymmetricFactor::new(&triangle.columns, values, border)?;
        let flux = match border {
            0 => Flux::Pruned(factor.closure(rows.ports())),
            _ => Flux::Dense,
        };
        Ok(Symmetric { factor, flux })
    }

    fn flux(&self, rows: &BoundaryRows, b: &[Complex64], flux: &mut [Complex64], work: &mut SolveWork) {
        match &self.flux {
            Flux::Dense => self.factor.schur_product(b, flux, work),
            Flux::Pruned(closure) => {
                rows.along(b, flux);
                self.factor.solve_within(closure, work, |y| rows.inward(b, y), |y| rows.subtract_outward(y, flux));
            }
        }
    }
}

impl Factor {
    /// Whether L_II has a symmetric factor, if it has any.
    pub fn is_symmetric(graph: &QuadGraph) -> bool {
        graph.rho.iter().all(|rho| rho.re > 0.0) || graph.is_orthogonal()
    }

    /// Factorises L_II. With a border (the boundary) `triangle` is that of the whole L.
    pub fn new(
        graph: &QuadGraph,
        triangle: &LowerTriangle,
        border: usize,
        rows: &BoundaryRows,
    ) -> Result<Self, LaplacianError> {
        let unknowns = triangle.columns.size() - border;
        let broken = |reason| LaplacianError::Factorisation { unknowns, reason };
        if unknowns == 0 {
            return Ok(Factor::Nothing);
        }
        if graph.is_orthogonal() {
            let values: Vec<f64> = triangle.values.iter().map(|value| value.re).collect();
            match Symmetric::new(triangle, &values, border, rows) {
                Ok(factor) => return Ok(Factor::Real(Box::new(factor))),
                Err(Breakdown::TooLarge) => return Err(broken(Breakdown::TooLarge)),
                // Not positive definite, which is possible with negative ρ.
                Err(_) => {}
            }
        } else if Factor::is_symmetric(graph) {
            let factor = Symmetric::new(triangle, &triangle.values, border, rows).map_err(broken)?;
            return Ok(Factor::Complex(Box::new(factor)));
        }
        lu(triangle, unknowns).map_err(broken)
    }

    /// Returns working memory for solves with `size` unknowns.
    pub fn work(&self, size: usize) -> Work {
        let solve = match self {
            Factor::Real(factor) => Some(factor.factor.work()),
            Factor::Complex(factor) => Some(factor.factor.work()),
            Factor::Nothing | Factor::Lu(_) => None,
        };
        Work { solve, column: vec![Complex64::ZERO; size] }
    }

    /// Overwrites y with `L_II⁻¹ y`.
    pub fn solve(&self, y: &mut [Complex64], work: &mut Work) {
        match (self, &mut work.solve) {
            (Factor::Real(factor), Some(work)) => factor.factor.solve(y, work),
            (Factor::Complex(factor), Some(work)) => factor.factor.solve(y, work),
            (Factor::Lu(factor), _) => {
                let n = y.len();
                factor.solve_in_place_with_conj(Conj::No, MatMut::from_column_major_slice_mut(y, n, 1));
            }
            _ => {}
        }
    }

    /// Computes `T b`.
    pub fn flux(&self, rows: &BoundaryRows, b: &[Complex64], flux: &mut [Complex64], work: &mut Work) {
        match (self, &mut work.solve) {
            (Factor::Real(factor), Some(work)) => factor.flux(rows, b, flux, work),
            (Factor::Complex(factor), Some(work)) => factor.flux(rows, b, flux, work),
            _ => {
                rows.along(b, flux);
                let mut y = work.take();
                rows.inward(b, &mut y);
                self.solve(&mut y, work);
                rows.subtract_outward(&y, flux);
                work.give_back(y);
            }
        }
    }
}

fn lu(triangle: &LowerTriangle, unknowns: usize) -> Result<Factor, Breakdown> {
    let LowerTriangle { columns, values } = triangle;
    let mut entries = Vec::with_capacity(2 * values.len());
    for column in 0..unknowns {
        for entry in columns.entries(column) {
            let row = columns.rows[entry] as usize;
            if row >= unknowns {
                continue;
            }
            entries.push(Triplet::new(row, column, values[entry]));
            if row != column {
                entries.push(Triplet::new(column, row, values[entry]));
            }
        }
    }
    let whole = SparseColMat::try_new_from_triplets(unknowns, unknowns, &entries).map_err(|_| Breakdown::TooLarge)?;
    let symbolic = SymbolicLu::try_new(whole.symbolic()).map_err(|_| Breakdown::TooLarge)?;
    let factor = Lu::try_new_with_symbolic(symbolic, whole.as_ref()).map_err(|error| match error {
        LuError::SymbolicSingular { .. } => Breakdown::Singular,
        LuError::Generic(_) => Breakdown::TooLarge,
    })?;
    Ok(Factor::Lu(Box::new(factor)))
}
