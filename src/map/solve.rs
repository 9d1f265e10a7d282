//! The order of things: boundary method → minimisation → local unflipping → bijective replacement.

use super::bijective;
use super::kept_factor::KeptFactor;
use super::method::minimise::Effort;
use super::method::{Attempt, boundary, convex, direct, minimise};
use super::normalisation::Normalisation;
use super::provenance::{Provenance, Replaced, Replacement, Setback};
use super::setup::Setup;
use super::{Domain, Map, MapError, MapOptions, Valid};
use crate::constraint::ConstraintError;
use crate::distortion::mesh_boundary;
use crate::geometry::polygon::out_of_order;
use crate::solver::Observer;
use crate::solver::boundary::{BoundaryError, TwoCirclesError};

/// Circle maps of larger quad meshes keep a boundary that is out of order, unless order is asked for: the factor of the
/// minimiser needs eight times the memory.
const MOST_FOR_MINIMISER: usize = 300_000;

/// Computes the map of a domain. `factor` keeps the factor of its conformal Laplacian; `exact` are exact conformal
/// coordinates, one pair for each vertex of the source.
pub(super) fn solve(
    options: &MapOptions,
    domain: &Domain,
    factor: Option<&KeptFactor>,
    exact: Option<&[[f64; 2]]>,
    watch: &mut dyn Observer,
) -> Result<Map, MapError> {
    let expression = options.expression();
    let normalisation = Normalisation::new(options, &expression, domain, exact);
    let (normalisation, refusal) = match normalisation {
        Ok(normalisation) => (normalisation, None),
        Err(error) => (Normalisation::default(), Some(error)),
    };
    let setup = Setup { options, domain, factor, expression, normalisation };

    if let Attempt::Solved(map) = convex::solve(&setup, watch)? {
        return Ok(*map);
    }
    setup.check()?;
    if let Attempt::Solved(map) = direct::solve(&setup, watch)? {
        return Ok(*map);
    }
    let conformal = match refusal {
        Some(error) => Err(error),
        None => conformal(&setup, watch),
    };
    match options.promises_valid() {
        true => injective(&setup, conformal, watch),
        false => conformal,
    }
}

/// Computes the minimum of the energy: by Newton's method on the boundary values if that suits, else by a minimiser.
fn conformal(setup: &Setup, watch: &mut dyn Observer) -> Result<Map, MapError> {
    let options = setup.options;
    let (after, start) = match boundary::solve(setup, watch)? {
        Attempt::Solved(map) if !is_to_be_ordered(setup, &map) => return Ok(*map),
        // An injective map that is as near to conformal spares the minimiser.
        Attempt::Solved(map) => {
            if options.promises_valid()
                && !options.is_ordered()
                && let Some(map) = bijective::unflipped(setup, &boundary::on_circle(setup, *map), watch)?.0
            {
                return Ok(map);
            }
            (Some(Setback::OutOfOrder), None)
        }
        Attempt::Unsuitable(reason) if boundary::is_asked(options) => return Err(reason.into()),
        // A minimiser would not come further, and a bijective map replaces this one anyway.
        Attempt::Failed { reason, .. }
            if boundary::is_asked(options) || (setup.is_circle() && options.promises_valid()) =>
        {
            return Err(reason);
        }
        Attempt::Unsuitable(_) => (None, None),
        Attempt::Failed { iterations, start, .. } => (Some(Setback::Stalled { iterations }), start),
    };
    let start = match start {
        None if setup.starts_from_free_map() => boundary::free_start(setup, watch),
        start => start,
    };
    let effort = match after.is_some() && options.promises_valid() {
        true => Effort::WhileHopeful,
        false => Effort::Full,
    };
    let map = minimise::solve(setup, start, effort, watch)?.found()?;
    Ok(Map { provenance: Provenance { after, ..map.provenance }, ..map })
}

/// Returns the conformal map if it is injective; else the same map with its flipped faces unflipped in place; else, or
/// if the iterations did not converge, a bijective map of low quasi-conformal distortion. With [`Valid::BestQc`] the
/// bijective map also replaces an injective conformal map of higher mean distortion.
fn injective(setup: &Setup, conformal: Result<Map, MapError>, watch: &mut dyn Observer) -> Result<Map, MapError> {
    let (kept, flipped, spent) = match conformal {
        Ok(map) => match setup.accepts(&map.z) {
            true if setup.options.valid == Valid::BestQc => {
                let spent = map.iterations;
                (Some(map), None, spent)
            }
            true => return Ok(map),
            false => {
                let map = boundary::on_circle(setup, map);
                if setup.accepts(&map.z) {
                    return Ok(map);
                }
                match bijective::unflipped(setup, &map, watch)? {
                    (Some(found), _) => return Ok(found),
                    (None, spent) => (None, Some(setup.domain.folded(&map.z).len()), spent),
                }
            }
        },
        Err(
            MapError::NotConverged { iterations, .. }
            | MapError::Reduced(BoundaryError::TwoCircles(TwoCirclesError::Stalled { iterations, .. })),
        ) => (None, None, iterations),
        // A start, or a matrix, beyond the range of doubles: others may be within.
        Err(MapError::Minimise(_) | MapError::Constraint(ConstraintError::NoArcLength(..))) => (None, None, 0),
        Err(MapError::Solve(ref error)) if error.is_of_rounding() => (None, None, 0),
        Err(_) => return conformal,
    };
    let found = bijective::replacement(setup, spent, watch);
    let replacing = |map: Map, by| {
        let replaced = Some(Replaced { by, flipped });
        Map { provenance: Provenance { replaced, ..map.provenance }, ..map }
    };
    let Some(kept) = kept else { return Ok(replacing(found?, Replacement::Wholly)) };
    let distortion = setup.mean_distortion(&kept);
    let is_better = |map: &Map| setup.accepts(&map.z) && setup.mean_distortion(map) < distortion;
    Ok(match found.ok().filter(is_better) {
        Some(map) => replacing(map, Replacement::LessDistorted { mean: distortion }),
        None => kept,
    })
}

/// Whether the boundary of a circle map is out of order and a minimiser may do better: where the order is asked for; and on quad meshes,
/// whose boundaries may be staircases. E = H + C, which draws their inner and outer corners towards the circle but not onto one, distorts
/// the faces there far less (inspired_mesh: a mean σ1/σ2 of 1.13).
fn is_to_be_ordered(setup: &Setup, map: &Map) -> bool {
    let Setup { options, domain, .. } = setup;
    let graph = &domain.graph;
    let is_small_quad_mesh = graph.primal == graph.vertices && graph.vertices <= MOST_FOR_MINIMISER;
    map.on_circle
        && !boundary::is_asked(options)
        && (options.is_ordered() || is_small_quad_mesh)
        && out_of_order(&mesh_boundary(graph, &map.z)) > 0
}
