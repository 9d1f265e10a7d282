//! Holomorphic differentials of closed surfaces, by the conformal Laplacian.

use nalgebra::DMatrix;
use num_complex::Complex64;

use crate::laplacian::{ConformalLaplacian, LaplacianError};
use crate::quad_graph::QuadGraph;
use crate::solver::linear::ACCEPTED_RESIDUAL;
use crate::solver::{Observer, Phase};

/// Name for the report: that of the linear solver with the same factor.
pub const PERIODS_NAME: &str = "laplacian";

/// The g holomorphic functions on the universal cover of a closed surface of genus g, normalised on the first g of 2g loops, which are a
/// basis of homology.
///
/// A black function with `L z = 0` and the periods p ∈ ℂ²ᵍ gives white values by (2), and these have the periods `q = P p`. The eigenvalues
/// of P come in pairs ±λ, λ = 1 + O(h²). The eigenvectors of those near 1 are the periods of holomorphic functions, the others those of
/// antiholomorphic ones. (On Riemann surfaces P is the complex structure of the cohomology, divided by i, and its square is 1.)
#[derive(Clone, Debug)]
pub struct Differentials {
    /// The functions (g of `nv` values), equal periods on black and white vertices; 0 at the first vertex of each colour.
    pub z: Vec<Vec<Complex64>>,
    /// Their periods along the last g loops (g × g): the period matrix Π where the basis is canonical, `Im Π > 0`. Column j belongs to
    /// function j, whose periods along the first g loops are those of the unit matrix.
    pub periods: DMatrix<Complex64>,
    /// The periods of the white values of (2), divided by those of the black ones (g × g): 1 + O(h²). White values of `z` are those
    /// of (2) times its inverse.
    pub white_to_black: DMatrix<Complex64>,
    /// The largest entry of `L z` at a vertex, relative to the sum of the absolute values of its terms.
    pub residual: f64,
}

/// No holomorphic differentials.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DifferentialsError {
    /// No Laplacian, or no factor.
    #[error(transparent)]
    Laplacian(#[from] LaplacianError),
    /// Periods of white values that the loops do not determine, or that do not split into holomorphic and antiholomorphic ones.
    #[error(
        "the periods along {loops} loops do not split into holomorphic and antiholomorphic ones: the mesh is too coarse"
    )]
    NotSplit {
        /// Number of loops.
        loops: usize,
    },
    /// The solution is not one.
    #[error("the conformal Laplacian is solved to {residual:e} only, above {limit:e}: mend nearly degenerate faces")]
    Inaccurate {
        /// The residual.
        residual: f64,
        /// The largest that is accepted.
        limit: f64,
    },
}

/// Steps of Newton's method for the sign of P, which converges quadratically from P² ≈ 1.
const SIGN_STEPS: usize = 60;

impl Differentials {
    /// Solves for the differentials by one factorisation and 2g solves.
    ///
    /// `form(q, k)` are integers at the corners of quad q, 0 at the first: by how many periods of loop k the lift of a corner beside the
    /// first is away from the lift that the vertex has in the fundamental domain.
    ///
    /// # Errors
    /// [`DifferentialsError`]
    pub fn new(
        graph: &QuadGraph,
        loops: usize,
        form: impl Fn(usize, usize) -> [i32; 4],
        watch: &mut dyn Observer,
    ) -> Result<Self, DifferentialsError> {
        watch.phase(Phase::Assemble);
        let laplacian = ConformalLaplacian::new(graph, || watch.phase(Phase::Factor))?;
        watch.phase(Phase::Solve);
        let steps: Vec<Step> = (0..graph.quads.len()).map(|q| Step::new(graph, &laplacian, q)).collect();
        let jump = |q: usize, k: usize, [from, to]: [usize; 2]| {
            let offsets = form(q, k);
            f64::from(offsets[to] - offsets[from])
        };
        let mut residual = 0.0;
        let mut functions: Vec<Vec<Complex64>> = (0..loops)
            .map(|k| {
                let (z, relative) = black(graph, &laplacian, &steps, |q, corners| jump(q, k, corners));
                // `f64::max` would pass over a NaN.
                residual = if relative <= residual { residual } else { relative };
                z
            })
            .collect();
        if residual.is_nan() || residual > ACCEPTED_RESIDUAL {
            return Err(DifferentialsError::Inaccurate { residual, limit: ACCEPTED_RESIDUAL });
        }
        let white = white(graph, &steps, &mut functions, jump).ok_or(DifferentialsError::NotSplit { loops })?;
        let (basis, white_to_black) = holomorphic(&white).ok_or(DifferentialsError::NotSplit { loops })?;
        let z = combined(graph, &laplacian, &functions, &basis, &white_to_black)
            .ok_or(DifferentialsError::NotSplit { loops })?;
        let genus = loops / 2;
        Ok(Differentials { z, periods: basis.rows(genus, genus).into_owned(), white_to_black, residual })
    }
}

