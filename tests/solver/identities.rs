//! What holds exactly, on every mesh: similarities are discrete conformal, planar meshes are reproduced.

use crate::common::*;
use num_complex::Complex64;
use riemap::energy::conformal::{self, Weight};
use riemap::problem::linear::{LinearProblem, system};
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, DUAL_POINTS, dual_point};
use riemap::solver::{LINEAR_SOLVERS, Silent, SolveError, solve_linear};
use riemap::surface::oriented_mesh::OrientedMesh;

/// Planar discs, jittered, random, with obtuse angles.
const PLANAR_TRIANGLES: [&str; 5] = [
    "graph:flat?n=8&mesh=triangle&diagonal=random&jitter=0.35&seed=1",
    "graph:flat?n=8&mesh=delaunay&points=random&seed=2",
    "plane?n=7&c=0.45&mesh=triangle",
    "plane-power?n=8&mesh=delaunay&seed=3",
    "plane-exp?n=6&c=2&mesh=triangle&jitter=0.3",
];
const PLANAR_QUADS: [&str; 4] =
    ["graph:flat?n=8&jitter=0.45&seed=4", "plane?n=8&c=-0.4", "plane-power?n=8&k=5", "plane-exp?n=8&c=2&jitter=0.3"];

/// Every planar mesh with every dual point: its quad graph and where the graph's vertices lie.
fn planar() -> Vec<(String, QuadGraph, Vec<Complex64>)> {
    let mut all = Vec::new();
    for name in PLANAR_QUADS {
        let disc = disc_of(name);
        let z = disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect();
        all.push((name.to_string(), graph_of(&disc, ""), z));
    }
    for name in PLANAR_TRIANGLES {
        let disc = disc_of(name);
        for dual in DUAL_POINTS {
            for side in [BoundaryDual::Midpoint, BoundaryDual::Foot] {
                // feet are beside some edges of these meshes: those are refused elsewhere
                if let Ok(graph) = QuadGraph::from_triangles(&disc, *dual, side) {
                    all.push((format!("{name} {} {side:?}", dual.name()), graph, planar_places(&disc, *dual, side)));
                }
            }
        }
    }
    assert!(all.len() >= PLANAR_QUADS.len() + 4 * PLANAR_TRIANGLES.len());
    all
}

/// The largest residual of (2) relative to the larger diagonal (circumcentres of a rectangle's halves coincide).
fn relative_residual(graph: &QuadGraph, z: &[Complex64]) -> f64 {
    let relative = |q: usize| {
        let [z0, z1, z2, z3] = graph.quads[q].map(|v| z[v as usize]);
        conformal::residual(graph, q, z).norm() / (z3 - z1).norm().max((z2 - z0).norm())
    };
    (0..graph.quads.len()).map(relative).fold(0.0, |m: f64, r| if r <= m { m } else { r })
}

/// Sums of a few coordinates of size 10, divided by edges of size 0.1 or, at dual points of thin triangles, less.
const ROUNDING: f64 = 1e-11;

#[test]
fn similarities_of_planar_meshes_are_conformal_whatever_the_dual_point() {
    let mut random = Random(1);
    for (name, graph, z) in planar() {
        for _ in 0..3 {
            let (a, b) = (random.complex(), random.complex());
            let moved: Vec<Complex64> = z.iter().map(|z| a * z + b).collect();
            let r = relative_residual(&graph, &moved);
            assert!(r <= ROUNDING, "{name}: {r:e}");
        }
        // mirrored, it is not
        let mirrored: Vec<Complex64> = z.iter().map(|z| z.conj()).collect();
        assert!(relative_residual(&graph, &mirrored) > 0.1, "{name}");
    }
}

#[test]
fn a_planar_mesh_is_as_conformal_anywhere_in_space() {
    let mut random = Random(2);
    for name in PLANAR_TRIANGLES.iter().chain(&PLANAR_QUADS) {
        let flat = disc_of(name);
        let (rotation, shift) = (random.rotation(), random.vector());
        let mut tilted = flat.clone();
        for p in &mut tilted.positions {
            let y = rotate(rotation, *p);
            *p = [0, 1, 2].map(|k| 3.0 * (y[k] + shift[k]));
        }
        for dual in DUAL_POINTS {
            let z = places(&flat, dual.name());
            let r = relative_residual(&graph_of(&tilted, dual.name()), &z);
            assert!(r <= ROUNDING, "{name} {}: {r:e}", dual.name());
        }
    }
}

