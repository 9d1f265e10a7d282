//! Normals of the faces of a surface, estimated: what ρ of a digital surface is made of.
//!
//! The faces of a digital surface know six directions, however fine the voxels; the surface that was digitised is in their
//! averages. An estimator is named by `name?parameter=value&…`, for example `hat?radius=4&ball=euclidean`. A new one is
//! one file and one row of [`NORMAL_ESTIMATORS`].
//!
//! Radii are counted in edges of faces (of voxels: in voxels). Where none is given it follows from the size L of the object
//! in the same unit, [`Facets::size`]: `radius = c L^exponent`. With h = 1/L the radius in units of the object is then
//! `c h^(1 − exponent)`.

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

/// A way to estimate the normals of faces.
pub trait NormalEstimator: Sync {
    /// Name for `--normals` and the report.
    fn name(&self) -> &'static str;

    /// One line for `riemap list`.
    fn about(&self) -> &'static str;

    /// What may stand behind the `?`.
    fn parameters(&self) -> &'static [Parameter];

    /// Unit normals, one per face (`nf × 3`), on the side of the faces' own normals. `arguments` has all of
    /// [`parameters`](Self::parameters).
    ///
    /// # Errors
    /// What the surface lacks: voxels, normals of its own.
    fn estimate(&self, facets: &Facets, arguments: &Arguments) -> Result<Vec<[f64; 3]>, NormalError>;
}

/// All estimators by name.
pub static NORMAL_ESTIMATORS: &[&dyn NormalEstimator] = &[
    &auto::Auto,
    &two_pass::TwoPass,
    &convolution::Convolution,
    &hat::Hat,
    &integral_invariant::IntegralInvariant,
    &surfel::Surfel,
    &given::Exact,
    &given::File,
];

/// The normals of `facets` by the estimator that `spec` names, for example `auto`.
///
/// # Errors
/// A text that names no estimator; a surface that does not suit it.
pub fn estimate(spec: &str, facets: &Facets) -> Result<Vec<[f64; 3]>, NormalError> {
    spec.parse::<NormalSpec>()?.estimate(facets)
}

/// The unit vector along `mean`, turned into the tangent plane of `own` where it points to the other side; `own` where
/// nothing is left of it.
fn outward(mean: [f64; 3], own: [f64; 3]) -> [f64; 3] {
    // Sums of unit vectors with weights of sum 1: below this, rounding decides.
    const NOTHING: f64 = 1e-9;
    let along = dot(mean, own);
    let mean = if along < 0.0 { sub(mean, scale(along, own)) } else { mean };
    let length = norm(mean);
    if length > NOTHING { scale(1.0 / length, mean) } else { own }
}
