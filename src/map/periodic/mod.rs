//! Conformal maps of closed surfaces of genus 1 to a torus ℂ / (Z + τZ) (design: §6): no cut, but two periods, one of
//! which is part of the solution.
//!
//! 1. [`Homology`]: two loops γ1, γ2, and closed integer 1-forms that count crossings of them;
//! 2. [`Periods`]: by these, the lifts of each quad's corners, `z_v + m ω1 + n ω2`;
//! 3. [`Differentials`]: the holomorphic function with the periods 1 and τ, by the periods P of white values as functions of those
//!    of black ones. With unit weights, or where some loop of the mesh has an odd number of edges so that there is no black and white,
//!    [`Harmonic`]: u1, u2 with the periods (1, 0), (0, 1), the matrix of H(ω) for `z = u1 ω1 + u2 ω2`, and the ratio that minimises H for an
//!    image of given area, [`ratio`](crate::solver::linear::periodic::PeriodEnergy::ratio);
//! 4. [`reduce`]: τ in the fundamental domain, with its basis; loops of that basis; [`PeriodicMap::unfold`]: faces laid out.

mod float;
mod modulus;
mod record;
mod tiling;
mod unfold;

pub use modulus::{NotReducible, Reduced, apply, reduce, relative_error};
pub use record::{LoopRecord, PeriodsRecord};
pub use tiling::{ACCEPTED_SHEAR, Texture, Tiling, checker, whole};
pub use unfold::Unfolded;

use num_complex::Complex64;

use crate::energy::conformal::{self, Weight};
use crate::laplacian::LaplacianError;
use crate::quad_graph::{Periods, PeriodsError, QuadGraph};
use crate::solver::Observer;
use crate::solver::boundary::{Differentials, DifferentialsError, PERIODS_NAME};
use crate::solver::linear::periodic::{Harmonic, HarmonicError};
use crate::surface::edges::Edges;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::homology::{Cycle, Homology, HomologyError};

/// A map z of the universal cover with `z(γ1 x) = z(x) + 1`, `z(γ2 x) = z(x) + τ`.
#[derive(Clone, Debug)]
pub struct PeriodicMap {
    /// One lift of every vertex of the quad graph (`nv`); vertex 0 is at 0.
    pub z: Vec<Complex64>,
    /// The period along γ2, that along γ1 being 1, in the fundamental domain: see [`Reduced`].
    pub tau: Complex64,
    /// How corners of quads and faces lie in the cover, in the basis (1, τ).
    pub periods: Periods,
    /// Loops of the mesh in the classes of γ1 and γ2, short ones; vertices as the disc numbers them.
    pub loops: [Cycle; 2],
    /// The ratio in the basis of shortest loops that the mesh was first given, and the change of basis to τ.
    pub found: Reduced,
    /// The ratio in that basis, before the change.
    pub tau_found: Complex64,
    /// The periods of the white values of (2) divided by those of the black ones, 1 + O(h²): the white values are divided by it.
    /// `None` for periods by least squares.
    pub white_to_black: Option<Complex64>,
    /// H of the map, whose image has the area Im τ.
    pub h: f64,
    /// The relative residual of the linear equations.
    pub residual: f64,
    /// The factorisation used.
    pub backend: &'static str,
}

