use super::{ShapeFrame, closed};
use crate::geometry::vector::norm;
use crate::surface::digital::Implicit;
use crate::surface::generate::{Arguments, Form, GenerateError, Generated, Parameter, SurfaceKind};

/// The ellipsoid √((x/a)² + (y/b)² + (z/c)²) ≤ 1.
pub(in super::super) const ELLIPSOID: SurfaceKind = SurfaceKind {
    name: "digital-ellipsoid",
    about: "surfels of the lattice points in an ellipsoid, (x/a)² + (y/b)² + (z/c)² ≤ 1: a closed sphere",
    parameters: &[
        &[
            Parameter::real("a", 16.0, 2.0, 500.0, "half axis along x, in voxels; largest ≤ smallest² / 1.5"),
            Parameter::real("b", 12.0, 2.0, 500.0, "along y"),
            Parameter::real("c", 8.0, 2.0, 500.0, "along z"),
        ],
        super::POSITION,
        super::TILT,
    ],
    form: Form::Whole(ellipsoid),
    exact: false,
};

/// Smallest radius of curvature, in voxels. The surface is at most half a voxel from the centre of
/// a surfel, so the closest point is unique and each iteration of its search at least halves the
/// error.
const SHARPEST: f64 = 1.5;

struct Ellipsoid {
    frame: ShapeFrame,
    half: [f64; 3],
}

impl Implicit for Ellipsoid {
    fn value(&self, p: [f64; 3]) -> f64 {
        let p = self.frame.inward(p);
        norm([0, 1, 2].map(|k| p[k] / self.half[k])) - 1.0
    }

    fn gradient(&self, p: [f64; 3]) -> [f64; 3] {
        let p = self.frame.inward(p);
        let length = norm([0, 1, 2].map(|k| p[k] / self.half[k]));
        self.frame.outward([0, 1, 2].map(|k| p[k] / (self.half[k] * self.half[k] * length)))
    }

    fn lipschitz(&self) -> f64 {
        1.0 / self.half.into_iter().fold(f64::INFINITY, f64::min)
    }
}

fn ellipsoid(arguments: &Arguments) -> Result<Generated, GenerateError> {
    let names = ["a", "b", "c"];
    let half = [arguments.real(names[0])?, arguments.real(names[1])?, arguments.real(names[2])?];
    let largest = half.into_iter().fold(0.0, f64::max);
    for (name, half) in names.into_iter().zip(half) {
        let least = (SHARPEST * largest).sqrt();
        if half < least {
            return Err(arguments.out_of_range(
                name,
                format!(" with a half axis of {largest}"),
                format!("at least {least}"),
            ));
        }
    }
    let frame = ShapeFrame::new(arguments, true)?;
    let bounds = frame.bounds(half);
    closed(arguments, &Ellipsoid { frame, half }, bounds, 2, "c")
}
