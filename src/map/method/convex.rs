//! Convex combination maps: the boundary fixed, every free vertex at a weighted mean of its neighbours.

use super::{Attempt, Unsuitable};
use crate::energy::conformal;
use crate::map::provenance::{Provenance, Replaced, Replacement};
use crate::map::setup::Setup;
use crate::map::{Clash, Map, MapError, SolverChoice, Valid};
use crate::solver::Observer;
use crate::solver::convex::{convex_map, edge_weights};

/// The map under which every free vertex is the mean of its neighbours by the weights that are asked for. Where the weights are positive
/// and rounding has spoiled the map nevertheless, others are used, unless `valid` is off.
///
/// # Errors
/// Weights beside a free boundary, an energy or a solver; unknown weights; a factorisation that breaks down.
pub(in crate::map) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, .. } = setup;
    let Some(name) = options.weights() else { return Ok(Attempt::Unsuitable(Unsuitable::NotAsked)) };
    let row = edge_weights(name)?;
    let refused = |clash| Err(MapError::WeightsOfNothing { name: name.to_owned(), clash });
    match () {
        () if options.energy.is_some() => return refused(Clash::Energy),
        () if options.solver != SolverChoice::Auto => return refused(Clash::Solver),
        () => {}
    }
    let mut fixed = options.fixed(&domain.disc, &domain.graph)?;
    let first = convex_map(&domain.disc, &(row.make)(&domain.disc)?, &fixed, watch)?;
    let (solution, solver) = match row.convex && options.valid != Valid::Off {
        true => domain.first_accepted((first, row.name), &fixed, &mut |z| domain.is_one_to_one(z), watch)?,
        false => (first, row.name),
    };
    fixed.hold_dual_boundary(&domain.graph);
    let z = domain.with_dual_vertices(solution.z, &fixed);
    let h = conformal::weights(&domain.graph, options.weight).ok().map(|w| conformal::value(&domain.graph, &w, &z));
    let replaced = (solver != row.name).then_some(Replaced { by: Replacement::OtherWeights, flipped: None });
    Ok(Attempt::solved(Map {
        residual: Some(solution.residual),
        on_circle: options.is_fixed_on_circle(),
        provenance: Provenance { replaced, ..Provenance::of(solver) },
        ..Map::solved(solver, z, fixed, h)
    }))
}
