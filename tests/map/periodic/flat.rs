//! Flat tori, given by their ρ alone: they are exact whatever the lattice.

use super::shared::*;
use crate::common::*;
use num_complex::Complex64;
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::DUAL_POINTS;
use riemap::surface::oriented_mesh::OrientedMesh;

/// A grid in the plane with the periods ω1 (across) and ω2 (up), its inner points moved.
struct Grid {
    columns: u32,
    rows: u32,
    omega: [Complex64; 2],
    /// The place of each vertex.
    place: Vec<Complex64>,
}

impl Grid {
    fn new(columns: u32, rows: u32, omega: [Complex64; 2], random: &mut Random) -> Self {
        let place = (0..columns * rows).map(|v| {
            let [i, j] = [v % columns, v / columns].map(|k| f64::from(k) + 0.25 * random.real());
            i / f64::from(columns) * omega[0] + j / f64::from(rows) * omega[1]
        });
        Grid { columns, rows, omega, place: place.collect() }
    }

    /// Quads, their vertices in general position in R³: lengths mean nothing, and so do the shortest loops.
    fn disc(&self, triangles: bool) -> OrientedMesh {
        let quads = quad_grid(self.columns, self.rows, Sides::Torus);
        closed(&if triangles { triangulated(&quads) } else { quads })
    }

    /// The lift of vertex v that is beside that of vertex `first` at its place.
    fn beside(&self, first: u32, v: u32) -> Complex64 {
        let wrap = |a: u32, b: u32, n: u32| {
            let d = i64::from(b) - i64::from(a);
            if 2 * d > i64::from(n) {
                -1.0
            } else if 2 * d < -i64::from(n) {
                1.0
            } else {
                0.0
            }
        };
        let m = wrap(first % self.columns, v % self.columns, self.columns);
        let n = wrap(first / self.columns, v / self.columns, self.rows);
        self.place[v as usize] + m * self.omega[0] + n * self.omega[1]
    }
}

/// Takes ρ and the diagonal from places in the plane.
fn with_places(graph: &mut QuadGraph, places: impl Fn(usize) -> [Complex64; 4]) {
    for q in 0..graph.quads.len() {
        let [z0, z1, z2, z3] = places(q);
        graph.rho[q] = (z3 - z1) / (Complex64::I * (z2 - z0));
        graph.diagonal[q] = (z2 - z0).norm();
    }
}

fn lattices() -> Vec<[Complex64; 2]> {
    let c = Complex64::new;
    vec![
        [c(1.0, 0.0), c(0.0, 1.0)],
        [c(1.0, 0.0), c(0.5, 0.75f64.sqrt())],
        [c(1.0, 0.0), c(0.5, 1.1)],
        [c(2.0, 0.3), c(-1.1, 0.9)],
        [c(1.0, 0.0), c(3.7, 1.3)],
        [c(1.0, 0.0), c(0.2, 0.07)],
        [c(0.3, -4.0), c(0.31, 0.5)],
    ]
}

/// The largest difference between the map on the corners of quads and a similarity of the places, in differences along
/// diagonals: colours float.
fn difference(
    graph: &QuadGraph,
    map: &riemap::map::periodic::PeriodicMap,
    places: impl Fn(usize) -> [Complex64; 4],
) -> f64 {
    let diagonal = |[z0, _, z2, _]: [Complex64; 4]| z2 - z0;
    let scale = diagonal(map.quad(graph, 0)) / diagonal(places(0));
    let quads = (0..graph.quads.len()).map(|q| {
        let ([z0, z1, z2, z3], [w0, w1, w2, w3]) = (map.quad(graph, q), places(q));
        ((z2 - z0) - scale * (w2 - w0)).norm().max(((z3 - z1) - scale * (w3 - w1)).norm())
    });
    quads.fold(0.0, f64::max)
}

#[test]
fn flat_quad_tori_are_exact() {
    for (k, omega) in lattices().into_iter().enumerate() {
        for (columns, rows) in [(8, 8), (9, 7), (6, 11)] {
            let grid = Grid::new(columns, rows, omega, &mut Random(k as u64));
            let disc = grid.disc(false);
            let mut graph = graph_of(&disc, "");
            let quads = graph.quads.clone();
            let places = |q: usize| quads[q].map(|v| grid.beside(quads[q][0], v));
            with_places(&mut graph, places);
            let wanted = omega[1] / omega[0];
            for weight in WEIGHTS {
                // Moved points of thin lattices turn quads over: integral weights are not defined there.
                if graph.min_re_rho() <= 0.0 && weight == Default::default() {
                    continue;
                }
                let found = map(&disc, &graph, weight);
                let error = riemap::map::periodic::relative_error(found.tau, wanted).unwrap();
                // rounding of normal equations, whose condition is some 1e4
                assert!(error < 1e-10, "{omega:?} {columns}×{rows} {weight:?}: {} {error:e}", found.tau);
                assert!(difference(&graph, &found, places) < 1e-10);
                assert!(found.h >= 0.0 && found.h < 1e-18 * found.tau.im.max(1.0), "{}", found.h);
            }
        }
    }
}

#[test]
fn flat_triangle_tori_are_exact_with_every_dual_point() {
    for (k, omega) in lattices().into_iter().enumerate() {
        let grid = Grid::new(7, 8, omega, &mut Random(k as u64));
        let disc = grid.disc(true);
        for &dual in DUAL_POINTS {
            let plain = graph_of(&disc, dual.name());
            let quads = plain.quads.clone();
            // The dual point of a face in the frame of its vertex `first`.
            let dual_place = |first: u32, vertex: u32| {
                let face = disc.faces.get((vertex as usize) - plain.primal);
                let corner = [0, 1, 2].map(|k| grid.beside(first, face[k]));
                let w = dual.weights([0, 1, 2].map(|k| (corner[(k + 2) % 3] - corner[(k + 1) % 3]).norm()));
                (corner[0] * w[0] + corner[1] * w[1] + corner[2] * w[2]) / (w[0] + w[1] + w[2])
            };
            let places = |q: usize| {
                let [vi, g, vj, f] = quads[q];
                [grid.place[vi as usize], dual_place(vi, g), grid.beside(vi, vj), dual_place(vi, f)]
            };
            let mut graph = plain.clone();
            with_places(&mut graph, places);
            for weight in WEIGHTS {
                if graph.min_re_rho() <= 1e-3 && weight == Default::default() {
                    continue;
                }
                let found = map(&disc, &graph, weight);
                let error = riemap::map::periodic::relative_error(found.tau, omega[1] / omega[0]).unwrap();
                assert!(error < 1e-9, "{omega:?} {} {weight:?}: {} {error:e}", dual.name(), found.tau);
                assert!(difference(&graph, &found, places) < 1e-9);
            }
        }
    }
}
