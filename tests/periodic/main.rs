//! Conformal maps of closed surfaces of genus 1.
#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
mod digital;
mod flat;
mod loops;
mod reduction;
mod refusals;
mod seams;
mod shared;
mod textures;
mod tori;
