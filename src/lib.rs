//! Riemap: discrete conformal maps of quad meshes, triangle meshes and digital surfaces.

pub mod backend;
pub mod constraint;
pub mod distortion;
pub mod energy;
pub mod figure;
pub mod input;
pub mod interop;
pub mod io;
pub mod libigl;
pub mod map;
pub mod objective;
pub mod problem;
pub mod quad_graph;
pub mod report;
pub mod sparse;
pub mod stopwatch;
pub mod surface;
pub mod verify;
