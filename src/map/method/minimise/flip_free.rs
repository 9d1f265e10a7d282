//! Minimisation of energies that are +∞ for maps with flipped faces: a start without flipped faces, and positions for the
//! dual vertices that they do not see.

use num_complex::Complex64;

use crate::constraint::{Fixed, on_circle};
use crate::energy::conformal::Weight;
use crate::energy::{Energy, Rest, SymmetricDirichlet};
use crate::map::setup::Setup;
use crate::map::{Boundary, MapError};
use crate::quad_graph::metric::RestMetric;
use crate::solver::Observer;

/// `z` of the best size, where it has no flipped face; else the map of [`start`].
pub(super) fn start_from(
    setup: &Setup,
    metric: &RestMetric,
    mut z: Vec<Complex64>,
    watch: &mut dyn Observer,
) -> Result<Vec<Complex64>, MapError> {
    if !setup.domain.folded(&z).is_empty() {
        return start(setup, metric, watch);
    }
    let size = size(setup, metric, &z)?;
    z.iter_mut().for_each(|z| *z *= size);
    Ok(z)
}

/// A map without flipped faces: every inner vertex a mean of its neighbours, the boundary where a fixed one is held, else on a circle by
/// arc length between the points that are held; of the best size where the energy sees lengths or areas, of radius 1 where it does not.
pub(super) fn start(setup: &Setup, metric: &RestMetric, watch: &mut dyn Observer) -> Result<Vec<Complex64>, MapError> {
    let Setup { options, domain, expression, normalisation, .. } = setup;
    let graph = &domain.graph;
    let fixed = match options.boundary {
        Boundary::Fixed { .. } => options.fixed(&domain.disc, graph)?,
        _ => on_circle(graph, 1.0, normalisation.or_first())?,
    };
    let z = domain.convex_start(&fixed, &|_| true, watch)?;
    let mut z = domain.with_dual_vertices(z, &fixed);
    if !options.boundary.is_fixed() && !expression.is_on_circle() && expression.fixes_scale() {
        let size = size(setup, metric, &z)?;
        z.iter_mut().for_each(|z| *z *= size);
    }
    Ok(z)
}

/// The factor that gives a map the least SD where no polynomial of lengths or areas is minimised, else the surface's area.
fn size(setup: &Setup, metric: &RestMetric, z: &[Complex64]) -> Result<f64, MapError> {
    let Setup { options, domain, expression, .. } = setup;
    if !expression.has_lengths_or_areas() {
        let rest = Rest { graph: &domain.graph, metric, weight: options.weight, held: &[] };
        let size = SymmetricDirichlet::new(rest)?.best_scale(z);
        if size.is_finite() && size > 0.0 {
            return Ok(size);
        }
    }
    Ok((metric.surface_area() / domain.image_area(z)).sqrt())
}

/// The factor on energies that see shapes alone, and weigh them by areas at rest: what the image's area is to that of the surface, so that
/// they are of one unit with the others. 1 where these see lengths or areas, and the two areas are nearly the same.
pub(super) fn unit_of_shapes(setup: &Setup, metric: &RestMetric, z: &[Complex64]) -> f64 {
    let Setup { options, domain, expression, .. } = setup;
    let integral = options.weight == Weight::Integral;
    let free = expression.fixes_scale() && !options.boundary.is_fixed();
    if integral && !free { domain.image_area(z) / metric.surface_area() } else { 1.0 }
}

/// Holds the vertices that none of the energies sees where they are, and names them.
pub(super) fn hold_unseen(fixed: &mut Fixed, energies: &[(f64, Box<dyn Energy>)], z: &[Complex64]) -> Vec<u32> {
    let mut seen = vec![false; z.len()];
    for (_, energy) in energies {
        for &v in &energy.stencils().vertices {
            seen[v as usize] = true;
        }
    }
    let unseen: Vec<u32> = (0..z.len() as u32).filter(|&v| !seen[v as usize] && !fixed.holds(v)).collect();
    for &v in &unseen {
        fixed.hold(v, z[v as usize]);
    }
    unseen
}
