//! Radii: given, or by the size of the object.

use super::{Facets, NormalError};
use crate::surface::parameters::{Arguments, Parameter};

/// How far an estimator looks.
pub(super) const fn radius() -> Parameter {
    Parameter::real("radius", 0.0, 0.0, 100.0, "in edges (voxels); 0: c L^exponent, L the size of the object")
}

/// The factor of the rule.
pub(super) const fn factor(default: f64) -> Parameter {
    Parameter::real("c", default, 0.01, 100.0, "factor of the rule").only_with("radius", &["0"])
}

/// The exponent of the rule.
pub(super) const fn exponent(default: f64) -> Parameter {
    Parameter::real("exponent", default, 0.0, 1.0, "exponent of the rule").only_with("radius", &["0"])
}

/// The radius, in edges: the parameter `radius`, or where that is 0 `max(c L^exponent, least)`.
pub(super) fn radius_of(facets: &Facets, arguments: &Arguments, least: f64) -> Result<f64, NormalError> {
    let given = arguments.real("radius")?;
    if given > 0.0 {
        return Ok(given);
    }
    Ok((arguments.real("c")? * facets.size().powf(arguments.real("exponent")?)).max(least))
}
