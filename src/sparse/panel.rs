//! Triangular solves with one supernode, for two real right-hand sides at once.
//!
//! A solve reads each value of the factor once, and this memory traffic determines its time;
//! several columns are therefore processed together, so that little else is read. The order of
//! summation does not depend on the vector width of the processor.

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;

use super::SplitColumns;

/// Number of columns that are processed together.
const FORWARD: usize = 4;

/// The dense columns of a supernode, concatenated: its own rows, then the rows below.
pub(super) struct RealPanel<'a> {
    start: usize,
    width: usize,
    rows: &'a [u32],
    values: &'a [f64],
}

impl<'a> RealPanel<'a> {
    #[inline(always)]
    pub fn new(nodes: &'a SymbolicSupernodalCholesky<u32>, values: &'a [f64], s: usize) -> Self {
        let node = nodes.supernode(s);
        let width = nodes.supernode_end()[s] as usize - node.start();
        let at = nodes.col_ptr_for_val()[s] as usize;
        let rows = node.pattern();
        RealPanel { start: node.start(), width, rows, values: &values[at..][..width * (width + rows.len())] }
    }

    fn own(&self) -> std::ops::Range<usize> {
        self.start..self.start + self.width
    }

    /// Column `j`: its own rows from the diagonal on, and the rows below.
    #[inline(always)]
    fn column(&self, j: usize) -> (&'a [f64], &'a [f64]) {
        let height = self.width + self.rows.len();
        let column = &self.values[j * height..(j + 1) * height];
        (&column[j..self.width], &column[self.width..])
    }

    /// Solves L x = b in this supernode's rows and subtracts the contribution of x from the rows
    /// below.
    #[inline(always)]
    pub fn forward(&self, work: &mut SplitColumns) {
        let SplitColumns { re, im, below_re, below_im } = work;
        let (own_re, own_im) = (&mut re[self.own()], &mut im[self.own()]);
        let (sum_re, sum_im) = (&mut below_re[..self.rows.len()], &mut below_im[..self.rows.len()]);
        sum_re.fill(0.0);
        sum_im.fill(0.0);
        let mut j = 0;
        while j + FORWARD <= self.width {
            let columns = [0, 1, 2, 3].map(|k| self.column(j + k));
            let (mut a, mut b) = ([0.0; FORWARD], [0.0; FORWARD]);
            for k in 0..FORWARD {
                let (own, _) = columns[k];
                (a[k], b[k]) = (own_re[j + k] / own[0], own_im[j + k] / own[0]);
                (own_re[j + k], own_im[j + k]) = (a[k], b[k]);
                for i in k + 1..FORWARD {
                    own_re[j + i] += -a[k] * own[i - k];
                    own_im[j + i] += -b[k] * own[i - k];
                }
            }
            let after = [0, 1, 2, 3].map(|k| &columns[k].0[FORWARD - k..]);
            add_multiples(&mut own_re[j + FORWARD..], &mut own_im[j + FORWARD..], a.map(|a| -a), b.map(|b| -b), after);
            add_multiples(sum_re, sum_im, a, b, columns.map(|(_, below)| below));
            j += FORWARD;
        }
        for j in j..self.width {
            let (own, below) = self.column(j);
            let (a, b) = (own_re[j] / own[0], own_im[j] / own[0]);
            (own_re[j], own_im[j]) = (a, b);
            add_multiples(&mut own_re[j + 1..], &mut own_im[j + 1..], [-a], [-b], [&own[1..]]);
            add_multiples(sum_re, sum_im, [a], [b], [below]);
        }
        for (i, &row) in self.rows.iter().enumerate() {
            re[row as usize] -= sum_re[i];
            im[row as usize] -= sum_im[i];
        }
    }

    /// Solves Lᵀ x = b in this supernode's rows.
    #[inline(always)]
    pub fn backward(&self, work: &mut SplitColumns) {
        let SplitColumns { re, im, below_re, below_im } = work;
        let (known_re, known_im) = (&mut below_re[..self.rows.len()], &mut below_im[..self.rows.len()]);
        for (i, &row) in self.rows.iter().enumerate() {
            (known_re[i], known_im[i]) = (re[row as usize], im[row as usize]);
        }
        let (own_re, own_im) = (&mut re[self.own()], &mut im[self.own()]);
        let mut j = self.width;
        while j >= 2 {
            let [(first, first_below), (second, second_below)] = [self.column(j - 2), self.column(j - 1)];
            let [of_first, of_second] = products([first_below, second_below], known_re, known_im);
            finish(own_re, own_im, j - 1, second, of_second);
            finish(own_re, own_im, j - 2, first, of_first);
            j -= 2;
        }
        if j == 1 {
            let (own, below) = self.column(0);
            let [of_it] = products([below], known_re, known_im);
            finish(own_re, own_im, 0, own, of_it);
        }
    }
}

/// Computes entry `j` of Lᵀ x = b when later entries are known: `own` is the column from the
/// diagonal on, `below` the contribution of the rows below.
#[inline(always)]
fn finish(re: &mut [f64], im: &mut [f64], j: usize, own: &[f64], below: (f64, f64)) {
    let [inside] = products([&own[1..]], &re[j + 1..], &im[j + 1..]);
    re[j] = (re[j] - inside.0 - below.0) / own[0];
    im[j] = (im[j] - inside.1 - below.1) / own[0];
}

/// x += Σ a_k l_k, y += Σ b_k l_k
#[inline(always)]
fn add_multiples<const K: usize>(x: &mut [f64], y: &mut [f64], a: [f64; K], b: [f64; K], l: [&[f64]; K]) {
    let n = x.len();
    let (y, l) = (&mut y[..n], l.map(|l| &l[..n]));
    for i in 0..n {
        let (mut u, mut v) = (x[i], y[i]);
        for k in 0..K {
            u += a[k] * l[k][i];
            v += b[k] * l[k][i];
        }
        (x[i], y[i]) = (u, v);
    }
}

/// (l_k·x, l_k·y), each accumulated in four partial sums.
#[inline(always)]
fn products<const K: usize>(l: [&[f64]; K], x: &[f64], y: &[f64]) -> [(f64, f64); K] {
    const STRANDS: usize = 4;
    let (mut a, mut b) = ([[0.0; STRANDS]; K], [[0.0; STRANDS]; K]);
    let n = x.len();
    let (y, l) = (&y[..n], l.map(|l| &l[..n]));
    let whole = n - n % STRANDS;
    let mut i = 0;
    while i < whole {
        let (x, y) = (&x[i..i + STRANDS], &y[i..i + STRANDS]);
        for k in 0..K {
            let l = &l[k][i..i + STRANDS];
            for s in 0..STRANDS {
                a[k][s] += l[s] * x[s];
                b[k][s] += l[s] * y[s];
            }
        }
        i += STRANDS;
    }
    std::array::from_fn(|k| {
        let sum = |[p, q, r, s]: [f64; STRANDS]| (p + q) + (r + s);
        let (mut re, mut im) = (sum(a[k]), sum(b[k]));
        for i in whole..n {
            re += l[k][i] * x[i];
            im += l[k][i] * y[i];
        }
        (re, im)
    })
}
