//! A Cholesky factor that is solved with again and again for right-hand sides on few rows, of which few entries of the
//! solution are wanted: the *ports*.

use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, supernodal::SymbolicSupernodalCholesky,
};
use num_complex::Complex64;

use super::{Analysis, Breakdown, Columns, Order};

/// `P M Pᵀ = L Lᵀ`, real, by supernodes. A solve from ports to ports touches only the columns that are ancestors of ports in
/// the elimination tree.
pub struct PrunedCholesky {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
    /// The unknowns that are ports.
    ports: Vec<u32>,
    /// Supernodes from which none of the ports' is cut off: those of the ports and all their ancestors, ascending.
    closure: Vec<u32>,
}

/// Memory for solves: two real columns, as long as the matrix.
pub struct Columns2 {
    re: Vec<f64>,
    im: Vec<f64>,
    below_re: Vec<f64>,
    below_im: Vec<f64>,
}

impl PrunedCholesky {
    /// Factorises the matrix with these values on the pattern.
    ///
    /// # Errors
    /// A pivot that is not positive; lack of memory or of indices.
    pub fn new(columns: &Columns, order: Order, values: &[f64], ports: Vec<u32>) -> Result<Self, Breakdown> {
        let by_supernodes = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let analysis = Analysis::with(columns, order, by_supernodes)?;
        let values = analysis.factorise(values, None)?.into_values();
        let symbolic = analysis.into_symbolic();
        let mut factor = PrunedCholesky { symbolic, values, ports: Vec::new(), closure: Vec::new() };
        factor.closure = factor.closure_of(&ports);
        factor.ports = ports;
        Ok(factor)
    }

    /// Memory for solves with this factor.
    pub fn work(&self) -> Columns2 {
        let size = self.symbolic.nrows();
        let below = self.nodes().map_or(0, |nodes| nodes.nnz_per_super().iter().copied().max().unwrap_or(0)) as usize;
        Columns2 { re: vec![0.0; size], im: vec![0.0; size], below_re: vec![0.0; below], below_im: vec![0.0; below] }
    }

    /// Values of the factor.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Values of the factor that a solve from ports to ports reads.
    pub fn pruned_len(&self) -> usize {
        let Some(nodes) = self.nodes() else { return 0 };
        let at = nodes.col_ptr_for_val();
        self.closure.iter().map(|&s| (at[s as usize + 1] - at[s as usize]) as usize).sum()
    }

    /// The entries at the ports of the solution with the right-hand side that is `y` at the ports, 0 elsewhere; in place.
    pub fn solve_at_ports(&self, y: &mut [Complex64], work: &mut Columns2) {
        self.put(self.ports.iter().copied().zip(y.iter().copied()), work);
        self.forward(self.closure.iter().copied(), work);
        self.backward(self.closure.iter().copied().rev(), work);
        self.take_ports(y, work);
        self.clear(self.closure.iter().copied(), work);
    }

    /// The entries at the ports of the solution with the right-hand side that has these entries, 0 elsewhere.
    pub fn solve_to_ports(
        &self,
        right: impl Iterator<Item = (u32, Complex64)> + Clone,
        work: &mut Columns2,
    ) -> Vec<Complex64> {
        let from = self.closure_of(&right.clone().map(|(u, _)| u).collect::<Vec<_>>());
        self.put(right, work);
        self.forward(from.iter().copied(), work);
        self.backward(self.closure.iter().copied().rev(), work);
        let mut y = vec![Complex64::ZERO; self.ports.len()];
        self.take_ports(&mut y, work);
        self.clear(from.iter().chain(&self.closure).copied(), work);
        y
    }

    /// The solution (one entry per row) with the right-hand side that is `y` at the ports, 0 elsewhere.
    pub fn solve_from_ports(&self, y: &[Complex64], work: &mut Columns2) -> Vec<Complex64> {
        self.put(self.ports.iter().copied().zip(y.iter().copied()), work);
        self.forward(self.closure.iter().copied(), work);
        self.whole(work)
    }

    /// Goes backward through all columns and reads everything.
    fn whole(&self, work: &mut Columns2) -> Vec<Complex64> {
        self.backward((0..self.node_count()).rev(), work);
        let solution = (0..self.symbolic.nrows() as u32).map(|u| self.at(u));
        let solution = solution.map(|p| Complex64::new(work.re[p], work.im[p])).collect();
        work.re.fill(0.0);
        work.im.fill(0.0);
        solution
    }

    /// The place of unknown `u` in the order of elimination.
    fn at(&self, u: u32) -> usize {
        self.symbolic.perm().map_or(u, |p| p.arrays().1[u as usize]) as usize
    }

    fn nodes(&self) -> Option<&SymbolicSupernodalCholesky<u32>> {
        match self.symbolic.raw() {
            SymbolicCholeskyRaw::Supernodal(nodes) => Some(nodes),
            SymbolicCholeskyRaw::Simplicial(_) => None,
        }
    }

    fn node_count(&self) -> u32 {
        self.nodes().map_or(0, |nodes| nodes.n_supernodes() as u32)
    }

    /// The supernodes of these unknowns and all their ancestors, ascending.
    fn closure_of(&self, unknowns: &[u32]) -> Vec<u32> {
        let Some(nodes) = self.nodes() else { return Vec::new() };
        let begin = nodes.supernode_begin();
        let node_of = |column: usize| begin.partition_point(|&b| b as usize <= column) - 1;
        let mut marked = vec![false; begin.len()];
        for &u in unknowns {
            marked[node_of(self.at(u))] = true;
        }
        for s in 0..marked.len() {
            // The parent holds the first row below the supernode's own.
            if let (true, Some(&row)) = (marked[s], nodes.supernode(s).pattern().first()) {
                marked[node_of(row as usize)] = true;
            }
        }
        (0..marked.len() as u32).filter(|&s| marked[s as usize]).collect()
    }

