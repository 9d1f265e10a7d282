//! Energies, their gradients and Hessians at a map near an isometry.

use divan::{Bencher, black_box};
use riemap::energy::Curvature;
use riemap::problem::nonlinear::HessianAssembly;

use crate::fixture::{Mesh, meshes, objective};

#[divan::bench(args = meshes())]
fn value_h(bencher: Bencher, mesh: Mesh) {
    value(bencher, mesh, "H");
}

#[divan::bench(args = meshes())]
fn value_a(bencher: Bencher, mesh: Mesh) {
    value(bencher, mesh, "A");
}

#[divan::bench(args = meshes())]
fn value_l(bencher: Bencher, mesh: Mesh) {
    value(bencher, mesh, "L");
}

#[divan::bench(args = meshes())]
fn gradient_h(bencher: Bencher, mesh: Mesh) {
    gradient(bencher, mesh, "H");
}

#[divan::bench(args = meshes())]
fn gradient_a(bencher: Bencher, mesh: Mesh) {
    gradient(bencher, mesh, "A");
}

#[divan::bench(args = meshes())]
fn gradient_l(bencher: Bencher, mesh: Mesh) {
    gradient(bencher, mesh, "L");
}

/// Of H + A + L.
#[divan::bench(args = meshes())]
fn hessian_gauss_newton(bencher: Bencher, mesh: Mesh) {
    hessian(bencher, mesh, Curvature::GaussNewton);
}

/// Of H + A + L.
#[divan::bench(args = meshes())]
fn hessian_exact(bencher: Bencher, mesh: Mesh) {
    hessian(bencher, mesh, Curvature::Exact);
}

fn value(bencher: Bencher, mesh: Mesh, name: &str) {
    let mapped = mesh.mapped();
    let (objective, y) = objective(&mapped, &[name]);
    bencher.bench_local(|| objective.value(black_box(&y)));
}

fn gradient(bencher: Bencher, mesh: Mesh, name: &str) {
    let mapped = mesh.mapped();
    let (objective, y) = objective(&mapped, &[name]);
    bencher.bench_local(|| objective.gradient(black_box(&y)));
}

fn hessian(bencher: Bencher, mesh: Mesh, curvature: Curvature) {
    let mapped = mesh.mapped();
    let (objective, y) = objective(&mapped, &["H", "A", "L"]);
    let assembly = HessianAssembly::new(&objective);
    bencher.bench_local(|| assembly.values(black_box(&y), curvature));
}
