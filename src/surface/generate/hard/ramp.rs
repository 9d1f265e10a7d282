use std::f64::consts::{FRAC_PI_2, PI};

use crate::surface::generate::{Form, Parameter, Row};

/// A strip around a column: with more than one turn it lies on itself when it is flattened, though no face folds.
pub(in super::super) const RAMP: Row = Row {
    name: "ramp",
    about: "a strip that rises around a column, between 0.75 and 1.25 from its axis; with more than a turn its free map lies on itself",
    parameters: &[
        Row::VERTICES,
        &[
            Parameter::real("turns", 1.3, 0.1, 5.0, "turns around the column"),
            Parameter::real("rise", 0.3, 0.01, 10.0, "what it rises in a turn"),
        ],
        Row::MESH,
    ],
    form: Form::Square(|arguments| {
        let (turns, rise) = (arguments.real("turns")?, arguments.real("rise")?);
        // Along the first direction angles grow, along the other one radii fall: seen from above it is counter-clockwise.
        Ok(Box::new(move |[s, t]| {
            let (angle, radius) = (turns * PI * s + FRAC_PI_2, 1.0 - 0.25 * t);
            [radius * angle.cos(), radius * angle.sin(), 0.5 * rise * turns * s]
        }))
    }),
    exact: false,
};
