//! The energies against finite differences of each other, and against what they are by name.
#![allow(clippy::unwrap_used)]

mod clearance;
#[path = "../common/mod.rs"]
mod common;
mod derivatives;
mod flip_free;
mod identities;
mod shared;