/// A quad with its corners in the order (i, g, j, f) of (2), as numbers among its own corners.
struct Step {
    vertices: [usize; 4],
    black: [usize; 2],
    white: [usize; 2],
    rho: Complex64,
}

impl Step {
    fn new(graph: &QuadGraph, laplacian: &ConformalLaplacian, q: usize) -> Self {
        let quad = laplacian.colouring().quad(graph, q);
        let first_is_black = laplacian.colouring().is_black(graph.quads[q][0]);
        let (black, white) = if first_is_black { ([0, 2], [1, 3]) } else { ([1, 3], [2, 0]) };
        let [i, j] = quad.black.map(|v| v as usize);
        let [g, f] = quad.white.map(|v| v as usize);
        Step { vertices: [i, g, j, f], black, white, rho: quad.rho }
    }

    /// ρ (z_j − z_i), z with the given period along the diagonal.
    fn flux(&self, z: &[Complex64], along: f64) -> Complex64 {
        let [i, _, j, _] = self.vertices;
        self.rho * (z[j] - z[i] + along)
    }
}

/// The black function with `L z = 0` and the periods of one loop, refined once, and its residual.
fn black(
    graph: &QuadGraph,
    laplacian: &ConformalLaplacian,
    steps: &[Step],
    jump: impl Fn(usize, [usize; 2]) -> f64,
) -> (Vec<Complex64>, f64) {
    let mut z = vec![Complex64::ZERO; graph.vertices];
    let mut work = laplacian.work();
    let mut relative = 0.0;
    for is_last in [false, false, true] {
        let mut sum = vec![Complex64::ZERO; graph.vertices];
        let mut scale = vec![0.0; graph.vertices];
        for (q, step) in steps.iter().enumerate() {
            let [i, _, j, _] = step.vertices;
            let flux = step.flux(&z, jump(q, step.black));
            sum[i] += flux;
            sum[j] -= flux;
            let size = step.rho.norm() * (z[i].norm() + z[j].norm() + jump(q, step.black).abs());
            scale[i] += size;
            scale[j] += size;
        }
        if is_last {
            for (sum, scale) in sum.iter().zip(&scale).filter(|(sum, _)| **sum != Complex64::ZERO) {
                let here = sum.norm() / scale;
                relative = if here <= relative { relative } else { here };
            }
            break;
        }
        let mut y: Vec<Complex64> = laplacian.inner().iter().map(|&v| sum[v as usize]).collect();
        laplacian.inner_solve(&mut y, &mut work);
        for (&v, y) in laplacian.inner().iter().zip(&y) {
            z[v as usize] += y;
        }
    }
    (z, relative)
}

