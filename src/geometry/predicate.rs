//! Signs of areas in the plane, exact for the given floating-point numbers.

use num_complex::Complex64;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Returns a number with the exact sign of the area of the triangle a, b, c: positive if they turn
/// left, negative if they turn right, 0 if they are collinear.
///
/// Coordinates near the ends of the range of doubles are first scaled by a power of two. The result
/// is also 0 if one coordinate is 10²⁹⁰ times another, so that no power of two moves both away from
/// these ends.
pub fn orientation(a: Complex64, b: Complex64, c: Complex64) -> f64 {
    let points = [a, b, c];
    let fits = |z: &Complex64| fits(z.re) && fits(z.im);
    let [a, b, c] = if points.iter().all(fits) {
        points
    } else {
        let largest = points.iter().fold(0.0, |m: f64, z| m.max(z.re.abs()).max(z.im.abs()));
        // 0 and subnormal numbers have the exponent −1023 here and are scaled up by less than
        // possible.
        let exponent = (largest.to_bits() >> 52) as i32 - 1023;
        let (half, rest) = ((498 - exponent) / 2, (498 - exponent) - (498 - exponent) / 2);
        let scale = |x: f64| x * 2f64.powi(half) * 2f64.powi(rest);
        let scaled = points.map(|z| Complex64::new(scale(z.re), scale(z.im)));
        let vanishes = |(z, w): (&Complex64, &Complex64)| (z.re != 0.0 && w.re == 0.0) || (z.im != 0.0 && w.im == 0.0);
        if !scaled.iter().all(fits) || points.iter().zip(&scaled).any(vanishes) {
            return 0.0;
        }
        scaled
    };
    let coord = |z: Complex64| Coord { x: z.re, y: z.im };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether products of two such coordinates, and their rounding errors, are exactly representable.
fn fits(x: f64) -> bool {
    x == 0.0 || (1e-140..=1e150).contains(&x.abs())
}

/// Whether (z2 − z0) × (z3 − z1) > 0, as the sign of the volume of the tetrahedron with one
/// diagonal at height 0 and the other at height 1.
pub(crate) fn diagonals_cross_left([z0, z1, z2, z3]: [Complex64; 4]) -> bool {
    let at = |z: Complex64, height: f64| Coord3D { x: z.re, y: z.im, z: height };
    orient3d(at(z0, 0.0), at(z2, 0.0), at(z1, 1.0), at(z3, 1.0)) > 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sign_of_the_diagonals_is_that_of_the_square() {
        let square = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| Complex64::new(x, y));
        assert!(diagonals_cross_left(square));
        let [a, b, c, d] = square;
        assert!(!diagonals_cross_left([d, c, b, a]));
        assert!(!diagonals_cross_left([a, a, a, a]));
    }

    #[test]
    fn sign_of_the_diagonals_is_exact_where_products_round() {
        // (1 + ε, 1) × (1, 1 − ε) = −ε² is lost in products of doubles.
        let e = f64::EPSILON;
        let at = Complex64::new;
        assert!(!diagonals_cross_left([at(0.0, 0.0), at(0.0, 0.0), at(1.0 + e, 1.0), at(1.0, 1.0 - e)]));
        assert!(diagonals_cross_left([at(0.0, 0.0), at(0.0, 0.0), at(1.0, 1.0 - e), at(1.0 + e, 1.0)]));
    }

    #[test]
    fn sign_of_an_area_is_exact_where_products_underflow_or_overflow() {
        let e = f64::EPSILON;
        let at = Complex64::new;
        let shallow = |scale: f64| orientation(at(0.0, 0.0), at(1.0 + e, 1.0) * scale, at(1.0, 1.0 - e) * scale);
        for exponent in [-1000, -700, -500, -300, 0, 300, 480, 520, 1000] {
            let scale = 2f64.powi(exponent);
            assert!(shallow(scale) < 0.0, "2^{exponent}");
            assert!(orientation(at(0.0, 0.0), at(scale, 0.0), at(scale, scale)) > 0.0, "2^{exponent}");
            assert_eq!(orientation(at(scale, scale), at(2.0 * scale, 2.0 * scale), at(0.0, 0.0)), 0.0, "2^{exponent}");
        }
        // The smallest possible triangle.
        let tiny = f64::from_bits(1);
        assert!(orientation(at(0.0, 0.0), at(tiny, 0.0), at(0.0, tiny)) > 0.0);
        assert!(orientation(at(0.0, 0.0), at(0.0, tiny), at(tiny, 0.0)) < 0.0);
        // Small and large coordinates: one factor suffices here, but not over the whole range.
        assert!(orientation(at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1e-200)) > 0.0);
        assert!(orientation(at(0.0, 0.0), at(1.0, 0.0), at(1.0, tiny)) >= 0.0);
    }
}
