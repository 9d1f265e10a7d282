use super::ShapeFrame;
use super::ball::Ball;
use crate::geometry::vector::norm;
use crate::surface::digital::{Adjacency, Solid, Surfel, digitise, exact_normals, part};
use crate::surface::generate::{Arguments, Form, GenerateError, Generated, Parameter, SurfaceKind};

/// The part of a digitised ball's boundary above a plane between two layers of voxels.
///
/// It is an open disc, because each ray from the centre crosses the boundary once. The flat bottom
/// does not belong to it. The exact coordinates are the stereographic projection from the south
/// pole of the radial projection of a pointel onto the sphere, scaled:
///
/// ```text
/// w = (x + iy)/(|p| + z) / tan(Θ/2),    p = (x, y, z) from the centre
/// ```
///
/// Here Θ is the polar angle of the circle in which the plane cuts the sphere. This circle is |w| =
/// 1, and boundary pointels lie on it up to O(1/R). Seen from outside, w preserves orientation.
pub(in super::super) const CAP: SurfaceKind = SurfaceKind {
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
    let ball = Ball { frame: ShapeFrame::new(arguments, false)?, radius: arguments.real("R")? };
    let solid = digitise(&ball, ball.frame.bounds([ball.radius; 3]))?;
    let wanted = ball.frame.centre[2] + ball.radius * arguments.real("angle")?.to_radians().cos();
    // Planes are at half-integers; at least one layer of voxels lies above.
    let plane = (wanted.floor() + 0.5).min(top(&solid) - 0.5);
    let lowest = (plane - solid.origin()[2]).ceil() as i32;
    let above = |surfel: &Surfel| {
        // A surfel of the lowest layer that faces down lies in the plane.
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

/// The z coordinate of the highest layer of voxels.
fn top(solid: &Solid) -> f64 {
    let [_, height, depth] = solid.size();
    let full = |&k: &usize| (0..height).any(|j| solid.row(j, k).iter().any(|&word| word != 0));
    let k = (0..depth).rev().find(full).unwrap_or(0);
    solid.origin()[2] + k as f64
}
