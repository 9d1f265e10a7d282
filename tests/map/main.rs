//! Maps of surfaces: accuracy, injectivity, periods.

#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod boundary_lengths;
mod convergence;
mod crowding;
mod digital_maps;
mod examples;
mod flattener;
mod flip_free_maps;
mod isometric;
mod near_folds;
mod nonlinear_maps;
mod periodic;
mod public_meshes;
mod riemann;
mod statistics;
mod tiny_discs;
mod valid;
mod valid_properties;
mod validity;
