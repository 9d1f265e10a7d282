use super::plane::polynomial;
use crate::surface::generate::{Form, Parameter, Row};

/// The plane image w + c w², rolled on a cylinder: isometric to it, so A = L = H = 0 can be reached.
pub(in super::super) const CYLINDER: Row = Row {
    name: "cylinder",
    about: "x + iy = w + c w² rolled up: (ρ sin(x/ρ), y, ρ (1 − cos(x/ρ))); developable",
    parameters: &[
        Row::CELLS,
        &[
            Parameter::real("c", 0.25, -0.49, 0.49, "coefficient of w²"),
            // the image is at most 2.3 wide: with ρ ≥ 1/2 the roll does not meet itself
            Parameter::real("radius", 0.75, 0.5, 1e3, "radius ρ of the cylinder"),
        ],
        Row::MESH,
    ],
    form: Form::Disc(|arguments| {
        let (c, radius) = (arguments.real("c")?, arguments.real("radius")?);
        Ok(Box::new(move |w| {
            let [x, y] = polynomial(w, c, 2);
            let half = (0.5 * x / radius).sin();
            [radius * (x / radius).sin(), y, 2.0 * radius * half * half]
        }))
    }),
    exact: true,
};
