use super::two_pass::TwoPass;
use super::{Facets, NormalError, NormalEstimator};
use crate::surface::parameters::{Arguments, Parameter};

/// Chooses the normals that are best as far as known: for surfels [`TwoPass`] with its defaults;
/// for other meshes the normals of the file, or the faces' own normals if the file has none.
pub(super) struct Auto;

impl NormalEstimator for Auto {
    fn name(&self) -> &'static str {
        "auto"
    }

    fn about(&self) -> &'static str {
        "surfels: two-pass; other meshes: the normals of the file, else the faces' own"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    fn estimate(&self, facets: &Facets, _: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        if facets.looks_digital() {
            return TwoPass.estimate(facets, &Arguments::defaults(TwoPass.name(), TwoPass.parameters()));
        }
        Ok(facets.given.unwrap_or(&facets.normal).to_vec())
    }
}
