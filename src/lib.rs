//! Riemap: discrete conformal maps of quad meshes, triangle meshes and digital surfaces.

pub mod io;
pub mod quad_graph;
pub mod surface;
