use crate::surface::generate::torus::radii;
use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// A patch of the torus of revolution, with curvature of both signs.
///
/// It is conformal in φ = u and θ with tan(θ/2) = √((R + r)/(R − r)) tan(v √(R² − r²)/2r).
pub(in super::super) const TORUS_PATCH: SurfaceKind = SurfaceKind {
    name: "torus-patch",
    about: "patch of a torus of revolution in its conformal coordinates, u + iv = scale · w",
    parameters: &[
        SurfaceKind::CELLS,
        &[
            Parameter::real("R", 2.0, 0.1, 100.0, "radius to the middle of the tube"),
            Parameter::real("r", 1.0, 0.1, 100.0, "radius of the tube, at most 0.99 R"),
            Parameter::real("scale", 1.0, 0.001, 3.0, "half the angle that the patch goes around the axis, radians"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let (big, small) = radii(arguments)?;
        let scale = arguments.real("scale")?;
        let rate = (big * big - small * small).sqrt() / (2.0 * small);
        let stretch = ((big + small) / (big - small)).sqrt();
        // Beyond v = π/(2 rate) the patch would close around the tube.
        let largest = 0.95 * std::f64::consts::FRAC_PI_2 / rate;
        if scale > largest {
            let circumstance = format!(" with R={big}, r={small}");
            return Err(arguments.out_of_range("scale", circumstance, format!("at most {largest}")));
        }
        Ok(Box::new(move |w| {
            let [u, v] = w.map(|x| scale * x);
            let (sin_theta, cos_theta) = (2.0 * (stretch * (rate * v).tan()).atan()).sin_cos();
            let distance = big + small * cos_theta;
            [distance * u.cos(), distance * u.sin(), small * sin_theta]
        }))
    }),
    exact: true,
};
