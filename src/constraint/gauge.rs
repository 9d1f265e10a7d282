//! The vertices that must be pinned so that a map is unique, and the freedoms that no energy sees.

use num_complex::Complex64;

use super::Fixed;
use crate::energy::Expression;
use crate::quad_graph::QuadGraph;
use crate::quad_graph::metric::RestMetric;

/// Returns `count` positions on the boundary, spread evenly by arc length; on triangle meshes they
/// are mesh vertices.
///
/// Of all such choices it returns the one whose worst quad shape, `2 Re ρ / (1 + |ρ|²)` (1 for a
/// square), is best.
///
/// # Rationale
/// A point at a badly shaped quad, such as the flat ones of a square grid mapped to a disc, pins
/// the whole map at an inaccurate position; errors double.
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
        // Only a clear gain counts: on regular meshes the first choice stays, whatever the
        // rounding.
        if worst_shape(&other) > 1.001 * worst_shape(&best) { other } else { best }
    };
    trials.reduce(better).unwrap_or_default()
}

/// Pins the rigid motions, and the translations of one colour relative to the other, that the
/// energy leaves free, at the positions of `z`.
///
/// With L or L' these are a boundary vertex and the direction from it to the farthest boundary
/// vertex. With A but neither L nor L' only diagonals enter: a black vertex, the direction to the
/// farthest black one, and a white vertex.
///
/// # Rationale
/// The paper (§3.3) pins the direction of the next boundary edge instead of that of the farthest
/// vertex. This removes the same rotation. But if that edge must rotate during the minimisation,
/// the whole map must rotate around it, in steps that shrink with the mesh width, and the number of
/// iterations grows as its inverse. [`turn_back`] restores the direction of that edge afterwards.
pub fn hold_gauge(fixed: &mut Fixed, energy: &Expression, graph: &QuadGraph, z: &[Complex64]) {
    let (first, next) = (graph.boundary[0], graph.boundary[1]);
    let at = |v: u32| z[v as usize];
    let away = |v: u32| (at(v) - at(first)).norm();
    let farthest = |boundary: &mut dyn Iterator<Item = u32>| boundary.max_by(|&v, &w| away(v).total_cmp(&away(w)));
    if !energy.has_lengths_or_areas() {
        return;
    }
    let far = if energy.joins_diagonal_classes() {
        farthest(&mut graph.boundary.iter().copied())
    } else {
        fixed.hold(next, at(next));
        let (class, _) = graph.diagonal_classes();
        let is_black = |v: &u32| class[*v as usize] == class[first as usize];
        farthest(&mut graph.boundary.iter().copied().filter(is_black))
    };
    fixed.hold(first, at(first));
    if let Some(far) = far.filter(|&far| far != first && away(far) > 0.0) {
        fixed.hold_on_line(far, at(first), at(far));
    }
}

/// Rotates a map around the vertex pinned by [`hold_gauge`] so that the next boundary edge has the
/// direction that it has in `start`; with A but neither L nor L', a black diagonal.
pub fn turn_back(energy: &Expression, graph: &QuadGraph, start: &[Complex64], z: &mut [Complex64]) {
    let first = graph.boundary[0];
    let through = if energy.joins_diagonal_classes() {
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

/// Translates the white vertices (those not connected to `boundary[0]` by diagonals) by the offset
/// that minimises `Σ_edges (|zi − zj|² − l²)²`. Energies of diagonals alone do not depend on the
/// offset.
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
    // Newton's method in two unknowns; a Hessian that is not positive definite is replaced by its
    // Gauss–Newton part.
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
