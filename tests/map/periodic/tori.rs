use super::shared::*;
use crate::common::*;
use num_complex::Complex64;
use riemap::distortion::{Distortion, Image};
use riemap::energy::conformal::Weight;
use riemap::map::periodic::{PeriodsRecord, periodic_from, relative_error};
use riemap::quad_graph::{Periods, QuadGraph};
use riemap::solver::Silent;
use riemap::solver::linear::periodic::Harmonic;
use riemap::surface::edges::Edges;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::homology::Homology;

fn error(disc: &OrientedMesh, graph: &QuadGraph, weight: Weight) -> f64 {
    relative_error(map(disc, graph, weight).tau, exact()).unwrap()
}

#[test]
fn the_period_of_quad_tori_has_the_error_of_the_independent_check() {
    // Design, §9: |error| of 0.4364358 i; the reduced ratio is its inverse, with the same relative error.
    for (n, expected) in [(16, 5.6e-3), (32, 1.4e-3), (64, 3.5e-4)] {
        let disc = torus(n, "");
        let absolute = error(&disc, &graph_of(&disc, ""), Weight::Integral) * exact().norm();
        // the numbers there have two digits
        assert!((absolute / expected - 1.0).abs() < 0.02, "{n}: {absolute:e}");
    }
}

#[test]
fn the_period_of_triangle_tori_has_order_two_with_every_dual_point() {
    let sizes = [16, 32, 64];
    for dual in ["barycentre", "incentre", "circumcentre"] {
        for weight in WEIGHTS {
            for mesh in
                ["acute", "&mesh=triangle", "&mesh=triangle&diagonal=same", "&mesh=triangle&diagonal=random&seed=1"]
            {
                // The two halves of a quad of the torus, a trapezium, have the same circumcentre: Re ρ = 0.
                if dual == "circumcentre" && mesh != "acute" {
                    continue;
                }
                let errors: Vec<f64> = sizes
                    .iter()
                    .map(|&n| {
                        let disc = if mesh == "acute" { brick_torus(n as u32, n as u32 / 2) } else { torus(n, mesh) };
                        error(&disc, &graph_of(&disc, dual), weight)
                    })
                    .collect();
                let order = fitted_order(&sizes.map(|n| n as f64), &errors);
                // Pre-asymptotic sizes; random diagonals keep an error of their own.
                assert!((order - 2.0).abs() < 0.15, "{dual} {weight:?} {mesh}: {errors:?}, order {order}");
                assert!(errors[2] < 2e-3, "{dual} {weight:?} {mesh}: {errors:?}");
            }
        }
    }
}

/// Relative errors of the period by the conformal Laplacian, and by least squares.
fn errors(disc: &OrientedMesh, graph: &QuadGraph) -> [f64; 2] {
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let homology = Homology::new(disc, &edges, 0).unwrap();
    let periods = Periods::new(disc, graph, &edges, &homology).unwrap();
    let squares = Harmonic::new(graph, &periods, Weight::Integral, &mut Silent).unwrap().energy.ratio();
    let found = map(disc, graph, Weight::Integral);
    assert!(found.white_to_black.is_some());
    [found.tau, squares].map(|tau| relative_error(tau, exact()).unwrap())
}

/// The two differ by 0.1 % of their errors at n = 16 and by 0.006 % at n = 64.
#[test]
fn periods_of_irregular_tori_have_order_two_and_are_no_farther_from_the_exact_one_than_those_of_least_squares() {
    let sizes = [16, 32, 64];
    for triangles in [true, false] {
        let of_sizes = sizes.map(|n| {
            let mean = (0..5).fold([0.0; 2], |sum, seed| {
                let disc = jittered_torus(n, triangles, seed);
                let found = errors(&disc, &graph_of(&disc, "barycentre"));
                [0, 1].map(|k| sum[k] + found[k] / 5.0)
            });
            println!("{n} {triangles}: {mean:?}");
            mean
        });
        let [ours, squares] = [0, 1].map(|k| of_sizes.map(|errors| errors[k]));
        let order = fitted_order(&sizes.map(f64::from), &ours);
        assert!((order - 2.0).abs() < 0.2, "{ours:?}, order {order}");
        assert!(ours.iter().zip(&squares).all(|(a, b)| a < b), "{ours:?} {squares:?}");
    }
}

