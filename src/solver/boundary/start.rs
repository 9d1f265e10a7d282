//! Where Newton's method on the angles begins.

use super::Reduction;
use super::angles::{Anchor, is_ascending, moebius, through_anchors};
use super::green::green_angles;
use crate::quad_graph::QuadGraph;

/// Ascending angles with those of the anchors: from the Green's function by a Möbius map, else by arc length.
pub(super) fn start(reduction: &Reduction, anchors: &[Anchor]) -> Vec<f64> {
    let by_length = arc_length(reduction.graph, anchors);
    let from_green = green_angles(reduction).and_then(|green| {
        let three = three_anchors(&by_length, anchors);
        let moved = moebius(&green, &three)?;
        let theta = through_anchors(&moved, std::f64::consts::TAU, anchors);
        is_ascending(&theta).then_some(theta)
    });
    from_green.unwrap_or(by_length)
}

/// Angles by arc length between the anchors.
fn arc_length(graph: &QuadGraph, anchors: &[Anchor]) -> Vec<f64> {
    let mut length = 0.0;
    let arc: Vec<f64> = graph
        .boundary_length
        .iter()
        .map(|l| {
            let here = length;
            length += l;
            here
        })
        .collect();
    through_anchors(&arc, length, anchors)
}

/// Three anchors: of many, those that are spread best; few are completed by arc length.
fn three_anchors(by_length: &[f64], anchors: &[Anchor]) -> Vec<Anchor> {
    let n = by_length.len();
    let mut three: Vec<Anchor> = match anchors.len() {
        0..=3 => anchors.to_vec(),
        count => [0, count / 3, 2 * count / 3].map(|i| anchors[i]).to_vec(),
    };
    while three.len() < 3.min(n) {
        let away = |k: usize| {
            let turn = |a: f64| (by_length[k] - a).rem_euclid(std::f64::consts::TAU);
            three.iter().map(|&(_, a)| turn(a).min(std::f64::consts::TAU - turn(a))).fold(f64::INFINITY, f64::min)
        };
        let Some(k) = (0..n).max_by(|&a, &b| away(a).total_cmp(&away(b))) else { break };
        three.push((k, by_length[k]));
    }
    three.sort_unstable_by_key(|&(k, _)| k);
    three
}
