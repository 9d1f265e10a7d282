//! The barrier that keeps the boundary off itself.

use std::f64::consts::TAU;

use super::shared::*;
use crate::common::*;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use riemap::energy::{Clearance, Curvature, Energy};
use riemap::quad_graph::QuadGraph;

const ALONG: u32 = 24;
const ACROSS: u32 = 2;

/// A strip bent to a ring whose ends, of edges of the length 0.25, are so far from each other; all vertices moved a little.
fn ring(gap: f64, random: &mut Random) -> Vec<Complex64> {
    let place = |v: u32| {
        let (i, j) = (v % (ALONG + 1), v / (ALONG + 1));
        let radius = 1.25 - 0.5 * f64::from(j) / f64::from(ACROSS);
        let angle = (TAU - gap / radius) * f64::from(i) / f64::from(ALONG);
        Complex64::from_polar(radius, angle)
    };
    (0..(ALONG + 1) * (ACROSS + 1)).map(|v| place(v) + 0.1 * gap * random.complex()).collect()
}

fn strip() -> QuadGraph {
    graph_of(&disc(&quad_grid(ALONG, ACROSS, Sides::Free)), "")
}

/// Kept clear is a quarter of an edge, 0.0625: ends at this distance are well within.
const GAP: f64 = 0.03;

#[test]
fn gradient_and_exact_hessian_are_the_derivatives_of_the_value() {
    let (mut random, graph) = (Random(31), strip());
    for _ in 0..10 {
        let z = ring(GAP, &mut random);
        let energy = Clearance::new(&graph, &z);
        assert!(energy.value(&z) > 0.0);
        let x = real(&z);
        let value = |x: &DVector<f64>| DVector::from_element(1, energy.value(&complex(x)));
        let g = DMatrix::from_columns(&[gradient(&energy, &z)]);
        // Third derivatives are as large as 1/GAP times second ones: a step of 1e-6 errs by some 1e-9 of them.
        let step = 1e-6;
        assert_near(&differences(&x, step, value).transpose(), &g, 1e-6, "gradient");
        let exact = hessian(&energy, &z, Curvature::Exact);
        let differences = differences(&x, step, |x| gradient(&energy, &complex(x)));
        assert_near(&differences, &exact, 1e-6, "Hessian");
    }
}

#[test]
fn the_definite_model_is_definite_and_right_along_the_distances() {
    let (mut random, graph) = (Random(32), strip());
    let z = ring(GAP, &mut random);
    let energy = Clearance::new(&graph, &z);
    let blocks = |curvature| {
        let mut blocks = Vec::new();
        energy.hessian(&z, curvature, &mut |_, block| blocks.push(DMatrix::from_fn(6, 6, |i, j| block[i][j])));
        blocks
    };
    let mut active = 0;
    for (exact, model) in blocks(Curvature::Exact).into_iter().zip(blocks(Curvature::GaussNewton)) {
        let size = exact.amax();
        let eigen = model.clone().symmetric_eigen();
        assert!(eigen.eigenvalues.min() >= -1e-12 * size);
        if size > 0.0 {
            // Of rank 1, along the gradient of the distance; what it leaves out there is the turn of the edge, of the order of
            // (distance/length)², 1 %.
            let (k, largest) = eigen.eigenvalues.argmax();
            assert!((eigen.eigenvalues.sum() - largest).abs() <= 1e-12 * largest);
            let along = eigen.eigenvectors.column(k);
            let curvature = (along.transpose() * &exact * along)[(0, 0)];
            assert!((curvature - largest).abs() <= 0.02 * largest, "{curvature} {largest}");
            active += 1;
        }
    }
    assert!(active >= 4, "{active}");
}

#[test]
fn a_boundary_that_is_clear_of_itself_has_no_energy_and_one_that_meets_itself_is_not_admitted() {
    let (mut random, graph) = (Random(33), strip());
    let clear = ring(0.1, &mut random);
    let energy = Clearance::new(&graph, &clear);
    assert_eq!(energy.value(&clear), 0.0);
    assert!(gradient(&energy, &clear).amax() == 0.0);
    // The ends one over the other.
    let crossed = ring(-0.05, &mut random);
    assert_eq!(energy.value(&crossed), f64::INFINITY);
    // Nearer is more, without bound.
    let values: Vec<f64> = [0.05, 0.03, 0.01, 1e-3, 1e-6].map(|gap| energy.value(&ring(gap, &mut random))).to_vec();
    assert!(values.windows(2).all(|pair| pair[0] < pair[1]) && values[4] > 1e6 * values[0], "{values:?}");
}

#[test]
fn thin_parts_of_the_surface_itself_are_not_pushed_open() {
    // A strip a hundred times as long as it is wide: its sides are near each other through the inside.
    let graph = strip();
    let thin = |v: u32| Complex64::new(f64::from(v % (ALONG + 1)), 0.005 * f64::from(v / (ALONG + 1)));
    let z: Vec<_> = (0..(ALONG + 1) * (ACROSS + 1)).map(thin).collect();
    assert_eq!(Clearance::new(&graph, &z).value(&z), 0.0);
}

#[test]
fn the_boundary_is_simple_up_to_the_largest_step_and_not_past_it() {
    let (mut random, graph) = (Random(34), strip());
    let mut met = 0;
    for _ in 0..50 {
        let z = ring(GAP, &mut random);
        let energy = Clearance::new(&graph, &z);
        let d: Vec<_> = z.iter().map(|_| 0.05 * random.complex()).collect();
        let at = |t: f64| z.iter().zip(&d).map(|(z, d)| z + t * d).collect::<Vec<_>>();
        match energy.largest_step(&z, &d) {
            t if t <= 1.0 => {
                for inside in [0.0, 0.1, 0.5, 0.9, 1.0 - 1e-9] {
                    assert!(energy.value(&at(inside * t)).is_finite(), "{inside}");
                }
                assert_eq!(energy.value(&at((1.0 + 1e-9) * t)), f64::INFINITY);
                met += 1;
            }
            t => {
                assert_eq!(t, f64::INFINITY);
                assert!([0.2, 0.5, 1.0].iter().all(|&t| energy.value(&at(t)).is_finite()));
            }
        }
    }
    assert!(met > 10 && met < 50, "{met}");
}
