use nalgebra::Matrix3;

use super::moments::{Moments, VoxelBall};
use super::whole::on_whole;
use super::{Facets, NormalError, NormalEstimator, outward, rule};
use crate::geometry::vector::{add, dot, scale};
use crate::surface::digital::Surfel;
use crate::surface::parameters::{Arguments, Parameter};

/// Estimates a normal from the covariance of the voxels in a ball around the surfel's centre: the
/// eigenvector of the smallest eigenvalue, on the side away from the mean of the voxels.
///
/// Half a ball has variance `0.059 r²` across its plane and `0.2 r²` along it. Voxels are counted
/// in runs along rows, in integers; only the eigenvector is subject to rounding. The cost is O(nf
/// r²). The ball must not reach through the solid: for a tube of voxels the radius must be less
/// than the tube's.
///
/// Source: Lachaud, Coeurjolly, Levallois, *Robust and convergent curvature and normal estimators
/// with digital integral invariants* (Modern Approaches to Discrete Curvature, LNM 2184, 2017).
/// Their radius `k h^(1/3)` in units of the object is `k L^(2/3)` voxels, that is,
/// `exponent=0.667`. The default was better on ellipsoids and tori of 2000 to 30 000 surfels.
pub(super) struct IntegralInvariant;

const RADIUS: [Parameter; 3] = [rule::radius(), rule::factor(1.7), rule::exponent(0.5)];

/// Smallest radius, in voxels: smaller balls hold too few voxels to determine a direction.
const LEAST_RADIUS: f64 = 2.0;

impl NormalEstimator for IntegralInvariant {
    fn name(&self) -> &'static str {
        "integral-invariant"
    }

    fn about(&self) -> &'static str {
        "the direction in which the voxels of a ball vary least (voxels)"
    }

    fn parameters(&self) -> &'static [Parameter] {
        &RADIUS
    }

    fn estimate(&self, facets: &Facets, arguments: &Arguments) -> Result<Vec<[f64; 3]>, NormalError> {
        on_whole(facets, |facets| {
            let digital = facets.digital.ok_or(NormalError::NotDigital { estimator: self.name() })?;
            let radius = rule::radius_of(facets, arguments, LEAST_RADIUS)?;
            let kinds = [0, 1, 2, 3, 4, 5].map(|kind: u8| VoxelBall::new(kind / 2, kind % 2 == 1, radius));
            let normal = |(surfel, &own): (&Surfel, &[f64; 3])| {
                let ball = &kinds[usize::from(2 * surfel.axis + u8::from(surfel.positive))];
                let moments = ball.moments(&digital.solid, surfel);
                let normal = least(&moments, own);
                let inward = dot(normal, moments.first.map(|s| s as f64)) > 0.0;
                outward(if inward { scale(-1.0, normal) } else { normal }, own)
            };
            Ok(digital.surfels.iter().zip(&facets.normal).map(normal).collect())
        })
    }
}

/// Returns the eigenvector of the smallest eigenvalue of `Σ p pᵀ − (Σ p)(Σ p)ᵀ / Σ 1`.
///
/// If that eigenvalue is multiple (a rod or a single voxel), returns the projection of `own` onto
/// its eigenspace.
fn least(m: &Moments, own: [f64; 3]) -> [f64; 3] {
    // Relative to the largest eigenvalue. The entries are integers except for one division.
    const EQUAL: f64 = 1e-10;
    let [x, y, z] = m.first.map(|s| s as f64);
    let [xx, yy, zz, yz, zx, xy] = m.second.map(|s| s as f64);
    // The ball contains at least the surfel's inner voxel.
    let n = m.count.max(1) as f64;
    let (xy, yz, zx) = (xy - x * y / n, yz - y * z / n, zx - z * x / n);
    let covariance = Matrix3::new(xx - x * x / n, xy, zx, xy, yy - y * y / n, yz, zx, yz, zz - z * z / n);
    let eigen = covariance.symmetric_eigen();
    let vector = |k: usize| -> [f64; 3] { eigen.eigenvectors.column(k).into_owned().into() };
    let bound = eigen.eigenvalues.min() + EQUAL * eigen.eigenvalues.max();
    let mut space = (0..3).filter(|&k| eigen.eigenvalues[k] <= bound).map(vector);
    match (space.next(), space.next(), space.next()) {
        (Some(only), None, _) => only,
        (Some(a), Some(b), None) => add(scale(dot(a, own), a), scale(dot(b, own), b)),
        _ => own,
    }
}
