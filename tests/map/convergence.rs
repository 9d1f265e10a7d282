//! The linear map with its boundary held at the exact images converges to the exact conformal map.

use crate::common::*;
use num_complex::Complex64;
use riemap::constraint::Fixed;
use riemap::energy::conformal::Weight;
use riemap::problem::linear::LinearProblem;
use riemap::quad_graph::QuadGraph;
use riemap::solver::{Silent, solve_linear};
use riemap::surface::generate::generate;

const SURFACES: [&str; 4] = ["plane?", "sphere?", "enneper?", "torus-patch?"];
const N: [f64; 3] = [16.0, 32.0, 64.0];

/// How the exact map is prescribed on the boundary.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    /// Mesh vertices at their images, dual vertices at the midpoints between.
    Chord,
    /// Mesh vertices at their images, dual vertices on the circle half-way between.
    Arc,
    /// Mesh vertices at their images and one dual vertex at the midpoint: (2) is square.
    Primal,
}

fn held(graph: &QuadGraph, exact: &[Complex64], how: Held) -> Fixed {
    let mut z = exact.to_vec();
    z.resize(graph.vertices, Complex64::ZERO);
    if graph.vertices > graph.primal {
        let n = graph.boundary.len();
        for k in (1..n).step_by(2) {
            let middle = 0.5 * (z[graph.boundary[k - 1] as usize] + z[graph.boundary[(k + 1) % n] as usize]);
            z[graph.boundary[k] as usize] = if how == Held::Arc { middle / middle.norm() } else { middle };
        }
    }
    match how {
        Held::Primal => hold_every_second(graph, &z),
        _ => hold_boundary(graph, &z),
    }
}

/// Distances of the mesh vertices from their exact images.
#[derive(Clone, Copy, Debug)]
struct Error {
    largest: f64,
    rms: f64,
}

fn error(name: &str, dual: &str, weight: Weight, how: Held) -> Error {
    let generated = generate(name).unwrap_or_else(|error| panic!("{error}"));
    let exact: Vec<Complex64> =
        generated.exact.expect("a known map").iter().map(|w| Complex64::new(w[0], w[1])).collect();
    let graph = graph_of(&disc(&generated.surface), dual);
    let fixed = held(&graph, &exact, how);
    let problem = LinearProblem::new(&graph, weight, &fixed).unwrap_or_else(|error| panic!("{error}"));
    let solution = solve_linear(&problem, "auto", &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"));
    let squares: f64 = exact.iter().zip(&solution.z).map(|(a, b)| (a - b).norm_sqr()).sum();
    Error { largest: largest_difference(&exact, &solution.z), rms: (squares / exact.len() as f64).sqrt() }
}

/// Errors at n = 32, and the orders of both.
fn study(surface: &str, mesh: &str, dual: &str, weight: Weight, how: Held) -> (Error, [f64; 2]) {
    let errors = N.map(|n| error(&format!("{surface}n={n}&{mesh}"), dual, weight, how));
    let [largest, rms] = [errors.map(|e| e.largest), errors.map(|e| e.rms)];
    let orders = [fitted_order(&N, &largest), fitted_order(&N, &rms)];
    let shown = |e: [f64; 3]| e.map(|e| format!("{e:.2e}")).join(" ");
    println!(
        "{surface}{mesh} {dual} {weight:?} {how:?}: largest {} order {:.2}, rms {} order {:.2}",
        shown(largest),
        orders[0],
        shown(rms),
        orders[1]
    );
    (errors[1], orders)
}

// Bounds at n = 32: the cells are h = 1/16 wide, the surfaces have size and curvature about 1, so h² = 4e-3 is the scale
// of the error; each bound is about twice the largest of the four surfaces'.

#[test]
fn quad_meshes_converge_with_order_two() {
    for surface in SURFACES {
        for weight in [Weight::Integral, Weight::Unit] {
            let (at_32, orders) = study(surface, "mesh=quad", "", weight, Held::Chord);
            assert!(orders[0] > 1.9 && orders[1] > 1.9, "{surface} {weight:?}: {orders:?}");
            assert!(at_32.largest < 6e-4, "{surface} {weight:?}: {at_32:?}");
        }
        // half of the boundary held, and one vertex more: the same order, ten times the error
        let (at_32, orders) = study(surface, "mesh=quad", "", Weight::Integral, Held::Primal);
        assert!(orders[0] > 1.9, "{surface}: {orders:?}");
        assert!(at_32.largest < 7e-3, "{surface}: {at_32:?}");
    }
}

#[test]
fn triangle_meshes_converge_with_order_two_when_their_own_boundary_is_held() {
    for surface in SURFACES {
        for (dual, bound) in [("barycentre", 4e-4), ("circumcentre", 3e-3), ("incentre", 7e-4)] {
            let (at_32, orders) = study(surface, "mesh=triangle", dual, Weight::Integral, Held::Primal);
            // at the four corners of the grid, flat angles on the circle, the order sets in late (n = 128: 1.9)
            assert!(orders[0] > 1.7 && orders[1] > 1.8, "{surface} {dual}: {orders:?}");
            assert!(at_32.largest < bound, "{surface} {dual}: {at_32:?}");
        }
    }
}

#[test]
fn triangle_meshes_converge_on_average_when_boundary_duals_are_held_at_midpoints_or_on_the_circle() {
    for surface in SURFACES {
        for (dual, weight, bound) in [
            ("barycentre", Weight::Integral, 6e-4),
            ("circumcentre", Weight::Unit, 3.5e-3),
            ("incentre", Weight::Integral, 6e-4),
        ] {
            for how in [Held::Chord, Held::Arc] {
                // Neither place is exact: where the scale varies along the edge the dual vertex is off by O(h²), and least
                // squares spread this. The largest error, at the grid's corners, falls slower (n = 128: 1.6 to 1.9).
                let (at_32, orders) = study(surface, "mesh=triangle", dual, weight, how);
                assert!(orders[0] > 1.2 && orders[1] > 1.6, "{surface} {dual} {how:?}: {orders:?}");
                assert!(at_32.largest < bound, "{surface} {dual} {how:?}: {at_32:?}");
            }
        }
    }
}

#[test]
fn on_irregular_meshes_barycentres_are_several_times_as_accurate_as_circumcentres() {
    for surface in SURFACES {
        let (barycentre, orders) = study(surface, "mesh=delaunay", "barycentre", Weight::Integral, Held::Primal);
        let (circumcentre, _) = study(surface, "mesh=delaunay", "circumcentre", Weight::Integral, Held::Primal);
        assert!(orders[0] > 1.7 && orders[1] > 1.7, "{surface}: {orders:?}");
        assert!(barycentre.largest < 3e-4, "{surface}: {barycentre:?}");
        assert!(circumcentre.largest > 3.0 * barycentre.largest, "{surface}: {circumcentre:?} {barycentre:?}");
        assert!(circumcentre.rms > 3.0 * barycentre.rms, "{surface}: {circumcentre:?} {barycentre:?}");
    }
}
