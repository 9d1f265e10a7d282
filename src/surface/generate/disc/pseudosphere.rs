use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// The pseudosphere, curvature −1: the metric (dx² + dy²)/y² of the half plane y > 1 as a surface
/// of revolution.
pub(in super::super) const PSEUDOSPHERE: SurfaceKind = SurfaceKind {
    name: "pseudosphere",
    about: "(cos x / y, sin x / y, arcosh y − √(y² − 1)/y), x + iy = height · i + scale · w; curvature −1",
    parameters: &[
        SurfaceKind::CELLS,
        &[
            Parameter::real("scale", 1.0, 0.01, 3.0, "half the angle that the patch goes around the axis, radians"),
            Parameter::real("height", 2.2, 1.1, 10.0, "of the patch's middle; at least scale + 1.05"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let (scale, height) = (arguments.real("scale")?, arguments.real("height")?);
        if height < scale + 1.05 {
            let range = format!("at least {}", scale + 1.05);
            return Err(arguments.out_of_range("height", format!(" with scale={scale}"), range));
        }
        Ok(Box::new(move |[u, v]| {
            let (x, y) = (scale * u, height + scale * v);
            let (sin, cos) = x.sin_cos();
            [cos / y, sin / y, y.acosh() - (y * y - 1.0).sqrt() / y]
        }))
    }),
    exact: true,
};
