use super::Derivatives;
use super::triangle_sum::{Density, TriangleSum};

/// The density of MIPS: `f = 2|b|²/(|a|² − |b|²) = ½(σ1/σ2 + σ2/σ1) − 1`.
///
/// It is 0 if the triangle keeps its shape and is invariant under similarities (Hormann, Greiner,
/// *MIPS: an efficient global parametrization method*, 2000).
pub struct MipsDensity;

/// MIPS: `Σ w 2|b|²/(|a|² − |b|²)`.
pub type Mips = TriangleSum<MipsDensity>;

impl Density for MipsDensity {
    const NAME: &'static str = "MIPS";

    fn value(_a: f64, b: f64, j: f64) -> f64 {
        2.0 * (b / j)
    }

    // Written as quotients of numbers of similar size: J² underflows where parts of a map have size
    // 1e-100.
    fn derivatives(a: f64, b: f64, j: f64) -> Derivatives {
        let (p, q) = (a / j, b / j);
        Derivatives {
            a: -2.0 * q / j,
            b: 2.0 * p / j,
            aa: 4.0 * p * q / j,
            ab: -2.0 * (p + q) * (p * q).sqrt() / j,
            bb: 4.0 * p * q / j,
        }
    }
}
