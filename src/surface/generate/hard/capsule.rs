use std::f64::consts::FRAC_PI_2;

use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// A capsule: a tube of radius 1 closed by a hemisphere. Its conformal map shrinks the cap to a
/// size of order e^{−length}, so that long tubes exceed the resolution of double precision.
pub(in super::super) const CAPSULE: SurfaceKind = SurfaceKind {
    name: "capsule",
    about: "a tube of radius 1 closed by half a sphere, open at its other end; its conformal map shrinks the cap as e^−length",
    parameters: &[
        SurfaceKind::VERTICES,
        &[Parameter::real("length", 4.0, 0.0, 100.0, "length of the tube, in its radii")],
        SurfaceKind::MESH,
    ],
    form: Form::Square(|arguments| {
        let length = arguments.real("length")?;
        Ok(Box::new(move |[s, t]| {
            let w = [s * (1.0 - 0.5 * t * t).sqrt(), t * (1.0 - 0.5 * s * s).sqrt()];
            let r = w[0].hypot(w[1]);
            // Arc length from the pole along a meridian.
            let along = r * (length + FRAC_PI_2);
            let on_cap = along.min(FRAC_PI_2);
            // sin(along)/r has a limit at the pole.
            let scale = if r > 0.0 { on_cap.sin() / r } else { 0.0 };
            [scale * w[0], scale * w[1], on_cap.cos() - (along - on_cap)]
        }))
    }),
    exact: false,
};