/// No periodic map.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PeriodicError {
    /// A surface that is not closed of genus 1.
    #[error(transparent)]
    Homology(#[from] HomologyError),
    /// Offsets that fail.
    #[error(transparent)]
    Periods(#[from] PeriodsError),
    /// No harmonic functions.
    #[error(transparent)]
    Harmonic(#[from] HarmonicError),
    /// No holomorphic function.
    #[error(transparent)]
    Differentials(#[from] DifferentialsError),
    /// Periods of no torus.
    #[error(transparent)]
    NotReducible(#[from] NotReducible),
}

/// The conformal map of the closed surface `disc`, of genus 1, with the quad graph `graph`.
///
/// With integral weights by [`Differentials`], H = 0 but for the factor that makes black and white periods equal. With unit weights, and on
/// meshes without black and white, the least H of all maps of a given area and of all periods.
///
/// # Errors
/// Another surface; integral weights where some Re ρ ≤ 0; a factorisation that breaks down.
pub fn periodic(
    disc: &OrientedMesh,
    graph: &QuadGraph,
    weight: Weight,
    watch: &mut dyn Observer,
) -> Result<PeriodicMap, PeriodicError> {
    periodic_from(disc, graph, weight, 0, watch)
}

/// The same with the first basis taken from loops through the vertex `root`.
///
/// # Errors
/// As [`periodic`].
pub fn periodic_from(
    disc: &OrientedMesh,
    graph: &QuadGraph,
    weight: Weight,
    root: u32,
    watch: &mut dyn Observer,
) -> Result<PeriodicMap, PeriodicError> {
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let homology = Homology::new(disc, &edges, root)?;
    let mut periods = Periods::new(disc, graph, &edges, &homology)?;
    drop(edges);
    let weights = conformal::weights(graph, weight).map_err(HarmonicError::from)?;
    let Cover { z: lifted, tau: tau_found, white_to_black, residual, backend } = cover(graph, &periods, weight, watch)?;
    let found = reduce(tau_found)?;
    let Reduced { tau, matrix } = found;
    let [[a, b], [c, d]] = matrix;
    periods.change_basis(matrix)?;
    let loops = [homology.cycle(disc, [d, c])?, homology.cycle(disc, [b, a])?];

    // ω1' = cω2 + dω1 becomes 1, for ω1 = 1.
    let scale = (c as f64 * tau_found + d as f64).inv();
    let mut z: Vec<Complex64> = lifted.iter().map(|z| z * scale).collect();
    float::white(disc, graph, &periods, [Complex64::ONE, tau], &mut z);
    let mut map = PeriodicMap { z, tau, periods, loops, found, tau_found, white_to_black, h: 0.0, residual, backend };
    let squares = weights.iter().enumerate().map(|(q, w)| w * map.residual(graph, q).norm_sqr());
    map.h = squares.sum();
    Ok(map)
}

/// A map with the periods 1 and τ in the first basis.
struct Cover {
    z: Vec<Complex64>,
    tau: Complex64,
    white_to_black: Option<Complex64>,
    residual: f64,
    backend: &'static str,
}

/// By the conformal Laplacian, or by least squares where that does not exist or unit weights are asked for.
fn cover(
    graph: &QuadGraph,
    periods: &Periods,
    weight: Weight,
    watch: &mut dyn Observer,
) -> Result<Cover, PeriodicError> {
    if weight == Weight::Integral {
        match Differentials::new(graph, 2, |q, k| periods.quads[q].map(|offset| offset[k]), watch) {
            Ok(Differentials { mut z, periods, white_to_black, residual }) => {
                let white_to_black = Some(white_to_black[(0, 0)]);
                let z = z.swap_remove(0);
                return Ok(Cover { z, tau: periods[(0, 0)], white_to_black, residual, backend: PERIODS_NAME });
            }
            Err(DifferentialsError::Laplacian(LaplacianError::NotTwoColoured { .. })) => {}
            Err(error) => return Err(error.into()),
        }
    }
    let Harmonic { u: [u1, u2], energy, residual, backend } = Harmonic::new(graph, periods, weight, watch)?;
    let tau = energy.ratio();
    let z = u1.iter().zip(&u2).map(|(u1, u2)| u1 + u2 * tau).collect();
    Ok(Cover { z, tau, white_to_black: None, residual, backend })
}

impl PeriodicMap {
    /// 1 and τ.
    pub fn omega(&self) -> [Complex64; 2] {
        [Complex64::ONE, self.tau]
    }

    /// The corners of quad `q` of the quad graph, side by side.
    pub fn quad(&self, graph: &QuadGraph, q: usize) -> [Complex64; 4] {
        self.periods.lifted(graph, q, &self.z, self.omega())
    }

    /// The residual of (2) on quad `q`.
    pub fn residual(&self, graph: &QuadGraph, q: usize) -> Complex64 {
        conformal::residual_at(graph.rho[q], self.quad(graph, q))
    }

    /// The corner `c` of a face of the mesh, beside that face's first corner.
    pub fn corner(&self, disc: &OrientedMesh, c: usize) -> Complex64 {
        self.z[disc.faces.corners()[c] as usize] + Periods::translation(self.periods.corners[c], self.omega())
    }
}
