//! Conformal immersions of the unit disc: |X_u| = |X_v| and X_u · X_v = 0 in w = u + iv. Their
//! exact disc coordinates are w itself.

pub(super) mod catenoid;
pub(super) mod cylinder;
pub(super) mod enneper;
pub(super) mod plane;
pub(super) mod pseudosphere;
pub(super) mod sphere;
pub(super) mod torus_patch;

#[cfg(test)]
mod tests;
