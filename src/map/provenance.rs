//! The history of a map: which solver found it, and what it replaces.

/// The solver that found a map, what was tried before it, and what the map replaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Provenance {
    /// Name of the solver.
    pub solver: &'static str,
    /// A solver that was tried before this one, and why its result was not kept.
    pub after: Option<Setback>,
    /// Set where the map replaces another one that was computed first.
    pub replaced: Option<Replaced>,
}

/// Why the result of a solver on the boundary was not kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Setback {
    /// It did not converge.
    Stalled {
        /// Iterations made.
        iterations: usize,
    },
    /// It mapped boundary points out of order.
    OutOfOrder,
}

/// A map that was computed first and is not the result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Replaced {
    /// How the result was found instead.
    pub by: Replacement,
    /// Number of faces that the first map flips; `None` where it did not converge.
    pub flipped: Option<usize>,
}

/// How a map that replaces another one was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Replacement {
    /// The vertices around the flipped faces were moved, the others were not.
    Locally,
    /// A bijective map was computed anew.
    Wholly,
    /// A bijective map of lower mean quasi-conformal distortion was computed anew, though the first map is injective.
    LessDistorted {
        /// The mean of σ1/σ2 of the first map.
        mean: f64,
    },
    /// A convex combination map with other weights was computed.
    OtherWeights,
}

impl Provenance {
    /// Found by `solver`, at once.
    pub fn of(solver: &'static str) -> Self {
        Provenance { solver, after: None, replaced: None }
    }

    /// Whether the map replaces one that is not injective or did not converge.
    pub fn is_repaired(&self) -> bool {
        self.replaced.is_some_and(|replaced| !matches!(replaced.by, Replacement::LessDistorted { .. }))
    }

    /// Number of faces that the map flips which this one replaces.
    pub fn flipped(&self) -> Option<usize> {
        self.replaced.and_then(|replaced| replaced.flipped)
    }
}
