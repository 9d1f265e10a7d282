use super::{Arguments, GenerateError};
use crate::geometry::vector::{dot, sub};

/// The rigid motion between lattice coordinates and the shape's own: a rotation about (2, 1, 0)/√5
/// and a translation.
pub(super) struct ShapeFrame {
    pub centre: [f64; 3],
    /// The shape's axes in lattice coordinates.
    axes: [[f64; 3]; 3],
}

impl ShapeFrame {
    /// Reads the parameters [`POSITION`](super::POSITION) and, if `tilted`, [`TILT`](super::TILT).
    pub(super) fn new(arguments: &Arguments, tilted: bool) -> Result<Self, GenerateError> {
        let centre = [arguments.real("x")?, arguments.real("y")?, arguments.real("z")?];
        let tilt = if tilted { arguments.real("tilt")? } else { 0.0 };
        let (sin, cos) = tilt.to_radians().sin_cos();
        let root = 5.0_f64.sqrt();
        let [a, b] = [2.0 / root, 1.0 / root];
        // Rodrigues' formula for the axis (a, b, 0)
        let axes = if tilt == 0.0 {
            [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]
        } else {
            let versine = 1.0 - cos;
            [
                [cos + a * a * versine, a * b * versine, -b * sin],
                [a * b * versine, cos + b * b * versine, a * sin],
                [b * sin, -a * sin, cos],
            ]
        };
        Ok(ShapeFrame { centre, axes })
    }

    /// Transforms a point to the shape's coordinates.
    pub(super) fn inward(&self, p: [f64; 3]) -> [f64; 3] {
        let p = sub(p, self.centre);
        self.axes.map(|axis| dot(axis, p))
    }

    /// Transforms a vector to lattice coordinates.
    pub(super) fn outward(&self, v: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| (0..3).map(|axis| v[axis] * self.axes[axis][k]).sum())
    }

    /// Returns a box that contains a shape within ± `reach` in its own coordinates and a layer of
    /// voxels around it.
    pub(super) fn bounds(&self, reach: [f64; 3]) -> [[f64; 3]; 2] {
        let extent = [0, 1, 2].map(|k| (0..3).map(|axis| reach[axis] * self.axes[axis][k].abs()).sum::<f64>() + 1.0);
        [
            [0, 1, 2].map(|k| (self.centre[k] - extent[k]).floor()),
            [0, 1, 2].map(|k| (self.centre[k] + extent[k]).ceil()),
        ]
    }
}
