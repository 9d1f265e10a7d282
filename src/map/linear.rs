use super::{Map, MapError, MapOptions};
use crate::constraint::Fixed;
use crate::energy::conformal;
use crate::problem::linear::LinearProblem;
use crate::quad_graph::QuadGraph;
use crate::solver::{Observer, solve_linear};

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
            on_circle: self.fixed_on_circle(),
            ..Map::solved(solution.backend, solution.z, fixed, total)
        })
    }
}
