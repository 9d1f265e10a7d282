//! The radii of estimators: given, or computed from the size of the object.

use super::{Facets, NormalError};
use crate::surface::parameters::{Arguments, Parameter};

/// Declares the parameter `radius`.
pub(super) const fn radius() -> Parameter {
    Parameter::real("radius", 0.0, 0.0, 100.0, "in edges (voxels); 0: c L^exponent, L the size of the object")
}

/// Declares the factor `c` of the rule `radius = c L^exponent`.
pub(super) const fn factor(default: f64) -> Parameter {
    Parameter::real("c", default, 0.01, 100.0, "factor of the rule").only_with("radius", &["0"])
}

/// Declares the exponent of the rule `radius = c L^exponent`.
pub(super) const fn exponent(default: f64) -> Parameter {
    Parameter::real("exponent", default, 0.0, 1.0, "exponent of the rule").only_with("radius", &["0"])
}

/// Returns the radius in edges: the parameter `radius`, or `max(c L^exponent, least)` if that is 0.
pub(super) fn radius_of(facets: &Facets, arguments: &Arguments, least: f64) -> Result<f64, NormalError> {
    let given = arguments.real("radius")?;
    if given > 0.0 {
        return Ok(given);
    }
    Ok((arguments.real("c")? * facets.size().powf(arguments.real("exponent")?)).max(least))
}
