//! Nested dissection by positions: an elimination order that keeps fill low in matrices that couple
//! nearby vertices of a surface.

use super::piece::Piece;
use super::separator::Band;

/// Largest number of pieces in a part that is not divided further: its few vertices form one
/// supernode.
const LEAF: usize = 32;

/// Smaller parts are cut across their longest side, because they contribute little fill.
const LARGE: usize = 300;

/// Sides shorter than this share of the longest one are not considered for cuts.
const SHORT: f64 = 0.3;

/// In parts with more pieces a better cut is sought near the first one: the large parts dominate
/// the work.
const REFINED: usize = 3000;

/// Returns the `free` vertices in an elimination order. `places` are the positions of all vertices;
/// `pieces` are the sets of vertices that the matrix couples.
///
/// The pieces are halved across the coordinate axis for which the fewest vertices are on the cut;
/// their number is then minimised by a maximum flow. These vertices come after all others, and the
/// halves are divided in the same way (A. George, *Nested dissection of a regular finite element
/// mesh*, 1973). On a surface of n vertices cuts have O(√n) vertices, the fill is O(n log n) and
/// the work O(n^1.5). The order is a postorder of the elimination tree: children come before
/// parents.
pub fn dissect(pieces: &[[u32; 4]], places: &[[f64; 3]], free: impl Fn(u32) -> bool) -> Vec<u32> {
    let free: Vec<bool> = (0..places.len() as u32).map(free).collect();
    let count = free.iter().filter(|free| **free).count();
    let mut pieces: Vec<Piece> = pieces.iter().map(|&vertices| Piece::new(vertices, places)).collect();
    let mut dissection =
        Dissection { free, mark: vec![0; places.len()], tag: 0, order: vec![u32::MAX; count], left: count };
    let mut parts = Vec::from([(0, pieces.len())]);
    while let Some((begin, end)) = parts.pop() {
        let pieces = &mut pieces[begin..end];
        if pieces.len() <= LEAF {
            pieces.iter().flat_map(|piece| piece.vertices).for_each(|v| dissection.number(v));
            continue;
        }
        let middle = begin + dissection.divide(pieces);
        parts.extend([(begin, middle), (middle, end)]);
    }
    dissection.order.drain(..dissection.left);
    dissection.order
}

struct Dissection {
    /// Whether a vertex is free and not yet numbered.
    free: Vec<bool>,
    /// The last marking of each vertex: the tag of a side of a cut, or one more for the cut itself.
    mark: Vec<u32>,
    tag: u32,
    /// The order, filled from its end; `left` entries are missing.
    order: Vec<u32>,
    left: usize,
}

impl Dissection {
    /// Numbers a vertex before all those numbered so far.
    fn number(&mut self, v: u32) {
        if std::mem::replace(&mut self.free[v as usize], false) {
            self.left -= 1;
            self.order[self.left] = v;
        }
    }

    /// Reorders the pieces so that those of one side of a cut come first, numbers the vertices on
    /// the cut, and returns the number of pieces on the first side. Neither side is empty.
    fn divide(&mut self, pieces: &mut [Piece]) -> usize {
        let half = pieces.len() / 2;
        let mut last = None;
        let cut = axes(pieces).into_iter().map(|axis| {
            halve(pieces, half, axis);
            last = Some(axis);
            (axis, self.cut(pieces, half))
        });
        let Some((axis, mut cut)) = cut.min_by_key(|(_, cut)| cut.len()) else { return half };
        if last != Some(axis) {
            halve(pieces, half, axis);
        }
        let mut middle = half;
        // Halves without common vertices need no better cut.
        if pieces.len() > REFINED && (1..half).contains(&cut.len()) {
            middle = self.refine(pieces, half, axis, cut.len());
            cut = self.cut(pieces, middle);
        }
        cut.into_iter().for_each(|v| self.number(v));
        middle
    }

    /// Moves the cut across `axis`, after `half` of the pieces, to where it has the fewest vertices
    /// among `wide` pieces on each side, and returns the number of pieces on the first side.
    fn refine(&mut self, pieces: &mut [Piece], half: usize, axis: usize, wide: usize) -> usize {
        halve(&mut pieces[..half], half - wide, axis);
        halve(&mut pieces[half..], wide, axis);
        let band = half - wide..half + wide;
        let (low, high) = (self.tag + 2, self.tag + 3);
        self.tag = high;
        pieces[..band.start].iter().flat_map(|piece| piece.vertices).for_each(|v| self.mark[v as usize] = low);
        let mut sides = Band::new(&pieces[band.clone()], |v| self.free[v as usize]);
        sides.hold_low(|v| self.mark[v as usize] == low);
        pieces[band.end..].iter().flat_map(|piece| piece.vertices).for_each(|v| self.mark[v as usize] = high);
        sides.hold_high(|v| self.mark[v as usize] == high);
        let is_low = sides.divide();
        let middle = band.start + is_low.iter().filter(|is_low| **is_low).count();
        let (mut first, mut second) = (band.start, middle);
        let unsorted: Vec<Piece> = pieces[band].to_vec();
        for (piece, is_low) in unsorted.into_iter().zip(is_low) {
            let to = if is_low { &mut first } else { &mut second };
            pieces[*to] = piece;
            *to += 1;
        }
        middle
    }

    /// Returns the vertices without number that are on both sides: the first `middle` pieces, and
    /// the others.
    fn cut(&mut self, pieces: &[Piece], middle: usize) -> Vec<u32> {
        let (side, cut) = (self.tag + 2, self.tag + 3);
        self.tag = cut;
        pieces[..middle].iter().flat_map(|piece| piece.vertices).for_each(|v| self.mark[v as usize] = side);
        let mut vertices = Vec::new();
        for v in pieces[middle..].iter().flat_map(|piece| piece.vertices) {
            let mark = &mut self.mark[v as usize];
            if *mark == side && self.free[v as usize] {
                *mark = cut;
                vertices.push(v);
            }
        }
        vertices
    }
}

/// Returns the axes that cuts may cross, the longest side first.
fn axes(pieces: &[Piece]) -> Vec<usize> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for piece in pieces {
        for axis in 0..3 {
            low[axis] = low[axis].min(piece.at[axis]);
            high[axis] = high[axis].max(piece.at[axis]);
        }
    }
    let length = |axis: usize| high[axis] - low[axis];
    let mut axes = Vec::from([0, 1, 2]);
    axes.sort_by(|&a, &b| length(b).total_cmp(&length(a)));
    let longest = length(axes[0]);
    let long = |&axis: &usize| pieces.len() > LARGE && length(axis) > SHORT * longest;
    let count = axes.iter().take_while(|axis| long(axis)).count().max(1);
    axes.truncate(count);
    axes
}

/// Reorders the pieces so that the lower `half` comes first.
fn halve(pieces: &mut [Piece], half: usize, axis: usize) {
    pieces.select_nth_unstable_by(half, |a, b| a.at[axis].total_cmp(&b.at[axis]));
}
