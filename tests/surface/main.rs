//! Surfaces: what they are, how they are cut, digital ones with their normals, and their quad graphs.

#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../opening/mod.rs"]
mod opening;

mod checked;
mod cut;
mod diagnosis;
mod digital_shapes;
mod generate;
mod generate_names;
mod holes;
mod normal_names;
mod normals;
mod quad_graph;
mod quad_graph_errors;
mod surfels;
mod surrogates;
mod topology_properties;
