//! What must be held so that a map is unique, and which freedoms no energy sees.

use num_complex::Complex64;

use super::Fixed;
use crate::energy::Expression;
use crate::quad_graph::QuadGraph;
use crate::quad_graph::metric::RestMetric;

/// Positions on the boundary, `count` of them, spread evenly by arc length; on triangle meshes those of mesh vertices.
///
/// Of all ways to spread them the one is taken whose worst point is best: a point at a misshapen quad, such as the flat
/// ones where a square grid covers a disc, holds the whole map at a bad place (errors double). The shape of a quad is
/// `2 Re ρ / (1 + |ρ|²)`, 1 for a square.
pub fn spread_points(graph: &QuadGraph, count: usize) -> Vec<usize> {
    const TRIALS: usize = 64;
    let n = graph.boundary.len();
    let mut shape_at = vec![f64::INFINITY; graph.vertices];
    for (quad, rho) in graph.quads.iter().zip(&graph.rho) {
        for &v in quad {
            let shape = &mut shape_at[v as usize];
            *shape = shape.min(2.0 * rho.re / (1.0 + rho.norm_sqr()));
        }
    }
    let mesh: Vec<usize> = (0..n).filter(|&k| !graph.is_dual(graph.boundary[k])).collect();
    let mut arc = vec![0.0; n];
    for k in 1..n {
        arc[k] = arc[k - 1] + graph.boundary_length[k - 1];
    }
    let perimeter = graph.perimeter();
    let spread_from = |first: usize| {
        let mut points: Vec<usize> = Vec::with_capacity(count);
        for i in 0..count {
            let wanted = (arc[first] + perimeter * i as f64 / count as f64) % perimeter;
            let away = |k: usize| ((arc[k] - wanted).abs()).min(perimeter - (arc[k] - wanted).abs());
            let free = mesh.iter().copied().filter(|k| !points.contains(k));
            points.extend(free.min_by(|&a, &b| away(a).total_cmp(&away(b))));
        }
        points.sort_unstable();
        points
    };
    let worst_shape = |points: &[usize]| {
        let shapes = points.iter().map(|&k| shape_at[graph.boundary[k] as usize]);
        shapes.fold(f64::INFINITY, f64::min)
    };
    let trials = mesh.iter().step_by(mesh.len().div_ceil(TRIALS).max(1)).map(|&first| spread_from(first));
    let better = |best: Vec<usize>, other: Vec<usize>| {
        // A clear gain only: on regular meshes the first way stays, whatever the rounding.
        if worst_shape(&other) > 1.001 * worst_shape(&best) { other } else { best }
    };
    trials.reduce(better).unwrap_or_default()
}

/// Holds what the rigid motions, and translations of one colour against the other, leave free, at the places of `z`:
///
/// with L or L', a boundary vertex and the direction from it to the farthest on the boundary; with A but neither (only
/// diagonals enter), a black vertex, the direction to the farthest black one, and a white vertex.
///
/// The paper (§3.3) has the direction of the next boundary edge in place of the farthest vertex's. It takes away the same
/// rotation, but where that edge must turn in the course of a minimisation the whole map must turn around it, by steps that
/// shrink with the mesh: iterations then grow like its side. [`turn_back`] gives the edge its direction again.
pub fn hold_gauge(fixed: &mut Fixed, energy: &Expression, graph: &QuadGraph, z: &[Complex64]) {
    let (first, next) = (graph.boundary[0], graph.boundary[1]);
    let at = |v: u32| z[v as usize];
    let away = |v: u32| (at(v) - at(first)).norm();
    let farthest = |boundary: &mut dyn Iterator<Item = u32>| boundary.max_by(|&v, &w| away(v).total_cmp(&away(w)));
    let far = if energy.has("L") || energy.has("Lb") {
        farthest(&mut graph.boundary.iter().copied())
    } else if energy.has("A") {
        fixed.hold(next, at(next));
        let (class, _) = graph.diagonal_classes();
        let is_black = |v: &u32| class[*v as usize] == class[first as usize];
        farthest(&mut graph.boundary.iter().copied().filter(is_black))
    } else {
        return;
    };
    fixed.hold(first, at(first));
    if let Some(far) = far.filter(|&far| far != first && away(far) > 0.0) {
        fixed.hold_on_line(far, at(first), at(far));
    }
}

