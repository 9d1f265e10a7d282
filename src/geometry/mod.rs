//! Geometry of the plane and of space: exact predicates, polygons, Möbius maps, vectors in R³.

pub(crate) mod maximum;
pub mod moebius;
pub mod polygon;
pub mod predicate;
pub(crate) mod vector;
