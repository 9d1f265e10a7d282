use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// Part of the unit sphere by stereographic projection from the north pole, seen from inside.
pub(in super::super) const SPHERE: SurfaceKind = SurfaceKind {
    name: "sphere",
    about: "part of the unit sphere, (2W, |W|² − 1)/(1 + |W|²), W = scale · w; scale 1: a half",
    parameters: &[
        SurfaceKind::CELLS,
        &[Parameter::real("scale", 1.0, 0.01, 10.0, "radius of the disc before the projection")],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let scale = arguments.real("scale")?;
        Ok(Box::new(move |[u, v]| {
            let (u, v) = (scale * u, scale * v);
            let square = u * u + v * v;
            [2.0 * u / (1.0 + square), 2.0 * v / (1.0 + square), (square - 1.0) / (1.0 + square)]
        }))
    }),
    exact: true,
};
