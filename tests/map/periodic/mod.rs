//! Conformal maps of closed surfaces of genus 1.
mod digital;
mod flat;
mod loops;
mod reduction;
mod refusals;
mod seams;
mod shared;
mod textures;
mod tori;
