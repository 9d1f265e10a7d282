//! Shapes that are hard to map: long protrusions, needles, staircases, triangles of every quality. Their conformal maps are not
//! known, but every one of them is a disc, so a map without folds exists.

pub(super) mod capsule;
mod cells;
pub(super) mod flat;
pub(super) mod graph;
pub(super) mod ramp;
