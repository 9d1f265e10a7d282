use super::{ShapeFrame, closed};
use crate::surface::digital::Implicit;
use crate::surface::generate::{Form, Parameter, SurfaceKind};

/// The box max(|x| − a, |y| − b, |z| − c) ≤ 0.
pub(in super::super) const BOX: SurfaceKind = SurfaceKind {
    name: "digital-box",
    about: "surfels of the lattice points in a box, |x| ≤ a, |y| ≤ b, |z| ≤ c: a closed sphere",
    parameters: &[
        &[
            Parameter::real("a", 8.0, 1.0, 500.0, "half the side along x, in voxels"),
            Parameter::real("b", 6.0, 1.0, 500.0, "along y"),
            Parameter::real("c", 4.0, 1.0, 500.0, "along z"),
        ],
        super::POSITION,
        super::TILT,
    ],
    form: Form::Whole(|arguments| {
        let half = [arguments.real("a")?, arguments.real("b")?, arguments.real("c")?];
        let cuboid = Cuboid { frame: ShapeFrame::new(arguments, true)?, half };
        closed(arguments, &cuboid, cuboid.frame.bounds(half), 2, "c")
    }),
    exact: false,
};

struct Cuboid {
    frame: ShapeFrame,
    half: [f64; 3],
}

impl Cuboid {
    /// Returns the face of the box on which |x| − a (|y| − b, |z| − c) is largest, as its axis and
    /// sign.
    fn outermost(&self, p: [f64; 3]) -> (usize, f64) {
        let over = |k: usize| p[k].abs() - self.half[k];
        let axis = (1..3).fold(0, |best, k| if over(k) > over(best) { k } else { best });
        (axis, if p[axis] < 0.0 { -1.0 } else { 1.0 })
    }

    fn face_normal(&self, (axis, sign): (usize, f64)) -> [f64; 3] {
        let mut normal = [0.0; 3];
        normal[axis] = sign;
        self.frame.outward(normal)
    }
}

impl Implicit for Cuboid {
    fn value(&self, p: [f64; 3]) -> f64 {
        let p = self.frame.inward(p);
        let (axis, _) = self.outermost(p);
        p[axis].abs() - self.half[axis]
    }

    fn gradient(&self, p: [f64; 3]) -> [f64; 3] {
        self.face_normal(self.outermost(self.frame.inward(p)))
    }

    fn lipschitz(&self) -> f64 {
        1.0
    }

    /// Returns the normal of the face through which the segment from the inner to the outer voxel
    /// leaves the box: near an edge of the box the closest point can lie on a different face.
    fn normal(&self, inner: [f64; 3], outer: [f64; 3]) -> [f64; 3] {
        let [p, q] = [inner, outer].map(|p| self.frame.inward(p));
        let mut first = (f64::INFINITY, self.outermost(q));
        for axis in 0..3 {
            let sign = if q[axis] < 0.0 { -1.0 } else { 1.0 };
            let [from, to] = [p, q].map(|p| sign * p[axis] - self.half[axis]);
            let part = -from / (to - from);
            if to > 0.0 && part < first.0 {
                first = (part, (axis, sign));
            }
        }
        self.face_normal(first.1)
    }
}
