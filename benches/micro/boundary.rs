//! The boundary operator S of the reduction, and the extension to the interior.

use divan::{Bencher, black_box};
use riemap::solver::boundary::Reduction;

use crate::fixture::{Mesh, meshes, rough};

/// S z, complex: one pruned solve.
#[divan::bench(args = meshes())]
fn product_with_s(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    let reduction = Reduction::new(&mapped.domain.graph, |_| ()).expect("Re ρ > 0");
    let z = rough(reduction.len());
    bencher.bench_local(|| reduction.s(black_box(&z)));
}

/// The interior from the boundary: one whole solve.
#[divan::bench(args = meshes())]
fn extension(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    let reduction = Reduction::new(&mapped.domain.graph, |_| ()).expect("Re ρ > 0");
    let z = rough(reduction.len());
    bencher.bench_local(|| reduction.extend(black_box(&z)));
}
