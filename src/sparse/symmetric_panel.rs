//! Triangular solves with one supernode of a symmetric factor.
//!
//! A solve reads each value of the factor once, and this memory traffic determines its time;
//! several columns are therefore processed together, so that little else is read. The order of
//! summation does not depend on the vector width of the processor.

use num_complex::Complex64;

use super::entry::{Entry, STRANDS};

/// Number of columns that are processed together in forward substitution.
const FORWARD: usize = 4;

/// Working memory for solves: a column, and two real arrays as long as the highest panel.
#[derive(Clone, Debug)]
pub struct SolveWork {
    /// One entry per row; 0 between solves.
    pub(super) x: Vec<Complex64>,
    pub(super) first: Vec<f64>,
    pub(super) second: Vec<f64>,
}

/// The dense columns of a supernode, concatenated: its own rows, then the rows below.
pub(super) struct SymmetricPanel<'a, T> {
    pub start: usize,
    pub width: usize,
    pub below: &'a [u32],
    pub values: &'a [T],
}

impl<'a, T: Entry> SymmetricPanel<'a, T> {
    #[inline(always)]
    pub fn height(&self) -> usize {
        self.width + self.below.len()
    }

    #[inline(always)]
    fn column(&self, j: usize) -> &'a [T] {
        let height = self.height();
        &self.values[j * height..(j + 1) * height]
    }

    /// Solves C x = b in this supernode's rows and subtracts the contribution of x from the rows
    /// below.
    #[inline(always)]
    pub fn forward(&self, work: &mut SolveWork) {
        let SolveWork { x, first, second } = work;
        let parts = T::PARTS * self.height();
        // Σ c Re x and Σ c Im x in all rows.
        let (by_re, by_im) = (&mut first[..parts], &mut second[..parts]);
        by_re.fill(0.0);
        by_im.fill(0.0);
        let own = &mut x[self.start..self.start + self.width];
        let mut j = 0;
        while j + FORWARD <= self.width {
            self.forward_columns::<FORWARD>(j, own, by_re, by_im);
            j += FORWARD;
        }
        for j in j..self.width {
            self.forward_columns::<1>(j, own, by_re, by_im);
        }
        for (i, &row) in (self.width..).zip(self.below) {
            x[row as usize] -= T::sum(by_re, by_im, i);
        }
    }

    /// Processes the columns `j .. j + K` in forward substitution; x are the supernode's own rows.
    #[inline(always)]
    fn forward_columns<const K: usize>(&self, j: usize, x: &mut [Complex64], by_re: &mut [f64], by_im: &mut [f64]) {
        let columns: [&[T]; K] = std::array::from_fn(|k| self.column(j + k));
        let mut solved = [Complex64::ZERO; K];
        for k in 0..K {
            let mut value = x[j + k] - T::sum(by_re, by_im, j + k);
            for before in 0..k {
                value -= columns[before][j + k] * solved[before];
            }
            solved[k] = columns[k][j + k].divide(value);
            x[j + k] = solved[k];
        }
        let columns: [&[f64]; K] = columns.map(|column| T::parts(&column[j + K..]));
        let (by_re, by_im) = (&mut by_re[T::PARTS * (j + K)..], &mut by_im[T::PARTS * (j + K)..]);
        let n = by_re.len();
        let (by_im, columns) = (&mut by_im[..n], columns.map(|column| &column[..n]));
        for i in 0..n {
            let (mut a, mut b) = (by_re[i], by_im[i]);
            for k in 0..K {
                a += columns[k][i] * solved[k].re;
                b += columns[k][i] * solved[k].im;
            }
            (by_re[i], by_im[i]) = (a, b);
        }
    }

    /// Solves Cᵀ x = b in this supernode's rows, where x is known below.
    #[inline(always)]
    pub fn backward(&self, work: &mut SolveWork) {
        let SolveWork { x, first, second } = work;
        let parts = T::PARTS * self.height();
        let (first, second) = (&mut first[..parts], &mut second[..parts]);
        for (i, &row) in (self.width..).zip(self.below) {
            T::put(i, x[row as usize], first, second);
        }
        let own = &mut x[self.start..self.start + self.width];
        let mut j = self.width;
        while j >= 2 {
            let [a, b] = [self.column(j - 2), self.column(j - 1)];
            let known = T::PARTS * j;
            let [of_a, of_b] = products([&a[j..], &b[j..]], &first[known..], &second[known..]);
            own[j - 1] = b[j - 1].divide(own[j - 1] - of_b);
            own[j - 2] = a[j - 2].divide(own[j - 2] - of_a - a[j - 1] * own[j - 1]);
            T::put(j - 1, own[j - 1], first, second);
            T::put(j - 2, own[j - 2], first, second);
            j -= 2;
        }
        if j == 1 {
            let column = self.column(0);
            let [below] = products([&column[1..]], &first[T::PARTS..], &second[T::PARTS..]);
            own[0] = column[0].divide(own[0] - below);
        }
    }
}

/// `Σ c_k x`, where x is [stored](Entry::put) in the two arrays.
#[inline(always)]
pub(super) fn products<T: Entry, const K: usize>(columns: [&[T]; K], first: &[f64], second: &[f64]) -> [Complex64; K] {
    let n = first.len();
    let columns: [&[f64]; K] = columns.map(|column| &T::parts(column)[..n]);
    let second = &second[..n];
    let (mut p, mut q) = ([[0.0; STRANDS]; K], [[0.0; STRANDS]; K]);
    let whole = n - n % STRANDS;
    let mut i = 0;
    while i < whole {
        let (x, y) = (&first[i..i + STRANDS], &second[i..i + STRANDS]);
        for k in 0..K {
            let c = &columns[k][i..i + STRANDS];
            for s in 0..STRANDS {
                p[k][s] += c[s] * x[s];
                q[k][s] += c[s] * y[s];
            }
        }
        i += STRANDS;
    }
    for k in 0..K {
        for i in whole..n {
            p[k][i - whole] += columns[k][i] * first[i];
            q[k][i - whole] += columns[k][i] * second[i];
        }
    }
    std::array::from_fn(|k| T::total(p[k], q[k]))
}
