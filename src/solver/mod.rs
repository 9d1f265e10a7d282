//! Interchangeable solvers: direct ones for linear problems, iterative ones for the others.

pub mod boundary;
pub mod convex;
pub mod linear;
pub mod minimise;
mod observer;

pub use linear::{
    LINEAR_SOLVERS, LinearSolution, LinearSolver, SolveError, Unsuitable, automatic, linear_solver, solve_linear,
    solve_with,
};
pub use minimise::{MINIMISERS, MinimiseError, Minimiser, Minimum, Status, StopRule, minimiser};
pub use observer::{Iteration, Observer, Phase, Repair, Silent};

/// What `--solver` takes: `auto`, and all backends by name.
pub fn solver_names() -> Vec<&'static str> {
    let direct = LINEAR_SOLVERS.iter().map(|b| b.name());
    let iterative = MINIMISERS.iter().map(|m| m.name());
    ["auto", boundary::NAME].into_iter().chain(direct).chain(iterative).collect()
}
