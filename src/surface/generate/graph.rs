//! Graphs z = f(s, t) over [−π, π]². Their conformal maps are not known exactly.

use std::f64::consts::PI;

use super::{Arguments, Form, GenerateError, Immersion, Parameter, SurfaceKind};

const AMPLITUDE: &[Parameter] =
    &[Parameter::real("amplitude", 1.0, -100.0, 100.0, "factor of z; steep graphs have many obtuse triangles")];

/// The egg-box surface of the paper's figures.
pub(super) const COSINES: SurfaceKind = SurfaceKind {
    name: "graph:cos+cos",
    about: "z = a (cos s + cos t) over [−π, π]²",
    parameters: &[SurfaceKind::VERTICES, AMPLITUDE, SurfaceKind::MESH],
    form: Form::Square(|arguments| graph(arguments, |s, t| s.cos() + t.cos())),
    exact: false,
};

/// A saddle: its curvature is negative everywhere.
pub(super) const SADDLE: SurfaceKind = SurfaceKind {
    name: "graph:saddle",
    about: "z = a (s² − t²)/4 over [−π, π]²",
    parameters: &[SurfaceKind::VERTICES, AMPLITUDE, SurfaceKind::MESH],
    form: Form::Square(|arguments| graph(arguments, |s, t| 0.25 * (s * s - t * t))),
    exact: false,
};

/// A Gaussian bump on a plane.
pub(super) const GAUSS: SurfaceKind = SurfaceKind {
    name: "graph:gauss",
    about: "z = a exp(−(s² + t²)/2) over [−π, π]²",
    parameters: &[SurfaceKind::VERTICES, AMPLITUDE, SurfaceKind::MESH],
    form: Form::Square(|arguments| graph(arguments, |s, t| (-0.5 * (s * s + t * t)).exp())),
    exact: false,
};

/// The flat square, for which every free-boundary map should be a similarity.
pub(super) const FLAT: SurfaceKind = SurfaceKind {
    name: "graph:flat",
    about: "z = 0 over [−π, π]²",
    parameters: &[SurfaceKind::VERTICES, SurfaceKind::MESH],
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
