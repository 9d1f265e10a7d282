//! The factorisation `M = C Cᵀ` of real or complex *symmetric* matrices (no conjugate),
//! left-looking by supernodes.

use faer::linalg::matmul::matmul_with_conj;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place_with_conj;
use faer::reborrow::{Reborrow, ReborrowMut};
use faer::{Accum, Conj, MatMut, MatRef, Par};
use num_complex::Complex64;
use pulp::Arch;

use super::entry::Entry;
use super::supernodes::Supernodes;
use super::symmetric_panel::{SolveWork, SymmetricPanel, products};
use super::{Breakdown, Columns};

/// Diagonal blocks up to this size are factorised column by column.
const SMALL: usize = 16;

/// A factor C of a symmetric matrix, `M = C Cᵀ`, real or complex, or of its leading part.
///
/// There is no pivoting. If Re M is positive definite, so is the real part of every Schur
/// complement, and growth is bounded; the diagonal entries of C are principal square roots.
///
/// With a *border* the last unknowns are not eliminated: M is `[[I, ·], [B, D]]`, I is factorised,
/// and the Schur complement `T = D − B I⁻¹ Bᵀ` is stored as a dense matrix.
#[derive(Debug)]
pub struct SymmetricFactor<T> {
    nodes: Supernodes,
    values: Vec<T>,
    border: usize,
}

impl<T: Entry> SymmetricFactor<T> {
    /// Factorises the matrix whose lower triangle has these values, except for the last `border`
    /// unknowns. The others are eliminated in the order of their numbers.
    ///
    /// # Errors
    /// A pivot that is 0 or not finite (for real matrices: negative before the root); insufficient
    /// memory or indices.
    pub fn new(columns: &Columns, values: &[T], border: usize) -> Result<Self, Breakdown> {
        let nodes = Supernodes::new(columns, border)?;
        let mut values = numeric(&nodes, columns, values, border)?;
        if border > 0 {
            complete(&mut values[nodes.panel(nodes.len() - 1)], border);
        }
        Ok(SymmetricFactor { nodes, values, border })
    }

    /// Number of eliminated rows.
    pub fn size(&self) -> usize {
        self.nodes.size() - self.border
    }

    /// Number of values of the factor and of T.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Computes T b, where b are the values of the border.
    pub fn schur_product(&self, b: &[Complex64], product: &mut [Complex64], work: &mut SolveWork) {
        if self.border == 0 {
            return;
        }
        let n = self.border;
        let t = &self.values[self.nodes.panel(self.nodes.len() - 1)];
        let (first, second) = (&mut work.first[..T::PARTS * n], &mut work.second[..T::PARTS * n]);
        for (i, &b) in b.iter().enumerate() {
            T::put(i, b, first, second);
        }
        Arch::new().dispatch(|| {
            for (two, product) in t.chunks(2 * n).zip(product.chunks_mut(2)) {
                match product {
                    [p, q] => [*p, *q] = products([&two[..n], &two[n..]], first, second),
                    [p] => [*p] = products([two], first, second),
                    _ => {}
                }
            }
        });
    }

    /// Number of supernodes without the border.
    fn count(&self) -> u32 {
        (self.nodes.len() - usize::from(self.border > 0)) as u32
    }

    /// Returns the supernodes involved in a solve with a right-hand side on these rows, ascending.
    pub fn closure(&self, rows: impl Iterator<Item = u32>) -> Vec<u32> {
        self.nodes.closure(rows)
    }

    /// Returns working memory for solves.
    pub fn work(&self) -> SolveWork {
        let height = T::PARTS * (0..self.nodes.len()).map(|s| self.nodes.height(s)).max().unwrap_or(0);
        SolveWork { x: vec![Complex64::ZERO; self.nodes.size()], first: vec![0.0; height], second: vec![0.0; height] }
    }

