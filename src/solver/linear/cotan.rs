use num_complex::Complex64;

use super::normal::{assemble, in_real_columns, pattern};
use super::{LinearBackend, SolveError, Unsuitable};
use crate::constraint::{Elimination, Fixed};
use crate::problem::linear::LinearProblem;
use crate::solver::{Observer, Phase};
use crate::sparse::Analysis;

/// Where every ρ is real, (2) splits: the black vertices carry a harmonic map of the Laplacian with edge weights ρ (the
/// cotan weights, for circumcentres), the white ones its conjugate, by `z3 = z1 + iρ(z2 − z0)` from one of them.
///
/// Needs no sign of ρ: the Laplacian of a triangle mesh is positive definite whatever the signs of its weights.
pub(super) struct Cotan;

impl LinearBackend for Cotan {
    fn name(&self) -> &'static str {
        "cotan"
    }

    fn description(&self) -> &'static str {
        "real cotan Laplacian, sparse Cholesky: circumcentres, mesh boundary and one dual vertex held"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        let graph = problem.graph;
        if let Some(quad) = graph.rho.iter().position(|rho| rho.im != 0.0) {
            return Err(Unsuitable::NotOrthogonal { quad, im_rho: graph.rho[quad].im });
        }
        if problem.is_square() && black_class(problem).is_some() { Ok(()) } else { Err(Unsuitable::NotPrimal) }
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        watch.phase(Phase::Assemble);
        let unsuitable = SolveError::Unsuitable { backend: self.name(), reason: Unsuitable::NotPrimal };
        let (is_black, white_start) = black_class(problem).ok_or(unsuitable)?;
        let graph = problem.graph;
        // To the Laplacian white vertices are as good as held.
        let mut not_unknown = Fixed::default();
        for v in (0..graph.vertices as u32).filter(|&v| !is_black[v as usize] || !problem.elimination.is_free(v)) {
            not_unknown.hold(v, problem.elimination.z0[v as usize]);
        }
        let black = Elimination::for_factor(graph, &not_unknown);
        let edge = |q: usize| {
            let [v0, v1, v2, v3] = graph.quads[q];
            let rho = graph.rho[q].re;
            if is_black[v0 as usize] { (v0, v2, rho) } else { (v1, v3, 1.0 / rho) }
        };
        let pattern = pattern(graph, &black);
        let values = assemble(&pattern, graph, &black, 0.0, |q| {
            let (.., weight) = edge(q);
            let (w, o) = (weight, 0.0);
            // Of the two diagonals only the black one has both ends on the pattern.
            [[w, o, -w, o], [o, w, o, -w], [-w, o, w, o], [o, -w, o, w]]
        });
        watch.phase(Phase::Factor);
        let broken = |reason| SolveError::broken(self, problem, reason);
        let analysis = Analysis::ordered(&pattern.columns, black.order).map_err(broken)?;
        let factor = analysis.factorise(&values, None).map_err(broken)?;
        watch.phase(Phase::Solve);
        let mut z = black.z0.clone();
        for _ in 0..2 {
            let mut defect = vec![Complex64::ZERO; graph.vertices];
            for q in 0..graph.quads.len() {
                let (a, b, weight) = edge(q);
                let flow = weight * (z[b as usize] - z[a as usize]);
                defect[a as usize] += flow;
                defect[b as usize] -= flow;
            }
            let mut y: Vec<Complex64> = black.free.iter().map(|&v| defect[v as usize]).collect();
            in_real_columns(&mut y, |columns| factor.solve_in_place(columns));
            for (&v, y) in black.free.iter().zip(&y) {
                z[v as usize] += y;
            }
        }
        integrate_white(problem, &is_black, white_start, &mut z);
        Ok(z)
    }
}

/// Which vertices are black (all boundary vertices of the class held) and the one white vertex that is held; `None`
/// where the constraints are of another form.
fn black_class(problem: &LinearProblem) -> Option<(Vec<bool>, u32)> {
    let (graph, elimination) = (problem.graph, &problem.elimination);
    let (class, classes) = graph.diagonal_classes();
    if classes != 2 {
        return None;
    }
    (0..2).find_map(|black| {
        let all_held = graph.boundary.iter().filter(|&&v| class[v as usize] == black).all(|&v| !elimination.is_free(v));
        let mut white_held =
            (0..graph.vertices as u32).filter(|&v| class[v as usize] != black && !elimination.is_free(v));
        let start = white_held.next()?;
        (all_held && white_held.next().is_none()).then(|| (class.iter().map(|&c| c == black).collect(), start))
    })
}

/// Carries (2) from the white vertex `start` to all others, breadth-first.
fn integrate_white(problem: &LinearProblem, is_black: &[bool], start: u32, z: &mut [Complex64]) {
    let graph = problem.graph;
    let incidence = graph.incidence();
    let mut reached = is_black.to_vec();
    reached[start as usize] = true;
    let mut queue = vec![start];
    let mut head = 0;
    while head < queue.len() {
        let v = queue[head];
        head += 1;
        for &q in incidence.quads_at(v) {
            let [v0, v1, v2, v3] = graph.quads[q as usize];
            let rho = graph.rho[q as usize];
            let ahead = |a: u32, b: u32| z[b as usize] - z[a as usize];
            let (other, step) = if is_black[v0 as usize] {
                let step = Complex64::I * rho * ahead(v0, v2);
                if v == v1 { (v3, step) } else { (v1, -step) }
            } else {
                let step = ahead(v1, v3) / (Complex64::I * rho);
                if v == v0 { (v2, step) } else { (v0, -step) }
            };
            if !std::mem::replace(&mut reached[other as usize], true) {
                z[other as usize] = z[v as usize] + step;
                queue.push(other);
            }
        }
    }
}
