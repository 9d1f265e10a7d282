use super::{ShapeFrame, closed};
use crate::surface::digital::Implicit;
use crate::surface::generate::{Arguments, Form, GenerateError, Generated, Parameter, SurfaceKind};

/// The torus √((√(x² + y²) − R)² + z²) ≤ r, with τ = i r/√(R² − r²).
pub(in super::super) const TORUS: SurfaceKind = SurfaceKind {
    name: "digital-torus",
    about: "surfels of the lattice points in a torus, √((√(x² + y²) − R)² + z²) ≤ r; τ = i r/√(R² − r²)",
    parameters: &[
        &[
            Parameter::real("R", 8.0, 2.0, 500.0, "radius to the middle of the tube, in voxels"),
            Parameter::real("r", 3.2, 0.1, 300.0, "radius of the tube, at most R − 1"),
        ],
        super::POSITION,
        super::TILT,
    ],
    form: Form::Whole(torus),
    exact: true,
};

struct Torus {
    frame: ShapeFrame,
    big: f64,
    small: f64,
}

impl Implicit for Torus {
    fn value(&self, p: [f64; 3]) -> f64 {
        let [x, y, z] = self.frame.inward(p);
        (x.hypot(y) - self.big).hypot(z) - self.small
    }

    fn gradient(&self, p: [f64; 3]) -> [f64; 3] {
        let [x, y, z] = self.frame.inward(p);
        let from_axis = x.hypot(y);
        let across = from_axis - self.big;
        let distance = across.hypot(z);
        let radial = across / (distance * from_axis);
        self.frame.outward([radial * x, radial * y, z / distance])
    }

    fn lipschitz(&self) -> f64 {
        1.0
    }
}

fn torus(arguments: &Arguments) -> Result<Generated, GenerateError> {
    let (big, small) = (arguments.real("R")?, arguments.real("r")?);
    if small > big - 1.0 {
        return Err(arguments.out_of_range("r", format!(" with R={big}"), format!("at most {}", big - 1.0)));
    }
    let frame = ShapeFrame::new(arguments, true)?;
    let bounds = frame.bounds([big + small, big + small, small]);
    let generated = closed(arguments, &Torus { frame, big, small }, bounds, 0, "r")?;
    Ok(Generated { period: Some([0.0, small / (big * big - small * small).sqrt()]), ..generated })
}
