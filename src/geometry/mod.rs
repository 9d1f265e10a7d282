//! Plane and space geometry: exact signs, polygons, maps of the disc to itself, vectors in R³.

pub mod moebius;
pub mod polygon;
pub mod predicate;
pub(crate) mod vector;
