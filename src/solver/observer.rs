//! What solvers tell while they work. Clocks and progress displays live behind [`Observer`], not in the solvers.

/// What a solver is doing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Phase {
    /// Building matrices.
    Assemble,
    /// Ordering the unknowns by nested dissection. Minimum degree is part of the factorisation.
    Order,
    /// Factorising them.
    Factor,
    /// Solving with the factors; iterating.
    Solve,
    /// Measuring the solution.
    Measure,
}

/// The repair of a map that is not injective.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repair {
    /// Faces are unflipped in one part of the map.
    Part {
        /// Number of the part, from 1.
        number: usize,
        /// Number of the parts.
        count: usize,
    },
    /// The whole map is replaced by a bijective one.
    Whole,
}

/// One iteration of a nonlinear solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Iteration {
    /// Its number; 0 is the start.
    pub number: usize,
    /// The energy.
    pub total: f64,
    /// Its terms, without their coefficients; empty where they were not asked for.
    pub terms: Vec<(&'static str, f64)>,
    /// Euclidean norm of the gradient.
    pub gradient_norm: f64,
    /// Euclidean norm of the step that led here.
    pub step: f64,
}

/// Listens to a solver.
pub trait Observer {
    /// A phase begins.
    fn phase(&mut self, phase: Phase);

    /// A repair begins; phases and iterations belong to it from now on.
    fn repair(&mut self, _repair: Repair) {}

    /// An iteration has ended.
    fn iteration(&mut self, _iteration: &Iteration) {}

    /// Whether iterations should come with their energies term by term.
    fn wants_terms(&self) -> bool {
        false
    }

    /// Whether the solver should stop and return the best state it has.
    fn stop_requested(&self) -> bool {
        false
    }
}

/// Hears nothing.
pub struct Silent;

impl Observer for Silent {
    fn phase(&mut self, _phase: Phase) {}
}