    fn put(&self, right: impl Iterator<Item = (u32, Complex64)>, work: &mut Columns2) {
        for (u, y) in right {
            let p = self.at(u);
            work.re[p] += y.re;
            work.im[p] += y.im;
        }
    }

    fn take_ports(&self, y: &mut [Complex64], work: &Columns2) {
        for (y, &u) in y.iter_mut().zip(&self.ports) {
            let p = self.at(u);
            *y = Complex64::new(work.re[p], work.im[p]);
        }
    }

    fn clear(&self, supernodes: impl Iterator<Item = u32>, work: &mut Columns2) {
        let Some(nodes) = self.nodes() else { return };
        for s in supernodes {
            let own = nodes.supernode_begin()[s as usize] as usize..nodes.supernode_end()[s as usize] as usize;
            work.re[own.clone()].fill(0.0);
            work.im[own].fill(0.0);
        }
    }

    /// L x = b over these supernodes, ascending. Rows of other supernodes may be left with rubbish only if no supernode in
    /// the list has them, which a closure excludes.
    fn forward(&self, supernodes: impl Iterator<Item = u32>, work: &mut Columns2) {
        let Some(nodes) = self.nodes() else { return };
        let Columns2 { re, im, below_re, below_im } = work;
        for s in supernodes {
            let panel = Panel::new(nodes, &self.values, s as usize);
            let (own_re, own_im) = (&mut re[panel.own()], &mut im[panel.own()]);
            let (sum_re, sum_im) = (&mut below_re[..panel.rows.len()], &mut below_im[..panel.rows.len()]);
            sum_re.fill(0.0);
            sum_im.fill(0.0);
            for j in 0..panel.width {
                let (diagonal, inside, below) = panel.column(j);
                let (a, b) = (own_re[j] / diagonal, own_im[j] / diagonal);
                (own_re[j], own_im[j]) = (a, b);
                add_multiple(&mut own_re[j + 1..], -a, inside);
                add_multiple(&mut own_im[j + 1..], -b, inside);
                add_multiple(sum_re, a, below);
                add_multiple(sum_im, b, below);
            }
            for (i, &row) in panel.rows.iter().enumerate() {
                re[row as usize] -= sum_re[i];
                im[row as usize] -= sum_im[i];
            }
        }
    }

    /// Lᵀ x = b over these supernodes, descending; x must be known at all rows below theirs.
    fn backward(&self, supernodes: impl Iterator<Item = u32>, work: &mut Columns2) {
        let Some(nodes) = self.nodes() else { return };
        let Columns2 { re, im, below_re, below_im } = work;
        for s in supernodes {
            let panel = Panel::new(nodes, &self.values, s as usize);
            let (known_re, known_im) = (&mut below_re[..panel.rows.len()], &mut below_im[..panel.rows.len()]);
            for (i, &row) in panel.rows.iter().enumerate() {
                (known_re[i], known_im[i]) = (re[row as usize], im[row as usize]);
            }
            let (own_re, own_im) = (&mut re[panel.own()], &mut im[panel.own()]);
            for j in (0..panel.width).rev() {
                let (diagonal, inside, below) = panel.column(j);
                let (a, b) = two_products(inside, &own_re[j + 1..], &own_im[j + 1..]);
                let (c, d) = two_products(below, known_re, known_im);
                own_re[j] = (own_re[j] - a - c) / diagonal;
                own_im[j] = (own_im[j] - b - d) / diagonal;
            }
        }
    }
}

/// The columns of a supernode, dense, one behind the other: its own rows, then those below.
struct Panel<'a> {
    start: usize,
    width: usize,
    rows: &'a [u32],
    values: &'a [f64],
}

impl<'a> Panel<'a> {
    fn new(nodes: &'a SymbolicSupernodalCholesky<u32>, values: &'a [f64], s: usize) -> Self {
        let node = nodes.supernode(s);
        let width = nodes.supernode_end()[s] as usize - node.start();
        let at = nodes.col_ptr_for_val()[s] as usize;
        let rows = node.pattern();
        Panel { start: node.start(), width, rows, values: &values[at..][..width * (width + rows.len())] }
    }

    fn own(&self) -> std::ops::Range<usize> {
        self.start..self.start + self.width
    }

    /// Column `j`: the diagonal, the supernode's own rows after it, the rows below.
    fn column(&self, j: usize) -> (f64, &'a [f64], &'a [f64]) {
        let height = self.width + self.rows.len();
        let column = &self.values[j * height..(j + 1) * height];
        (column[j], &column[j + 1..self.width], &column[self.width..])
    }
}

/// y += t x
fn add_multiple(y: &mut [f64], t: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += t * x;
    }
}

/// (l·x, l·y), summed in four strands.
fn two_products(l: &[f64], x: &[f64], y: &[f64]) -> (f64, f64) {
    let (mut a, mut b) = ([0.0; 4], [0.0; 4]);
    let n = l.len() & !3;
    let strands = l[..n].chunks_exact(4).zip(x[..n].chunks_exact(4)).zip(y[..n].chunks_exact(4));
    for ((l, x), y) in strands {
        for i in 0..4 {
            a[i] += l[i] * x[i];
            b[i] += l[i] * y[i];
        }
    }
    let (mut re, mut im) = ((a[0] + a[1]) + (a[2] + a[3]), (b[0] + b[1]) + (b[2] + b[3]));
    for i in n..l.len() {
        re += l[i] * x[i];
        im += l[i] * y[i];
    }
    (re, im)
}
