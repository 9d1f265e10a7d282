//! Graphs z = f(s, t) over [−π, π]². Their conformal maps are not known.

use std::f64::consts::PI;

use super::{Arguments, Form, GenerateError, Immersion, Parameter, Row};

const AMPLITUDE: &[Parameter] =
    &[Parameter::real("amplitude", 1.0, -100.0, 100.0, "factor of z; steep graphs have many obtuse triangles")];

/// The egg box of the paper's figures.
pub(super) const COSINES: Row = Row {
    name: "graph:cos+cos",
    about: "z = a (cos s + cos t) over [−π, π]²",
    parameters: &[Row::VERTICES, AMPLITUDE, Row::MESH],
    form: Form::Square(|arguments| graph(arguments, |s, t| s.cos() + t.cos())),
    exact: false,
};

/// Negative curvature throughout.
pub(super) const SADDLE: Row = Row {
    name: "graph:saddle",
    about: "z = a (s² − t²)/4 over [−π, π]²",
    parameters: &[Row::VERTICES, AMPLITUDE, Row::MESH],
    form: Form::Square(|arguments| graph(arguments, |s, t| 0.25 * (s * s - t * t))),
    exact: false,
};

/// A bump on a plain.
pub(super) const GAUSS: Row = Row {
    name: "graph:gauss",
    about: "z = a exp(−(s² + t²)/2) over [−π, π]²",
    parameters: &[Row::VERTICES, AMPLITUDE, Row::MESH],
    form: Form::Square(|arguments| graph(arguments, |s, t| (-0.5 * (s * s + t * t)).exp())),
    exact: false,
};

/// Where every map of a free boundary should be the identity.
pub(super) const FLAT: Row = Row {
    name: "graph:flat",
    about: "z = 0 over [−π, π]²",
    parameters: &[Row::VERTICES, Row::MESH],
    form: Form::Square(|_| Ok(Box::new(|[s, t]| [PI * s, PI * t, 0.0]))),
    exact: false,
};

fn graph(arguments: &Arguments, f: fn(f64, f64) -> f64) -> Result<Immersion, GenerateError> {
    let a = arguments.real("amplitude")?;
    Ok(Box::new(move |p| {
        let [s, t] = p.map(|x| PI * x);
        [s, t, a * f(s, t)]
    }))
}
