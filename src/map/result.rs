//! A map and how it was found.

use num_complex::Complex64;

use super::Provenance;
use crate::constraint::Fixed;
use crate::solver::Status;

/// How the computation of a map ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// By a direct solver.
    Solved,
    /// By iteration; see there.
    Minimised(Status),
}

impl Ending {
    /// As in reports.
    pub fn name(self) -> &'static str {
        match self {
            Ending::Solved => "solved",
            Ending::Minimised(status) => status.name(),
        }
    }
}

/// What a map meets exactly, where an energy would only draw it there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exactly {
    /// The boundary is on the unit circle.
    Circle,
    /// (2) on every quad.
    Conformal,
    /// The boundary edges have their rest lengths.
    Lengths,
}

/// A map and what is known of it.
#[derive(Clone, Debug)]
pub struct Map {
    /// The image of every vertex of the quad graph (`nv`).
    pub z: Vec<Complex64>,
    /// The vertices that were held.
    pub fixed: Fixed,
    /// The energy that was minimised; `None` where its weights are undefined (Re ρ ≤ 0).
    pub total: Option<f64>,
    /// Its terms, without their coefficients.
    pub energies: Vec<(&'static str, f64)>,
    /// |∇E| over the free unknowns, Euclidean.
    pub gradient_norm: Option<f64>,
    /// How it came about.
    pub provenance: Provenance,
    /// How it ended.
    pub ending: Ending,
    /// Iterations, of all stages.
    pub iterations: usize,
    /// Direct solvers: the relative residual reached, of (2) where that is square, else of the normal equations.
    pub residual: Option<f64>,
    /// Circle maps: the smallest singular value of the Jacobian of the residuals.
    pub smallest_singular_value: Option<f64>,
    /// Whether the boundary was to be on the unit circle.
    pub on_circle: bool,
    /// Whether the held points are where the exact map of the surface has them.
    pub anchored: bool,
    /// What was solved for exactly; `None`: the energy's minimum.
    pub exactly: Option<Exactly>,
    /// Circle maps with H = 0: half the difference ε of the squared radii, `|b|² = 1 + ε` on black and `|w|² = 1 − ε` on white
    /// boundary points before the map is scaled.
    pub epsilon: Option<f64>,
}

impl Map {
    /// The map z of a direct solver, H its only energy where `h` is known; nothing else is said of it.
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
