//! Holomorphic images of the disc in the plane, injective on |w| ≤ 1.

use crate::surface::generate::{Arguments, Form, GenerateError, Immersion, Parameter, SurfaceKind};

const COEFFICIENT: Parameter = Parameter::real("c", 0.25, -0.49, 0.49, "coefficient; at ±1/2 the boundary has a cusp");

/// The map w + c w².
pub(in super::super) const QUADRATIC: SurfaceKind = SurfaceKind {
    name: "plane",
    about: "w + c w², z = 0",
    parameters: &[SurfaceKind::CELLS, &[COEFFICIENT], SurfaceKind::MESH],
    form: Form::Disc(|arguments| {
        let c = arguments.real("c")?;
        Ok(Box::new(move |w| {
            let [x, y] = polynomial(w, c, 2);
            [x, y, 0.0]
        }))
    }),
    exact: true,
};

/// The map w + (c/k) wᵏ.
pub(in super::super) const POWER: SurfaceKind = SurfaceKind {
    name: "plane-power",
    about: "w + (c/k) wᵏ, z = 0: k − 1 petals",
    parameters: &[
        SurfaceKind::CELLS,
        &[
            Parameter::real("c", 0.6, -0.98, 0.98, "coefficient; at ±1 the boundary has cusps"),
            Parameter::whole("k", 4, 2, 12, "exponent"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(power),
    exact: true,
};

/// The map (e^{cw} − 1)/c.
pub(in super::super) const EXPONENTIAL: SurfaceKind = SurfaceKind {
    name: "plane-exp",
    about: "(e^{cw} − 1)/c, z = 0: scale varies by e^{2c}",
    parameters: &[SurfaceKind::CELLS, &[Parameter::real("c", 1.0, 0.01, 3.0, "coefficient")], SurfaceKind::MESH],
    form: Form::Disc(|arguments| {
        let c = arguments.real("c")?;
        Ok(Box::new(move |[u, v]| {
            let (sin, cos) = (c * v).sin_cos();
            // e^{cu} cos cv − 1 without cancellation.
            let x = (c * u).exp_m1() * cos - 2.0 * (0.5 * c * v).sin().powi(2);
            [x / c, (c * u).exp() * sin / c, 0.0]
        }))
    }),
    exact: true,
};

fn power(arguments: &Arguments) -> Result<Immersion, GenerateError> {
    let k = arguments.whole("k")? as i32;
    let c = arguments.real("c")? / f64::from(k);
    Ok(Box::new(move |w| {
        let [x, y] = polynomial(w, c, k);
        [x, y, 0.0]
    }))
}

/// Evaluates w + c wᵏ.
pub(super) fn polynomial([u, v]: [f64; 2], c: f64, k: i32) -> [f64; 2] {
    let (mut x, mut y) = (c, 0.0);
    for _ in 0..k {
        (x, y) = (x * u - y * v, x * v + y * u);
    }
    [u + x, v + y]
}
