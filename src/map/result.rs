//! A map and how it was found.

use num_complex::Complex64;

use super::Provenance;
use crate::constraint::Fixed;
use crate::solver::Status;

/// The ending of a computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// A direct solver solved the problem.
    Solved,
    /// An iterative solver ended with this status.
    Minimised(Status),
}

impl Ending {
    /// The name in reports.
    pub fn name(self) -> &'static str {
        match self {
            Ending::Solved => "solved",
            Ending::Minimised(status) => status.name(),
        }
    }
}

/// A condition that a map meets exactly, not only as the minimum of an energy.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exactly {
    /// The boundary is on the unit circle.
    Circle,
    /// (2) on every quad.
    Conformal,
    /// The mesh's boundary edges have the lengths asked for, and (2) holds on every quad; on quad meshes H is the lowest under that.
    Lengths,
}

/// A map and the record of its computation.
#[derive(Clone, Debug)]
pub struct Map {
    /// The image of every vertex of the quad graph (`nv`).
    pub z: Vec<Complex64>,
    /// The pinned vertices.
    pub fixed: Fixed,
    /// The energy; `None` if its weights are undefined (Re ρ ≤ 0).
    pub total: Option<f64>,
    /// The terms of the energy, without their coefficients.
    pub energies: Vec<(&'static str, f64)>,
    /// |∇E| over the free unknowns, Euclidean.
    pub gradient_norm: Option<f64>,
    /// The solver that found it, and what was tried before.
    pub provenance: Provenance,
    /// How the computation ended.
    pub ending: Ending,
    /// The number of iterations of all stages.
    pub iterations: usize,
    /// The relative residual of a direct solver: of (2) if that is square, else of the normal equations.
    pub residual: Option<f64>,
    /// The smallest singular value of the Jacobian of the residuals, for circle maps.
    pub smallest_singular_value: Option<f64>,
    /// Whether the boundary is to be on the unit circle.
    pub on_circle: bool,
    /// Whether the pinned points are at their positions under the exact map of the surface.
    pub anchored: bool,
    /// The condition that is met exactly; `None` for the minimum of an energy.
    pub exactly: Option<Exactly>,
    /// Circle maps with H = 0: half the difference ε of the squared radii, `|b|² = 1 + ε` on black and `|w|² = 1 − ε` on white
    /// boundary points before the map is scaled.
    pub epsilon: Option<f64>,
}

impl Map {
    /// The map z of a direct solver, with H as its only energy if `h` is known.
    pub(crate) fn solved(solver: &'static str, z: Vec<Complex64>, fixed: Fixed, h: Option<f64>) -> Map {
        Map {
            z,
            fixed,
            total: h,
            energies: h.map(|h| ("H", h)).into_iter().collect(),
            gradient_norm: None,
            provenance: Provenance::of(solver),
            ending: Ending::Solved,
            iterations: 0,
            residual: None,
            smallest_singular_value: None,
            on_circle: false,
            anchored: false,
            exactly: None,
            epsilon: None,
        }
    }
}
