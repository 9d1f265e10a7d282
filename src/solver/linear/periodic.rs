//! Harmonic functions with given periods on a closed surface of genus 1, and the matrix of their
//! energies.

use num_complex::Complex64;

use crate::constraint::{Elimination, Fixed};
use crate::energy::conformal::{self, NonPositiveRho, Weight};
use crate::geometry::maximum::max_or_nan;
use crate::quad_graph::{Periods, QuadGraph};
use crate::solver::linear::normal::{assemble, in_real_columns, pattern, real_values, solve_and_refine};
use crate::solver::{Observer, Phase};
use crate::sparse::{Analysis, Breakdown};

/// The harmonic functions u1, u2 with the periods (1, 0) and (0, 1), each of which minimises H.
///
/// The minimiser of H with periods ω1, ω2 is `z = u1 ω1 + u2 ω2`, and `H = ω̄ᵀ P ω`.
#[derive(Clone, Debug)]
pub struct Harmonic {
    /// u1 and u2 (`nv` each; 0 at the first vertex of each diagonal class). Real with integral weights.
    pub u: [Vec<Complex64>; 2],
    /// `P_jk = Σ w r̄_j r_k`, where r_k are the residuals of (2) for u_k; Hermitian.
    pub energy: PeriodEnergy,
    /// The largest entry of the normal equations `Aᴴ W A u` at a vertex, relative to `|Aᴴ| W |A|
    /// |u|`.
    pub residual: f64,
    /// Name of the linear solver with the same factorisation.
    pub backend: &'static str,
}

/// The Hermitian matrix of the quadratic form `H(ω) = P11 |ω1|² + 2 Re(ω̄1 P12 ω2) + P22 |ω2|²`.
///
/// With integral weights H is the Dirichlet energy minus the area `Im(ω̄1 ω2)`: P = D + iK, where D
/// is real and K12 = ½.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PeriodEnergy {
    /// P11.
    pub p11: f64,
    /// P12.
    pub p12: Complex64,
    /// P22.
    pub p22: f64,
}

impl PeriodEnergy {
    /// √(P11 P22 − (Re P12)²)
    fn root(&self) -> f64 {
        (self.p11 * self.p22 - self.p12.re * self.p12.re).sqrt()
    }

    /// Returns the ratio ω2/ω1 that minimises H for an image of area 1:
    ///
    /// ```text
    /// τ = (−Re P12 + i √(P11 P22 − (Re P12)²)) / P22
    /// ```
    ///
    /// Under a change of basis it transforms like the periods, so that the shape of the image does
    /// not depend on the basis. The minimum of H for ω1 = 1 instead,
    /// [`PeriodEnergy::least_squares`], favours small images: its τ has the same real part and an
    /// imaginary part that is too small by the factor `2 √det`, which is 1 + O(h²).
    pub fn ratio(&self) -> Complex64 {
        Complex64::new(-self.p12.re, self.root()) / self.p22
    }

    /// Returns the ratio that minimises H for ω1 = 1: `τ = −P̄12 / P22`, with integral weights
    /// `(−Re P12 + i/2) / P22`.
    pub fn least_squares(&self) -> Complex64 {
        -self.p12.conj() / self.p22
    }

    /// Returns the minimum of H for an image of area 1, `2 √(P11 P22 − (Re P12)²) − 2 Im P12`.
    pub fn least(&self) -> f64 {
        2.0 * (self.root() - self.p12.im)
    }
}

/// The harmonic functions cannot be computed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HarmonicError {
    /// Integral weights are undefined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// A pivot is not positive.
    #[error(
        "the normal equations of {size} unknowns are not positive definite to rounding: the mesh has nearly degenerate \
         faces; repair these, or use another dual point"
    )]
    NotPositiveDefinite {
        /// Number of unknowns.
        size: usize,
    },
    /// The factor does not fit into memory or its indices.
    #[error("the factor of {size} unknowns does not fit into memory or its indices")]
    TooLarge {
        /// Number of unknowns.
        size: usize,
    },
    /// The residual of the solution is too large.
    #[error(
        "the normal equations have a relative residual of {residual:e}, above {limit:e}: the mesh is too badly conditioned; repair nearly \
         degenerate faces, or use another dual point"
    )]
    Inaccurate {
        /// The relative residual.
        residual: f64,
        /// The largest accepted residual.
        limit: f64,
    },
}

const UNIT: [[Complex64; 2]; 2] = [[Complex64::ONE, Complex64::ZERO], [Complex64::ZERO, Complex64::ONE]];