/// Writes the white values of every function by (2), and returns their periods: the matrix P. `None` where the loops do not determine it.
///
/// Values on the cover follow along a tree of quads; every other quad closes a loop, and has one equation for the periods.
fn white(
    graph: &QuadGraph,
    steps: &[Step],
    functions: &mut [Vec<Complex64>],
    jump: impl Fn(usize, usize, [usize; 2]) -> f64,
) -> Option<DMatrix<Complex64>> {
    let loops = functions.len();
    let incidence = graph.incidence();
    let start = steps.first()?.vertices[1];
    // How many times each loop was gone around on the way along the tree (nv × loops).
    let mut turns = vec![0.0; graph.vertices * loops];
    let mut reached = vec![false; graph.vertices];
    let mut in_tree = vec![false; steps.len()];
    reached[start] = true;
    let mut queue = vec![start];
    let mut head = 0;
    while let Some(&from) = queue.get(head) {
        head += 1;
        for &q in incidence.of(from as u32) {
            let q = q as usize;
            let [_, g, _, f] = steps[q].vertices;
            let (to, sign) = if from == g { (f, 1.0) } else { (g, -1.0) };
            if std::mem::replace(&mut reached[to], true) {
                continue;
            }
            in_tree[q] = true;
            for (k, z) in functions.iter_mut().enumerate() {
                z[to] = z[from] + sign * Complex64::I * steps[q].flux(z, jump(q, k, steps[q].black));
                turns[to * loops + k] = turns[from * loops + k] + sign * jump(q, k, steps[q].white);
            }
            queue.push(to);
        }
    }
    let mut matrix = DMatrix::<Complex64>::zeros(loops, loops);
    let mut right = DMatrix::<Complex64>::zeros(loops, loops);
    let mut around = vec![0.0; loops];
    for (q, step) in steps.iter().enumerate().filter(|(q, _)| !in_tree[*q]) {
        let [_, g, _, f] = step.vertices;
        for (k, around) in around.iter_mut().enumerate() {
            *around = turns[g * loops + k] + jump(q, k, step.white) - turns[f * loops + k];
        }
        if around.iter().all(|n| *n == 0.0) {
            continue;
        }
        for (k, z) in functions.iter().enumerate() {
            let gap = Complex64::I * step.flux(z, jump(q, k, step.black)) - (z[f] - z[g]);
            for (l, n) in around.iter().enumerate() {
                matrix[(l, k)] += n * around[k];
                right[(l, k)] += n * gap;
            }
        }
    }
    let periods = matrix.try_inverse()? * right;
    for (k, z) in functions.iter_mut().enumerate() {
        for &v in &queue {
            z[v] -= (0..loops).map(|l| turns[v * loops + l] * periods[(l, k)]).sum::<Complex64>();
        }
    }
    Some(periods)
}

/// The periods of holomorphic functions (2g × g), the first g rows the unit matrix, and those of their white values divided by them (g × g).
///
/// The projector on the eigenvectors of P with eigenvalues of positive real part is (1 + sign P)/2.
fn holomorphic(white: &DMatrix<Complex64>) -> Option<(DMatrix<Complex64>, DMatrix<Complex64>)> {
    let (loops, genus) = (white.nrows(), white.nrows() / 2);
    let mut sign = white.clone();
    for _ in 0..SIGN_STEPS {
        let next = (&sign + sign.clone().try_inverse()?) * Complex64::from(0.5);
        let change = (&next - &sign).norm();
        sign = next;
        if change <= 1e-15 * sign.norm() {
            break;
        }
    }
    let projector = (DMatrix::identity(loops, loops) + sign) * Complex64::from(0.5);
    let trace = projector.trace();
    if (trace - genus as f64).norm() > 1e-6 {
        return None;
    }
    let columns = projector.columns(0, genus).into_owned();
    let basis = &columns * columns.rows(0, genus).into_owned().try_inverse()?;
    let white_to_black = (white * &basis).rows(0, genus).into_owned();
    Some((basis, white_to_black))
}

/// The functions with the periods of each column of `basis`, white values divided so that they have the periods of the black ones.
fn combined(
    graph: &QuadGraph,
    laplacian: &ConformalLaplacian,
    functions: &[Vec<Complex64>],
    basis: &DMatrix<Complex64>,
    white_to_black: &DMatrix<Complex64>,
) -> Option<Vec<Vec<Complex64>>> {
    let scaled = basis * white_to_black.clone().try_inverse()?;
    let value = |v: usize, j: usize| -> Complex64 {
        let coefficients = if laplacian.colouring().is_black(v as u32) { basis } else { &scaled };
        functions.iter().enumerate().map(|(k, z)| coefficients[(k, j)] * z[v]).sum()
    };
    Some((0..basis.ncols()).map(|j| (0..graph.vertices).map(|v| value(v, j)).collect()).collect())
}
