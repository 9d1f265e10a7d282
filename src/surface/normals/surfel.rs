use super::{Facets, NormalError, NormalEstimator};
use crate::surface::parameters::{Arguments, Parameter};

/// The face's own normal (`e3` of a surfel), which does not converge, as figure 11 of the paper
/// shows.
pub(super) struct SurfelNormal;

impl NormalEstimator for SurfelNormal {
    fn name(&self) -> &'static str {
        "surfel"
    }

    fn about(&self) -> &'static str {
        "the face's own normal"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    fn estimate(&self, facets: &Facets, _: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        Ok(facets.normal.clone())
    }
}
