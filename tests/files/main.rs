//! Mesh and volume files, read and written.

#![allow(clippy::unwrap_used)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../mesh_files/mod.rs"]
mod mesh_files;

mod glb;
mod readers;
mod volumes;
mod writers;
