use num_complex::Complex64;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use riemap::map::periodic::{ACCEPTED_SHEAR, Texture, checker, reduce, whole};

fn tau() -> impl Strategy<Value = Complex64> {
    (-0.5..0.5f64, -0.2..4.0f64).prop_map(|(re, log)| reduce(Complex64::new(re, log.exp())).unwrap().tau)
}

/// σ1/σ2 − 1 of N after the inverse of (a, b) → a + bτ, by its trace and determinant.
fn shear(texture: &Texture, tau: Complex64) -> f64 {
    let [[p, q], [r, s]] = texture.matrix.map(|row| row.map(|x| x as f64));
    let column = |x: f64, y: f64| [x, (y - tau.re * x) / tau.im];
    let ([a, b], [c, d]) = (column(p, q), column(r, s));
    let (squares, determinant) = (a * a + b * b + c * c + d * d, a * d - b * c);
    // σ1² + σ2² = squares, σ1 σ2 = determinant
    let (sum, difference) = ((squares + 2.0 * determinant).sqrt(), (squares - 2.0 * determinant).max(0.0).sqrt());
    (sum + difference) / (sum - difference) - 1.0
}

proptest! {
    #![proptest_config(ProptestConfig { rng_seed: RngSeed::Fixed(8), ..ProptestConfig::default() })]

    #[test]
    fn whole_periods_close_up_with_little_shear(tau in tau()) {
        let texture = whole(tau);
        prop_assert!(texture.shear <= ACCEPTED_SHEAR && texture.squares() > 0.0, "{:?}", texture);
        prop_assert!((texture.shear - shear(&texture, tau)).abs() < 1e-6);
        let [[p, q], [r, s]] = texture.matrix;
        prop_assert!((p + r) % 2 == 0 && (q + s) % 2 == 0);
    }

    #[test]
    fn checkerboards_are_continuous_across_both_periods(tau in tau(), squares in 4u32..64, a in 0.0..1.0f64, b in 0.0..1.0f64) {
        let texture = checker(tau, squares);
        prop_assert!(texture.shear < 0.35, "{:?}", texture);
        prop_assert!(squares < 16 || texture.shear < 0.1, "{:?}", texture);
        let around = (texture.matrix[0][0] as f64).hypot(texture.matrix[1][0] as f64);
        prop_assert!((0.6..1.6).contains(&(around / f64::from(squares))), "{} for {}", around, squares);
        // away from the edges of squares, where rounding decides
        let clear = |at: [f64; 2]| texture.place(at).iter().all(|x| (x - x.round()).abs() > 1e-6);
        if clear([a, b]) {
            for (m, n) in [(1.0, 0.0), (0.0, 1.0), (-3.0, 2.0)] {
                prop_assert_eq!(texture.is_dark([a + m, b + n]), texture.is_dark([a, b]));
            }
        }
    }
}

#[test]
fn a_square_torus_needs_no_shear() {
    let texture = whole(Complex64::I);
    assert_eq!((texture.shear, texture.squares()), (0.0, 2.0));
    assert_eq!(checker(Complex64::I, 16).matrix, [[16, 0], [0, 16]]);
    // Neighbouring squares differ.
    let checker = checker(Complex64::I, 16);
    assert_ne!(checker.is_dark([0.01, 0.01]), checker.is_dark([0.07, 0.01]));
    assert_ne!(checker.is_dark([0.01, 0.01]), checker.is_dark([0.01, 0.07]));
}

#[test]
fn extreme_ratios_and_sizes_give_textures_all_the_same() {
    for im in [1.0, 1e3, 1e9] {
        for squares in [0, 1, 2, u32::MAX] {
            assert!(checker(Complex64::new(0.2, im), squares).squares() > 0.0);
        }
        assert!(whole(Complex64::new(0.2, im)).shear <= ACCEPTED_SHEAR);
    }
}
