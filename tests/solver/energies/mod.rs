//! The energies against finite differences of each other, and against what they are by name.
mod clearance;
mod derivatives;
mod flip_free;
mod identities;
mod shared;
