//! ρ and the quad graph: known values, invariances, counts, and what degenerate faces are told.

use crate::common::*;
use num_complex::Complex64;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, DUAL_POINTS, DualPoint, dual_point};
use riemap::quad_graph::rho::{extrinsic, with_normal};
use riemap::surface::oriented_mesh::OrientedMesh;

/// Lengths and angles of random triangles carry a few dozen roundings.
const ROUNDING: f64 = 1e-13;

fn rho(v: [[f64; 3]; 4]) -> Complex64 {
    extrinsic(sub(v[2], v[0]), sub(v[3], v[1])).expect("a proper quad").rho
}

fn close(a: Complex64, b: Complex64, tolerance: f64) -> bool {
    (a - b).norm() <= tolerance * (1.0 + b.norm())
}

/// cot of the angle at `c` in the triangle of side lengths a, b, c, from lengths alone (Kahan's area).
fn cot_opposite(a: f64, b: f64, c: f64) -> f64 {
    let mut s = [a, b, c];
    s.sort_by(f64::total_cmp);
    let [z, y, x] = s;
    let sixteen_area_squared = (x + (y + z)) * (z - (x - y)) * (z + (x - y)) * (x + (y - z));
    (a * a + b * b - c * c) / sixteen_area_squared.sqrt()
}

/// Discs of triangles: grown at random (skew, in no way embedded), jittered, Delaunay, obtuse.
fn triangle_discs() -> Vec<OrientedMesh> {
    let mut random = Random(7);
    let mut discs: Vec<OrientedMesh> = [5, 30, 60].map(|steps| disc(&grown_disc(3, steps, &mut random))).into();
    discs.extend(
        [
            "sphere?n=6&mesh=triangle&diagonal=random&jitter=0.3&seed=1",
            "enneper?n=6&mesh=delaunay&points=random&seed=2",
            "graph:saddle?n=7&amplitude=5&mesh=triangle",
        ]
        .map(disc_of),
    );
    discs
}

#[test]
fn rho_of_simple_quads_is_known() {
    let i = Complex64::I;
    let unit_square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    assert_eq!(rho(unit_square), Complex64::ONE);
    // a rhombus: ratio of its diagonals, real
    let rhombus = [[-2., 0., 0.], [0., -3., 0.], [2., 0., 0.], [0., 3., 0.]];
    assert_eq!(rho(rhombus), Complex64::from(1.5));
    // a kite too, wherever its diagonals cross
    assert_eq!(rho([[-1., 0., 0.], [0., -3., 0.], [3., 0., 0.], [0., 3., 0.]]), Complex64::from(1.5));
    // rectangle a × b: |ρ| = 1, the angle between the diagonals
    let (a, b) = (3.0, 1.0);
    let rectangle = [[0., 0., 0.], [a, 0., 0.], [a, b, 0.], [0., b, 0.]];
    assert!(close(rho(rectangle), Complex64::new(2. * a * b, a * a - b * b) / (a * a + b * b), 1e-15));
    // a parallelogram, by iρ = d13 / d02 in the plane
    let sheared = [[0., 0., 0.], [2., 0., 0.], [3., 1., 0.], [1., 1., 0.]];
    assert!(close(rho(sheared), Complex64::new(-1., 1.) / Complex64::new(3., 1.) / i, 1e-15));
    // a skew quad: the diagonals count, not where they pass each other
    let skew = [[0., 0., 1.], [1., 0., 0.], [1., 1., 1.], [0., 1., 0.]];
    assert_eq!(rho(skew), Complex64::ONE);
}