/// The pairs ±λ of the eigenvalues of P come together at 1.
#[test]
fn white_and_black_periods_become_equal_with_refinement() {
    let apart = [16, 32, 64].map(|n| {
        let disc = jittered_torus(n, true, 1);
        (map(&disc, &graph_of(&disc, "barycentre"), Weight::Integral).white_to_black.unwrap() - 1.0).norm()
    });
    println!("{apart:?}");
    let order = fitted_order(&[16.0, 32.0, 64.0], &apart);
    assert!((order - 2.0).abs() < 0.2, "{apart:?}, order {order}");
}

#[test]
fn tori_of_odd_size_have_one_diagonal_class_and_the_same_order() {
    let errors = [15, 31, 63].map(|n| {
        let disc = torus(n, "");
        let graph = graph_of(&disc, "");
        assert_eq!(graph.diagonal_classes().1, 1);
        error(&disc, &graph, Weight::Integral)
    });
    let order = fitted_order(&[15.0, 31.0, 63.0], &errors);
    assert!((order - 2.0).abs() < 0.1, "{errors:?}");
}

#[test]
fn the_map_is_the_exact_one_at_every_vertex() {
    // The conformal coordinates (φ, s(θ)) of the torus of revolution, s' = r / (R + r cos θ), over iτ so that γ1 goes around
    // the tube.
    let exact_map = |disc: &OrientedMesh| -> Vec<Complex64> {
        let s = |theta: f64| {
            let (half, k) = (0.5 * theta, ((BIG - SMALL) / (BIG + SMALL)).sqrt());
            2.0 * exact().im * (k * half.sin()).atan2(half.cos())
        };
        let place = |&[x, y, z]: &[f64; 3]| {
            let theta = z.atan2(x.hypot(y) - BIG);
            Complex64::new(y.atan2(x), s(theta)) / (std::f64::consts::TAU * exact())
        };
        disc.positions.iter().map(place).collect()
    };
    for (mesh, dual) in [("", ""), ("&mesh=triangle", "barycentre")] {
        let errors = [16, 32, 64].map(|n| {
            let disc = torus(n, mesh);
            let found = map(&disc, &graph_of(&disc, dual), Weight::Integral);
            let wanted = exact_map(&disc);
            // A torus has translations, and the symmetry z → −z comes with the choice of the basis.
            let distance = |sign: f64| {
                let difference = |v: usize| {
                    let d = found.lattice_coordinates(found.z[v] - sign * wanted[v] - found.z[0] + sign * wanted[0]);
                    let [a, b] = d.map(|x| x - x.round());
                    (a + b * found.tau).norm()
                };
                (0..wanted.len()).map(difference).fold(0.0, f64::max)
            };
            distance(1.0).min(distance(-1.0))
        });
        let order = fitted_order(&[16.0, 32.0, 64.0], &errors);
        // Both colours of the quads: the white ones float, and a wrong place for them would cost an order at least.
        assert!(order > 1.8 && errors[2] < 2e-3, "{mesh}: {errors:?}, order {order}");
    }
}

