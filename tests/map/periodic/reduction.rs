use num_complex::Complex64;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use riemap::map::periodic::{apply, reduce, relative_error};
use riemap::solver::linear::periodic::PeriodEnergy;

/// A word in the generators of SL(2, Z).
fn matrix() -> impl Strategy<Value = [[i64; 2]; 2]> {
    prop::collection::vec(-3i64..=3, 0..6).prop_map(|shifts| {
        shifts.into_iter().fold([[1, 0], [0, 1]], |[[a, b], [c, d]], n| [[c, d], [-a - n * c, -b - n * d]])
    })
}

fn tau() -> impl Strategy<Value = Complex64> {
    (-3.0..3.0f64, -3.0..3.0f64).prop_map(|(re, log_im)| Complex64::new(re, log_im.exp()))
}

/// Strictly inside of the fundamental domain, where the reduced τ is unique.
fn inside() -> impl Strategy<Value = Complex64> {
    (-0.499..0.499f64, 1.001..20.0f64).prop_map(|(re, radius)| Complex64::new(re, (radius * radius - re * re).sqrt()))
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(6), ..ProptestConfig::default() })]

    #[test]
    fn a_reduced_ratio_is_in_the_fundamental_domain_and_its_matrix_leads_there(tau in tau()) {
        let reduced = reduce(tau).unwrap();
        let [[a, b], [c, d]] = reduced.matrix;
        prop_assert_eq!(a * d - b * c, 1);
        prop_assert!(reduced.tau.re.abs() <= 0.5 + 1e-9 && reduced.tau.norm() >= 1.0 - 1e-9);
        let there = (a as f64 * tau + b as f64) / (c as f64 * tau + d as f64);
        prop_assert!((there - reduced.tau).norm() < 1e-9 * there.norm());
    }

    #[test]
    fn every_basis_of_a_torus_has_the_same_reduced_ratio(tau in inside(), matrix in matrix()) {
        let other = apply(matrix, tau);
        // Where Im τ is tiny its relative error, and so that of the reduced ratio, is large.
        let tolerance = 1e-13 * tau.im / other.im;
        prop_assert!((reduce(other).unwrap().tau - tau).norm() < tolerance);
        prop_assert!(relative_error(other, tau).unwrap() < tolerance);
        prop_assert!(relative_error(tau, other).unwrap() < tolerance);
    }

    #[test]
    fn across_the_boundary_of_the_domain_ratios_stay_close(angle in 1.05..2.09f64, height in 0.87..5.0f64, step in 1e-6..1e-3f64) {
        let arc = Complex64::from_polar(1.0, angle);
        let pairs = [(arc * (1.0 + step), arc * (1.0 - step)), (Complex64::new(0.5 - step, height), Complex64::new(0.5 + step, height))];
        for (one, other) in pairs {
            prop_assert!(relative_error(one, other).unwrap() < 3.0 * step);
        }
    }

    #[test]
    fn the_ratio_of_least_energy_goes_with_the_basis(
        p11 in 0.2..3.0f64, p22 in 0.2..3.0f64, angle in -0.95..0.95f64, im in 0.0..1.0f64, matrix in matrix()
    ) {
        let re = angle * (p11 * p22).sqrt();
        let p12 = Complex64::new(re, im);
        let energy = PeriodEnergy { p11, p12, p22 };
        // ω = Nᵀ ω' with N the inverse of [[d, c], [b, a]], by which (ω1', ω2') come from (ω1, ω2).
        let [[a, b], [c, d]] = matrix.map(|row| row.map(|x| x as f64));
        let (to_first, to_second) = ([a, -b], [-c, d]);
        let product = |x: [f64; 2], y: [f64; 2]| {
            x[0] * y[0] * p11 + x[0] * y[1] * p12 + x[1] * y[0] * p12.conj() + x[1] * y[1] * p22
        };
        // ω1 = a ω1' − c ω2', ω2 = −b ω1' + d ω2'
        let other = PeriodEnergy { p11: product(to_first, to_first).re, p12: product(to_first, to_second), p22: product(to_second, to_second).re };
        let (there, back) = (other.ratio(), apply(matrix, energy.ratio()));
        prop_assert!((there - back).norm() < 1e-6 * back.norm(), "{} {}", there, back);
        prop_assert!((other.least() - energy.least()).abs() < 1e-6 * (1.0 + energy.least().abs()));
        // It is a minimum of H / area, and the other of H.
        let h = |t: Complex64| p11 + 2.0 * (p12 * t).re + p22 * t.norm_sqr();
        let (best, least) = (energy.ratio(), energy.least_squares());
        for step in [Complex64::new(1e-3, 0.0), Complex64::new(0.0, 1e-3)] {
            for t in [best + step * best.im, best - step * best.im] {
                prop_assert!(h(t) / t.im >= h(best) / best.im);
            }
            for t in [least + step, least - step] {
                prop_assert!(h(t) >= h(least));
            }
        }
    }
}

#[test]
fn the_boundary_has_one_side() {
    let corner = Complex64::new(0.5, 0.75f64.sqrt());
    let on_arc = Complex64::from_polar(1.0, 1.3);
    let on_line = Complex64::new(0.5, 1.7);
    for (tau, wanted) in [
        (corner, corner),
        (corner - 1.0, corner),
        (on_arc, on_arc),
        (-on_arc.conj(), on_arc),
        (on_line, on_line),
        (on_line - 1.0, on_line),
        (Complex64::I, Complex64::I),
    ] {
        // Rounding to either side changes nothing.
        for noise in [0.0, 1e-14, -1e-14] {
            let reduced = reduce(tau * (1.0 + noise) + noise).unwrap().tau;
            assert!((reduced - wanted).norm() < 1e-13, "{tau}: {reduced}");
        }
    }
}

#[test]
fn what_is_no_ratio_of_periods_is_refused() {
    for (re, im) in
        [(0.0, 0.0), (1.0, -1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (1e300, 1.0), (0.3, 1e-300), (0.1, 5e-324)]
    {
        let tau = Complex64::new(re, im);
        if let Ok(reduced) = reduce(tau) {
            panic!("{tau}: {reduced:?}");
        }
    }
    // Large and small ones that are representable are not.
    assert_eq!(reduce(Complex64::new(0.0, 1e-12)).unwrap().matrix, [[0, -1], [1, 0]]);
    assert!((reduce(Complex64::new(1e6, 1e9)).unwrap().tau - Complex64::new(0.0, 1e9)).norm() < 1e-3);
}
