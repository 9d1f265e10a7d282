//! Minimum vertex separators of two sides.

use std::collections::HashMap;

use super::Lists;
use super::piece::Piece;

const NONE: u32 = u32::MAX;
/// Stands for a piece where paths begin and end.
const OUTSIDE: u32 = u32::MAX - 1;

/// A band of pieces between two sides, some of whose vertices are assigned to a side.
///
/// By Menger's theorem the smallest number of vertices that separate the sides is the largest
/// number of vertex-disjoint paths from the low to the high side through pieces that share
/// vertices. The paths are found by Dinic's algorithm. The nodes of the network are `2v` and `2v +
/// 1`, at which paths enter and leave vertex v (capacity 1), followed by the pieces (unlimited
/// capacity).
pub(super) struct Band {
    /// The vertices of each piece, numbered within the band, or [`NONE`].
    pieces: Vec<[u32; 4]>,
    /// The vertices' numbers outside of the band.
    names: Vec<u32>,
    /// The pieces around each vertex.
    around: Lists,
    low: Vec<bool>,
    high: Vec<bool>,
    /// The piece from which a path enters each vertex and the piece to which it leaves; [`NONE`]
    /// without a path.
    from: Vec<u32>,
    to: Vec<u32>,
    level: Vec<u32>,
}

impl Band {
    /// Makes the band of these pieces; only `free` vertices count.
    pub fn new(pieces: &[Piece], free: impl Fn(u32) -> bool) -> Self {
        let mut number = HashMap::with_capacity(pieces.len());
        let mut names = Vec::with_capacity(pieces.len());
        let pieces: Vec<[u32; 4]> = pieces
            .iter()
            .map(|piece| {
                piece.vertices.map(|v| match free(v) {
                    false => NONE,
                    true => *number.entry(v).or_insert_with(|| {
                        names.push(v);
                        names.len() as u32 - 1
                    }),
                })
            })
            .collect();
        let count = names.len();
        let members = pieces.iter().zip(0..).flat_map(|(piece, p)| piece.map(|v| (v, p)));
        let around = Lists::new(count, members.filter(|&(v, _)| v != NONE));
        let level = vec![NONE; 2 * count + pieces.len()];
        let [low, high] = [(); 2].map(|()| vec![false; count]);
        let [from, to] = [(); 2].map(|()| vec![NONE; count]);
        Band { pieces, names, around, low, high, from, to, level }
    }

    /// Assigns vertices to the low side.
    pub fn hold_low(&mut self, held: impl Fn(u32) -> bool) {
        self.low = self.names.iter().map(|&v| held(v)).collect();
    }

    /// Assigns vertices to the high side.
    pub fn hold_high(&mut self, held: impl Fn(u32) -> bool) {
        self.high = self.names.iter().map(|&v| held(v)).collect();
    }

    /// Returns for each piece whether it is on the low side in a division with the fewest vertices
    /// on both sides.
    pub fn divide(mut self) -> Vec<bool> {
        while self.reach() {
            let mut next = vec![0; self.level.len()];
            for v in 0..self.names.len() as u32 {
                if self.level[2 * v as usize] == 0
                    && let Some(path) = self.path(2 * v, &mut next)
                {
                    self.take(&path);
                }
            }
        }
        self.level[2 * self.names.len()..].iter().map(|level| *level != NONE).collect()
    }

    /// Returns the `k`-th neighbour of a node in the residual network, `None` if that edge is
    /// saturated, `Err` after the last one.
    fn neighbour(&self, node: u32, k: u32) -> Result<Option<u32>, ()> {
        let first_piece = 2 * self.names.len() as u32;
        if node >= first_piece {
            let p = node - first_piece;
            let Some(&v) = self.pieces[p as usize].get(k as usize % 4).filter(|_| k < 8) else { return Err(()) };
            return Ok(match (v, k < 4) {
                (NONE, _) => None,
                (v, true) => Some(2 * v),
                // Back along a path that enters here from v.
                (v, false) => (self.to[v as usize] == p).then_some(2 * v + 1),
            });
        }
        let v = node as usize / 2;
        let has_path = self.from[v] != NONE;
        match (node % 2, k) {
            (0, 0) if !has_path => Ok(Some(node + 1)),
            // Back along the path to the piece from which it comes.
            (0, 0) => Ok((self.from[v] != OUTSIDE).then(|| first_piece + self.from[v])),
            (0, _) => Err(()),
            (_, 0) => Ok(has_path.then_some(node - 1)),
            _ => self.around.of(v as u32).get(k as usize - 1).map(|p| Some(first_piece + p)).ok_or(()),
        }
    }

