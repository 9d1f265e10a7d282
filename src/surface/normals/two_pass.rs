use super::whole::on_whole;
use super::{Facets, NormalError, NormalEstimator, convolution, hat, rule};
use crate::surface::parameters::{Arguments, Parameter};

/// [`Hat`](hat::Hat) over a Euclidean ball, normalised; then `radius² / 2` steps of [`Convolution`](convolution::Convolution).
///
/// An average around a surfel leans toward the surfel's own axis: its own plane is closest to it. The error of neighbours with
/// different axes then differs in sign, and ρ, which depends on n relative to the axis, sees it whole: τ of a digital torus is
/// off by more than the angles let expect. A second average mixes the axes. With the default the angles are about two thirds of
/// those by convolution alone, at the same error of τ.
pub(super) struct TwoPass;

const PARAMETERS: [Parameter; 3] = [rule::radius(), rule::factor(1.9), rule::exponent(0.333)];

impl NormalEstimator for TwoPass {
    fn name(&self) -> &'static str {
        "two-pass"
    }

    fn about(&self) -> &'static str {
        "hat over a Euclidean ball, then radius²/2 averages over face neighbours"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &PARAMETERS
    }

    fn estimate(&self, facets: &Facets, arguments: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        on_whole(facets, |facets| {
            let radius = rule::radius_of(facets, arguments, hat::LEAST_RADIUS)?;
            let steps = (0.5 * radius * radius).round() as usize;
            Ok(convolution::convolved(facets, &hat::averaged(facets, radius, false), steps))
        })
    }
}
