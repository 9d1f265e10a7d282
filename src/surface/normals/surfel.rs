use super::{Facets, NormalError, NormalEstimator};
use crate::surface::parameters::{Arguments, Parameter};

/// The face's own normal, `e3` of a surfel: what the paper's figure 11 shows not to converge.
pub(super) struct Surfel;

impl NormalEstimator for Surfel {
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
