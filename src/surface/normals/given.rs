//! Normals that are known, so that nothing is estimated.

use super::{Facets, NormalError, NormalEstimator};
use crate::surface::generate::SURFACES;
use crate::surface::parameters::{Arguments, Parameter};

/// The exact normals of the shape that was digitised, at its closest point to the surfel's centre.
pub(super) struct Exact;

impl NormalEstimator for Exact {
    fn name(&self) -> &'static str {
        "exact"
    }

    fn about(&self) -> &'static str {
        "the normal of the shape that was digitised (generated digital shapes)"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    fn estimate(&self, facets: &Facets, _: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        facets.digital.and_then(|digital| digital.exact_normals.clone()).ok_or_else(|| {
            let digital = SURFACES.iter().map(|row| row.name).filter(|name| name.starts_with("digital-"));
            NormalError::NotExact { known: digital.collect::<Vec<_>>().join(", ") }
        })
    }
}

/// The normals given by the mesh file.
pub(super) struct File;

impl NormalEstimator for File {
    fn name(&self) -> &'static str {
        "file"
    }

    fn about(&self) -> &'static str {
        "the normals that the mesh file gives"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    fn estimate(&self, facets: &Facets, _: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        facets.given.map(<[_]>::to_vec).ok_or(NormalError::NotGiven)
    }
}
