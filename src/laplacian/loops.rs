//! The boundary loops, black and white.

use std::ops::Range;

use super::{Colouring, LaplacianError};
use crate::quad_graph::QuadGraph;

/// The boundary vertices by colour, loop by loop.
#[derive(Debug)]
pub(super) struct Loops {
    /// The boundary positions of each loop.
    pub ranges: Vec<Range<usize>>,
    pub black: Vec<u32>,
    /// The white vertex after each black one.
    pub white: Vec<u32>,
    /// Positions in [`QuadGraph::boundary`].
    pub black_index: Vec<u32>,
    pub white_index: Vec<u32>,
}

impl Loops {
    pub fn new(graph: &QuadGraph, colouring: &Colouring) -> Result<Self, LaplacianError> {
        let mut loops = Loops {
            ranges: Vec::with_capacity(graph.loops.len()),
            black: Vec::new(),
            white: Vec::new(),
            black_index: Vec::new(),
            white_index: Vec::new(),
        };
        for (boundary, range) in graph.loops.iter().enumerate() {
            let begin = loops.black.len();
            for k in range.clone() {
                let next = if k + 1 == range.end { range.start } else { k + 1 };
                let [here, ahead] = [k, next].map(|k| graph.boundary[k]);
                if colouring.is_black(here) == colouring.is_black(ahead) {
                    return Err(LaplacianError::NotAlternating { boundary });
                }
                if colouring.is_black(here) {
                    loops.black.push(here);
                    loops.white.push(ahead);
                    loops.black_index.push(k as u32);
                    loops.white_index.push(next as u32);
                }
            }
            loops.ranges.push(begin..loops.black.len());
        }
        Ok(loops)
    }
}
