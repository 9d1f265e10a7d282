//! Signs of areas in the plane, exact on the doubles given.

use num_complex::Complex64;
use robust::{Coord, Coord3D, orient2d, orient3d};

/// Positive where a, b, c turn left, negative where they turn right, 0 on a line.
pub(super) fn orientation(a: Complex64, b: Complex64, c: Complex64) -> f64 {
    let coord = |z: Complex64| Coord { x: z.re, y: z.im };
    orient2d(coord(a), coord(b), coord(c))
}

/// Whether (z2 − z0) × (z3 − z1) > 0: the sign of the volume of the tetrahedron with one diagonal at height 0 and the
/// other at height 1.
pub(super) fn diagonals_cross_left([z0, z1, z2, z3]: [Complex64; 4]) -> bool {
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
        // (1 + ε, 1) × (1, 1 − ε) = −ε² is lost in double products.
        let e = f64::EPSILON;
        let at = Complex64::new;
        assert!(!diagonals_cross_left([at(0.0, 0.0), at(0.0, 0.0), at(1.0 + e, 1.0), at(1.0, 1.0 - e)]));
        assert!(diagonals_cross_left([at(0.0, 0.0), at(0.0, 0.0), at(1.0, 1.0 - e), at(1.0 + e, 1.0)]));
    }
}
