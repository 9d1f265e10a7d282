//! Digitised shapes: the boundaries of the sets of lattice points in a solid {f ≤ 0} (Gauss
//! digitisation). The lattice is Z³, voxels have side 1, and the parameters x, y, z move the shape
//! relative to the lattice.

mod ball;
mod cap;
mod cuboid;
mod ellipsoid;
mod frame;
mod torus;

pub(super) use ball::BALL;
pub(super) use cap::CAP;
pub(super) use cuboid::BOX;
pub(super) use ellipsoid::ELLIPSOID;
pub(super) use torus::TORUS;

use super::{Arguments, GenerateError, Generated, Parameter};
use crate::surface::digital::{Adjacency, DigitalError, Implicit, boundary, digitise, exact_normals};
use frame::ShapeFrame;

/// Parameters of the position of the shape's centre.
const POSITION: &[Parameter] = &[
    Parameter::real("x", 0.0, -1.0, 1.0, "centre of the shape; voxels have theirs at whole numbers"),
    Parameter::real("y", 0.0, -1.0, 1.0, "the same"),
    Parameter::real("z", 0.0, -1.0, 1.0, "the same"),
];

/// Parameter of the rotation of the shape.
const TILT: &[Parameter] = &[Parameter::real(
    "tilt",
    0.0,
    -180.0,
    180.0,
    "degrees about (2, 1, 0), by which the shape's z axis leaves that of the lattice",
)];

/// Returns the closed digital surface of a shape.
///
/// If its Euler characteristic is not `euler`, the voxels are too coarse for the shape; the error
/// then blames `parameter`.
fn closed(
    arguments: &Arguments,
    shape: &dyn Implicit,
    bounds: [[f64; 3]; 2],
    euler: i64,
    parameter: &'static str,
) -> Result<Generated, GenerateError> {
    let too_thin = |what: String| {
        let range = "a shape that is thick enough for voxels of side 1".to_string();
        arguments.out_of_range(parameter, format!(" here: {what}"), range)
    };
    let (surface, mut digital) = match boundary(digitise(shape, bounds)?, Adjacency::default(), 0) {
        Err(DigitalError::Empty { .. }) => return Err(too_thin("it holds no lattice point".to_string())),
        other => other?,
    };
    // Quads have E = 2F.
    let found = surface.positions.len() as i64 - surface.faces.len() as i64;
    if found != euler {
        let genus = |euler: i64| 1 - euler / 2;
        return Err(too_thin(format!("its voxels have a surface of genus {}, not {}", genus(found), genus(euler))));
    }
    digital.exact_normals = Some(exact_normals(shape, &digital));
    Ok(Generated { surface, exact: None, period: None, digital: Some(digital), name: String::new() })
}
