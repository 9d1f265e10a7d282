//! A Cholesky factor for repeated solves whose right-hand sides and required solution entries are
//! restricted to few unknowns, the *ports*.

use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, supernodal::SymbolicSupernodalCholesky,
};
use num_complex::Complex64;
use pulp::Arch;

use super::panel::RealPanel;
use super::{Analysis, Breakdown, Columns, Order};

/// The real factorisation `P M Pᵀ = L Lᵀ` by supernodes. A solve from ports to ports involves only
/// the columns that are ancestors of ports in the elimination tree.
pub struct PrunedCholesky {
    symbolic: SymbolicCholesky<u32>,
    values: Vec<f64>,
    /// The unknowns that are ports.
    ports: Vec<u32>,
    /// The supernodes of the ports and all their ancestors, ascending.
    closure: Vec<u32>,
}

/// Workspace of a solve: the real and the imaginary parts of one complex column, as two real columns
/// of the length of the matrix.
pub struct SplitColumns {
    pub(super) re: Vec<f64>,
    pub(super) im: Vec<f64>,
    /// Real parts of the rows below a supernode; as long as the largest supernode requires.
    pub(super) below_re: Vec<f64>,
    pub(super) below_im: Vec<f64>,
}

impl PrunedCholesky {
    /// Factorises the matrix with these values on the pattern.
    ///
    /// # Errors
    /// A pivot that is not positive; insufficient memory or indices.
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

    /// Returns a zeroed workspace for solves with this factor.
    pub fn work(&self) -> SplitColumns {
        let size = self.symbolic.nrows();
        let below = self.nodes().map_or(0, |nodes| nodes.nnz_per_super().iter().copied().max().unwrap_or(0)) as usize;
        SplitColumns {
            re: vec![0.0; size],
            im: vec![0.0; size],
            below_re: vec![0.0; below],
            below_im: vec![0.0; below],
        }
    }

    /// Number of values of the factor.
    pub fn len(&self) -> usize {
        self.values.len()
    }

    /// Whether the matrix has no rows.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Number of values of the factor that a solve from ports to ports reads.
    pub fn pruned_len(&self) -> usize {
        let Some(nodes) = self.nodes() else { return 0 };
        let at = nodes.col_ptr_for_val();
        self.closure.iter().map(|&s| (at[s as usize + 1] - at[s as usize]) as usize).sum()
    }

    /// Solves in place for the entries at the ports, with the right-hand side `y` at the ports and
    /// 0 elsewhere.
    pub fn solve_at_ports(&self, y: &mut [Complex64], work: &mut SplitColumns) {
        self.put(self.ports.iter().copied().zip(y.iter().copied()), work);
        self.forward(self.closure.iter().copied(), work);
        self.backward(self.closure.iter().copied().rev(), work);
        self.take_ports(y, work);
        self.clear(self.closure.iter().copied(), work);
    }

    /// Solves for the entries at the ports, with a right-hand side that has these entries and is 0
    /// elsewhere.
    pub fn solve_to_ports(
        &self,
        right: impl Iterator<Item = (u32, Complex64)> + Clone,
        work: &mut SplitColumns,
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

    /// Solves for all entries, with the right-hand side `y` at the ports and 0 elsewhere.
    pub fn solve_from_ports(&self, y: &[Complex64], work: &mut SplitColumns) -> Vec<Complex64> {
        self.put(self.ports.iter().copied().zip(y.iter().copied()), work);
        self.forward(self.closure.iter().copied(), work);
        self.whole(work)
    }

    /// Substitutes backward through all columns and returns the whole solution.
    fn whole(&self, work: &mut SplitColumns) -> Vec<Complex64> {
        self.backward((0..self.node_count()).rev(), work);
        let solution = (0..self.symbolic.nrows() as u32).map(|u| self.at(u));
        let solution = solution.map(|p| Complex64::new(work.re[p], work.im[p])).collect();
        work.re.fill(0.0);
        work.im.fill(0.0);
        solution
    }

    /// The position of unknown `u` in the elimination order.
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

    /// Returns the supernodes of these unknowns and all their ancestors, ascending.
    fn closure_of(&self, unknowns: &[u32]) -> Vec<u32> {
        let Some(nodes) = self.nodes() else { return Vec::new() };
        let begin = nodes.supernode_begin();
        let node_of = |column: usize| begin.partition_point(|&b| b as usize <= column) - 1;
        let mut marked = vec![false; begin.len()];
        for &u in unknowns {
            marked[node_of(self.at(u))] = true;
        }
        for s in 0..marked.len() {
            // The parent contains the first row below the supernode's own rows.
            if let (true, Some(&row)) = (marked[s], nodes.supernode(s).pattern().first()) {
                marked[node_of(row as usize)] = true;
            }
        }
        (0..marked.len() as u32).filter(|&s| marked[s as usize]).collect()
    }

    fn put(&self, right: impl Iterator<Item = (u32, Complex64)>, work: &mut SplitColumns) {
        for (u, y) in right {
            let p = self.at(u);
            work.re[p] += y.re;
            work.im[p] += y.im;
        }
    }

    fn take_ports(&self, y: &mut [Complex64], work: &SplitColumns) {
        for (y, &u) in y.iter_mut().zip(&self.ports) {
            let p = self.at(u);
            *y = Complex64::new(work.re[p], work.im[p]);
        }
    }

    fn clear(&self, supernodes: impl Iterator<Item = u32>, work: &mut SplitColumns) {
        let Some(nodes) = self.nodes() else { return };
        for s in supernodes {
            let own = nodes.supernode_begin()[s as usize] as usize..nodes.supernode_end()[s as usize] as usize;
            work.re[own.clone()].fill(0.0);
            work.im[own].fill(0.0);
        }
    }

    /// Solves L x = b over these supernodes, ascending. The list must be closed under ancestors;
    /// then the values left in rows of other supernodes are never read.
    fn forward(&self, supernodes: impl Iterator<Item = u32>, work: &mut SplitColumns) {
        let Some(nodes) = self.nodes() else { return };
        // Uses the widest vectors of the processor.
        Arch::new().dispatch(|| {
            for s in supernodes {
                RealPanel::new(nodes, &self.values, s as usize).forward(work);
            }
        });
    }

    /// Solves Lᵀ x = b over these supernodes, descending; x must be known at all rows below them.
    fn backward(&self, supernodes: impl Iterator<Item = u32>, work: &mut SplitColumns) {
        let Some(nodes) = self.nodes() else { return };
        Arch::new().dispatch(|| {
            for s in supernodes {
                RealPanel::new(nodes, &self.values, s as usize).backward(work);
            }
        });
    }
}
