//! `M = C Cᵀ` of complex *symmetric* matrices (no conjugate), left-looking by supernodes.

use faer::linalg::matmul::matmul_with_conj;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place_with_conj;
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw};
use faer::{Accum, Conj, MatMut, MatRef, Par};
use num_complex::Complex64;

use super::{Analysis, Breakdown, Columns, Order};

/// Diagonal blocks up to this size are factorised column by column.
const SMALL: usize = 16;

/// A factor C of a complex symmetric matrix, `M = C Cᵀ`.
///
/// There is no pivoting. Where Re M is positive definite every Schur complement has a positive definite real part too, and growth is
/// bounded; the pivots are the principal square roots.
#[derive(Debug)]
pub struct SymmetricFactor {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<Complex64>,
}

impl SymmetricFactor {
    /// Factorises the matrix whose lower triangle has these values; unknowns are eliminated as they are numbered.
    ///
    /// # Errors
    /// A pivot that is 0 or not finite; lack of memory or of indices.
    pub fn new(columns: &Columns, values: &[Complex64]) -> Result<Self, Breakdown> {
        let by_supernodes = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = Analysis::with(columns, Order::AsGiven, by_supernodes)?.into_symbolic();
        let SymbolicCholeskyRaw::Supernodal(nodes) = symbolic.raw() else { return Err(Breakdown::TooLarge) };
        let values = numeric(nodes, columns, values)?;
        Ok(SymmetricFactor { symbolic, values })
    }

    /// Values of the factor.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Overwrites x with `M⁻¹ x`.
    pub fn solve_in_place(&self, x: &mut [Complex64]) {
        let SymbolicCholeskyRaw::Supernodal(nodes) = self.symbolic.raw() else { return };
        for s in 0..nodes.n_supernodes() {
            let Panel { start, width, below, values } = Panel::new(nodes, &self.values, s);
            let height = width + below.len();
            for j in 0..width {
                let column = &values[j * height..(j + 1) * height];
                let t = x[start + j] / column[j];
                x[start + j] = t;
                for (x, c) in x[start + j + 1..start + width].iter_mut().zip(&column[j + 1..width]) {
                    *x -= c * t;
                }
                for (&row, c) in below.iter().zip(&column[width..]) {
                    x[row as usize] -= c * t;
                }
            }
        }
        for s in (0..nodes.n_supernodes()).rev() {
            let Panel { start, width, below, values } = Panel::new(nodes, &self.values, s);
            let height = width + below.len();
            for j in (0..width).rev() {
                let column = &values[j * height..(j + 1) * height];
                let own = x[start + j + 1..start + width].iter().zip(&column[j + 1..width]).map(|(x, c)| c * x);
                let others = below.iter().zip(&column[width..]).map(|(&row, c)| c * x[row as usize]);
                x[start + j] = (x[start + j] - own.sum::<Complex64>() - others.sum::<Complex64>()) / column[j];
            }
        }
    }
}

/// The columns of a supernode, dense, one behind the other: its own rows, then those below.
struct Panel<'a> {
    start: usize,
    width: usize,
    below: &'a [u32],
    values: &'a [Complex64],
}

impl<'a> Panel<'a> {
    fn new(nodes: &'a SymbolicSupernodalCholesky<u32>, values: &'a [Complex64], s: usize) -> Self {
        let (start, end) = (nodes.supernode_begin()[s] as usize, nodes.supernode_end()[s] as usize);
        let below = nodes.supernode(s).pattern();
        let (width, at) = (end - start, nodes.col_ptr_for_val()[s] as usize);
        Panel { start, width, below, values: &values[at..][..width * (width + below.len())] }
    }
}

const NONE: u32 = u32::MAX;