impl Harmonic {
    /// Solves for u1 and u2 by one factorisation. With integral weights it is real: `Aᴴ W A = D +
    /// iK`, and K, which involves only boundary vertices, is 0.
    ///
    /// # Errors
    /// [`HarmonicError`].
    pub fn new(
        graph: &QuadGraph,
        periods: &Periods,
        weight: Weight,
        watch: &mut dyn Observer,
    ) -> Result<Self, HarmonicError> {
        let weights = conformal::weights(graph, weight)?;
        watch.phase(Phase::Assemble);
        let elimination = hold_classes(graph);
        let size = elimination.unknowns();
        let (u, backend) = match weight {
            Weight::Integral => (real(graph, periods, &weights, &elimination, watch), "cholesky-real"),
            Weight::Unit => (hermitian(graph, periods, &weights, &elimination, watch), "cholesky"),
        };
        let u = u.map_err(|breakdown| match breakdown {
            Breakdown::NotPositiveDefinite | Breakdown::Singular => HarmonicError::NotPositiveDefinite { size },
            Breakdown::TooLarge => HarmonicError::TooLarge { size },
        })?;
        let mut residual = 0.0;
        for (u, omega) in u.iter().zip(UNIT) {
            let corners = |q| periods.lifted(graph, q, u, omega);
            let product = conformal::normal_product_at(graph, &weights, corners);
            let scale = conformal::normal_product_scale_at(graph, &weights, corners);
            for &v in &elimination.free {
                let relative = product[v as usize].norm() / scale[v as usize].max(f64::MIN_POSITIVE);
                residual = max_or_nan(residual, relative);
            }
        }
        if residual.is_nan() || residual > crate::solver::linear::ACCEPTED_RESIDUAL {
            return Err(HarmonicError::Inaccurate { residual, limit: crate::solver::linear::ACCEPTED_RESIDUAL });
        }
        let energy = energy(graph, periods, &weights, &u);
        Ok(Harmonic { u, energy, residual, backend })
    }
}

/// Pins the first vertex of each diagonal class at 0, because H depends only on differences within
/// a class.
fn hold_classes(graph: &QuadGraph) -> Elimination {
    let (class, classes) = graph.diagonal_classes();
    let mut fixed = Fixed::default();
    let mut held = vec![false; classes];
    for (v, &k) in class.iter().enumerate() {
        if !std::mem::replace(&mut held[k as usize], true) {
            fixed.hold(v as u32, Complex64::ZERO);
        }
    }
    Elimination::new(graph.vertices, &fixed)
}

/// Computes both functions at once, as the real and the imaginary part of one function with the
/// periods 1 and i.
fn real(
    graph: &QuadGraph,
    periods: &Periods,
    weights: &[f64],
    elimination: &Elimination,
    watch: &mut dyn Observer,
) -> Result<[Vec<Complex64>; 2], Breakdown> {
    let pattern = pattern(graph, elimination);
    let values = real_values(&pattern, graph, elimination, weights);
    watch.phase(Phase::Factor);
    let columns = pattern.into_columns();
    let analysis = Analysis::new(&columns)?;
    let factor = analysis.factorise(&values, None)?;
    watch.phase(Phase::Solve);
    let both = [Complex64::ONE, Complex64::I];
    let product = |z: &[Complex64]| conformal::normal_product_at(graph, weights, |q| periods.lifted(graph, q, z, both));
    let z = solve_and_refine(elimination, product, |y| in_real_columns(y, |c| factor.solve_in_place(c)));
    Ok([z.iter().map(|z| z.re.into()).collect(), z.iter().map(|z| z.im.into()).collect()])
}

fn hermitian(
    graph: &QuadGraph,
    periods: &Periods,
    weights: &[f64],
    elimination: &Elimination,
    watch: &mut dyn Observer,
) -> Result<[Vec<Complex64>; 2], Breakdown> {
    let pattern = pattern(graph, elimination);
    let block = |q: usize| conformal::block(graph.rho[q], weights[q]);
    let values = assemble(&pattern, graph, elimination, Complex64::ZERO, block);
    watch.phase(Phase::Factor);
    let columns = pattern.into_columns();
    let analysis = Analysis::new(&columns)?;
    let factor = analysis.factorise(&values, None)?;
    watch.phase(Phase::Solve);
    Ok(UNIT.map(|omega| {
        let product =
            |z: &[Complex64]| conformal::normal_product_at(graph, weights, |q| periods.lifted(graph, q, z, omega));
        solve_and_refine(elimination, product, |y| factor.solve_in_place(y))
    }))
}

fn energy(graph: &QuadGraph, periods: &Periods, weights: &[f64], u: &[Vec<Complex64>; 2]) -> PeriodEnergy {
    let mut energy = PeriodEnergy { p11: 0.0, p12: Complex64::ZERO, p22: 0.0 };
    for (q, &w) in weights.iter().enumerate() {
        let residual = |k: usize| conformal::residual_at(graph.rho[q], periods.lifted(graph, q, &u[k], UNIT[k]));
        let (r1, r2) = (residual(0), residual(1));
        energy.p11 += w * r1.norm_sqr();
        energy.p12 += w * r1.conj() * r2;
        energy.p22 += w * r2.norm_sqr();
    }
    energy
}
