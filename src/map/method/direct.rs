//! Linear problems: H alone, with the boundary fixed.

use super::{Attempt, Unsuitable};
use crate::constraint::{Elimination, Fixed};
use crate::energy::{Standard, conformal};
use crate::map::setup::Setup;
use crate::map::{Map, MapError, MapOptions, SolverChoice};
use crate::problem::linear::LinearProblem;
use crate::quad_graph::QuadGraph;
use crate::solver::linear::Factored;
use crate::solver::{LinearSolution, Observer, Phase, solve_linear, solve_with};

/// The map of lowest H whose boundary is fixed.
///
/// # Errors
/// H alone with a free boundary; constraints that do not suffice; a solver that does not suit or fails.
pub(in crate::map) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, .. } = setup;
    if expression.as_standard() != Some(Standard::Conformal) {
        return Ok(Attempt::Unsuitable(Unsuitable::Request("the energy is not H alone")));
    }
    if !options.boundary.is_fixed() {
        return Err(MapError::FreeBoundary);
    }
    let fixed = options.fixed(&domain.disc, &domain.graph)?;
    match by_kept_factor(setup, &fixed, watch)? {
        Some(solution) => Ok(Attempt::solved(options.map_of(&domain.graph, &fixed, solution))),
        None => options.solve(&domain.graph, fixed, watch).map(Attempt::solved),
    }
}

/// The solution by the factor that is kept from map to map, where there is one and the constraints suit.
fn by_kept_factor(setup: &Setup, fixed: &Fixed, watch: &mut dyn Observer) -> Result<Option<LinearSolution>, MapError> {
    let Setup { options, domain, factor, .. } = setup;
    if factor.is_none() || options.solver != SolverChoice::Auto || !domain.is_of_triangles() {
        return Ok(None);
    }
    let graph = &domain.graph;
    fixed.determine(graph)?;
    // The order of elimination is that of the factor; none is needed here.
    let elimination = Elimination::new(graph.vertices, fixed);
    let problem = LinearProblem { graph, weight: options.weight, elimination };
    let Ok(laplacian) = setup.laplacian(watch) else { return Ok(None) };
    let factored = Factored(laplacian);
    Ok(solve_with(&factored, &problem, watch).ok())
}

impl MapOptions {
    /// The map that minimises H over those that hold `fixed`.
    ///
    /// # Errors
    /// Constraints that do not suffice; a solver that does not suit or fails.
    pub fn solve(&self, graph: &QuadGraph, fixed: Fixed, watch: &mut dyn Observer) -> Result<Map, MapError> {
        watch.phase(Phase::Order);
        let problem = LinearProblem::new(graph, self.weight, &fixed)?;
        let solution = match &self.solver {
            SolverChoice::Linear(solver) => solve_with(&**solver, &problem, watch)?,
            solver => solve_linear(&problem, solver.name(), watch)?,
        };
        drop(problem);
        Ok(self.map_of(graph, &fixed, solution))
    }

    /// The map that a linear solution is, with its energy.
    fn map_of(&self, graph: &QuadGraph, fixed: &Fixed, solution: LinearSolution) -> Map {
        let weights = conformal::weights(graph, self.weight).ok();
        let gradient_norm = weights.as_ref().map(|w| {
            let product = conformal::normal_product(graph, w, &solution.z);
            let free = (0..graph.vertices).filter(|&v| !fixed.holds(v as u32));
            free.map(|v| (2.0 * product[v]).norm_sqr()).sum::<f64>().sqrt()
        });
        let total = weights.map(|w| conformal::value(graph, &w, &solution.z));
        Map {
            gradient_norm,
            residual: Some(solution.residual),
            on_circle: self.is_fixed_on_circle(),
            ..Map::solved(solution.backend, solution.z, fixed.clone(), total)
        }
    }
}