#[test]
fn diagonals_that_span_no_area_have_no_rho() {
    for (d02, d13) in [
        ([0.0; 3], [1., 0., 0.]),
        ([1., 0., 0.], [0.0; 3]),
        ([1., 2., 3.], [2., 4., 6.]),
        ([1., 0., 0.], [-1., 0., 0.]),
        ([f64::NAN, 0., 0.], [0., 1., 0.]),
        ([1., 0., 0.], [0., f64::INFINITY, 0.]),
        ([1e200, 0., 0.], [0., 1e200, 0.]),
        ([1e-200, 0., 0.], [0., 1e-200, 0.]),
    ] {
        assert_eq!(extrinsic(d02, d13), None, "{d02:?} {d13:?}");
        assert_eq!(with_normal(d02, d13, [0., 0., 1.]), None, "{d02:?} {d13:?}");
    }
    // edge-on, and from below
    assert_eq!(with_normal([1., 0., 0.], [0., 1., 0.], [1., 0., 0.]), None);
    assert_eq!(with_normal([1., 0., 0.], [0., 1., 0.], [0., 0., -1.]), None);
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn rho_is_invariant_under_similarities_and_inverted_by_the_other_diagonal(seed in any::<u64>(), size in -9i32..9) {
        let mut random = Random(seed);
        let quad = [0; 4].map(|_| random.vector());
        // ρ is a quotient of differences: quads much thinner than the rest lose digits
        let seen = rho(quad);
        prop_assume!(seen.re > 1e-2 && seen.norm() < 1e2);
        let (rotation, shift, scale) = (random.rotation(), random.vector(), 10f64.powi(size));
        let moved = quad.map(|x| {
            let y = rotate(rotation, x);
            [0, 1, 2].map(|k| scale * (y[k] + shift[k]))
        });
        prop_assert!(close(rho(moved), seen, 1e-11));
        let [v0, v1, v2, v3] = quad;
        prop_assert!(close(rho([v1, v2, v3, v0]), 1.0 / seen, 1e-11));
        prop_assert!(close(rho([v2, v3, v0, v1]), seen, 1e-15));
        // seen from behind: the conjugate
        prop_assert!(close(rho([v0, v3, v2, v1]), seen.conj(), 1e-15));
    }

    #[test]
    fn a_planar_quad_seen_along_its_normal_has_its_extrinsic_rho(seed in any::<u64>()) {
        let mut random = Random(seed);
        let rotation = random.rotation();
        let flat = [0; 2].map(|_| [random.real(), random.real(), 0.0]);
        prop_assume!(cross(flat[0], flat[1])[2] > 1e-2);
        let [d02, d13] = flat.map(|x| [0, 1, 2].map(|k| rotation[0][k] * x[0] + rotation[1][k] * x[1]));
        let (a, b) = (extrinsic(d02, d13).expect("proper"), with_normal(d02, d13, rotation[2]).expect("proper"));
        prop_assert!(close(a.rho, b.rho, 1e-11) && (a.length - b.length).abs() < 1e-14);
        // and equals d13 / (i d02) in the plane
        let [p, q] = flat.map(|x| Complex64::new(x[0], x[1]));
        prop_assert!(close(a.rho, q / (Complex64::I * p), 1e-11));
    }

    #[test]
    fn a_surfel_with_estimated_normal_has_the_closed_form(seed in any::<u64>()) {
        let mut random = Random(seed);
        let n = random.unit_vector();
        let [n1, n2, n3] = n;
        // counter-clockwise seen from outside, e3
        let (d02, d13) = ([1., 1., 0.], [-1., 1., 0.]);
        let seen = with_normal(d02, d13, n);
        prop_assert_eq!(seen.is_some(), n3 > 0.0);
        if let Some(seen) = seen.filter(|_| n3 > 1e-3) {
            let closed = Complex64::new(2.0 * n3, n2 * n2 - n1 * n1) / (2.0 - (n1 + n2).powi(2));
            prop_assert!(close(seen.rho, closed, 1e-10));
            // the projected area is n3
            prop_assert!((0.5 * seen.rho.re * seen.length * seen.length - n3).abs() < 1e-14);
        }
    }

    #[test]
    fn twice_the_vertices_less_the_quads_is_the_boundary_and_two(arity in 3usize..5, steps in 0usize..60, seed in any::<u64>()) {
        let disc = disc(&grown_disc(arity, steps, &mut Random(seed)));
        for dual in DUAL_POINTS {
            let graph = graph_of(&disc, dual.name());
            prop_assert_eq!(2 * (graph.vertices - graph.quads.len()), graph.boundary.len() + 2);
            prop_assert_eq!(graph.rho.len(), graph.quads.len());
            prop_assert_eq!(graph.diagonal.len(), graph.quads.len());
            prop_assert_eq!(graph.boundary_length.len(), graph.boundary.len());
            // bipartite: two diagonal classes, which alternate along the boundary
            let (class, classes) = graph.diagonal_classes();
            prop_assert_eq!(classes, 2);
            prop_assert!(graph.quads.iter().all(|q| class[q[0] as usize] != class[q[1] as usize]));
            let next = graph.boundary.iter().cycle().skip(1);
            prop_assert!(graph.boundary.iter().zip(next).all(|(&v, &w)| class[v as usize] != class[w as usize]));
            // every quad's rim edges are oriented alike: an interior one is run through both ways
            let mut rim = std::collections::HashSet::new();
            for q in &graph.quads {
                prop_assert!((0..4).all(|k| rim.insert((q[k], q[(k + 1) % 4]))));
            }
            let open = rim.iter().filter(|(a, b)| !rim.contains(&(*b, *a))).count();
            prop_assert_eq!(open, graph.boundary.len());
            let next = graph.boundary.iter().cycle().skip(1);
            prop_assert!(graph.boundary.iter().zip(next).all(|(&v, &w)| rim.contains(&(v, w)) && !rim.contains(&(w, v))));
        }
    }

    #[test]
    fn a_dual_point_is_one_point_seen_from_the_three_edges(seed in any::<u64>()) {
        let mut random = Random(seed);
        let p = [0; 3].map(|_| random.complex());
        let twice_area = ((p[1] - p[0]).conj() * (p[2] - p[0])).im;
        prop_assume!(twice_area > 1e-2);
        let lengths = [0, 1, 2].map(|k| (p[(k + 2) % 3] - p[(k + 1) % 3]).norm());
        for dual in DUAL_POINTS {
            let w = dual.weights(lengths);
            let by_weights = (p[0] * w[0] + p[1] * w[1] + p[2] * w[2]) / (w[0] + w[1] + w[2]);
            for k in 0..3 {
                let (a, b, c) = (p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
                let third = (c - a) / (b - a);
                let (s, h) = dual.place(third.re, third.im);
                let seen = a + (b - a) * Complex64::new(s, h);
                // circumcentres of thin triangles are far away
                prop_assert!(close(seen, by_weights, 1e-9), "{}: {seen} {by_weights}", dual.name());
            }
        }
    }

    #[test]
    fn barycentres_and_incentres_make_re_rho_positive_on_any_sliver(
        seed in any::<u64>(), height in 0i32..12, reach in 0i32..6,
    ) {
        let mut random = Random(seed);
        // the third vertices far outside the common edge and close to its line
        let apex = |random: &mut Random, side: f64| {
            [10f64.powi(reach) * random.real(), side * 10f64.powi(-height) * (1.0 + random.real() / 2.0), 0.0]
        };
        let s = surface(
            vec![[0., 0., 0.], [1., 0., 0.], apex(&mut random, 1.0), apex(&mut random, -1.0)],
            [[0, 1, 2], [1, 0, 3]],
        );
        let diagnosis = riemap::surface::topology::diagnosis::Diagnosis::new(&s);
        prop_assume!(diagnosis.findings.is_empty());
        let disc = OrientedMesh::new(&s, &diagnosis).expect("two triangles");
        for name in ["barycentre", "incentre"] {
            prop_assert!(graph_of(&disc, name).min_re_rho() > 0.0, "{name}");
        }
    }
}

#[test]
fn circumcentres_give_half_the_sum_of_cotangents_and_no_imaginary_part() {
    let mut negative = 0;
    for disc in triangle_discs() {
        let graph = graph_of(&disc, "circumcentre");
        assert!(graph.is_orthogonal());
        assert!(graph.rho.iter().all(|rho| rho.im == 0.0));
        for (q, quad) in graph.quads.iter().enumerate() {
            let length = |a: u32, b: u32| distance(disc.positions[a as usize], disc.positions[b as usize]);
            let (vi, vj) = (quad[0], quad[2]);
            let opposite = |dual: u32| {
                let face = disc.faces.get(dual as usize - disc.positions.len());
                let vk = *face.iter().find(|&&v| v != vi && v != vj).expect("three corners");
                cot_opposite(length(vi, vk), length(vj, vk), length(vi, vj))
            };
            let faces = quad.iter().filter(|&&v| {
                (v as usize) >= disc.positions.len() && (v as usize) < disc.positions.len() + disc.faces.len()
            });
            let expected = 0.5 * faces.map(|&v| opposite(v)).sum::<f64>();
            let size = graph.rho[q].norm() + 1.0;
            // the cotangent of a thin triangle has the error of its area
            assert!((graph.rho[q].re - expected).abs() < 1e-9 * size * size, "{} {expected}", graph.rho[q]);
            assert!((graph.diagonal[q] - length(vi, vj)).abs() <= ROUNDING * length(vi, vj));
            negative += usize::from(graph.rho[q].re < 0.0);
        }
    }
    assert!(negative > 20, "only {negative} negative weights: the test says little");
}

#[test]
fn the_quads_of_a_triangle_mesh_have_its_area() {
    for disc in triangle_discs() {
        let x = |v: u32| disc.positions[v as usize];
        let area = |f: &[u32]| {
            0.5 * {
                let n = cross(sub(x(f[1]), x(f[0])), sub(x(f[2]), x(f[0])));
                dot(n, n).sqrt()
            }
        };
        let total: f64 = disc.faces.iter().map(area).sum();
        for dual in DUAL_POINTS {
            let graph = graph_of(&disc, dual.name());
            let quads: f64 = (0..graph.quads.len()).map(|q| graph.area(q)).sum();
            // with circumcentres positive and negative areas cancel
            let summands: f64 = (0..graph.quads.len()).map(|q| graph.area(q).abs()).sum();
            assert!((quads - total).abs() <= ROUNDING * summands, "{}: {quads} {total}", dual.name());
        }
    }
}

#[test]
fn the_quads_of_a_planar_quad_mesh_have_its_area() {
    let disc = disc_of("graph:flat?n=9&jitter=0.4&seed=3");
    let graph = graph_of(&disc, "");
    let total: f64 = (0..graph.quads.len()).map(|q| graph.area(q)).sum();
    // [−π, π]²
    assert!((total - 4.0 * std::f64::consts::PI.powi(2)).abs() < 1e-12);
    assert!((graph.perimeter() - 8.0 * std::f64::consts::PI).abs() < 1e-12);
}

#[test]
fn folding_a_mesh_along_its_edges_changes_nothing() {
    // a flat strip folded like a fan along the lines between its columns: intrinsically the same
    for name in ["graph:flat?n=7&mesh=triangle&diagonal=same", "graph:flat?n=7"] {
        let flat = disc_of(name);
        let mut folded = flat.clone();
        let fold = |x: f64| {
            // columns lie in turn in the planes through the y axis direction of slope 3/4 and −3/4
            let column = ((x + std::f64::consts::PI) / (std::f64::consts::TAU / 6.0)).round();
            let up = if column as i64 % 2 == 0 { 0.0 } else { 1.0 };
            let width = std::f64::consts::TAU / 6.0;
            [column * width * 0.8, up * width * 0.6]
        };
        for p in &mut folded.positions {
            let [x, z] = fold(p[0]);
            *p = [x, p[1], z];
        }
        for dual in DUAL_POINTS {
            let (a, b) = (graph_of(&flat, dual.name()), graph_of(&folded, dual.name()));
            assert!(a.rho.iter().zip(&b.rho).all(|(a, b)| close(*a, *b, ROUNDING)), "{name} {}", dual.name());
            assert!(a.diagonal.iter().zip(&b.diagonal).all(|(a, b)| (a - b).abs() < ROUNDING));
        }
    }
}

#[test]
fn boundary_duals_lie_at_the_midpoint_or_at_the_foot() {
    let disc = disc_of("sphere?n=6&mesh=delaunay&seed=4");
    let barycentre = dual_point("barycentre").expect("in the table");
    let at = |dual: &dyn DualPoint, boundary| QuadGraph::from_triangles(&disc, dual, boundary).expect("acute enough");
    let (midpoint, foot) = (at(barycentre, BoundaryDual::Midpoint), at(barycentre, BoundaryDual::Foot));
    let lengths = |k: usize| {
        let [v, w] = [k, k + 1].map(|k| disc.boundary[k % disc.boundary.len()] as usize);
        distance(disc.positions[v], disc.positions[w])
    };
    let first_boundary_dual = (disc.positions.len() + disc.faces.len()) as u32;
    for k in 0..disc.boundary.len() {
        assert_eq!(midpoint.boundary[2 * k], disc.boundary[k]);
        assert_eq!(midpoint.boundary[2 * k + 1], first_boundary_dual + k as u32);
        let half = lengths(k) / 2.0;
        assert!((midpoint.boundary_length[2 * k] - half).abs() < ROUNDING);
        assert!((midpoint.boundary_length[2 * k + 1] - half).abs() < ROUNDING);
        let halves = [foot.boundary_length[2 * k], foot.boundary_length[2 * k + 1]];
        assert!(halves.iter().all(|&l| l > 0.0) && (halves[0] + halves[1] - lengths(k)).abs() < ROUNDING);
    }
    for q in 0..foot.quads.len() {
        if foot.quads[q].iter().any(|&v| v >= first_boundary_dual) {
            assert_eq!(foot.rho[q].im, 0.0);
            assert_eq!(foot.rho[q].re, midpoint.rho[q].re);
        } else {
            assert_eq!(foot.rho[q], midpoint.rho[q]);
        }
    }
    // the circumcentre's foot is the midpoint
    let circumcentre = dual_point("circumcentre").expect("in the table");
    assert_eq!(at(circumcentre, BoundaryDual::Midpoint), at(circumcentre, BoundaryDual::Foot));
}
