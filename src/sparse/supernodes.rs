//! The supernodes of a factor: runs of columns with the same rows below.

use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{CholeskySymbolicParams, SymbolicCholeskyRaw};

use super::{Analysis, Breakdown, Columns, Order};

/// The supernodes in elimination order and the positions of their values.
///
/// The values of a supernode form a dense panel in column-major order: its own rows, then the rows
/// below.
#[derive(Debug)]
pub(super) struct Supernodes {
    /// The first column of each supernode, and the end of the last.
    begin: Vec<u32>,
    /// The first of the rows below each supernode in `rows`.
    offsets: Vec<usize>,
    rows: Vec<u32>,
    /// The first value of each supernode.
    values: Vec<usize>,
}

impl Supernodes {
    /// Analyses a pattern whose unknowns are eliminated in the order of their numbers, except for
    /// the last `border`. If there are any, these form the last supernode, which is dense.
    pub fn new(columns: &Columns, border: usize) -> Result<Self, Breakdown> {
        let by_supernodes = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..Default::default()
        };
        let symbolic = Analysis::with(columns, Order::AsGiven, by_supernodes)?.into_symbolic();
        let SymbolicCholeskyRaw::Supernodal(nodes) = symbolic.raw() else { return Err(Breakdown::TooLarge) };
        let end = (columns.size() - border) as u32;
        let mut supernodes = Supernodes { begin: vec![0], offsets: vec![0], rows: Vec::new(), values: vec![0] };
        for s in 0..nodes.n_supernodes() {
            let (start, stop) = (nodes.supernode_begin()[s], nodes.supernode_end()[s]);
            if start >= end {
                break;
            }
            // If a supernode extends into the border, its rows there become rows below.
            supernodes.rows.extend(end.min(stop)..stop);
            supernodes.rows.extend(nodes.supernode(s).pattern());
            supernodes.close(stop.min(end));
        }
        if border > 0 {
            supernodes.close(columns.size() as u32);
        }
        Ok(supernodes)
    }

    /// Closes the supernode to which the last rows belong.
    fn close(&mut self, end: u32) {
        let last = self.begin.len() - 1;
        let width = (end - self.begin[last]) as usize;
        let height = width + self.rows.len() - self.offsets[last];
        self.begin.push(end);
        self.offsets.push(self.rows.len());
        self.values.push(self.values[last] + width * height);
    }

    /// Number of supernodes.
    pub fn len(&self) -> usize {
        self.begin.len() - 1
    }

    /// Number of columns.
    pub fn size(&self) -> usize {
        self.begin[self.len()] as usize
    }

    /// Total number of values of all panels.
    pub fn value_count(&self) -> usize {
        self.values[self.len()]
    }

    /// The columns of a supernode.
    pub fn own(&self, s: usize) -> std::ops::Range<usize> {
        self.begin[s] as usize..self.begin[s + 1] as usize
    }

    /// The rows below a supernode's own rows.
    pub fn below(&self, s: usize) -> &[u32] {
        &self.rows[self.offsets[s]..self.offsets[s + 1]]
    }

    /// The range of a supernode's values.
    pub fn panel(&self, s: usize) -> std::ops::Range<usize> {
        self.values[s]..self.values[s + 1]
    }

    /// Number of rows of a supernode's panel.
    pub fn height(&self, s: usize) -> usize {
        self.own(s).len() + self.below(s).len()
    }

    /// The supernode of a column.
    pub fn of_column(&self, column: usize) -> usize {
        self.begin.partition_point(|&begin| begin as usize <= column) - 1
    }

    /// Returns the supernodes of these columns and all their ancestors, ascending. Forward
    /// substitution with a right-hand side that is 0 elsewhere involves no others.
    pub fn closure(&self, columns: impl Iterator<Item = u32>) -> Vec<u32> {
        let mut marked = vec![false; self.len()];
        columns.for_each(|column| marked[self.of_column(column as usize)] = true);
        for s in 0..self.len() {
            // The parent contains the first row below the supernode's own rows.
            if let (true, Some(&row)) = (marked[s], self.below(s).first()) {
                marked[self.of_column(row as usize)] = true;
            }
        }
        (0..self.len() as u32).filter(|&s| marked[s as usize]).collect()
    }
}
