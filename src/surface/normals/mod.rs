//! Estimated normals of the faces of a surface, from which ρ of a digital surface is computed.
//!
//! The faces of a digital surface have only six directions, however fine the voxels are; averages
//! of them recover the normals of the surface that was digitised. An estimator is named by
//! `name?parameter=value&…`, for example `hat?radius=4&ball=euclidean`. A new estimator is one file
//! and one row of [`NORMAL_ESTIMATORS`].
//!
//! Radii are counted in edges of faces (for voxels: in voxels). The default radius depends on the
//! size L of the object in the same unit ([`Facets::size`]): `radius = c L^exponent`. With h = 1/L
//! this is `c h^(1 − exponent)` in units of the object.

mod auto;
mod convolution;
mod error;
mod facets;
mod given;
mod hat;
mod integral_invariant;
mod moments;
mod rule;
mod spec;
mod surfel;
mod two_pass;
mod whole;

pub use error::NormalError;
pub use facets::Facets;
pub use spec::{NormalSpec, NormalSpecError};

use super::parameters::{Arguments, Parameter};
use crate::geometry::vector::{dot, norm, scale, sub};

/// An estimator of the normals of faces.
pub trait NormalEstimator: Sync {
    /// The name, as used in options and in the report.
    fn name(&self) -> &'static str;

    /// A description of one line.
    fn about(&self) -> &'static str;

    /// The parameters that can follow the `?`.
    fn parameters(&self) -> &'static [Parameter];

    /// Returns unit normals, one per face (`nf × 3`), on the same side as the faces' own normals.
    /// `arguments` has a value for each of [`parameters`](Self::parameters).
    ///
    /// # Errors
    /// The surface lacks what the estimator needs: voxels, or normals in the file.
    fn estimate(&self, facets: &Facets, arguments: &Arguments) -> Result<Vec<[f64; 3]>, NormalError>;
}

/// The table of all estimators.
pub static NORMAL_ESTIMATORS: &[&dyn NormalEstimator] = &[
    &auto::Auto,
    &two_pass::TwoPass,
    &convolution::Convolution,
    &hat::Hat,
    &integral_invariant::IntegralInvariant,
    &surfel::SurfelNormal,
    &given::Exact,
    &given::File,
];

/// Estimates the normals of `facets` with the estimator that `spec` names, for example `auto`.
///
/// # Errors
/// `spec` names no estimator, or the surface does not suit it.
pub fn estimate(spec: &str, facets: &Facets) -> Result<Vec<[f64; 3]>, NormalError> {
    spec.parse::<NormalSpec>()?.estimate(facets)
}

/// Returns the unit vector along `mean`, made to lie on the side of `own`.
///
/// A `mean` on the opposite side is projected onto the tangent plane of `own`. If nothing is left
/// of it, the result is `own`.
fn outward(mean: [f64; 3], own: [f64; 3]) -> [f64; 3] {
    // `mean` is an average of unit vectors with weights of sum 1: a smaller length is rounding.
    const NOTHING: f64 = 1e-9;
    let along = dot(mean, own);
    let mean = if along < 0.0 { sub(mean, scale(along, own)) } else { mean };
    let length = norm(mean);
    if length > NOTHING { scale(1.0 / length, mean) } else { own }
}
