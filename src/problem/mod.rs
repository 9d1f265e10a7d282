//! The problems that solvers solve: linear ones, and minimisations of energies.

pub mod linear;
pub mod nonlinear;

pub use linear::*;
pub use nonlinear::*;
