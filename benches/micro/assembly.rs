//! From positions and polygons to matrices.

use divan::{Bencher, black_box};
use riemap::map::{Domain, MapOptions};
use riemap::problem::linear::system;
use riemap::problem::nonlinear::HessianAssembly;
use riemap::surface::oriented_mesh::OrientedMesh;

use crate::fixture::{Mesh, meshes, objective};

#[divan::bench(args = meshes())]
fn diagnosis(bencher: Bencher, mesh: Mesh) {
    let input = mesh.input();
    bencher.bench_local(|| black_box(&input).diagnosis());
}

#[divan::bench(args = meshes())]
fn quad_graph(bencher: Bencher, mesh: Mesh) {
    let input = mesh.input();
    let disc = OrientedMesh::new(&input.surface, &input.diagnosis()).expect("a disc");
    let options = MapOptions::default();
    bencher.with_inputs(|| disc.clone()).bench_local_values(|disc| Domain::of_positions(disc, &options));
}

/// System (2) as a complex matrix.
#[divan::bench(args = meshes())]
fn system_2(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    bencher.bench_local(|| system(black_box(&mapped.domain.graph)));
}

/// The pattern of the Hessian of H + A + L, with the part that never changes.
#[divan::bench(args = meshes())]
fn hessian_pattern(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    let (objective, _) = objective(&mapped, &["H", "A", "L"]);
    bencher.bench_local(|| HessianAssembly::new(black_box(&objective)).columns().rows.len());
}
