use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// The isometric family from the catenoid to the helicoid: cos α · C + sin α · H with C = (cos v
/// cosh u, sin v cosh u, u), H = (sin v sinh u, −cos v sinh u, v).
pub(in super::super) const CATENOID: SurfaceKind = SurfaceKind {
    name: "catenoid",
    about: "patch of the catenoid (angle 0), helicoid (angle 90) and the minimal surfaces between, u + iv = scale · w",
    parameters: &[
        SurfaceKind::CELLS,
        &[
            Parameter::real("scale", 1.0, 0.01, 3.0, "half the angle that the patch goes around the axis, radians"),
            Parameter::real("angle", 0.0, 0.0, 90.0, "of the family, degrees"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let scale = arguments.real("scale")?;
        let (sin, cos) = arguments.real("angle")?.to_radians().sin_cos();
        Ok(Box::new(move |w| {
            let [u, v] = w.map(|x| scale * x);
            let (sin_v, cos_v) = v.sin_cos();
            let (sinh, cosh) = (u.sinh(), u.cosh());
            [cos * cos_v * cosh + sin * sin_v * sinh, cos * sin_v * cosh - sin * cos_v * sinh, cos * u + sin * v]
        }))
    }),
    exact: true,
};
