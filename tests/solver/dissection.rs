//! The order of elimination of large meshes: every unknown once, little fill, the same solutions.

use crate::common::{Random, disc, graph_of};
use num_complex::Complex64;
use riemap::constraint::{Elimination, Fixed};
use riemap::energy::conformal::{self, Weight};
use riemap::input::Input;
use riemap::map::{Domain, MapOptions};
use riemap::quad_graph::QuadGraph;
use riemap::sparse::{Order, Pattern, PrunedCholesky, Stencils, dissect};
use riemap::surface::oriented_mesh::OrientedMesh;

fn graph(name: &str) -> QuadGraph {
    let input = Input::open(name).unwrap();
    let options = MapOptions::default();
    let (disc, _) = OrientedMesh::open(&input.surface, &input.diagnosis(), &options.opening()).unwrap();
    Domain::of_positions(disc, &options).unwrap().graph
}

/// The same, vertices and faces in random order.
fn shuffled(name: &str) -> QuadGraph {
    let surface = Input::open(name).unwrap().surface;
    let mut random = Random(1);
    let [faces, vertices] = [surface.faces().len(), surface.positions().len()].map(|n| random.permutation(n));
    graph_of(&disc(&crate::common::shuffled(&surface, &faces, &vertices)), "")
}

fn boundary_held(graph: &QuadGraph) -> Fixed {
    let mut fixed = Fixed::default();
    graph.boundary.iter().for_each(|&v| fixed.hold(v, Complex64::ZERO));
    fixed
}

/// D_II factorised, with these vertices as ports.
fn factor(graph: &QuadGraph, elimination: &Elimination, ports: &[u32]) -> PrunedCholesky {
    let weights = conformal::weights(graph, Weight::Integral).unwrap();
    let stencils = Stencils::new(&graph.quads);
    let pattern = Pattern::new(&[&stencils], &elimination.unknown, elimination.unknowns());
    let mut values = vec![0.0; pattern.columns.rows.len()];
    for (q, quad) in graph.quads.iter().enumerate() {
        let block = conformal::block(graph.rho[q], weights[q]);
        let pairs = (0..4).flat_map(|i| (0..=i).map(move |j| (i, j)));
        for (&slot, (i, j)) in pattern.slots(0, q, 4).iter().zip(pairs).filter(|(slot, _)| **slot != Pattern::NONE) {
            let unknown = |k: usize| elimination.unknown[quad[k] as usize];
            let (row, column) = if unknown(i) >= unknown(j) { (i, j) } else { (j, i) };
            values[slot as usize] += block[row][column].re;
        }
    }
    let ports = ports.iter().map(|&v| elimination.unknown[v as usize]).collect();
    PrunedCholesky::new(&pattern.columns, elimination.order, &values, ports).unwrap()
}

/// Above the size at which unknowns are dissected, of both kinds.
const LARGE: [&str; 2] = ["graph:cos+cos?n=240&mesh=delaunay", "graph:cos+cos?n=400"];

#[test]
fn every_free_vertex_has_one_place_in_the_order_and_no_other_vertex_has() {
    for name in ["plane?n=8", "sphere?n=40&mesh=delaunay", LARGE[0], LARGE[1]] {
        let graph = graph(name);
        // Any vertices may be held.
        let is_free = |v: u32| !v.is_multiple_of(7);
        let mut order = dissect(&graph.quads, &graph.places, is_free);
        order.sort_unstable();
        let free: Vec<u32> = (0..graph.vertices as u32).filter(|&v| is_free(v)).collect();
        assert_eq!(order, free, "{name}");
    }
}

#[test]
fn parts_that_have_nothing_in_common_are_ordered_too() {
    let graph = graph(LARGE[1]);
    // Held along both lines through the middle: whichever way the mesh is halved, no free vertex is on both sides.
    let is_free = |v: u32| graph.places[v as usize][..2].iter().all(|x| x.abs() > 0.1);
    let mut order = dissect(&graph.quads, &graph.places, is_free);
    order.sort_unstable();
    assert_eq!(order, (0..graph.vertices as u32).filter(|&v| is_free(v)).collect::<Vec<_>>());
}

#[test]
fn surfaces_of_one_point_are_ordered_too() {
    let graph = graph("plane?n=40");
    let nowhere = vec![[0.0; 3]; graph.vertices];
    assert_eq!(dissect(&graph.quads, &nowhere, |_| true).len(), graph.vertices);
}

#[test]
fn meshes_numbered_row_by_row_are_left_to_minimum_degree_which_costs_less_there() {
    for (graph, order) in [(graph(LARGE[1]), Order::Amd), (shuffled(LARGE[1]), Order::AsGiven)] {
        assert_eq!(Elimination::for_factor(&graph, &boundary_held(&graph)).order, order);
    }
}

#[test]
fn dissection_fills_as_little_as_minimum_degree_and_solves_the_same() {
    for (name, graph) in [(LARGE[0], graph(LARGE[0])), ("shuffled", shuffled(LARGE[1]))] {
        let fixed = boundary_held(&graph);
        let [plain, dissected] = [Elimination::new(graph.vertices, &fixed), Elimination::for_factor(&graph, &fixed)];
        assert_eq!((plain.order, dissected.order), (Order::Amd, Order::AsGiven), "{name}");
        let ports: Vec<u32> = plain.free.iter().copied().step_by(1000).collect();
        let [plain, dissected] = [&plain, &dissected].map(|elimination| factor(&graph, elimination, &ports));
        // About 80 values an unknown in both; the work of larger ones is half that of minimum degree.
        assert!((dissected.len() as f64) < 1.2 * plain.len() as f64, "{name}: {} {}", dissected.len(), plain.len());
        let right = || (0..ports.len()).map(|k| Complex64::new(1.0 + k as f64, -(k as f64))).collect::<Vec<_>>();
        let [x, y] = [plain, dissected].map(|factor| {
            let mut y = right();
            factor.solve_at_ports(&mut y, &mut factor.work());
            y
        });
        let size = x.iter().map(|x| x.norm()).fold(0.0, f64::max);
        // The condition is about the number of vertices, 1e5.
        assert!(x.iter().zip(&y).all(|(x, y)| (x - y).norm() < 1e-10 * size), "{name}");
    }
}
