//! Linear problems: H alone, with the boundary fixed.

use super::{Attempt, Unsuitable};
use crate::constraint::Fixed;
use crate::energy::conformal;
use crate::map::setup::Setup;
use crate::map::{Map, MapError, MapOptions};
use crate::problem::linear::LinearProblem;
use crate::quad_graph::QuadGraph;
use crate::solver::{Observer, solve_linear};

/// The map of lowest H whose boundary is fixed.
///
/// # Errors
/// H alone with a free boundary; constraints that do not suffice; a solver that does not suit or fails.
pub(in crate::map) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, .. } = setup;
    if !expression.rows().all(|row| row.name == "H") {
        return Ok(Attempt::Unsuitable(Unsuitable::Request("the energy is not H alone")));
    }
    if !options.boundary.is_fixed() {
        return Err(MapError::FreeBoundary);
    }
    let fixed = options.fixed(&domain.disc, &domain.graph)?;
    options.solve(&domain.graph, fixed, watch).map(Attempt::solved)
}

impl MapOptions {
    /// The map that minimises H over those that hold `fixed`.
    ///
    /// # Errors
    /// Constraints that do not suffice; a solver that does not suit or fails.
    pub fn solve(&self, graph: &QuadGraph, fixed: Fixed, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let problem = LinearProblem::new(graph, self.weight, &fixed)?;
        let solution = solve_linear(&problem, &self.solver, watch)?;
        let weights = conformal::weights(graph, self.weight).ok();
        let gradient_norm = weights.as_ref().map(|w| {
            let product = conformal::normal_product(graph, w, &solution.z);
            let free = problem.elimination.free.iter().map(|&v| (2.0 * product[v as usize]).norm_sqr());
            free.sum::<f64>().sqrt()
        });
        let total = weights.map(|w| conformal::value(graph, &w, &solution.z));
        Ok(Map {
            gradient_norm,
            residual: Some(solution.residual),
            on_circle: self.is_fixed_on_circle(),
            ..Map::solved(solution.backend, solution.z, fixed, total)
        })
    }
}