    /// Overwrites y with `I⁻¹ y`.
    pub fn solve(&self, y: &mut [Complex64], work: &mut SolveWork) {
        let size = self.size();
        work.x[..size].copy_from_slice(y);
        self.forward(0..self.count(), work);
        work.x[size..].fill(Complex64::ZERO);
        self.backward((0..self.count()).rev(), work);
        y.copy_from_slice(&work.x[..size]);
        work.x[..size].fill(Complex64::ZERO);
    }

    /// Solves without a border for a right-hand side on rows with the given
    /// [closure](SymmetricFactor::closure). `put` adds it to a zero column; `take` reads the
    /// solution, which is valid on the rows of the closure.
    pub fn solve_within(
        &self,
        closure: &[u32],
        work: &mut SolveWork,
        put: impl FnOnce(&mut [Complex64]),
        take: impl FnOnce(&[Complex64]),
    ) {
        put(&mut work.x);
        self.forward(closure.iter().copied(), work);
        self.backward(closure.iter().rev().copied(), work);
        take(&work.x);
        closure.iter().for_each(|&s| work.x[self.nodes.own(s as usize)].fill(Complex64::ZERO));
    }

    /// Computes `−I⁻¹ Bᵀ b`, where b are the values of the border.
    pub fn extend(&self, b: &[Complex64], y: &mut [Complex64], work: &mut SolveWork) {
        let size = self.size();
        work.x[size..].copy_from_slice(b);
        self.backward((0..self.count()).rev(), work);
        y.copy_from_slice(&work.x[..size]);
        work.x.fill(Complex64::ZERO);
    }

    fn panel(&self, s: u32) -> SymmetricPanel<'_, T> {
        panel(&self.nodes, &self.values, s as usize)
    }

    fn forward(&self, supernodes: impl Iterator<Item = u32>, work: &mut SolveWork) {
        // Uses the widest vectors of the processor.
        Arch::new().dispatch(|| supernodes.for_each(|s| self.panel(s).forward(work)));
    }

    fn backward(&self, supernodes: impl Iterator<Item = u32>, work: &mut SolveWork) {
        Arch::new().dispatch(|| supernodes.for_each(|s| self.panel(s).backward(work)));
    }
}

#[inline(always)]
fn panel<'a, T>(nodes: &'a Supernodes, values: &'a [T], s: usize) -> SymmetricPanel<'a, T> {
    let own = nodes.own(s);
    SymmetricPanel { start: own.start, width: own.len(), below: nodes.below(s), values: &values[nodes.panel(s)] }
}

/// Copies the lower triangle of a symmetric matrix to the upper triangle.
fn complete<T: Copy>(values: &mut [T], n: usize) {
    for column in 0..n {
        for row in column + 1..n {
            values[row * n + column] = values[column * n + row];
        }
    }
}

const NONE: u32 = u32::MAX;

