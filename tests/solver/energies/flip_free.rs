//! MIPS and SD: energies of maps without folds.

use super::shared::*;
use crate::common::*;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use riemap::distortion::{Image, face_maps};
use riemap::energy::conformal::Weight;
use riemap::energy::{Curvature, Energy, EnergyError, EnergyKind, SymmetricDirichlet};
use riemap::quad_graph::metric::RestMetric;

/// Quads, triangles, irregular triangles: dual points do not matter.
fn cases(surface: &str) -> Vec<Case> {
    let triangles = ["triangle", "delaunay"]
        .map(|mesh| Case::triangles(&format!("{surface}&mesh={mesh}"), "barycentre", Default::default()));
    std::iter::once(Case::quads(&format!("{surface}&mesh=quad"))).chain(triangles.into_iter().flatten()).collect()
}

#[test]
fn gradients_and_exact_hessians_are_the_derivatives_of_values() {
    let mut random = Random(21);
    for case in cases("sphere?n=4") {
        for weight in WEIGHTS {
            for (row, energy) in case.flip_free(weight) {
                let x = real(&case.state_without_folds(&mut random));
                let what = format!("{} {weight:?} {}", row.name(), case.name);
                let value = |x: &DVector<f64>| DVector::from_element(1, energy.value(&complex(x)));
                let g = DMatrix::from_columns(&[gradient(energy.as_ref(), &complex(&x))]);
                // Third derivatives grow as 1/J³ where triangles are small: a shorter step, and more rounding.
                let step = 1e-7;
                assert_near(&differences(&x, step, value).transpose(), &g, 1e-5, &what);
                let exact = hessian(energy.as_ref(), &complex(&x), Curvature::Exact);
                let differences = differences(&x, step, |x| gradient(energy.as_ref(), &complex(x)));
                assert_near(&differences, &exact, 1e-5, &what);
            }
        }
    }
}

#[test]
fn projected_hessians_are_the_positive_parts_of_the_exact_ones_in_a_and_b() {
    let mut random = Random(22);
    let (mut kept, mut changed) = (0, 0);
    for case in cases("torus-patch?n=4") {
        for (row, energy) in case.flip_free(Weight::Integral) {
            // Where a map stretches all, SD is convex.
            let stretch = if row.properties().fixes_scale { 1.0 + 4.0 * random.real().abs() } else { 1.0 };
            let z: Vec<_> = case.state_without_folds(&mut random).into_iter().map(|z| stretch * z).collect();
            let blocks = |curvature| {
                let mut blocks = Vec::new();
                energy.hessian(&z, curvature, &mut |_, block| {
                    blocks.push(DMatrix::from_fn(6, 6, |i, j| block[i][j]));
                });
                blocks
            };
            for (exact, projected) in blocks(Curvature::Exact).into_iter().zip(blocks(Curvature::GaussNewton)) {
                let size = exact.amax();
                assert!((&projected - projected.transpose()).amax() <= 1e-14 * size, "{}", row.name());
                // Eigenvalues of sums of four squares, to rounding; and never below the exact ones.
                assert!(projected.clone().symmetric_eigenvalues().min() >= -1e-12 * size, "{}", row.name());
                assert!((&projected - &exact).symmetric_eigenvalues().min() >= -1e-12 * size, "{}", row.name());
                // A block without negative eigenvalues but those of rounding is left as it is.
                let is_definite = exact.symmetric_eigenvalues().min() >= -1e-13 * size;
                let same = (&projected - &exact).amax() <= 1e-12 * size;
                assert!(same || !is_definite, "{}", row.name());
                kept += usize::from(is_definite);
                changed += usize::from(!same);
            }
        }
    }
    assert!(kept > 0 && changed > 0, "{kept} {changed}");
}

#[test]
fn values_are_those_of_the_singular_values_of_the_faces() {
    let mut random = Random(23);
    for case in cases("enneper?n=5").into_iter().filter(|case| case.disc.faces.arity() == Some(3)) {
        let z = case.state_without_folds(&mut random);
        let maps = face_maps(&case.disc, &case.graph, &Image::of_disc(&z));
        for weight in WEIGHTS {
            for (row, energy) in case.flip_free(weight) {
                let sum: f64 = maps
                    .iter()
                    .map(|map| {
                        let w = if weight == Weight::Unit { 1.0 } else { map.area };
                        let [s, t] = [map.sigma1, map.sigma2];
                        w * match row.name() {
                            "MIPS" => 0.5 * (s / t + t / s) - 1.0,
                            _ => s * s + t * t + 1.0 / (s * s) + 1.0 / (t * t) - 4.0,
                        }
                    })
                    .sum();
                // The difference with 1, or 4, loses a few bits where the map is nearly perfect.
                assert!((energy.value(&z) - sum).abs() <= 1e-11 * sum, "{} {weight:?}", row.name());
            }
        }
    }
}

