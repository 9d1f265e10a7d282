//! Sparse Cholesky factors: of the interior's Laplacian, and of a Hessian.

use divan::{Bencher, black_box};
use riemap::energy::Curvature;
use riemap::problem::nonlinear::HessianAssembly;
use riemap::solver::boundary::Reduction;
use riemap::sparse::Analysis;

use crate::fixture::{Mesh, meshes, objective};

/// D_II, one real number a vertex: assembly, ordering, factor.
#[divan::bench(args = meshes(), sample_count = 20)]
fn interior(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    bencher.bench_local(|| Reduction::new(black_box(&mapped.domain.graph), |_| ()).expect("Re ρ > 0").len());
}

/// The ordering and the fill of the Hessian of H + A + L, two real numbers a vertex.
#[divan::bench(args = meshes(), sample_count = 10)]
fn hessian_symbolic(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    let (objective, _) = objective(&mapped, &["H", "A", "L"]);
    let assembly = HessianAssembly::new(&objective);
    bencher.bench_local(|| Analysis::new(black_box(assembly.columns())).map(|_| ()));
}

/// Its factor.
#[divan::bench(args = meshes(), sample_count = 10)]
fn hessian_numeric(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    let (objective, y) = objective(&mapped, &["H", "A", "L"]);
    let assembly = HessianAssembly::new(&objective);
    let values = assembly.values(&y, Curvature::GaussNewton);
    let analysis = Analysis::new(assembly.columns()).expect("it fits");
    bencher.bench_local(|| analysis.factorise(black_box(&values), None).map(|_| ()).expect("positive definite"));
}

/// One solution with it.
#[divan::bench(args = meshes())]
fn hessian_solve(bencher: Bencher, mesh: Mesh) {
    let mapped = mesh.mapped();
    let (objective, y) = objective(&mapped, &["H", "A", "L"]);
    let assembly = HessianAssembly::new(&objective);
    let values = assembly.values(&y, Curvature::GaussNewton);
    let analysis = Analysis::new(assembly.columns()).expect("it fits");
    let factor = analysis.factorise(&values, None).expect("positive definite");
    bencher.with_inputs(|| y.clone()).bench_local_refs(|right| factor.solve_in_place(right));
}
