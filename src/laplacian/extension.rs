//! The extension of boundary values to the whole map.

use num_complex::Complex64;

use super::{ConformalLaplacian, Work};
use crate::geometry::maximum::max_or_nan;
use crate::quad_graph::QuadGraph;
use crate::sparse::Lists;

impl ConformalLaplacian {
    /// Returns the map (`nv`) with black boundary values b (n) and H = 0.
    ///
    /// Inner black values are `−L_II⁻¹ L_IB b`. White values follow by summing (2) and have mean
    /// w_0 over the first boundary loop.
    pub fn extend(&self, graph: &QuadGraph, b: &[Complex64], w_0: Complex64, work: &mut Work) -> Vec<Complex64> {
        let mut z = self.extend_black(graph, b, work);
        let Some(first) = self.loops.ranges.first() else { return z };
        self.add_up(graph, self.loops.white[first.start], &mut z);
        let white = &self.loops.white[first.clone()];
        let mean = white.iter().map(|&v| z[v as usize]).sum::<Complex64>() / white.len() as f64;
        self.shift_white(w_0 - mean, &mut z);
        z
    }

    /// Returns the black values (`nv`, 0 at white vertices) with `L z = 0` at inner vertices and
    /// boundary values b (n).
    pub fn extend_black(&self, graph: &QuadGraph, b: &[Complex64], work: &mut Work) -> Vec<Complex64> {
        let mut z = vec![Complex64::ZERO; graph.vertices];
        let mut y = work.take();
        self.rows.inward(b, &mut y);
        self.factor.solve(&mut y, work);
        for (&v, y) in self.numbering.inner.iter().zip(&y) {
            z[v as usize] = -y;
        }
        work.give_back(y);
        for (&v, &b) in self.loops.black.iter().zip(b) {
            z[v as usize] = b;
        }
        z
    }

    /// Computes the white values of z (`nv`) by summing (2), breadth first, from the white vertex
    /// `start`, whose value is kept.
    pub fn add_up(&self, graph: &QuadGraph, start: u32, z: &mut [Complex64]) {
        self.walk_white(graph, start, |from, to, i_rho, [i, j]| {
            z[to as usize] = z[from as usize] + i_rho * (z[j as usize] - z[i as usize]);
            false
        });
    }

    /// Adds `step` to all white values of z.
    fn shift_white(&self, step: Complex64, z: &mut [Complex64]) {
        let white = z.iter_mut().enumerate().filter(|&(v, _)| !self.colouring.is_black(v as u32));
        white.for_each(|(_, z)| *z += step);
    }

    /// Visits the white vertices breadth first from `start`: `visit(from, to, iρ, [i, j])`, where
    /// `z_to = z_from + iρ (z_j − z_i)`. Stops when it returns true.
    fn walk_white(&self, graph: &QuadGraph, start: u32, mut visit: impl FnMut(u32, u32, Complex64, [u32; 2]) -> bool) {
        let quads = self.colouring.quads(graph).zip(0..);
        let around = Lists::new(graph.vertices, quads.flat_map(|(quad, q)| quad.white.map(|v| (v, q))));
        let mut reached = vec![false; graph.vertices];
        reached[start as usize] = true;
        let mut queue = vec![start];
        let mut head = 0;
        while head < queue.len() {
            let from = queue[head];
            head += 1;
            for &q in around.of(from) {
                let quad = self.colouring.quad(graph, q as usize);
                let [g, f] = quad.white;
                let [i, j] = quad.black;
                let (to, ends) = if from == g { (f, [i, j]) } else { (g, [j, i]) };
                if !std::mem::replace(&mut reached[to as usize], true) {
                    if visit(from, to, Complex64::I * quad.rho, ends) {
                        return;
                    }
                    queue.push(to);
                }
            }
        }
    }

    /// Computes [`ConformalLaplacian::shifts`].
    ///
    /// A path of quads from the first loop to another one gives the functional `c_B·z_B + c_I·z_I`.
    /// On solutions of `L z = 0` it is `(c_B − L_BI L_II⁻¹ c_I)·b`, because L is symmetric.
    pub(super) fn shifts_between_loops(&self, graph: &QuadGraph) -> Vec<Vec<Complex64>> {
        let [first, others @ ..] = self.loops.ranges.as_slice() else { return Vec::new() };
        if others.is_empty() {
            return Vec::new();
        }
        // The step by which each white vertex was reached.
        let mut step = vec![None; graph.vertices];
        self.walk_white(graph, self.loops.white[first.start], |from, to, i_rho, ends| {
            step[to as usize] = Some((from, i_rho, ends));
            false
        });
        let mut work = self.work();
        let shift = |range: &std::ops::Range<usize>| {
            let mut c = vec![Complex64::ZERO; self.len()];
            let mut y = work.take();
            let mut at = self.loops.white[range.start];
            while let Some((from, i_rho, [i, j])) = step[at as usize] {
                for (v, value) in [(j, i_rho), (i, -i_rho)] {
                    match (self.numbering.position(v), self.inner_index(v)) {
                        (Some(k), _) => c[k] += value,
                        (_, Some(u)) => y[u] += value,
                        _ => {}
                    }
                }
                at = from;
            }
            self.factor.solve(&mut y, &mut work);
            self.rows.subtract_outward(&y, &mut c);
            work.give_back(y);
            c
        };
        others.iter().map(shift).collect()
    }

    /// Returns the largest `|r| / (|z_f| + |z_g| + |ρ| (|z_j| + |z_i|))` over the quads, where r is
    /// the residual of (2).
    pub fn residual(&self, graph: &QuadGraph, z: &[Complex64]) -> f64 {
        self.colouring.quads(graph).fold(0.0, |worst, quad| {
            let [i, j] = quad.black.map(|v| z[v as usize]);
            let [g, f] = quad.white.map(|v| z[v as usize]);
            let size = |z: Complex64| z.norm_sqr().sqrt();
            let r = size(f - g - Complex64::I * quad.rho * (j - i));
            let scale = size(f) + size(g) + size(quad.rho) * (size(j) + size(i));
            let relative = if r == 0.0 { 0.0 } else { r / scale };
            max_or_nan(worst, relative)
        })
    }
}