#[test]
fn mips_sees_no_similarity_and_sd_no_rigid_motion() {
    let mut random = Random(24);
    for case in cases("catenoid?n=4") {
        let z = case.state_without_folds(&mut random);
        let turn = Complex64::cis(1.0 + random.real());
        let moved = |scale: f64| z.iter().map(|z| scale * turn * z + Complex64::new(0.3, -0.2)).collect::<Vec<_>>();
        for (row, energy) in case.flip_free(Weight::Integral) {
            let same = |scale: f64| {
                let (here, there) = (energy.value(&z), energy.value(&moved(scale)));
                (here - there).abs() <= 1e-11 * here
            };
            assert!(same(1.0), "{}", row.name());
            assert_eq!(same(3.0), row.name() == "MIPS", "{}", row.name());
            // A mirror turns every triangle over.
            let mirrored: Vec<_> = z.iter().map(|z| z.conj()).collect();
            assert_eq!(energy.value(&mirrored), f64::INFINITY);
        }
    }
}

#[test]
fn flat_meshes_have_no_energy_where_they_lie() {
    for case in cases("plane?n=5") {
        let mut z: Vec<_> = case.disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect();
        z.resize(case.graph.vertices, Complex64::ZERO);
        for (row, energy) in case.flip_free(Weight::Integral) {
            // Squares of roundings.
            assert!(energy.value(&z) < 1e-27, "{} {}: {:e}", row.name(), case.name, energy.value(&z));
        }
    }
}

#[test]
fn energies_are_finite_up_to_the_largest_step_and_infinite_past_it() {
    let mut random = Random(25);
    for case in cases("sphere?n=5") {
        for _ in 0..20 {
            let z = case.state_without_folds(&mut random);
            let d: Vec<_> = z.iter().map(|_| random.complex()).collect();
            let at = |t: f64| z.iter().zip(&d).map(|(z, d)| z + t * d).collect::<Vec<_>>();
            for (row, energy) in case.flip_free(Weight::Integral) {
                let t = energy.largest_step(&z, &d);
                assert!(t > 0.0 && t.is_finite());
                for inside in [0.0, 0.1, 0.5, 0.9, 1.0 - 1e-9] {
                    assert!(energy.value(&at(inside * t)).is_finite(), "{} {inside}", row.name());
                }
                assert_eq!(energy.value(&at((1.0 + 1e-9) * t)), f64::INFINITY, "{}", row.name());
                // Growing for ever is admitted.
                assert_eq!(energy.largest_step(&z, &z), f64::INFINITY);
                let gradient = gradient(energy.as_ref(), &at(1.5 * t));
                assert!(gradient.iter().any(|g| g.is_nan()), "no derivatives where the energy is infinite");
            }
        }
    }
}

#[test]
fn the_best_scale_has_the_least_energy() {
    let mut random = Random(26);
    for case in cases("sphere?n=5") {
        let held = vec![false; case.graph.vertices];
        for weight in WEIGHTS {
            let energy = SymmetricDirichlet::new(case.rest(weight, &held)).unwrap();
            let z = case.state_without_folds(&mut random);
            let at = |scale: f64| energy.value(&z.iter().map(|z| scale * z).collect::<Vec<_>>());
            let best = energy.best_scale(&z);
            // Of second order around the minimum: 1e-4 off it is higher by some 1e-8 of the energy.
            assert!(at(best) < at(best * 1.0001) && at(best) < at(best / 1.0001), "{}", case.name);
        }
    }
}

#[test]
fn a_face_without_area_is_refused_by_name() {
    let mut mesh = quad_grid(3, 2, Sides::Free);
    // The first face's corner at vertex 1 becomes straight.
    mesh.positions_mut()[0] = [0.0, 0.0, 0.0];
    mesh.positions_mut()[1] = [1.0, 0.0, 0.0];
    mesh.positions_mut()[5] = [2.0, 0.0, 0.0];
    let disc = disc(&mesh);
    let graph = graph_of(&disc, "");
    let case = Case { name: "straight".to_owned(), metric: RestMetric::of_quads(&disc, &graph, None), disc, graph };
    let held = vec![false; case.graph.vertices];
    for row in riemap::energy::ENERGIES.iter().filter(|row| row.properties().flip_free) {
        let error = row.make(case.rest(Weight::Unit, &held)).err().unwrap();
        assert_eq!(error, EnergyError::NoArea { energy: row.name(), face: 0, count: 1 });
        assert!(error.to_string().contains("face 0"));
    }
}
