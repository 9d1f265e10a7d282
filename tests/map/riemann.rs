//! Circle maps converge to the Riemann map, with order 2, where that is known.

use crate::common::*;
use riemap::energy::conformal::Weight;
use riemap::input::Input;
use riemap::map::{MapOptions, map_input};
use riemap::report::ErrorRecord;
use riemap::solver::Silent;

const N: [f64; 3] = [16.0, 32.0, 64.0];

/// The error of the circle map with three points held at their exact images.
fn error(surface: &str, mesh: &str, n: u32, dual: &str, weight: Weight) -> ErrorRecord {
    let name = format!("{surface}?n={n}&mesh={mesh}");
    let input = Input::open(&name).unwrap();
    let options = MapOptions { dual: dual.to_owned(), weight, ..MapOptions::default() };
    let mapped = map_input(&input, &options, &mut Silent).unwrap_or_else(|error| panic!("{name} {dual}: {error}"));
    assert!(mapped.map.anchored && mapped.map.iterations <= 20, "{name} {dual}: {}", mapped.map.iterations);
    assert_eq!(mapped.distortion.flipped, 0, "{name} {dual}");
    ErrorRecord::new(input.exact.as_ref().unwrap(), &mapped.domain.disc, &mapped.map)
}

/// Largest errors at n = 16, 32, 64, their order, and that of the mean squares' roots.
fn study(surface: &str, mesh: &str, dual: &str, weight: Weight) -> ([f64; 3], f64, f64) {
    let errors = N.map(|n| error(surface, mesh, n as u32, dual, weight));
    let rms = fitted_order(&N, &errors.map(|e| e.rms));
    let errors = errors.map(|e| e.max);
    let order = fitted_order(&N, &errors);
    println!(
        "{surface} {mesh} {dual} {weight:?}: {} order {order:.2} rms {rms:.2}",
        errors.map(|e| format!("{e:.2e}")).join(" ")
    );
    (errors, order, rms)
}

/// The three of the design, with the errors of its table, and two others.
const SURFACES: [(&str, Option<[f64; 3]>); 5] = [
    ("plane", Some([3.4e-3, 8.0e-4, 1.9e-4])),
    ("sphere", Some([4.6e-3, 1.1e-3, 2.6e-4])),
    ("enneper", Some([7.9e-4, 1.9e-4, 4.6e-5])),
    ("catenoid", None),
    ("torus-patch", None),
];

#[test]
fn quad_meshes_converge_with_order_two() {
    for (surface, table) in SURFACES {
        // With E all but 0 the weights decide nothing.
        let weights = if table.is_some() { &[Weight::Integral, Weight::Unit][..] } else { &[Weight::Integral] };
        for &weight in weights {
            let (errors, order, _) = study(surface, "quad", "barycentre", weight);
            // Measured 1.99 to 2.08.
            assert!(order > 1.9, "{surface} {weight:?}: {order}");
            // The table was made with other points held; measured 0.7 to 1.85 of it.
            for (error, expected) in errors.iter().zip(table.into_iter().flatten()) {
                assert!(*error < 2.0 * expected, "{surface} {weight:?}: {error:e}, {expected:e} in the table");
            }
        }
    }
}

/// Dual points with weights that are defined: circumcentres of obtuse pairs have Re ρ < 0.
const DUALS: [(&str, Weight); 3] =
    [("barycentre", Weight::Integral), ("incentre", Weight::Integral), ("circumcentre", Weight::Unit)];

// From one n to the next the points that are held move against the cells, at the corners of split grids among misshapen
// triangles: fits over n = 16, 32, 64 scatter from 1.72 to 2.25 (mean square: 1.59 to 2.37), 1.94 on average.

#[test]
fn triangle_meshes_converge_with_order_two_for_every_dual_point() {
    let (mut sum, mut count) = (0.0, 0.0);
    for (surface, table) in SURFACES {
        for &(dual, weight) in if table.is_some() { &DUALS[..] } else { &DUALS[..1] } {
            let (_, order, rms) = study(surface, "triangle", dual, weight);
            assert!(order > 1.65 && rms > 1.5, "{surface} {dual}: {order} {rms}");
            (sum, count) = (sum + order, count + 1.0);
        }
    }
    assert!(sum / count > 1.85, "{}", sum / count);
}

#[test]
fn irregular_meshes_converge_with_order_two_for_every_dual_point() {
    let (mut sum, mut count) = (0.0, 0.0);
    for (surface, table) in SURFACES {
        for &(dual, weight) in if table.is_some() { &DUALS[..] } else { &DUALS[..1] } {
            let (_, order, rms) = study(surface, "delaunay", dual, weight);
            assert!(order > 1.65 && rms > 1.8, "{surface} {dual}: {order} {rms}");
            (sum, count) = (sum + order, count + 1.0);
        }
    }
    assert!(sum / count > 1.9, "{}", sum / count);
}

#[test]
fn where_coarse_meshes_fall_short_of_order_two_finer_ones_do_not() {
    let [coarse, fine] = [64, 128].map(|n| error("sphere", "triangle", n, "barycentre", Weight::Integral).max);
    let order = (coarse / fine).log2();
    assert!(order > 1.9, "{coarse:e} {fine:e} {order}");
}
