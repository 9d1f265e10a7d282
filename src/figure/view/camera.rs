use super::super::FigureError;
use super::SurfaceView;
use crate::geometry::vector::{add, cross, dot, norm, scale, sub};

/// Where a surface is seen from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// From the surface to the eye, of any length; by default chosen by the surface's normals, see [`SurfaceView`].
    pub towards: Option<[f64; 3]>,
    /// What is upright in the picture; of any length. Where it points to the eye or away from it, the next of y, z, x is.
    pub up: [f64; 3],
    /// Angle in degrees under which the surface's bounding sphere is seen, from 0.1 (nearly parallel) to 90.
    pub field_of_view: f64,
}

impl Default for Camera {
    /// z is up, the direction chosen, 26°: a page at reading distance.
    fn default() -> Camera {
        Camera { towards: None, up: [0.0, 0.0, 1.0], field_of_view: 26.0 }
    }
}

impl Camera {
    /// The default with another axis up.
    pub fn with_up(up: [f64; 3]) -> Camera {
        Camera { up, ..Camera::default() }
    }
}

/// Space → picture: central projection from the eye, at Z = 0, to the plane Z = 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    /// Right, upward, towards the eye: orthonormal.
    pub(super) axes: [[f64; 3]; 3],
    centre: [f64; 3],
    radius: f64,
    /// From the eye to the centre, in radii.
    pub(super) distance: f64,
    /// Whether the side that the faces' normals point to is the outer one.
    pub(super) outward: bool,
}

impl Lens {
    /// The lens for a view whose surface lies in the box from `low` to `high`.
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
        // Nor may they underflow.
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

    /// A point in the picture's plane with its nearness 1/Z, which is affine in the picture along straight lines in space.
    pub(super) fn place(&self, p: [f64; 3]) -> [f64; 3] {
        let p = scale(1.0 / self.radius, sub(p, self.centre));
        let nearness = 1.0 / (self.distance - dot(self.axes[2], p));
        [dot(self.axes[0], p) * nearness, dot(self.axes[1], p) * nearness, nearness]
    }

    /// Of an edge, in radii; as seen at the surface's middle.
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

/// Right, upward, `towards`, for unit vectors.
fn axes(towards: [f64; 3], up: [f64; 3]) -> [[f64; 3]; 3] {
    let candidates = [up, [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
    let right = candidates.map(|up| cross(up, towards));
    let right = right.into_iter().find(|r| norm(*r) > 1e-6).unwrap_or(right[0]);
    let right = scale(1.0 / norm(right), right);
    [right, cross(towards, right), towards]
}

/// 1 for a box that has no height, 0 for one that is no wider than high.
fn flatness(size: [f64; 3], up: [f64; 3]) -> f64 {
    let height: f64 = (0..3).map(|k| up[k].abs() * size[k]).sum();
    let width = (0..3).map(|k| (1.0 - up[k] * up[k]).max(0.0).sqrt() * size[k]).fold(0.0, f64::max);
    if width > height { 1.0 - height / width } else { 0.0 }
}

/// Candidates for the direction to the eye: as many around the upright axis, and these angles above the ground.
const AROUND: usize = 24;
const ABOVE: [f64; 17] =
    [-60.0, -50.0, -40.0, -30.0, -20.0, -10.0, 0.0, 10.0, 20.0, 25.0, 30.0, 35.0, 40.0, 45.0, 50.0, 55.0, 60.0];
/// Three-quarter view: the eye right of −y where z is up, right of z where y is up.
const FAVOURITE: f64 = -57.0;
/// Mean normal of unit normals from which on a surface counts as open: more is seen of one side than of the other.
const OPEN: f64 = 0.3;
/// Angle at which the mean normal of an open surface is seen, in degrees.
const ASLANT: f64 = 40.0;
/// Angle above the ground from which a closed surface is seen, and how much more when it lies flat.
const ELEVATION: f64 = 25.0;
const ELEVATION_FLAT: f64 = 20.0;
/// So many faces represent all when directions are compared.
const ENOUGH: usize = 50_000;

/// Area vectors of some faces and what follows from those of all; lengths in radii.
struct Bulk {
    sample: Vec<[f64; 3]>,
    /// Area of the sample.
    area: f64,
    /// Sum of all area vectors by the total area.
    mean: [f64; 3],
    /// Volume that the faces enclose with the centre, positive where the normals point outward.
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

    /// Open surfaces are seen aslant from the side their normals point to, closed ones from above, where most of them
    /// turns to the eye; among equals from the favourite side.
    fn direction(&self, up: [f64; 3], elevation: f64) -> [f64; 3] {
        // The ground's axes: x stays x where it can.
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

/// ½ Σ p × q over the edges pq of a polygon: its area times its normal, where it is flat.
pub(super) fn area_vector(polygon: impl Iterator<Item = [f64; 3]> + Clone) -> [f64; 3] {
    // From one corner on, for the sake of rounding.
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
