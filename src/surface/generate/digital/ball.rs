use super::{ShapeFrame, closed};
use crate::geometry::vector::{norm, scale};
use crate::surface::digital::Implicit;
use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// The ball √(x² + y² + z²) ≤ R.
///
/// Rays from the centre cross the boundary of its digitisation once: an inner voxel at v with an
/// outer neighbour at v + n satisfies n · (v + n/2) = (|v + n|² − |v|²)/2 > 0.
pub(in super::super) const BALL: SurfaceKind = SurfaceKind {
    name: "digital-ball",
    about: "surfels of the lattice points in a ball, √(x² + y² + z²) ≤ R: a closed sphere",
    parameters: &[&[Parameter::real("R", 16.0, 1.0, 500.0, "radius, in voxels")], super::POSITION],
    form: Form::Whole(|arguments| {
        let ball = Ball { frame: ShapeFrame::new(arguments, false)?, radius: arguments.real("R")? };
        closed(arguments, &ball, ball.frame.bounds([ball.radius; 3]), 2, "R")
    }),
    exact: false,
};

pub(super) struct Ball {
    pub frame: ShapeFrame,
    pub radius: f64,
}

impl Implicit for Ball {
    fn value(&self, p: [f64; 3]) -> f64 {
        norm(self.frame.inward(p)) - self.radius
    }

    fn gradient(&self, p: [f64; 3]) -> [f64; 3] {
        let p = self.frame.inward(p);
        self.frame.outward(scale(1.0 / norm(p), p))
    }

    fn lipschitz(&self) -> f64 {
        1.0
    }
}