    /// Whether a path can end at `node`.
    fn is_end(&self, node: u32) -> bool {
        node < 2 * self.names.len() as u32 && node % 2 == 1 && self.high[node as usize / 2]
    }

    /// Computes the levels of the nodes from the low side; returns whether the high side is
    /// reached.
    fn reach(&mut self) -> bool {
        self.level.fill(NONE);
        let mut queue: Vec<u32> =
            (0..self.names.len() as u32).filter(|&v| self.low[v as usize]).map(|v| 2 * v).collect();
        queue.iter().for_each(|&node| self.level[node as usize] = 0);
        let (mut head, mut last) = (0, NONE);
        while head < queue.len() && self.level[queue[head] as usize] < last {
            let node = queue[head];
            head += 1;
            if self.is_end(node) {
                last = self.level[node as usize];
            }
            let mut k = 0;
            while let Ok(neighbour) = self.neighbour(node, k) {
                k += 1;
                if let Some(next) = neighbour.filter(|&next| self.level[next as usize] == NONE) {
                    self.level[next as usize] = self.level[node as usize] + 1;
                    queue.push(next);
                }
            }
        }
        last != NONE
    }

    /// Finds a path from `start` to the high side that ascends one level per step; `next` are the
    /// first neighbours not yet tried.
    fn path(&mut self, start: u32, next: &mut [u32]) -> Option<Vec<u32>> {
        let mut path = Vec::from([start]);
        while let Some(&node) = path.last() {
            if self.is_end(node) {
                return Some(path);
            }
            match self.neighbour(node, next[node as usize]) {
                Err(()) => {
                    self.level[node as usize] = NONE;
                    path.pop();
                }
                Ok(neighbour) => {
                    next[node as usize] += 1;
                    let above = Some(self.level[node as usize] + 1);
                    path.extend(neighbour.filter(|&n| above == Some(self.level[n as usize])));
                }
            }
        }
        None
    }

    /// Adds a path; where it runs back along other paths, these are rerouted.
    fn take(&mut self, path: &[u32]) {
        let first_piece = 2 * self.names.len() as u32;
        let piece = |node: u32| node.checked_sub(first_piece);
        for (i, &node) in path.iter().enumerate().filter(|(_, node)| **node < first_piece) {
            // The capacity is 1: the node is closed for the other paths of this round.
            self.level[node as usize] = NONE;
            let v = node as usize / 2;
            let before = if i == 0 { Some(OUTSIDE) } else { piece(path[i - 1]) };
            let after = path.get(i + 1).map_or(Some(OUTSIDE), |&node| piece(node));
            match (node % 2 == 0, before, after) {
                // From a piece into the vertex: the path now enters from that piece.
                (true, Some(before), _) => self.from[v] = before,
                (false, _, Some(after)) => self.to[v] = after,
                // Back through the vertex: no path is left.
                (true, None, _) => self.from[v] = NONE,
                (false, _, None) => self.to[v] = NONE,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudo-random numbers below `bound` (linear congruential generator).
    struct Numbers(u64);

    impl Numbers {
        fn below(&mut self, bound: u32) -> u32 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as u32 % bound
        }
    }

    /// Number of vertices on both sides.
    fn cut(pieces: &[[u32; 4]], held: [&[bool]; 2], is_low: impl Fn(usize) -> bool) -> usize {
        let mut sides = held.map(<[bool]>::to_vec);
        for (p, piece) in pieces.iter().enumerate() {
            piece.iter().for_each(|&v| sides[usize::from(!is_low(p))][v as usize] = true);
        }
        sides[0].iter().zip(&sides[1]).filter(|(low, high)| **low && **high).count()
    }

    #[test]
    fn no_division_of_a_band_has_fewer_vertices_on_both_sides() {
        let mut numbers = Numbers(1);
        for _ in 0..300 {
            let vertices = 6 + numbers.below(10);
            let count = 3 + numbers.below(7) as usize;
            let pieces: Vec<[u32; 4]> = (0..count).map(|_| [(); 4].map(|()| numbers.below(vertices))).collect();
            let [low, high] = [(); 2].map(|()| (0..vertices).map(|_| numbers.below(4) == 0).collect::<Vec<bool>>());
            let places: Vec<Piece> = pieces.iter().map(|&vertices| Piece::nowhere(vertices)).collect();
            let mut band = Band::new(&places, |_| true);
            band.hold_low(|v| low[v as usize]);
            band.hold_high(|v| high[v as usize]);
            let found = band.divide();
            let fewest = (0..1usize << count).map(|set| cut(&pieces, [&low, &high], |p| set >> p & 1 == 1)).min();
            assert_eq!(Some(cut(&pieces, [&low, &high], |p| found[p])), fewest, "{pieces:?} {low:?} {high:?}");
        }
    }
}
