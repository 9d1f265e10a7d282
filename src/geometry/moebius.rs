//! Möbius maps, in particular those of the disc to itself.

use num_complex::Complex64;

/// A Möbius map `z ↦ (a z + b)/(c z + d)`, by its coefficients a, b, c, d.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moebius(pub [Complex64; 4]);

/// A Möbius map is not determined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MoebiusError {
    /// Two of three points coincide.
    #[error("a Möbius map through three points needs three different points and three different images")]
    Coincident,
}

impl Moebius {
    /// Returns the map that takes z_k to w_k. It maps the disc to itself if both triples lie on the
    /// circle in the same order.
    ///
    /// # Errors
    /// [`MoebiusError::Coincident`].
    pub fn through(z: [Complex64; 3], w: [Complex64; 3]) -> Result<Self, MoebiusError> {
        let apart = |p: [Complex64; 3]| p[0] != p[1] && p[1] != p[2] && p[2] != p[0];
        if !(apart(z) && apart(w)) {
            return Err(MoebiusError::Coincident);
        }
        // Takes z0, z1, z2 to 0, 1, ∞.
        let standard = |[p, q, r]: [Complex64; 3]| Moebius([q - r, -p * (q - r), q - p, -r * (q - p)]);
        let Moebius([a, b, c, d]) = standard(w);
        Ok(Moebius([d, -b, -c, a]).after(&standard(z)))
    }

    /// Returns M(z); not finite at the pole.
    pub fn at(&self, z: Complex64) -> Complex64 {
        let Moebius([a, b, c, d]) = self;
        (a * z + b) / (c * z + d)
    }

    /// Returns the composition `z ↦ self(first(z))`, with a determinant of absolute value 1.
    #[must_use]
    pub fn after(&self, first: &Moebius) -> Self {
        let (Moebius([a, b, c, d]), Moebius([e, f, g, h])) = (self, first);
        let product = [a * e + b * g, a * f + b * h, c * e + d * g, c * f + d * h];
        let scale = (product[0] * product[3] - product[1] * product[2]).norm().sqrt();
        Moebius(product.map(|x| x / scale))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn points() -> Vec<Complex64> {
        (0..40).map(|k| Complex64::from_polar(((k as f64 * 0.618).fract()).sqrt(), k as f64 * 2.4)).collect()
    }

    #[test]
    fn three_points_are_met_and_the_disc_stays_the_disc() {
        let z = [0.1, 2.0, 4.5].map(Complex64::cis);
        let w = [1.0, 1.3, 6.0].map(Complex64::cis);
        let map = Moebius::through(z, w).unwrap();
        for (z, w) in z.into_iter().zip(w) {
            // Rounding, and a few derivatives of about 10.
            assert!((map.at(z) - w).norm() < 1e-13);
        }
        assert!((0..20).all(|k| (map.at(Complex64::cis(k as f64)).norm() - 1.0).abs() < 1e-13));
        assert!(points().iter().all(|&z| map.at(z).norm() < 1.0));
        assert_eq!(Moebius::through([z[0], z[0], z[2]], w), Err(MoebiusError::Coincident));
    }
}
