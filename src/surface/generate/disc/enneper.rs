use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// Enneper's minimal surface, with y mirrored so that the normal at w = 0 is +z.
pub(in super::super) const ENNEPER: SurfaceKind = SurfaceKind {
    name: "enneper",
    about: "(u − u³/3 + uv², v − v³/3 + vu², u² − v²), u + iv = scale · w",
    parameters: &[
        SurfaceKind::CELLS,
        &[Parameter::real("scale", 0.5, 0.01, 1.7, "|u + iv| on the boundary; above √3 it meets itself")],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let scale = arguments.real("scale")?;
        Ok(Box::new(move |w| {
            let [u, v] = w.map(|x| scale * x);
            [u - u * u * u / 3.0 + u * v * v, v - v * v * v / 3.0 + v * u * u, u * u - v * v]
        }))
    }),
    exact: true,
};
