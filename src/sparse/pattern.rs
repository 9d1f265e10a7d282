use super::Lists;

/// Sets of vertices, all of the same small size: the vertices of the pieces of an energy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stencils {
    /// Vertices per piece.
    pub arity: usize,
    /// The vertices of all pieces, concatenated.
    pub vertices: Vec<u32>,
}

impl Stencils {
    /// Makes the stencils of pieces with `N` vertices each.
    pub fn new<const N: usize>(pieces: &[[u32; N]]) -> Self {
        Stencils { arity: N, vertices: pieces.as_flattened().to_vec() }
    }

    /// Number of pieces.
    pub fn len(&self) -> usize {
        self.vertices.len() / self.arity
    }

    /// Whether there is no piece.
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// The vertices of piece `e`.
    pub fn get(&self, e: usize) -> &[u32] {
        &self.vertices[e * self.arity..(e + 1) * self.arity]
    }
}

/// The positions of the entries of a sparse lower triangle, column by column.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Columns {
    /// The first entry of each column in `rows`, and the total number (`m + 1`).
    pub offsets: Vec<u32>,
    /// Row indices, ascending in each column, the diagonal first.
    pub rows: Vec<u32>,
}

impl Columns {
    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The diagonal of the matrix with these values.
    pub fn diagonal(&self, values: &[f64]) -> impl Iterator<Item = f64> {
        self.offsets[..self.size()].iter().map(|&first| values[first as usize])
    }

    /// Returns M x for the symmetric matrix M whose lower triangle has these values.
    pub fn multiply(&self, values: &[f64], x: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; x.len()];
        for column in 0..self.size() {
            for entry in self.entries(column) {
                let row = self.rows[entry] as usize;
                product[row] += values[entry] * x[column];
                if row != column {
                    product[column] += values[entry] * x[row];
                }
            }
        }
        product
    }

    /// The range of a column's entries in `rows`.
    pub fn entries(&self, column: usize) -> std::ops::Range<usize> {
        self.offsets[column] as usize..self.offsets[column + 1] as usize
    }
}

/// The lower triangle of a symmetric matrix that couples the vertices of each piece, and the entry
/// of each pair of vertices of a piece. Once it is made, values are assembled without search.
#[derive(Clone, Debug)]
pub struct Pattern {
    /// The entries, one for each pair of coupled vertices.
    pub columns: Columns,
    /// For each list of stencils, each piece and each pair i ≥ j of its vertices (row by row:
    /// (0,0), (1,0), (1,1), (2,0) …) the entry, or [`Pattern::NONE`].
    slots: Vec<Vec<u32>>,
}

impl Pattern {
    /// Marks vertices that are not unknowns and pairs without an entry.
    pub const NONE: u32 = u32::MAX;

    /// Makes the pattern of `stencils` over `size` unknowns; `unknown[v]` is the unknown of vertex
    /// v or [`Pattern::NONE`]. Time and memory are linear in the number of pairs.
    pub fn new(stencils: &[&Stencils], unknown: &[u32], size: usize) -> Self {
        let around = Around::new(stencils, unknown, size);
        let mut columns = Columns { offsets: Vec::with_capacity(size + 1), rows: Vec::with_capacity(6 * size) };
        let mut slots: Vec<Vec<u32>> =
            stencils.iter().map(|s| vec![Self::NONE; s.len() * (s.arity * (s.arity + 1) / 2)]).collect();
        columns.offsets.push(0);
        let mut entry = vec![Self::NONE; size];
        let mut rows: Vec<u32> = Vec::new();
        for column in 0..size as u32 {
            rows.clear();
            for (list, piece) in around.pieces(column) {
                let unknowns = stencils[list].get(piece).iter().map(|&v| unknown[v as usize]);
                rows.extend(unknowns.filter(|&r| r != Self::NONE && r >= column));
            }
            rows.sort_unstable();
            rows.dedup();
            for &row in &rows {
                entry[row as usize] = columns.rows.len() as u32;
                columns.rows.push(row);
            }
            columns.offsets.push(columns.rows.len() as u32);
            for (list, piece) in around.pieces(column) {
                let vertices = stencils[list].get(piece);
                let pairs = vertices.len() * (vertices.len() + 1) / 2;
                let slots = &mut slots[list][piece * pairs..(piece + 1) * pairs];
                for (slot, (i, j)) in slots.iter_mut().zip(pairs_of(vertices.len())) {
                    let (a, b) = (unknown[vertices[i] as usize], unknown[vertices[j] as usize]);
                    if a != Self::NONE && b != Self::NONE && a.min(b) == column {
                        *slot = entry[a.max(b) as usize];
                    }
                }
            }
        }
        Pattern { columns, slots }
    }

    /// Number of rows and columns.
    pub fn size(&self) -> usize {
        self.columns.size()
    }

    /// Returns the entries without the slots, which are needed only for assembly.
    pub fn into_columns(self) -> Columns {
        self.columns
    }

    /// The entries of the pairs i ≥ j of a piece.
    pub fn slots(&self, list: usize, piece: usize, arity: usize) -> &[u32] {
        let pairs = arity * (arity + 1) / 2;
        &self.slots[list][piece * pairs..(piece + 1) * pairs]
    }
}

/// Iterates over the pairs i ≥ j of `0 .. n`, row by row.
pub(crate) fn pairs_of(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)))
}

/// The pieces around every unknown.
struct Around {
    /// The pieces of each unknown, numbered through all lists of stencils.
    pieces: Lists,
    /// The first index of each list in the numbering of all pieces.
    first: Vec<u32>,
}

impl Around {
    fn new(stencils: &[&Stencils], unknown: &[u32], size: usize) -> Self {
        let mut first = vec![0];
        for list in stencils {
            first.push(first[first.len() - 1] + list.len() as u32);
        }
        let members = stencils.iter().zip(&first).flat_map(|(list, &first)| {
            list.vertices.iter().enumerate().filter_map(move |(k, &v)| {
                let u = unknown[v as usize];
                (u != Pattern::NONE).then_some((u, first + (k / list.arity) as u32))
            })
        });
        let pieces = Lists::new(size, members);
        Around { pieces, first }
    }

    /// Iterates over (list, piece) for every piece around unknown `u`.
    fn pieces(&self, u: u32) -> impl Iterator<Item = (usize, usize)> {
        self.pieces.of(u).iter().map(|&piece| {
            let list = self.first.partition_point(|&first| first <= piece) - 1;
            (list, (piece - self.first[list]) as usize)
        })
    }
}
