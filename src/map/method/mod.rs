//! The methods that find a map. Each takes a [`Setup`](super::setup::Setup) and says how far it came; none names another.
//!
//! | method | problems | solver |
//! |---|---|---|
//! | [`convex`] | the boundary fixed, inner vertices at weighted means of their neighbours | one sparse LU factorisation |
//! | [`direct`] | H with the boundary fixed | a direct solver |
//! | [`boundary`] | H with the boundary exactly on a circle, or exactly of given lengths | Newton's method on the boundary values |
//! | [`minimise`] | any sum of energies | an iterative minimiser |

pub(super) mod boundary;
pub(super) mod convex;
pub(super) mod direct;
pub(super) mod minimise;

use num_complex::Complex64;

use super::{Map, MapError};
use crate::solver::boundary::{BoundaryError, TwoCirclesError};

/// How far a method came.
pub(super) enum Attempt {
    /// It found a map.
    Solved(Box<Map>),
    /// The problem is not one that it solves.
    Unsuitable(Unsuitable),
    /// It did not converge.
    Failed {
        /// Why.
        reason: MapError,
        /// Iterations made.
        iterations: usize,
        /// A map from which another method may start (`nv`).
        start: Option<Vec<Complex64>>,
    },
}

impl Attempt {
    /// A map that was found.
    fn solved(map: Map) -> Self {
        Attempt::Solved(Box::new(map))
    }

    /// No convergence.
    fn failed(reason: BoundaryError, start: Option<Vec<Complex64>>) -> Self {
        let iterations = match reason {
            BoundaryError::Stalled { iterations, .. }
            | BoundaryError::TwoCircles(TwoCirclesError::Stalled { iterations, .. }) => iterations,
            _ => 0,
        };
        Attempt::Failed { reason: reason.into(), iterations, start }
    }

    /// The map, where no other method may find one.
    pub fn found(self) -> Result<Map, MapError> {
        match self {
            Attempt::Solved(map) => Ok(*map),
            Attempt::Unsuitable(reason) => Err(reason.into()),
            Attempt::Failed { reason, .. } => Err(reason),
        }
    }
}

/// Why a method does not solve a problem.
pub(super) enum Unsuitable {
    /// The user did not ask for this method, or asked for another one.
    NotAsked,
    /// The request is of another kind.
    Request(&'static str),
    /// The matrix that the method needs does not exist.
    Matrix(BoundaryError),
}

impl From<Unsuitable> for MapError {
    fn from(reason: Unsuitable) -> Self {
        match reason {
            Unsuitable::NotAsked => BoundaryError::Unsuitable { reason: "it was not asked for" }.into(),
            Unsuitable::Request(reason) => BoundaryError::Unsuitable { reason }.into(),
            Unsuitable::Matrix(error) => error.into(),
        }
    }
}
