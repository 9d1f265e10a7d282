use super::Frame;
use super::ball::Ball;
use crate::geometry::vector::norm;
use crate::surface::digital::{Adjacency, Solid, Surfel, digitise, exact_normals, part};
use crate::surface::generate::{Arguments, Form, GenerateError, Generated, Parameter, Row};

/// The part of a digitised ball's boundary above a plane between two layers of voxels: an open disc, as each ray from the
/// centre crosses the boundary once. The flat bottom is no part of it.
///
/// Exact coordinates: the radial projection of a pointel onto the sphere, projected from the south pole and scaled,
///
/// ```text
/// w = (x + iy)/(|p| + z) / tan(Θ/2),    p = (x, y, z) from the centre
/// ```
///
/// where Θ is the polar angle of the circle in which the plane cuts the sphere. This circle is |w| = 1; pointels of the boundary
/// are on it but for O(1/R). Seen from outside, w keeps the orientation.
pub(in super::super) const CAP: Row = Row {
    name: "digital-cap",
    about: "surfels of the lattice points in a ball above a lattice plane: a disc; exact map: stereographic, rim at |w| = 1 + O(1/R)",
    parameters: &[
        &[
            Parameter::real("R", 16.0, 2.0, 500.0, "radius, in voxels"),
            Parameter::real(
                "angle",
                60.0,
                5.0,
                150.0,
                "from the pole to the rim, in degrees; the nearest lattice plane is taken",
            ),
        ],
        super::POSITION,
    ],
    form: Form::Whole(cap),
    exact: true,
};

fn cap(arguments: &Arguments) -> Result<Generated, GenerateError> {
    let ball = Ball { frame: Frame::new(arguments, false)?, radius: arguments.real("R")? };
    let solid = digitise(&ball, ball.frame.bounds([ball.radius; 3]))?;
    let wanted = ball.frame.centre[2] + ball.radius * arguments.real("angle")?.to_radians().cos();
    // planes are at half-integers; one layer of voxels at least
    let plane = (wanted.floor() + 0.5).min(top(&solid) - 0.5);
    let lowest = (plane - solid.origin()[2]).ceil() as i32;
    let above = |surfel: &Surfel| {
        // a surfel that looks down from the lowest layer lies in the plane
        surfel.voxel[2] > lowest || (surfel.voxel[2] == lowest && (surfel.axis != 2 || surfel.positive))
    };
    let (surface, mut digital) = part(solid, Adjacency::default(), 0, above)?;
    digital.exact_normals = Some(exact_normals(&ball, &digital));
    let cos = (plane - ball.frame.centre[2]) / ball.radius;
    // 1/tan(Θ/2)
    let scale = ((1.0 + cos) / (1.0 - cos)).sqrt();
    let stereographic = |&p: &[f64; 3]| {
        let [x, y, z] = ball.frame.inward(p);
        let below_pole = norm([x, y, z]) + z;
        [scale * x / below_pole, scale * y / below_pole]
    };
    let exact = surface.positions.iter().map(stereographic).collect();
    Ok(Generated { surface, exact: Some(exact), period: None, digital: Some(digital), name: String::new() })
}

/// Height of the highest voxels.
fn top(solid: &Solid) -> f64 {
    let [_, height, depth] = solid.size();
    let full = |&k: &usize| (0..height).any(|j| solid.row(j, k).iter().any(|&word| word != 0));
    let k = (0..depth).rev().find(full).unwrap_or(0);
    solid.origin()[2] + k as f64
}
