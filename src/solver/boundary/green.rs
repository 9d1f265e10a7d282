//! Boundary angles from the Green's function of a point far inside.

use std::f64::consts::PI;

use num_complex::Complex64;

use super::Reduction;
use super::angles::is_ascending;

/// The share of the mean gap below which gaps are lifted: fluxes may be negative on misshapen quads, or vanish.
const SMALLEST_GAP: f64 = 1e-9;

/// The angles (`nb`) of a map to the disc that takes a vertex far inside next to 0: of the Riemann map's inverse image of the
/// uniform measure, which is the flux of the Green's function. A black and a white pole, for D all but separates the
/// colours; the flux of each turns by π. `None` where there is no interior or the flux is no measure.
pub(super) fn green_angles(reduction: &Reduction) -> Option<Vec<f64>> {
    let poles = poles(reduction)?;
    let flux = reduction.flux(&poles.map(|v| (v, Complex64::ONE)));
    let n = flux.len();
    let mut gaps: Vec<f64> = (0..n).map(|k| 0.5 * PI * (flux[k].re + flux[(k + 1) % n].re)).collect();
    let least = SMALLEST_GAP * 2.0 * PI / n as f64;
    if gaps.iter().any(|gap| !gap.is_finite()) || 10 * gaps.iter().filter(|gap| **gap < 0.0).count() > n {
        return None;
    }
    gaps.iter_mut().for_each(|gap| *gap = gap.max(least));
    let whole: f64 = gaps.iter().sum();
    let mut angle = 0.0;
    let theta: Vec<f64> = gaps
        .iter()
        .map(|gap| {
            let here = angle;
            angle += gap * 2.0 * PI / whole;
            here
        })
        .collect();
    is_ascending(&theta).then_some(theta)
}

/// Two neighbouring interior vertices, one of each colour, as far from the boundary as any.
fn poles(reduction: &Reduction) -> Option<[u32; 2]> {
    let graph = reduction.graph;
    let incidence = graph.incidence();
    let mut reached = vec![false; graph.vertices];
    let mut queue = graph.boundary.clone();
    for &v in &queue {
        reached[v as usize] = true;
    }
    let on_boundary = queue.len();
    let mut head = 0;
    while head < queue.len() {
        for &q in incidence.quads_at(queue[head]) {
            for v in graph.quads[q as usize] {
                if !std::mem::replace(&mut reached[v as usize], true) {
                    queue.push(v);
                }
            }
        }
        head += 1;
    }
    queue[on_boundary..].iter().rev().find_map(|&v| {
        incidence.quads_at(v).iter().find_map(|&q| {
            let quad = graph.quads[q as usize];
            let k = quad.iter().position(|&w| w == v)?;
            [quad[(k + 1) % 4], quad[(k + 3) % 4]].into_iter().find(|&w| reduction.is_inside(w)).map(|w| [v, w])
        })
    })
}