/// Where the vertices of the quad graph of a planar mesh lie.
fn places(disc: &OrientedMesh, dual: &str) -> Vec<Complex64> {
    match disc.faces.arity() {
        Some(3) => planar_places(disc, dual_point(dual).expect(dual), BoundaryDual::Midpoint),
        _ => disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect(),
    }
}

#[test]
fn a_folded_strip_unrolls_conformally() {
    // triangles of random shape, each hinged to the one before at a random angle: a developable strip, laid out flat
    let mut random = Random(3);
    let mut flat = vec![Complex64::ZERO, Complex64::ONE];
    let mut folded = vec![[0.0; 3], [1.0, 0.0, 0.0]];
    let mut faces = Vec::new();
    let mut normal = [0.0, 0.0, 1.0];
    for k in 0..20 {
        // the new vertex in the frame of the edge a → b, on its left
        let (a, b) = if k % 2 == 0 { (k, k + 1) } else { (k + 1, k) };
        let (s, h) = (0.5 + 0.3 * random.real(), 1.0 + 0.3 * random.real());
        flat.push(flat[a] + (flat[b] - flat[a]) * Complex64::new(s, h));
        let along = sub(folded[b], folded[a]);
        let length = distance(folded[b], folded[a]);
        let axis = along.map(|x| x / length);
        let up = cross(normal, axis);
        let (sin, cos) = random.real().sin_cos();
        let turned = [0, 1, 2].map(|i| cos * up[i] + sin * normal[i]);
        folded.push([0, 1, 2].map(|i| folded[a][i] + s * along[i] + h * length * turned[i]));
        normal = cross(axis, turned);
        faces.push([a as u32, b as u32, k as u32 + 2]);
        assert!(distance(folded[a], folded[b]) > 1e-3);
    }
    let strip = disc(&surface(folded, &faces));
    let mut unrolled = strip.clone();
    for (p, z) in unrolled.positions.iter_mut().zip(&flat) {
        *p = [z.re, z.im, 0.0];
    }
    for dual in DUAL_POINTS {
        let z = places(&unrolled, dual.name());
        let r = relative_residual(&graph_of(&strip, dual.name()), &z);
        assert!(r <= ROUNDING, "{}: {r:e}", dual.name());
    }
}

#[test]
fn every_backend_reproduces_a_planar_mesh_from_its_boundary() {
    let mut solved = 0;
    let mut worst: f64 = 0.0;
    for (name, graph, z) in planar() {
        let (a, b) = (Complex64::new(0.6, -0.8), Complex64::new(3.0, 1.0));
        let z: Vec<Complex64> = z.iter().map(|z| a * z + b).collect();
        let size = z.iter().map(|z| z.norm()).fold(0.0, f64::max);
        for weight in [Weight::Integral, Weight::Unit] {
            for fixed in [hold_boundary(&graph, &z), hold_every_second(&graph, &z)] {
                let problem = LinearProblem::new(&graph, weight, &fixed).unwrap_or_else(|e| panic!("{name}: {e}"));
                for backend in LINEAR_SOLVERS {
                    match solve_linear(&problem, backend.name(), &mut Silent) {
                        Ok(solution) => {
                            solved += 1;
                            let d = largest_difference(&z, &solution.z) / size;
                            worst = worst.max(d);
                            assert!(d <= 1e-9, "{name}, {weight:?}: {} is off by {d:e}", backend.name());
                        }
                        Err(SolveError::Unsuitable { .. }) => {}
                        Err(error) => panic!("{name}: {error}"),
                    }
                }
            }
        }
    }
    println!("linear precision: {solved} solves, the largest error relative to the mesh {worst:.1e}");
    assert!(solved > 100);
}

#[test]
fn the_square_system_needs_no_sign_of_rho() {
    // a lattice sheared until every pair of angles across its long edges is obtuse: circumcentres far outside
    let mut disc = disc_of("graph:flat?n=6&mesh=triangle&diagonal=same");
    for p in &mut disc.positions {
        p[0] += 3.0 * p[1];
    }
    let graph = graph_of(&disc, "circumcentre");
    assert!(graph.min_re_rho() < -0.5);
    let z = places(&disc, "circumcentre");
    let problem = LinearProblem::new(&graph, Weight::Integral, &hold_every_second(&graph, &z)).expect("square");
    for backend in ["auto", "cotan", "laplacian", "lu", "cholesky", "qr"] {
        let solution = solve_linear(&problem, backend, &mut Silent).unwrap_or_else(|e| panic!("{e}"));
        let d = largest_difference(&z, &solution.z);
        assert!(d <= 1e-10, "{backend}: {d:e}");
    }
}

