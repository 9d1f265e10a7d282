use std::f64::consts::{FRAC_PI_2, PI};

use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// A strip around a column. With more than one turn its flattening overlaps itself, although no
/// face is flipped.
pub(in super::super) const RAMP: SurfaceKind = SurfaceKind {
    name: "ramp",
    about: "a strip that rises around a column, between 0.75 and 1.25 from its axis; with more than a turn its free map lies on itself",
    parameters: &[
        SurfaceKind::VERTICES,
        &[
            Parameter::real("turns", 1.3, 0.1, 5.0, "turns around the column"),
            Parameter::real("rise", 0.3, 0.01, 10.0, "what it rises in a turn"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Square(|arguments| {
        let (turns, rise) = (arguments.real("turns")?, arguments.real("rise")?);
        // Angles grow along s and radii decrease along t: the faces are counter-clockwise seen from
        // above.
        Ok(Box::new(move |[s, t]| {
            let (angle, radius) = (turns * PI * s + FRAC_PI_2, 1.0 - 0.25 * t);
            [radius * angle.cos(), radius * angle.sin(), 0.5 * rise * turns * s]
        }))
    }),
    exact: false,
};