/// Computes the values of C, supernode by supernode.
///
/// Each supernode collects the products of the earlier ones that have rows in it; linked lists hold
/// these by the supernode that needs them next. The last supernode is not factorised if it is the
/// border.
fn numeric<T: Entry>(nodes: &Supernodes, columns: &Columns, entries: &[T], border: usize) -> Result<Vec<T>, Breakdown> {
    let count = nodes.len();
    let mut values = Vec::new();
    values.try_reserve_exact(nodes.value_count()).map_err(|_| Breakdown::TooLarge)?;
    values.resize(nodes.value_count(), T::ZERO);
    let mut node_of = vec![0u32; columns.size()];
    (0..count).for_each(|s| node_of[nodes.own(s)].fill(s as u32));
    let mut local = vec![0u32; columns.size()];
    // Linked lists of the earlier supernodes by the supernode to which they contribute next, and
    // their first row in it.
    let (mut head, mut next, mut from) = (vec![NONE; count], vec![NONE; count], vec![0u32; count]);
    let mut product: Vec<T> = Vec::new();
    for s in 0..count {
        let (own, below) = (nodes.own(s), nodes.below(s));
        let (width, height) = (own.len(), nodes.height(s));
        for (k, row) in own.clone().chain(below.iter().map(|&row| row as usize)).enumerate() {
            local[row] = k as u32;
        }
        let (done, rest) = values.split_at_mut(nodes.panel(s).start);
        let target = &mut rest[..width * height];
        for (column, target) in own.clone().zip(target.chunks_exact_mut(height)) {
            for entry in columns.entries(column) {
                target[local[columns.rows[entry] as usize] as usize] = entries[entry];
            }
        }
        let mut d = head[s];
        while d != NONE {
            let earlier = panel(nodes, done, d as usize);
            let first = from[d as usize] as usize;
            let last = first + earlier.below[first..].partition_point(|&row| (row as usize) < own.end);
            multiply(&earlier, first, last, &mut product);
            let rows = &earlier.below[first..];
            for (j, product) in product.chunks_exact(rows.len()).enumerate() {
                let target = &mut target[local[rows[j] as usize] as usize * height..][..height];
                for (&row, &x) in rows[j..].iter().zip(&product[j..]) {
                    target[local[row as usize] as usize] -= x;
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
        if border > 0 && s + 1 == count {
            break;
        }
        let (mut square, lower) = MatMut::from_column_major_slice_mut(target, height, width).split_at_row_mut(width);
        dense(square.rb_mut());
        if (0..width).any(|j| !square[(j, j)].is_pivot()) {
            return Err(Breakdown::Singular);
        }
        if let Some(&row) = below.first() {
            solve_right(square.rb(), lower);
            let to = node_of[row as usize] as usize;
            next[s] = head[to];
            head[to] = s as u32;
        }
    }
    Ok(values)
}

/// Computes the lower part of `D Eᵀ`, where D are the rows `first ..` below an earlier supernode
/// and E those in `first .. last`.
fn multiply<T: Entry>(earlier: &SymmetricPanel<T>, first: usize, last: usize, product: &mut Vec<T>) {
    let (rows, columns) = (earlier.below.len() - first, last - first);
    product.clear();
    product.resize(rows * columns, T::ZERO);
    let panel = MatRef::from_column_major_slice(earlier.values, earlier.height(), earlier.width);
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
        T::ONE,
        Par::Seq,
    );
    if rows > columns {
        matmul_with_conj(lower, Accum::Replace, rest, Conj::No, top.transpose(), Conj::No, T::ONE, Par::Seq);
    }
}

/// Overwrites the lower triangle of A with that of C, `A = C Cᵀ`.
fn dense<T: Entry>(mut a: MatMut<'_, T>) {
    let n = a.nrows();
    if n <= SMALL {
        for j in 0..n {
            let pivot = a[(j, j)].root();
            a[(j, j)] = pivot;
            let inverse = pivot.inverse();
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
        -T::ONE,
        Par::Seq,
    );
    dense(rest);
}

/// `B := B C⁻ᵀ`
fn solve_right<T: Entry>(c: MatRef<'_, T>, b: MatMut<'_, T>) {
    solve_lower_triangular_in_place_with_conj(c, Conj::No, b.transpose_mut(), Par::Seq);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sparse::Lists;

    /// Pseudo-random numbers in [−1, 1) (linear congruential generator).
    struct RandomNumbers(u64);

    impl RandomNumbers {
        fn next(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// Makes a sparse symmetric matrix of n rows whose real part is positive definite, as a lower
    /// triangle and in full.
    fn matrix<T: Entry>(n: usize, seed: u64, entry: impl Fn(f64, f64) -> T) -> (Columns, Vec<T>, Vec<Vec<T>>) {
        let mut numbers = RandomNumbers(seed);
        let mut full = vec![vec![T::ZERO; n]; n];
        (0..n).for_each(|i| {
            full[i][i] = entry(6.0 + numbers.next(), 3.0 * numbers.next());
            for j in [i / 2, i / 3, i.saturating_sub(1)].into_iter().filter(|&j| j < i) {
                let value = entry(0.5 * numbers.next(), numbers.next());
                (full[i][j], full[j][i]) = (value, value);
            }
        });
        let entries = (0..n).flat_map(|j| (j..n).map(move |i| (i, j)));
        let used: Vec<(usize, usize)> = entries.filter(|&(i, j)| i == j || full[i][j].is_pivot()).collect();
        let lists = Lists::new(n, used.iter().map(|&(i, j)| (j as u32, i as u32)));
        let offsets = (0..=n as u32).map(|j| if j == 0 { 0 } else { lists.range(j - 1).end as u32 }).collect();
        let values = used.iter().map(|&(i, j)| full[i][j]).collect();
        (Columns { offsets, rows: lists.items().to_vec() }, values, full)
    }

    fn multiply_by<T: Entry>(full: &[Vec<T>], x: &[Complex64]) -> Vec<Complex64> {
        full.iter().map(|row| row.iter().zip(x).map(|(&c, &x)| c * x).sum()).collect()
    }

    fn apart(a: &[Complex64], b: &[Complex64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
    }

    fn solves<T: Entry>(entry: impl Fn(f64, f64) -> T + Copy) {
        for (n, border) in [(1, 0), (5, 0), (40, 0), (200, 0), (200, 1), (200, 13), (60, 59)] {
            let (columns, values, full) = matrix(n, n as u64, entry);
            let factor = SymmetricFactor::new(&columns, &values, border).unwrap();
            let mut work = factor.work();
            let mut numbers = RandomNumbers(9);
            let x: Vec<Complex64> = (0..n).map(|_| Complex64::new(numbers.next(), numbers.next())).collect();
            // [[I, Bᵀ], [B, D]] (y, b) = (0, T b) with y = −I⁻¹ Bᵀ b.
            let size = n - border;
            let mut whole = x.clone();
            factor.extend(&x[size..], &mut whole[..size], &mut work);
            let product = multiply_by(&full, &whole);
            let mut schur = vec![Complex64::ZERO; border];
            factor.schur_product(&x[size..], &mut schur, &mut work);
            assert!(apart(&product[..size], &vec![Complex64::ZERO; size]) < 1e-13, "{n} {border}");
            assert!(apart(&product[size..], &schur) < 1e-13, "{n} {border}");
            // I y = x
            let mut y = x[..size].to_vec();
            factor.solve(&mut y, &mut work);
            y.resize(n, Complex64::ZERO);
            assert!(apart(&multiply_by(&full, &y)[..size], &x[..size]) < 1e-13, "{n} {border}");
            if border == 0 {
                let rows = [n as u32 / 3, n as u32 / 5];
                let closure = factor.closure(rows.into_iter());
                let mut y = vec![Complex64::ZERO; n];
                rows.iter().for_each(|&row| y[row as usize] = x[row as usize]);
                let right = y.clone();
                factor.solve(&mut y, &mut work);
                let put = |x: &mut [Complex64]| x.copy_from_slice(&right);
                factor.solve_within(&closure, &mut work, put, |x| {
                    rows.iter().for_each(|&row| assert!((x[row as usize] - y[row as usize]).norm() < 1e-14));
                });
            }
            assert!(work.x.iter().all(|x| *x == Complex64::ZERO), "{n} {border}");
        }
    }

    #[test]
    fn complex_symmetric_factors_solve() {
        solves(Complex64::new);
    }

    #[test]
    fn real_factors_solve() {
        solves(|re, _| re);
    }

    #[test]
    fn a_real_matrix_that_is_not_positive_definite_has_no_factor() {
        let columns = Columns { offsets: vec![0, 2, 3], rows: vec![0, 1, 1] };
        assert_eq!(SymmetricFactor::new(&columns, &[1.0, 2.0, 1.0], 0).unwrap_err(), Breakdown::Singular);
    }
}
