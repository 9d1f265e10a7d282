use super::{Digital, DigitalError, Solid, Surfel, words_per_row};
use crate::geometry::vector::{add, dot, norm, scale, sub};

/// A solid {f ≤ 0} in R³, where f is differentiable near the surface {f = 0} and ∇f ≠ 0 on it.
pub trait Implicit {
    /// Returns f(p).
    fn value(&self, p: [f64; 3]) -> f64;

    /// Returns ∇f(p).
    fn gradient(&self, p: [f64; 3]) -> [f64; 3];

    /// Returns a Lipschitz constant L of f: |f(p) − f(q)| ≤ L |p − q| for all p, q.
    ///
    /// With a finite L, voxels that are certainly far from the surface are skipped during
    /// digitisation. With the default ∞, f is evaluated at every voxel.
    fn lipschitz(&self) -> f64 {
        f64::INFINITY
    }

    /// Returns the outward unit normal of the surface between an inner and an outer voxel, given
    /// their centres: ∇f/|∇f| at the point of the surface that is closest to the midpoint.
    fn normal(&self, inner: [f64; 3], outer: [f64; 3]) -> [f64; 3] {
        let halfway = scale(0.5, add(inner, outer));
        let gradient = self.gradient(closest(self, halfway));
        scale(1.0 / norm(gradient), gradient)
    }
}

/// Returns the point of {f = 0} closest to `p`; its distance must be below the radii of curvature.
///
/// Newton steps along ∇f onto the surface alternate with steps toward `p` in the tangent plane.
/// Each iteration reduces the error by the factor distance × curvature.
fn closest(shape: &(impl Implicit + ?Sized), p: [f64; 3]) -> [f64; 3] {
    const MOST_STEPS: usize = 200;
    let mut q = p;
    for _ in 0..MOST_STEPS {
        let gradient = shape.gradient(q);
        let square = dot(gradient, gradient);
        let off = sub(p, q);
        // The tangential part of p − q, and a Newton step back onto the surface.
        let along = dot(off, gradient) / square;
        let step = sub(sub(off, scale(along, gradient)), scale(shape.value(q) / square, gradient));
        // Where the gradient vanishes this is 0/0; the current point is then the best one known.
        if !step.iter().all(|x| x.is_finite()) {
            break;
        }
        q = add(q, step);
        if norm(step) <= 4.0 * f64::EPSILON * norm(q).max(1.0) {
            break;
        }
    }
    q
}

/// Gauss digitisation: the points of Z³ with f ≤ 0 in the box `bounds` (lower and upper corner,
/// inclusive).
///
/// The origin of the [`Solid`] is the lowest lattice point of the box, so its coordinates are those
/// of f. The box should include a layer of voxels around the shape, because everything outside of
/// the box counts as outside of the solid.
///
/// ```
/// use riemap::surface::digital::{Adjacency, Implicit, boundary, digitise, exact_normals};
///
/// /// x⁴ + y⁴ + z⁴ ≤ r⁴
/// struct Rounded(f64);
///
/// impl Implicit for Rounded {
///     fn value(&self, p: [f64; 3]) -> f64 {
///         p.iter().map(|x| x.powi(4)).sum::<f64>() - self.0.powi(4)
///     }
///     fn gradient(&self, p: [f64; 3]) -> [f64; 3] {
///         p.map(|x| 4.0 * x.powi(3))
///     }
/// }
///
/// let shape = Rounded(10.2);
/// let solid = digitise(&shape, [[-11.0; 3], [11.0; 3]])?;
/// let (surface, mut digital) = boundary(solid, Adjacency::Six, 0)?;
/// digital.exact_normals = Some(exact_normals(&shape, &digital));
/// assert_eq!(surface.faces().len(), digital.surfels.len());
/// # Ok::<(), riemap::surface::digital::DigitalError>(())
/// ```
///
/// # Errors
/// [`DigitalError::Bounds`] if the bounds are not a box; [`DigitalError::TooLarge`] if it has more
/// than [`DigitalError::MOST_VOXELS`] voxels.
pub fn digitise(shape: &dyn Implicit, bounds: [[f64; 3]; 2]) -> Result<Solid, DigitalError> {
    let mut size = [0; 3];
    for axis in 0..3 {
        let [low, high] = [bounds[0][axis].ceil(), bounds[1][axis].floor()];
        // Coordinates must stay in the range in which double precision represents all integers.
        if !(low.abs().max(high.abs()) < 1e15 && bounds[0][axis] <= bounds[1][axis]) {
            return Err(DigitalError::Bounds { axis, bounds: [bounds[0][axis], bounds[1][axis]] });
        }
        size[axis] = (high - low + 1.0).max(0.0) as usize;
    }
    let padded =
        (64 * words_per_row(size[0]) as u64).checked_mul(size[1] as u64).and_then(|n| n.checked_mul(size[2] as u64));
    if padded.is_none_or(|n| n > DigitalError::MOST_VOXELS) || size.iter().any(|&n| n > i32::MAX as usize) {
        return Err(DigitalError::TooLarge { size });
    }
    let origin = bounds[0].map(f64::ceil);
    let mut solid = Solid::empty(size, origin);
    // Slightly less than the distance that f guarantees, to allow for its rounding.
    let per_value = (1.0 - 1e-9) / shape.lipschitz();
    for k in 0..size[2] {
        for j in 0..size[1] {
            let mut i = 0;
            while i < size[0] {
                let value = shape.value([origin[0] + i as f64, origin[1] + j as f64, origin[2] + k as f64]);
                // The sign of f is the same up to this voxel, exclusive.
                let next = i + ((value.abs() * per_value) as usize).clamp(1, size[0]);
                if value <= 0.0 {
                    solid.insert_run(i..next, j, k);
                }
                i = next;
            }
        }
    }
    Ok(solid)
}

/// Returns the outward unit normal of the shape at every surfel of its digitisation (`nf × 3`), by
/// [`Implicit::normal`].
pub fn exact_normals(shape: &dyn Implicit, digital: &Digital) -> Vec<[f64; 3]> {
    let normal = |surfel: &Surfel| {
        let inner = digital.solid.centre(surfel.voxel);
        shape.normal(inner, add(inner, surfel.normal()))
    };
    digital.surfels.iter().map(normal).collect()
}
