//! The circle map: the boundary exactly on the unit circle, H the lowest.

use num_complex::Complex64;

use super::{is_asked, reduction, total};
use crate::constraint::Fixed;
use crate::energy::conformal::{self, Weight};
use crate::map::boundary_energy::circle_energy;
use crate::map::method::{Attempt, Unsuitable};
use crate::map::options::hold_pins;
use crate::map::setup::Setup;
use crate::map::{Domain, Ending, Exactly, Map, MapError};
use crate::solver::boundary::{self, CircleProblem, circle_map};
use crate::solver::{Observer, StopRule};

/// Minimises H with the boundary on the unit circle.
///
/// # Errors
/// Pins that are not in use.
pub(super) fn solve(setup: &Setup, watch: &mut dyn Observer) -> Result<Attempt, MapError> {
    let Setup { options, domain, expression, normalisation } = setup;
    let Domain { graph, .. } = domain;
    let Some(pins) = pins(setup)? else {
        return Ok(Attempt::Unsuitable(Unsuitable::Request("a vertex inside is held")));
    };
    let reduction = match reduction(setup, watch) {
        Ok(reduction) => reduction,
        Err(reason) => return Ok(Attempt::Unsuitable(Unsuitable::Matrix(reason))),
    };
    // Unless this solver was asked for, the order is left to the minimisers: they enforce it with far less distortion.
    let keep_order = is_asked(options) && options.keep_order;
    let rule = StopRule { tolerance: options.tolerance, reference: None, max_iterations: options.max_iterations };
    let problem = CircleProblem { reduction: &reduction, pins: &pins, keep_order, rule };
    let found = match circle_map(&problem, watch) {
        Ok(found) => found,
        Err(reason) => return Ok(Attempt::failed(reason, None)),
    };
    let mut fixed = Fixed::default();
    for &(k, place) in &pins {
        fixed.hold(graph.boundary[k], place);
    }
    let z = reduction.extend(&found.boundary);
    drop(reduction);
    let h = conformal::value(graph, &conformal::weights(graph, Weight::Integral)?, &z);
    let energies = vec![("H", h), ("C", circle_energy(graph, &fixed, &z))];
    Ok(Attempt::solved(Map {
        total: Some(total(expression, &energies)),
        energies,
        gradient_norm: Some(found.gradient_norm),
        ending: Ending::Minimised(found.status),
        iterations: found.iterations,
        smallest_singular_value: found.smallest_singular_value,
        on_circle: true,
        anchored: normalisation.exact,
        exactly: Some(Exactly::Circle),
        ..Map::solved(boundary::NAME, z, fixed, None)
    }))
}

/// Boundary positions that are held, ascending, and where; `None` if a vertex inside is held.
fn pins(setup: &Setup) -> Result<Option<Vec<(usize, Complex64)>>, MapError> {
    let Domain { disc, graph, .. } = setup.domain;
    if setup.options.pins.is_empty() {
        let points = setup.normalisation.points.iter();
        return Ok(Some(points.map(|&(k, angle)| (k, Complex64::cis(angle))).collect()));
    }
    let mut fixed = Fixed::default();
    hold_pins(&mut fixed, disc, &setup.options.pins)?;
    let held: Vec<_> = graph.boundary.iter().enumerate().filter_map(|(k, &v)| Some((k, fixed.place(v)?))).collect();
    Ok((held.len() == fixed.len()).then_some(held))
}
