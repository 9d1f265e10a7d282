//! What a map spends its time on, piece by piece: `cargo bench`; `cargo bench -- factorisation` for some of it.
//!
//! Meshes have 10⁴ and 10⁵ vertices, quads in a grid and Delaunay triangles. One thread.

mod assembly;
mod boundary;
mod energies;
mod exchange;
mod factorisation;
mod fixture;

fn main() {
    divan::main();
}
