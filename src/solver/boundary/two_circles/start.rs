//! The angles that Newton's method for the two circles begins with.

use std::f64::consts::TAU;

use super::CirclePin;
use crate::laplacian::{ConformalLaplacian, Work};
use crate::quad_graph::QuadGraph;
use crate::solver::boundary::angles::{Anchor, is_ascending, moebius, through_anchors};

/// The share of the mean gap below which gaps are lifted: fluxes may be negative on misshapen quads, or vanish.
const SMALLEST_GAP: f64 = 1e-9;

/// Ascending angles (2n, black and white points in turn) that take the anchors' values: those of the Green's function of a black
/// vertex far inside, whose flux is the harmonic measure, moved by a Möbius map; else those of arc length. `order` has the position of
/// each point in [`QuadGraph::boundary`].
pub(super) fn start_angles(
    laplacian: &ConformalLaplacian,
    graph: &QuadGraph,
    order: &[u32],
    anchors: &[Anchor],
    work: &mut Work,
) -> Vec<f64> {
    let from_green = green_angles(laplacian, graph, work).and_then(|green| {
        let theta = through_anchors(&moebius(&green, anchors)?, TAU, anchors);
        is_ascending(&theta).then_some(theta)
    });
    from_green.unwrap_or_else(|| by_arc_length(graph, order, anchors))
}

/// Angles from the flux of the Green's function, half a black vertex's flux on either side of it.
fn green_angles(laplacian: &ConformalLaplacian, graph: &QuadGraph, work: &mut Work) -> Option<Vec<f64>> {
    let flux = laplacian.green(graph, work)?.flux;
    let n = flux.len();
    let total: f64 = flux.iter().map(|flux| flux.re).sum();
    let mut gaps: Vec<f64> = flux.iter().map(|flux| TAU * flux.re / total).collect();
    let negative = gaps.iter().filter(|gap| **gap < 0.0).count();
    if gaps.iter().any(|gap| !gap.is_finite()) || 10 * negative > n {
        return None;
    }
    gaps.iter_mut().for_each(|gap| *gap = gap.max(SMALLEST_GAP * TAU / n as f64));
    let scale = TAU / gaps.iter().sum::<f64>();
    let mut white = 0.0;
    let pairs = gaps.iter().map(|gap| {
        let gap = scale * gap;
        white += gap;
        [white - 0.5 * gap, white]
    });
    let theta: Vec<f64> = pairs.flatten().collect();
    is_ascending(&theta).then_some(theta)
}

/// Angles by arc length between the anchors; `order` has the position of each point in [`QuadGraph::boundary`].
fn by_arc_length(graph: &QuadGraph, order: &[u32], anchors: &[Anchor]) -> Vec<f64> {
    let mut length = 0.0;
    let along = order.iter().map(|&k| {
        let here = length;
        length += graph.boundary_length[k as usize];
        here
    });
    let along: Vec<f64> = along.collect();
    through_anchors(&along, length, anchors)
}

/// The anchors, completed to three by the points farthest from them by arc length, at the angles of arc length.
pub(super) fn three_anchors(graph: &QuadGraph, order: &[u32], anchors: &[Anchor]) -> Vec<Anchor> {
    let mut three = anchors.to_vec();
    if three.len() >= 3 {
        return three;
    }
    let theta = by_arc_length(graph, order, anchors);
    while three.len() < 3 {
        let away = |v: usize| {
            let turn = |angle: f64| (theta[v] - angle).rem_euclid(TAU);
            let near = three.iter().map(|&(_, angle)| turn(angle).min(TAU - turn(angle)));
            near.fold(f64::INFINITY, f64::min)
        };
        // Black points: on triangle meshes they are vertices of the mesh.
        let Some(v) = (0..theta.len()).step_by(2).max_by(|&a, &b| away(a).total_cmp(&away(b))) else { break };
        three.push((v, theta[v]));
    }
    three.sort_unstable_by_key(|&(v, _)| v);
    three
}

/// Three black boundary points about a third of the harmonic measure apart, seen from a black vertex far inside, at the angles
/// of that measure; the first boundary point is near angle 0. `None` where there is no such measure.
///
/// Points pinned like this spread a map as evenly as it can be: its derivative is least uneven where long parts of the surface
/// would crowd into short arcs.
pub fn centred_pins(laplacian: &ConformalLaplacian, graph: &QuadGraph) -> Option<Vec<CirclePin>> {
    let theta = green_angles(laplacian, graph, &mut laplacian.work())?;
    let n = laplacian.len();
    let turned = |k: usize| theta[2 * k] - theta[0];
    let nearest = |angle: f64| (0..n).min_by(|&a, &b| (turned(a) - angle).abs().total_cmp(&(turned(b) - angle).abs()));
    let positions = [0.0, TAU / 3.0, 2.0 * TAU / 3.0].map(nearest);
    let pins = positions
        .into_iter()
        .flatten()
        .map(|k| CirclePin { position: laplacian.black_index()[k] as usize, angle: turned(k) });
    let pins: Vec<CirclePin> = pins.collect();
    let distinct = pins.windows(2).all(|pair| pair[0].position != pair[1].position);
    (pins.len() == 3 && distinct).then_some(pins)
}
