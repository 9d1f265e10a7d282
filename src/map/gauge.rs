//! The vertices that are pinned while an energy is minimised.

use num_complex::Complex64;

use super::MapError;
use super::setup::Setup;
use crate::constraint::{Fixed, hold_gauge, spread_points};
use crate::quad_graph::QuadGraph;

/// Returns the vertices that are pinned while the energy is minimised (design: the table of §3), at their positions in
/// `z`.
///
/// # Errors
/// A pinned vertex is not in use; the boundary has too few vertices for its shape.
pub(super) fn held(setup: &Setup, z: &[Complex64]) -> Result<Fixed, MapError> {
    let Setup { options, domain, expression, normalisation, .. } = setup;
    let (disc, graph) = (&domain.disc, &domain.graph);
    if options.boundary.is_fixed() {
        return options.fixed(disc, graph);
    }
    let mut fixed = Fixed::default();
    options.hold(&mut fixed, disc, graph)?;
    let fixes_scale = expression.fixes_scale();
    if options.holds_more() {
        return Ok(fixed);
    }
    match (expression.is_on_circle(), fixes_scale) {
        (true, false) => return Ok(normalisation.fixed(graph)),
        (true, true) => {
            let first = graph.boundary[0];
            fixed.hold_on_line(first, Complex64::ZERO, z[first as usize]);
        }
        (false, _) if expression.is_flip_free() && !expression.has_lengths_or_areas() => {
            hold_mesh_gauge(&mut fixed, fixes_scale, graph, z);
        }
        (false, _) => hold_gauge(&mut fixed, expression, graph, z),
    }
    Ok(fixed)
}

/// Removes rigid motions (if the energy fixes the scale) or similarities (if not), at the boundary of the mesh: pins a
/// vertex and the direction to the farthest one, see [`hold_gauge`]; or two opposite vertices.
pub(super) fn hold_mesh_gauge(fixed: &mut Fixed, fixes_scale: bool, graph: &QuadGraph, z: &[Complex64]) {
    let at = |v: u32| z[v as usize];
    if fixes_scale {
        let mut mesh = graph.boundary.iter().copied().filter(|&v| !graph.is_dual(v));
        let Some(first) = mesh.next() else { return };
        let away = |v: u32| (at(v) - at(first)).norm();
        fixed.hold(first, at(first));
        if let Some(far) = mesh.max_by(|&v, &w| away(v).total_cmp(&away(w))) {
            // The line begins at the vertex itself, which then stays there exactly.
            fixed.hold_on_line(far, at(far), at(far) + (at(far) - at(first)));
        }
    } else {
        for k in spread_points(graph, 2) {
            fixed.hold(graph.boundary[k], at(graph.boundary[k]));
        }
    }
}