#[test]
fn nothing_depends_on_numbering_or_on_the_first_basis() {
    for (mesh, dual) in [("", ""), ("&mesh=triangle&diagonal=random&seed=5", "barycentre")] {
        let s = torus_surface(14, mesh);
        let disc = closed(&s);
        let graph = graph_of(&disc, dual);
        for weight in WEIGHTS {
            let first = map(&disc, &graph, weight);
            for root in [1, 17, 100, 195] {
                let other = periodic_from(&disc, &graph, weight, root, &mut riemap::solver::Silent).unwrap();
                assert!((other.tau - first.tau).norm() < 1e-10, "{root}: {} {}", other.tau, first.tau);
            }
            for seed in 0..4 {
                let mut random = Random(seed);
                let (order, name) = (random.permutation(s.faces().len()), random.permutation(s.positions().len()));
                let disc = closed(&shuffled(&s, &order, &name));
                let other = map(&disc, &graph_of(&disc, dual), weight);
                assert!((other.tau - first.tau).norm() < 1e-10, "{seed}: {} {}", other.tau, first.tau);
                // H is rounding on the quads.
                assert!((other.h - first.h).abs() < 1e-10 * first.h.max(1.0));
            }
        }
    }
}

#[test]
fn seen_from_the_other_side_the_torus_is_its_mirror_image() {
    let s = torus_surface(12, "&mesh=triangle&diagonal=same");
    let all = 0..s.faces().len();
    let [there, back] = [s.clone(), flipped(&s, all)].map(|s| {
        let disc = closed(&s);
        map(&disc, &graph_of(&disc, "incentre"), Weight::Integral).tau
    });
    assert!(there.re.abs() > 1e-3, "this mesh is not its own mirror image: {there}");
    assert!((there + back.conj()).norm() < 1e-12, "{there} {back}");
}

#[test]
fn no_face_of_a_torus_is_flipped_and_the_distortion_vanishes_with_refinement() {
    let errors = [16, 32, 64].map(|n| {
        let disc = torus(n, "&mesh=triangle");
        let graph = graph_of(&disc, "barycentre");
        let found = map(&disc, &graph, Weight::Integral);
        let image = Image { z: &found.z, cover: Some((&found.periods, found.omega())) };
        let distortion = Distortion::new(&disc, &graph, None, &image);
        assert_eq!((distortion.flipped, distortion.not_convex, distortion.boundary_crosses), (0, 0, false));
        distortion.quasi_conformal.unwrap().max - 1.0
    });
    assert!(errors[1] < 0.6 * errors[0] && errors[2] < 0.6 * errors[1], "{errors:?}");
}

#[test]
fn the_record_says_how_far_the_period_is_from_the_exact_one() {
    let disc = torus(16, "");
    let found = map(&disc, &graph_of(&disc, ""), Weight::Integral);
    let record = PeriodsRecord::new(&disc, &found, Some(exact())).unwrap();
    let [re, im] = record.exact.unwrap();
    assert!(re.abs() < 1e-15 && (im - 1.0 / exact().im).abs() < 1e-14);
    let error = record.error.unwrap();
    assert!((error - (found.tau.im - im).abs() / im).abs() < 1e-12);
    assert!(record.h_per_area >= 0.0 && record.h_per_area < 1e-12);
    assert_eq!(record.loops.each_ref().map(|l| l.vertices.len()), [16, 16]);
    assert_eq!(PeriodsRecord::new(&disc, &found, None).unwrap().error, None);
}

#[test]
fn a_torus_read_from_a_file_has_the_period_of_its_radii() {
    let Some(folder) = data_folder() else { return };
    let file = folder.join("topology/torus.obj");
    if !file.is_file() {
        return;
    }
    let disc = closed(&riemap::io::read(&file).unwrap().surface);
    let (mut far, mut near) = (0.0f64, f64::INFINITY);
    // Its axis is y.
    for &[x, _, z] in &disc.positions {
        (far, near) = (far.max(x.hypot(z)), near.min(x.hypot(z)));
    }
    let exact = Complex64::new(0.0, 0.5 * (far - near) / (far * near).sqrt());
    let found = map(&disc, &graph_of(&disc, "barycentre"), Weight::Integral);
    let error = relative_error(found.tau, exact).unwrap();
    // 7680 triangles; n = 64 of the generated torus has 8192 and 3e-4.
    assert!(error < 2e-3, "{} against {exact}: {error:e}", found.tau);
}
