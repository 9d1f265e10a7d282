//! Newton's method on the boundary values alone: circle maps and free maps with integral weights.

mod circle;
mod free;
mod mesh_edges;

pub(in crate::map) use circle::on_circle;

use num_complex::Complex64;

use super::{Attempt, Unsuitable};
use crate::energy::conformal::Weight;
use crate::energy::{Expression, Standard};
use crate::map::setup::Setup;
use crate::map::{MapError, MapOptions, SolverChoice};
use crate::solver::boundary::{self, BoundaryError, Reduction};
use crate::solver::{Observer, Phase};

/// The map whose boundary is exactly on the unit circle, or has exactly the given lengths, of lowest H.
///
/// # Errors
/// Pins that are not in use.
pub(in crate::map) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let options = setup.options;
    if !is_asked(options) && options.solver != SolverChoice::Auto {
        return Ok(Attempt::Unsuitable(Unsuitable::NotAsked));
    }
    let problem = match BoundaryProblem::of(options, &setup.expression) {
        Ok(problem) => problem,
        Err(reason) => return Ok(Attempt::Unsuitable(Unsuitable::Request(reason))),
    };
    match problem {
        BoundaryProblem::Circle => circle::solve(setup, watch),
        // The half edges of triangles zigzag if they are held; the edges of quads are those of the mesh.
        BoundaryProblem::Free if setup.domain.is_of_triangles() => match mesh_edges::solve(setup, watch)? {
            // The half edges give a minimiser a start that flips fewer faces (bunny_cut: none, where this one leads to 12).
            Attempt::Failed { .. } if !is_asked(options) => free::solve(setup, watch),
            attempt => Ok(attempt),
        },
        BoundaryProblem::Free => free::solve(setup, watch),
    }
}

/// The free map as a start for other energies; `None` where it is not found.
pub(in crate::map) fn free_start(setup: &Setup, watch: &mut dyn Observer) -> Option<Vec<Complex64>> {
    match setup.domain.is_of_triangles() {
        true => mesh_edges::start(setup, watch),
        false => free::start(setup, watch),
    }
}

/// Whether the user has named this method's solver.
pub(in crate::map) fn is_asked(options: &MapOptions) -> bool {
    options.solver.is_named(boundary::NAME)
}

/// The reduced operator of the problem's quad graph.
fn reduction<'a>(setup: &Setup<'a>, watch: &mut dyn Observer) -> Result<Reduction<'a>, BoundaryError> {
    watch.phase(Phase::Assemble);
    let reduction = Reduction::new(&setup.domain.graph, |phase| watch.phase(phase))?;
    watch.phase(Phase::Solve);
    Ok(reduction)
}

/// The problems that reduce to the boundary.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BoundaryProblem {
    /// H with the boundary on the unit circle, the limit of H + βC.
    Circle,
    /// H with the boundary edges of the mesh of their rest lengths; of quad meshes the limit of H + γ'L'.
    Free,
}

impl BoundaryProblem {
    /// The problem that is asked, or why it is none of these.
    fn of(options: &MapOptions, expression: &Expression) -> Result<Self, &'static str> {
        if options.weight != Weight::Integral {
            return Err("it needs integral weights");
        }
        if options.boundary.is_fixed() {
            return Err("the whole boundary is held");
        }
        // Other coefficients ask for a compromise between the terms, which this is not.
        if !expression.is_even() && !is_asked(options) {
            return Err("the coefficients are not 1");
        }
        match expression.as_standard() {
            Some(Standard::OnCircle) => Ok(BoundaryProblem::Circle),
            Some(Standard::OfLengths) if !options.holds_more() => Ok(BoundaryProblem::Free),
            Some(Standard::OfLengths) => Err("vertices of a free map are held"),
            _ => Err("the energy is neither H + C nor H + Lb"),
        }
    }
}

/// The energies with their coefficients.
fn total(expression: &Expression, energies: &[(&'static str, f64)]) -> f64 {
    let value = |name: &str| energies.iter().find(|(n, _)| *n == name).map_or(0.0, |(_, value)| *value);
    expression.terms().iter().map(|term| term.coefficient * value(term.energy.name())).sum()
}
