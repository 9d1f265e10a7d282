use std::f64::consts::FRAC_PI_2;

use crate::surface::generate::{Form, Parameter, Row};

/// A finger: seen from its rim, the cap is conformally as small as e^{−length}, so that long ones end what doubles can tell apart.
pub(in super::super) const CAPSULE: Row = Row {
    name: "capsule",
    about: "a tube of radius 1 closed by half a sphere, open at its other end; its conformal map shrinks the cap as e^−length",
    parameters: &[
        Row::VERTICES,
        &[Parameter::real("length", 4.0, 0.0, 100.0, "length of the tube, in its radii")],
        Row::MESH,
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
