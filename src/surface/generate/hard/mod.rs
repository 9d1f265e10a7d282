//! Shapes that are hard to map: long protrusions, needles, staircases, triangles of every quality.
//!
//! Their conformal maps are not known exactly, but each shape is a disc, so a map without flipped
//! faces exists.

pub(super) mod capsule;
mod cells;
pub(super) mod flat;
pub(super) mod graph;
pub(super) mod ramp;
