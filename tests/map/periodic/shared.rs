use crate::common::*;
use num_complex::Complex64;
use riemap::energy::conformal::Weight;
use riemap::map::periodic::{PeriodicMap, periodic};
use riemap::quad_graph::QuadGraph;
use riemap::solver::Silent;
use riemap::surface::Surface;
use riemap::surface::generate::generate;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::diagnosis::Diagnosis;

pub const WEIGHTS: [Weight; 2] = [Weight::Integral, Weight::Unit];

/// A closed surface as the pipeline takes it.
#[track_caller]
pub fn closed(s: &Surface) -> OrientedMesh {
    OrientedMesh::closed(s, &Diagnosis::new(s), false).unwrap_or_else(|error| panic!("{error}")).0
}

#[track_caller]
pub fn map(disc: &OrientedMesh, graph: &QuadGraph, weight: Weight) -> PeriodicMap {
    periodic(disc, graph, weight, &mut Silent).unwrap_or_else(|error| panic!("{error}"))
}

pub const BIG: f64 = 2.0;
pub const SMALL: f64 = 0.8;

/// i r/√(R² − r²)
pub fn exact() -> Complex64 {
    Complex64::new(0.0, SMALL / (BIG * BIG - SMALL * SMALL).sqrt())
}

pub fn torus_surface(n: usize, mesh: &str) -> Surface {
    generate(&format!("torus?R={BIG}&r={SMALL}&n={n}{mesh}")).unwrap().surface
}

pub fn torus(n: usize, mesh: &str) -> OrientedMesh {
    closed(&torus_surface(n, mesh))
}

/// The torus of revolution of n × n quads, every angle moved at random by up to a fifth of a step; or of their halves.
pub fn jittered_torus(n: u32, triangles: bool, seed: u64) -> OrientedMesh {
    let mut random = Random(seed);
    let grid = quad_grid(n, n, Sides::Torus);
    let mut place = |v: u32| {
        let [phi, theta] =
            [v % n, v / n].map(|k| std::f64::consts::TAU * (f64::from(k) + 0.2 * random.real()) / f64::from(n));
        let distance = BIG + SMALL * theta.cos();
        [distance * phi.cos(), distance * phi.sin(), SMALL * theta.sin()]
    };
    let s = surface((0..n * n).map(&mut place).collect(), grid.faces().iter());
    closed(&if triangles { triangulated(&s) } else { s })
}

/// The torus of revolution of about equilateral triangles: n around the axis in each of m rows, every second row turned by half
/// a step. All angles are acute for m < 0.57 n.
pub fn brick_torus(n: u32, m: u32) -> OrientedMesh {
    let angle = |k: f64, n: u32| std::f64::consts::TAU * k / f64::from(n);
    let mut positions = Vec::new();
    for j in 0..m {
        let (sin_theta, cos_theta) = angle(f64::from(j), m).sin_cos();
        for i in 0..n {
            let (sin, cos) = angle(f64::from(i) + 0.5 * f64::from(j % 2), n).sin_cos();
            let distance = BIG + SMALL * cos_theta;
            positions.push([distance * cos, distance * sin, SMALL * sin_theta]);
        }
    }
    let vertex = |i: u32, j: u32| (j % m) * n + i % n;
    let mut faces = Vec::new();
    for j in 0..m {
        for i in 0..n {
            // The vertex above the edge from i to i + 1; that from i − 1 to i has the one before it.
            let above = i + j % 2;
            faces.push([vertex(i, j), vertex(i + 1, j), vertex(above, j + 1)]);
            faces.push([vertex(i, j), vertex(above, j + 1), vertex(above + n - 1, j + 1)]);
        }
    }
    closed(&surface(positions, faces))
}

/// Whether `jump` is m + nτ.
pub fn is_period(map: &PeriodicMap, jump: Complex64, tolerance: f64) -> bool {
    let [m, n] = map.lattice_coordinates(jump);
    (m - m.round()).abs() < tolerance && (n - n.round()).abs() < tolerance
}
