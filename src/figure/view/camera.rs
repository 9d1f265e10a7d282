use super::super::FigureError;
use super::SurfaceView;
use crate::geometry::vector::{add, cross, dot, norm, scale, sub};

/// The position from which a surface is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Direction from the surface to the eye, of any length; by default it depends on the surface's
    /// normals, see [`SurfaceView`].
    pub towards: Option<[f64; 3]>,
    /// Upright direction in the picture, of any length. If it is parallel to the viewing direction,
    /// the first suitable of y, z, x is used.
    pub up: [f64; 3],
    /// Angle in degrees under which the bounding sphere is seen, from 0.1 (nearly parallel) to 90.
    pub field_of_view: f64,
}

impl Default for Camera {
    /// The axis z is up, the direction is chosen automatically, and the angle is 26°, that of a
    /// page at reading distance.
    fn default() -> Camera {
        Camera { towards: None, up: [0.0, 0.0, 1.0], field_of_view: 26.0 }
    }
}

impl Camera {
    /// Returns the default with another upright axis.
    pub fn with_up(up: [f64; 3]) -> Camera {
        Camera { up, ..Camera::default() }
    }
}

/// The central projection from space to the picture plane Z = 1, with the eye at Z = 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    /// Orthonormal axes: right, upward, towards the eye.
    pub(super) axes: [[f64; 3]; 3],
    centre: [f64; 3],
    radius: f64,
    /// Distance from the eye to the centre, in radii.
    pub(super) distance: f64,
    /// Whether the faces' normals point to the outer side.
    pub(super) outward: bool,
}

impl Lens {
    /// Makes the projection of a view whose surface lies in the box from `low` to `high`.
    pub(super) fn of(view: &SurfaceView, low: [f64; 3], high: [f64; 3]) -> Result<Lens, FigureError> {
        let camera = &view.camera;
        let angle = camera.field_of_view;
        if !(0.1..=90.0).contains(&angle) {
            return Err(FigureError::FieldOfView { angle });
        }
        let up = direction("up", camera.up)?;
        let towards = camera.towards.map(|d| direction("towards", d)).transpose()?;
        let centre = add(scale(0.5, low), scale(0.5, high));
        let size = sub(high, low);
        let largest = size.into_iter().fold(0.0, f64::max);
        // Squares of the extent must not overflow.
        if largest > 1e150 {
            return Err(FigureError::SurfaceExtent { size });
        }
        // Nor underflow.
        if largest < 1e-150 {
            return Err(FigureError::NoSurfaceExtent { at: low });
        }
        let used = || view.faces.corners().iter().map(|v| view.positions[*v as usize]);
        let radius = used().map(|p| norm(sub(p, centre))).fold(0.0, f64::max);
        let bulk = Bulk::of(view, centre, radius);
        let flat = flatness(size, up);
        let towards = towards.unwrap_or_else(|| bulk.direction(up, ELEVATION + ELEVATION_FLAT * flat));
        Ok(Lens {
            axes: axes(towards, up),
            centre,
            radius,
            distance: 1.0 / (angle / 2.0).to_radians().sin(),
            outward: bulk.is_open() || bulk.volume >= 0.0,
        })
    }

    /// Projects a point; the third coordinate is its nearness 1/Z, which is affine in the picture
    /// along straight lines in space.
    pub(super) fn place(&self, p: [f64; 3]) -> [f64; 3] {
        let p = scale(1.0 / self.radius, sub(p, self.centre));
        let nearness = 1.0 / (self.distance - dot(self.axes[2], p));
        [dot(self.axes[0], p) * nearness, dot(self.axes[1], p) * nearness, nearness]
    }

    /// The length of an edge in radii.
    pub(super) fn length(&self, [a, b]: [[f64; 3]; 2]) -> f64 {
        norm(scale(1.0 / self.radius, sub(b, a)))
    }
}

fn direction(name: &'static str, vector: [f64; 3]) -> Result<[f64; 3], FigureError> {
    let length = norm(vector);
    if !length.is_normal() {
        return Err(FigureError::Direction { name, vector });
    }
    Ok(scale(1.0 / length, vector))
}