/// The values of C, supernode by supernode. Each gathers the products of the earlier ones that have rows in it, which are kept
/// in lists by the supernode that needs them next.
fn numeric(
    nodes: &SymbolicSupernodalCholesky<u32>,
    columns: &Columns,
    entries: &[Complex64],
) -> Result<Vec<Complex64>, Breakdown> {
    let count = nodes.n_supernodes();
    let (begin, end, at) = (nodes.supernode_begin(), nodes.supernode_end(), nodes.col_ptr_for_val());
    let mut values = Vec::new();
    values.try_reserve_exact(nodes.len_val()).map_err(|_| Breakdown::TooLarge)?;
    values.resize(nodes.len_val(), Complex64::ZERO);
    let mut node_of = vec![0u32; columns.size()];
    for s in 0..count {
        node_of[begin[s] as usize..end[s] as usize].fill(s as u32);
    }
    let mut local = vec![0u32; columns.size()];
    // The earlier supernodes that contribute to each one next, as linked lists, and the first row that they contribute to.
    let (mut head, mut next, mut from) = (vec![NONE; count], vec![NONE; count], vec![0u32; count]);
    let mut product: Vec<Complex64> = Vec::new();
    for s in 0..count {
        let (start, stop) = (begin[s] as usize, end[s] as usize);
        let width = stop - start;
        let below = nodes.supernode(s).pattern();
        let height = width + below.len();
        for (k, row) in (start..stop).chain(below.iter().map(|&row| row as usize)).enumerate() {
            local[row] = k as u32;
        }
        let (done, rest) = values.split_at_mut(at[s] as usize);
        let panel = &mut rest[..width * height];
        for column in start..stop {
            for entry in columns.entries(column) {
                panel[(column - start) * height + local[columns.rows[entry] as usize] as usize] = entries[entry];
            }
        }
        let mut d = head[s];
        while d != NONE {
            let earlier = Panel::new(nodes, done, d as usize);
            let first = from[d as usize] as usize;
            let last = first + earlier.below[first..].partition_point(|&row| (row as usize) < stop);
            let (rows, width) = (earlier.below.len() - first, last - first);
            multiply(&earlier, first, last, &mut product);
            for j in 0..width {
                let target = local[earlier.below[first + j] as usize] as usize * height;
                for i in j..rows {
                    panel[target + local[earlier.below[first + i] as usize] as usize] -= product[j * rows + i];
                }
            }
            let following = next[d as usize];
            if let Some(&row) = earlier.below.get(last) {
                from[d as usize] = last as u32;
                let to = node_of[row as usize] as usize;
                next[d as usize] = head[to];
                head[to] = d;
            }
            d = following;
        }
        let (mut own, lower) = MatMut::from_column_major_slice_mut(panel, height, width).split_at_row_mut(width);
        dense(own.rb_mut());
        if (0..width).any(|j| !own[(j, j)].is_finite() || own[(j, j)] == Complex64::ZERO) {
            return Err(Breakdown::Singular);
        }
        if let Some(&row) = below.first() {
            solve_right(own.rb(), lower);
            let to = node_of[row as usize] as usize;
            next[s] = head[to];
            head[to] = s as u32;
        }
    }
    Ok(values)
}

/// The lower part of `D Eᵀ`: D are the rows `first ..` below an earlier supernode, E those in `first .. last`.
fn multiply(earlier: &Panel, first: usize, last: usize, product: &mut Vec<Complex64>) {
    let (rows, columns) = (earlier.below.len() - first, last - first);
    product.clear();
    product.resize(rows * columns, Complex64::ZERO);
    let height = earlier.width + earlier.below.len();
    let panel = MatRef::from_column_major_slice(earlier.values, height, earlier.width);
    let top = panel.get(earlier.width + first..earlier.width + last, ..);
    let rest = panel.get(earlier.width + last.., ..);
    let (square, lower) = MatMut::from_column_major_slice_mut(product, rows, columns).split_at_row_mut(columns);
    triangular::matmul_with_conj(
        square,
        BlockStructure::TriangularLower,
        Accum::Replace,
        top,
        BlockStructure::Rectangular,
        Conj::No,
        top.transpose(),
        BlockStructure::Rectangular,
        Conj::No,
        Complex64::ONE,
        Par::Seq,
    );
    if rows > columns {
        matmul_with_conj(lower, Accum::Replace, rest, Conj::No, top.transpose(), Conj::No, Complex64::ONE, Par::Seq);
    }
}

/// Overwrites the lower triangle of A with that of C, `A = C Cᵀ`.
fn dense(mut a: MatMut<'_, Complex64>) {
    let n = a.nrows();
    if n <= SMALL {
        for j in 0..n {
            let pivot = a[(j, j)].sqrt();
            a[(j, j)] = pivot;
            let inverse = pivot.inv();
            for i in j + 1..n {
                a[(i, j)] *= inverse;
            }
            for k in j + 1..n {
                let factor = a[(k, j)];
                for i in k..n {
                    let x = a[(i, j)] * factor;
                    a[(i, k)] -= x;
                }
            }
        }
        return;
    }
    let half = (n / 2).next_multiple_of(8).min(n - 1);
    let (mut first, _, mut below, mut rest) = a.rb_mut().split_at_mut(half, half);
    dense(first.rb_mut());
    solve_right(first.rb(), below.rb_mut());
    triangular::matmul_with_conj(
        rest.rb_mut(),
        BlockStructure::TriangularLower,
        Accum::Add,
        below.rb(),
        BlockStructure::Rectangular,
        Conj::No,
        below.rb().transpose(),
        BlockStructure::Rectangular,
        Conj::No,
        -Complex64::ONE,
        Par::Seq,
    );
    dense(rest);
}

/// `B := B C⁻ᵀ`
fn solve_right(c: MatRef<'_, Complex64>, b: MatMut<'_, Complex64>) {
    solve_lower_triangular_in_place_with_conj(c, Conj::No, b.transpose_mut(), Par::Seq);
}
