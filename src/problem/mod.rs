//! The problems that solvers are handed: linear ones, and minimisations of energies.

pub mod linear;
pub mod nonlinear;

pub use linear::*;
pub use nonlinear::*;