/// The axes right, upward and `towards`, given unit vectors.
fn axes(towards: [f64; 3], up: [f64; 3]) -> [[f64; 3]; 3] {
    let candidates = [up, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    let right = candidates.map(|up| cross(up, towards));
    let right = right.into_iter().find(|r| norm(*r) > 1e-6).unwrap_or(right[0]);
    let right = scale(1.0 / norm(right), right);
    [right, cross(towards, right), towards]
}

/// The flatness of a box: 1 if it has no height, 0 if it is not wider than high.
fn flatness(size: [f64; 3], up: [f64; 3]) -> f64 {
    let height: f64 = (0..3).map(|k| up[k].abs() * size[k]).sum();
    let width = (0..3).map(|k| (1.0 - up[k] * up[k]).max(0.0).sqrt() * size[k]).fold(0.0, f64::max);
    if width > height { 1.0 - height / width } else { 0.0 }
}

/// Candidates for the direction to the eye: number of directions around the upright axis, and
/// angles above the ground.
const AROUND: usize = 24;
const ABOVE: [f64; 17] =
    [-60.0, -50.0, -40.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0];
/// Preferred angle for a three-quarter view: the eye is to the right of −y if z is up, to the right
/// of z if y is up.
const FAVOURITE: f64 = -57.0;
/// A surface counts as open if the length of its mean unit normal exceeds this.
const OPEN: f64 = 0.3;
/// Angle in degrees between the view and the mean normal of an open surface.
const ASLANT: f64 = 40.0;
/// Angle above the ground from which a closed surface is seen, and the additional angle if it is
/// flat.
const ELEVATION: f64 = 25.0;
const ELEVATION_FLAT: f64 = 20.0;
/// Number of faces that are sampled to compare directions.
const ENOUGH: usize = 50_000;

/// A sample of area vectors and quantities computed from all of them; lengths in radii.
struct Bulk {
    sample: Vec<[f64; 3]>,
    /// Area of the sample.
    area: f64,
    /// Sum of all area vectors divided by the total area.
    mean: [f64; 3],
    /// The volume between the faces and the centre, positive if the normals point outward.
    volume: f64,
}

impl Bulk {
    fn of(view: &SurfaceView, centre: [f64; 3], radius: f64) -> Bulk {
        let stride = view.faces.len().div_ceil(ENOUGH).max(1);
        let mut bulk = Bulk { sample: Vec::new(), area: 0.0, mean: [0.0; 3], volume: 0.0 };
        let mut total = 0.0;
        for (f, polygon) in view.faces.iter().enumerate() {
            let at = |v: u32| scale(1.0 / radius, sub(view.positions[v as usize], centre));
            let area = area_vector(polygon.iter().map(|v| at(*v)));
            let size = norm(area);
            bulk.mean = add(bulk.mean, area);
            total += size;
            bulk.volume += polygon.first().map_or(0.0, |v| dot(at(*v), area)) / 3.0;
            if f % stride == 0 {
                bulk.area += size;
                bulk.sample.push(area);
            }
        }
        bulk.mean = if total > 0.0 { scale(1.0 / total, bulk.mean) } else { bulk.mean };
        bulk
    }

    fn is_open(&self) -> bool {
        norm(self.mean) > OPEN
    }

    /// Chooses the direction to the eye.
    ///
    /// Open surfaces are seen at an angle from the side to which their normals point. Closed ones
    /// are seen from above, where most of their area faces the eye. Ties are resolved by the
    /// preferred angle.
    fn direction(&self, up: [f64; 3], elevation: f64) -> [f64; 3] {
        // The axes of the ground; x remains x if possible.
        let first = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|e| sub(e, scale(dot(e, up), up)));
        let first = if norm(first[0]) > 0.1 { first[0] } else { first[1] };
        let first = scale(1.0 / norm(first), first);
        let second = cross(up, first);
        let mut best = (f64::NEG_INFINITY, up);
        for k in 0..AROUND {
            let turn = 360.0 * k as f64 / AROUND as f64;
            let (sin, cos) = (FAVOURITE + turn).to_radians().sin_cos();
            let level = add(scale(cos, first), scale(sin, second));
            for above in ABOVE {
                let (sin, cos) = above.to_radians().sin_cos();
                let towards = add(scale(cos, level), scale(sin, up));
                let favour = turn.to_radians().cos();
                let score = if self.is_open() {
                    self.aslant(towards, above - elevation)
                } else {
                    self.turned(towards, above - elevation)
                };
                if score + 0.05 * favour > best.0 {
                    best = (score + 0.05 * favour, towards);
                }
            }
        }
        best.1
    }

    fn aslant(&self, towards: [f64; 3], higher: f64) -> f64 {
        let angle = (dot(self.mean, towards) / norm(self.mean)).clamp(-1.0, 1.0).acos().to_degrees();
        -((angle - ASLANT) / 10.0).powi(2) - (higher / 40.0).powi(2)
    }

    fn turned(&self, towards: [f64; 3], higher: f64) -> f64 {
        let front = self.sample.iter().map(|a| dot(*a, towards).max(0.0)).sum::<f64>();
        let inward = if self.volume < 0.0 { -1.0 } else { 1.0 };
        let seen = if self.area > 0.0 { front / self.area } else { 0.0 };
        seen + inward * dot(self.mean, towards) / 2.0 - (higher / 20.0).powi(2)
    }
}

/// The area vector ½ Σ p × q over the edges pq of a polygon: area times normal if it is flat.
pub(super) fn area_vector(polygon: impl Iterator<Item = [f64; 3]> + Clone) -> [f64; 3] {
    // Relative to one corner, to reduce rounding.
    let Some(first) = polygon.clone().next() else { return [0.0; 3] };
    let mut corners = polygon.map(|p| sub(p, first));
    let mut last = corners.next().unwrap_or_default();
    let mut sum = [0.0; 3];
    for p in corners {
        sum = add(sum, cross(last, p));
        last = p;
    }
    scale(0.5, sum)
}
