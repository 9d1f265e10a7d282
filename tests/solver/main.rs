//! Energies, constraints and solvers: contracts that every registered one keeps, and identities.

#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;

mod constraints;
mod contracts;
mod convex;
mod dissection;
mod energies;
mod identities;
mod laplacian;
mod minimisers;
mod reduced;
mod starts;
mod two_circles;