#[test]
fn quadratic_polynomials_are_exact_where_diagonals_bisect_each_other() {
    // parallelograms: f(m + d) − f(m − d) = 2f'(m) d without a quadratic term
    let mut disc = disc_of("graph:flat?n=9");
    for p in &mut disc.positions {
        p[0] = 1.5 * p[0] + 0.7 * p[1];
    }
    let graph = graph_of(&disc, "");
    let z: Vec<Complex64> = places(&disc, "");
    let square: Vec<Complex64> = z.iter().map(|z| z * z + 0.3 * z).collect();
    assert!(relative_residual(&graph, &square) <= ROUNDING);
    let problem =
        LinearProblem::new(&graph, Weight::Integral, &hold_boundary(&graph, &square)).expect("whole boundary");
    let solution = solve_linear(&problem, "auto", &mut Silent).expect("solvable");
    // values up to 70
    assert!(largest_difference(&square, &solution.z) <= 1e-9);
    // cubes are not
    let cube: Vec<Complex64> = z.iter().map(|z| z * z * z).collect();
    assert!(relative_residual(&graph, &cube) > 1e-3);
}

#[test]
fn holomorphic_functions_are_conformal_to_second_order() {
    // residual relative to the diagonals' images where f' ≠ 0, and H, an integral of its square
    let f = |z: Complex64| {
        let z = z / std::f64::consts::PI;
        z + 0.2 * z * z - 0.1 * z * z * z + 0.05 * (2.0 * z).exp()
    };
    let n = [17.0, 33.0, 65.0];
    let measure = |name: &str, dual: &str| {
        let mut found = [Vec::new(), Vec::new()];
        for n in n {
            let disc = disc_of(&format!("{name}n={n}"));
            let graph = graph_of(&disc, dual);
            let z: Vec<Complex64> = places(&disc, dual).into_iter().map(f).collect();
            let w = conformal::weights(&graph, Weight::Integral).expect("Re ρ > 0");
            found[0].push(relative_residual(&graph, &z));
            found[1].push(conformal::value(&graph, &w, &z));
        }
        let orders = [fitted_order(&n, &found[0]), fitted_order(&n, &found[1])];
        println!(
            "{name} {dual}: residual {:.1e}, order {:.2}; H {:.1e}, order {:.2}",
            found[0][2], orders[0], found[1][2], orders[1]
        );
        orders
    };
    let quads = measure("graph:flat?", "");
    assert!(quads[0] > 1.9 && quads[1] > 3.8, "{quads:?}");
    for dual in ["barycentre", "incentre"] {
        // inside, pairs of triangles are parallelograms and the order is two; along the boundary the dual point and the
        // midpoint are no mirror images, and it is one, on a strip of width h
        let triangles = measure("graph:flat?mesh=triangle&diagonal=same&", dual);
        assert!(triangles[0] > 0.9 && triangles[1] > 2.8, "{dual}: {triangles:?}");
    }
}

#[test]
fn the_matrix_of_the_system_has_the_rows_of_the_equation() {
    let mut random = Random(5);
    for (name, graph, _) in planar().into_iter().step_by(3) {
        let a = system(&graph);
        assert_eq!((a.nrows(), a.ncols(), a.nnz()), (graph.quads.len(), graph.vertices, 4 * graph.quads.len()));
        let z: Vec<Complex64> = (0..graph.vertices).map(|_| random.complex()).collect();
        let mut product = vec![Complex64::ZERO; graph.quads.len()];
        for (q, v, &entry) in a.triplet_iter() {
            product[q] += entry * z[v];
        }
        for (q, product) in product.iter().enumerate() {
            let [z0, z1, z2, z3] = graph.quads[q].map(|v| z[v as usize]);
            let equation = z3 - z1 - Complex64::I * graph.rho[q] * (z2 - z0);
            assert!((product - equation).norm() <= 1e-13 * (1.0 + graph.rho[q].norm()), "{name}");
        }
        // A z = (A Z) y − b
        let problem = LinearProblem::new(&graph, Weight::Unit, &hold_boundary(&graph, &z)).expect("whole");
        let (reduced, right) = problem.reduced_system();
        let mut sum: Vec<Complex64> = right.iter().map(|b| -b).collect();
        for (q, k, &entry) in reduced.triplet_iter() {
            sum[q] += entry * z[problem.elimination.free[k] as usize];
        }
        assert!(largest_difference(&sum, &product) <= 1e-10, "{name}");
        let y: Vec<Complex64> = problem.elimination.free.iter().map(|&v| z[v as usize]).collect();
        assert_eq!(problem.elimination.expand(&y), z);
    }
}
