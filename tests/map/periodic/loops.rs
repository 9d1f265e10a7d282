use super::shared::*;
use crate::common::*;
use num_complex::Complex64;
use riemap::energy::conformal::Weight;
use riemap::surface::edges::Edges;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::homology::{Cycle, Homology};

/// Sum of the map's differences along a closed walk of edges.
fn period(
    disc: &OrientedMesh,
    cycle: &Cycle,
    edges: &Edges,
    difference: impl Fn(usize, usize) -> Complex64,
) -> Complex64 {
    let vertex = disc.faces.corners();
    let mut sum = Complex64::ZERO;
    for (k, &e) in cycle.edges.iter().enumerate() {
        let (from, to) = (cycle.vertices[k], cycle.vertices[(k + 1) % cycle.vertices.len()]);
        let c = edges.corners(e as usize)[0] as usize;
        let range = disc.faces.corner_range(edges.face_of_corner[c] as usize);
        let next = if c + 1 == range.end { range.start } else { c + 1 };
        let along = difference(c, next);
        match (vertex[c], vertex[next]) {
            (a, b) if (a, b) == (from, to) => sum += along,
            (a, b) if (b, a) == (from, to) => sum -= along,
            ends => panic!("edge {e} with ends {ends:?} does not lead from {from} to {to}"),
        }
    }
    sum
}

#[test]
fn the_loops_have_the_periods_1_and_tau() {
    let skew = closed(&triangulated(&quad_grid(9, 8, Sides::Torus)));
    for disc in [torus(12, ""), torus(9, "&mesh=triangle&diagonal=same"), brick_torus(16, 8), skew] {
        let found = map(&disc, &graph_of(&disc, "barycentre"), Weight::Integral);
        let edges = Edges::new(&disc.faces, disc.positions.len());
        for (cycle, omega) in found.loops.iter().zip(found.omega()) {
            let sum = period(&disc, cycle, &edges, |c, d| found.corner(&disc, d) - found.corner(&disc, c));
            assert!((sum - omega).norm() < 1e-10, "{sum} for {omega}");
            let length: f64 = (0..cycle.vertices.len())
                .map(|k| {
                    let [a, b] =
                        [k, (k + 1) % cycle.vertices.len()].map(|k| disc.positions[cycle.vertices[k] as usize]);
                    distance(a, b)
                })
                .sum();
            assert!((length - cycle.length).abs() < 1e-12 * length);
        }
    }
}

#[test]
fn every_class_has_a_walk_and_none_runs_to_and_fro() {
    let disc = closed(&triangulated(&quad_grid(7, 6, Sides::Torus)));
    let edges = Edges::new(&disc.faces, disc.positions.len());
    for root in [0, 20] {
        let homology = Homology::new(&disc, &edges, root).unwrap();
        for class in [[1, 0], [0, 1], [1, 1], [1, -1], [-2, 1], [3, 5], [0, -1], [-4, -4]] {
            let cycle = homology.cycle(&disc, class).unwrap();
            let form =
                |k: usize| period(&disc, &cycle, &edges, |c, _| Complex64::new(f64::from(homology.form[c][k]), 0.0)).re;
            assert_eq!([form(0), form(1)], class.map(|x| x as f64));
            let n = cycle.edges.len();
            assert!((0..n).all(|k| cycle.edges[k] != cycle.edges[(k + 1) % n]), "{class:?}: {:?}", cycle.edges);
        }
        assert!(homology.cycle(&disc, [0, 0]).unwrap().vertices.is_empty());
        assert!(homology.cycle(&disc, [i64::MAX, i64::MIN]).is_err());
        assert!(homology.cycle(&disc, [1 << 40, 3]).is_err());
    }
}

#[test]
fn the_loops_of_a_torus_of_revolution_are_its_circles() {
    let disc = torus(16, "");
    let found = map(&disc, &graph_of(&disc, ""), Weight::Integral);
    // Inscribed polygons of 16 edges: sin(π/16) · 16/π = 0.9936 of the circle; around the axis the one nearest to it.
    let lengths = found.loops.each_ref().map(|l| l.length / std::f64::consts::TAU);
    assert!((lengths[0] - 0.9936 * SMALL).abs() < 1e-3, "{lengths:?}");
    assert!(lengths[1] >= 0.993 * (BIG - SMALL) && lengths[1] < BIG + SMALL, "{lengths:?}");
}
