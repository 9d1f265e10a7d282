//! Constraints and solvers supplied by the user of the library.

use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use crate::solver::{LinearSolver, Minimiser};

/// A shared value supplied by the user of the library; it equals only its own clones.
pub struct Own<T: ?Sized>(Arc<T>);

impl<T: ?Sized> Own<T> {
    /// The value of an `Arc`, which may be one of a trait object.
    pub fn new(value: Arc<T>) -> Self {
        Own(value)
    }
}

impl<T: ?Sized> Clone for Own<T> {
    fn clone(&self) -> Self {
        Own(Arc::clone(&self.0))
    }
}

impl<T: ?Sized> Deref for Own<T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: ?Sized> PartialEq for Own<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T: ?Sized> fmt::Debug for Own<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str("Own")
    }
}

/// Which solver finds a map.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum SolverChoice {
    /// The fastest solver that suits the problem.
    #[default]
    Auto,
    /// The solver of this name: [`solver_names`](crate::solver::solver_names) has all.
    Named(String),
    /// A linear solver supplied by the user: for H with the boundary fixed.
    Linear(Own<dyn LinearSolver>),
    /// A minimiser supplied by the user: for all other problems.
    Minimiser(Own<dyn Minimiser>),
}

impl SolverChoice {
    /// Its name; `auto` where none was chosen.
    pub fn name(&self) -> &str {
        match self {
            SolverChoice::Auto => "auto",
            SolverChoice::Named(name) => name,
            SolverChoice::Linear(solver) => solver.name(),
            SolverChoice::Minimiser(minimiser) => minimiser.name(),
        }
    }

    /// Whether the solver of this name was chosen from the tables.
    pub fn is_named(&self, name: &str) -> bool {
        matches!(self, SolverChoice::Named(chosen) if chosen == name)
    }
}

impl From<&str> for SolverChoice {
    fn from(name: &str) -> Self {
        match name {
            "auto" => SolverChoice::Auto,
            name => SolverChoice::Named(name.to_owned()),
        }
    }
}

impl From<String> for SolverChoice {
    fn from(name: String) -> Self {
        SolverChoice::from(name.as_str())
    }
}