/// Turns a map around the vertex that [`hold_gauge`] holds, so that the next boundary edge has the direction that it has in
/// `start`; with A but neither L nor L', a black diagonal.
pub fn turn_back(energy: &Expression, graph: &QuadGraph, start: &[Complex64], z: &mut [Complex64]) {
    let first = graph.boundary[0];
    let through = if energy.has("L") || energy.has("Lb") {
        Some(graph.boundary[1])
    } else {
        graph.quads.iter().find_map(|quad| {
            let k = quad.iter().position(|&v| v == first)?;
            Some(quad[(k + 2) % 4])
        })
    };
    let Some(through) = through else { return };
    let centre = z[first as usize];
    let turn = (start[through as usize] - start[first as usize]) / (z[through as usize] - centre);
    let turn = turn / turn.norm();
    if turn.is_finite() {
        for z in z {
            *z = centre + turn * (*z - centre);
        }
    }
}

/// Shifts the white vertices (those not connected with `boundary[0]` by diagonals) by the one offset that minimises
/// `Σ_edges (|zi − zj|² − l²)²`. No energy of diagonals alone sees it.
pub fn float_white_back(graph: &QuadGraph, metric: &RestMetric, z: &mut [Complex64]) {
    let (class, _) = graph.diagonal_classes();
    let black = class[graph.boundary[0] as usize];
    let is_black = |v: u32| class[v as usize] == black;
    // From black to white, so that the offset adds to every difference.
    let edges = || {
        metric.edges.iter().zip(&metric.length).filter_map(|(&[a, b], &length)| match (is_black(a), is_black(b)) {
            (true, false) => Some((a, b, length)),
            (false, true) => Some((b, a, length)),
            _ => None,
        })
    };
    let energy = |offset: Complex64| -> f64 {
        edges()
            .map(|(a, b, length)| ((z[b as usize] - z[a as usize] + offset).norm_sqr() - length * length).powi(2))
            .sum()
    };
    let mut offset = Complex64::ZERO;
    let mut lowest = energy(offset);
    // Newton in two unknowns, the Hessian made definite by the Gauss–Newton part where it is not.
    for _ in 0..50 {
        let (mut g, mut gauss, mut bend) = (Complex64::ZERO, [0.0; 3], 0.0);
        for (a, b, length) in edges() {
            let d = z[b as usize] - z[a as usize] + offset;
            let r = d.norm_sqr() - length * length;
            g += 4.0 * r * d;
            gauss = [gauss[0] + 8.0 * d.re * d.re, gauss[1] + 8.0 * d.re * d.im, gauss[2] + 8.0 * d.im * d.im];
            bend += 4.0 * r;
        }
        let solve = |extra: f64| {
            let (p, q, r) = (gauss[0] + extra, gauss[1], gauss[2] + extra);
            let determinant = p * r - q * q;
            (p > 0.0 && determinant > 0.0)
                .then(|| -Complex64::new(r * g.re - q * g.im, p * g.im - q * g.re) / determinant)
        };
        let Some(mut step) = solve(bend).or_else(|| solve(0.0)) else { break };
        while energy(offset + step) > lowest && step.norm_sqr() > 0.0 {
            step *= 0.5;
        }
        let next = energy(offset + step);
        if next >= lowest {
            break;
        }
        (offset, lowest) = (offset + step, next);
    }
    for (v, z) in z.iter_mut().enumerate() {
        if !is_black(v as u32) {
            *z += offset;
        }
    }
}
