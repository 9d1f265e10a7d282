use faer::linalg::solvers::Solve;
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::solvers::{Lu, SymbolicLu};
use faer::{Mat, MatRef};
use nalgebra_sparse::{CooMatrix, CscMatrix};
use num_complex::Complex64;

use super::{ConvexError, Weighted};
use crate::constraint::{Elimination, Fixed};
use crate::solver::{Observer, Phase};
use crate::sparse::interop::faer_view;
use crate::surface::oriented_mesh::OrientedMesh;

/// A convex combination map.
#[derive(Clone, Debug)]
pub struct ConvexSolution {
    /// The images of the vertices of the mesh.
    pub z: Vec<Complex64>,
    /// The largest `|z_i − m_i| / (|z_i| + |m_i|)` over the free vertices, where m_i is the
    /// weighted mean of the neighbours.
    pub residual: f64,
}

/// Computes the map of `disc` in which every vertex that is not pinned by `fixed` is the weighted
/// mean of its neighbours.
///
/// The method is real sparse LU of `D − W` with rows divided by their sums D, and one step of
/// iterative refinement.
///
/// # Errors
/// A free boundary vertex; a matrix that is singular or too large.
pub fn convex_map(
    disc: &OrientedMesh,
    weights: &[Weighted],
    fixed: &Fixed,
    watch: &mut dyn Observer,
) -> Result<ConvexSolution, ConvexError> {
    if let Some(&free) = disc.boundary.iter().find(|&&v| !fixed.holds(v)) {
        return Err(ConvexError::FreeBoundary { vertex: disc.source_vertex[free as usize] });
    }
    watch.phase(Phase::Assemble);
    let vertices = disc.positions.len();
    let mut held = Fixed::default();
    for (v, place) in fixed.iter().filter(|(v, _)| (*v as usize) < vertices) {
        held.hold(v, place);
    }
    let elimination = Elimination::new(vertices, &held);
    let size = elimination.unknowns();
    if size == 0 {
        return Ok(ConvexSolution { z: elimination.z0, residual: 0.0 });
    }
    let rows = weights.iter().filter(|w| elimination.is_free(w.vertex));
    let mut sum = vec![0.0; vertices];
    for w in rows.clone() {
        sum[w.vertex as usize] += w.weight;
    }
    let mut coefficients = CooMatrix::new(size, size);
    let mut right = Mat::<f64>::zeros(size, 2);
    for w in rows {
        let row = elimination.unknown[w.vertex as usize] as usize;
        let share = w.weight / sum[w.vertex as usize];
        match elimination.unknown[w.neighbour as usize] {
            Elimination::HELD => {
                let place = elimination.z0[w.neighbour as usize];
                right[(row, 0)] += share * place.re;
                right[(row, 1)] += share * place.im;
            }
            column => coefficients.push(row, column as usize, -share),
        }
    }
    for row in 0..size {
        coefficients.push(row, row, 1.0);
    }
    let coefficients = CscMatrix::from(&coefficients);
    let y = solve(&coefficients, right.as_ref(), watch)?;
    let y: Vec<Complex64> = (0..size).map(|k| Complex64::new(y[(k, 0)], y[(k, 1)])).collect();
    let z = elimination.expand(&y);
    let mut mean = vec![Complex64::ZERO; vertices];
    for w in weights.iter().filter(|w| elimination.is_free(w.vertex)) {
        mean[w.vertex as usize] += w.weight / sum[w.vertex as usize] * z[w.neighbour as usize];
    }
    let relative = |a: Complex64, b: Complex64| if a == b { 0.0 } else { (a - b).norm() / (a.norm() + b.norm()) };
    let residuals = elimination.free.iter().map(|&v| relative(z[v as usize], mean[v as usize]));
    Ok(ConvexSolution { residual: residuals.fold(0.0, f64::max), z })
}

fn solve(matrix: &CscMatrix<f64>, right: MatRef<f64>, watch: &mut dyn Observer) -> Result<Mat<f64>, ConvexError> {
    let size = matrix.nrows();
    let matrix = faer_view(matrix);
    watch.phase(Phase::Factor);
    let symbolic = SymbolicLu::try_new(matrix.symbolic()).map_err(|_| ConvexError::TooLarge { size })?;
    let factor = Lu::try_new_with_symbolic(symbolic, matrix).map_err(|error| match error {
        LuError::SymbolicSingular { .. } => ConvexError::Singular { size },
        LuError::Generic(_) => ConvexError::TooLarge { size },
    })?;
    watch.phase(Phase::Solve);
    let mut y = factor.solve(right);
    let defect = right - matrix * &y;
    y += factor.solve(&defect);
    let finite = (0..size).all(|k| y[(k, 0)].is_finite() && y[(k, 1)].is_finite());
    if finite { Ok(y) } else { Err(ConvexError::Singular { size }) }
}
