use super::plane::polynomial;
use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// The plane image w + c w² rolled onto a cylinder. It is isometric to the plane image, so the
/// minima A = L = H = 0 are attained.
pub(in super::super) const CYLINDER: SurfaceKind = SurfaceKind {
    name: "cylinder",
    about: "x + iy = w + c w² rolled up: (ρ sin(x/ρ), y, ρ (1 − cos(x/ρ))); developable",
    parameters: &[
        SurfaceKind::CELLS,
        &[
            Parameter::real("c", 0.25, -0.49, 0.49, "coefficient of w²"),
            // The image is at most 2.3 wide: with ρ ≥ 1/2 it does not wrap around to itself.
            Parameter::real("radius", 0.75, 0.5, 1e3, "radius ρ of the cylinder"),
        ],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let (c, radius) = (arguments.real("c")?, arguments.real("radius")?);
        Ok(Box::new(move |w| {
            let [x, y] = polynomial(w, c, 2);
            let half = (0.5 * x / radius).sin();
            [radius * (x / radius).sin(), y, 2.0 * radius * half * half]
        }))
    }),
    exact: true,
};
