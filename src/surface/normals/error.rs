use super::NormalSpecError;
use crate::surface::parameters::ParameterError;

/// The normals of a surface cannot be estimated.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NormalError {
    /// The specification names no estimator.
    #[error(transparent)]
    Spec(#[from] NormalSpecError),
    /// An estimator used a parameter that it does not declare.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A face has no area and hence no direction.
    #[error("face {face} has no area, hence no normal: remove it")]
    NoArea {
        /// Index of the face.
        face: usize,
    },
    /// The surfels do not belong to the faces.
    #[error("{faces} faces, but {surfels} surfels: they belong to different surfaces")]
    OtherSurfels {
        /// Number of faces.
        faces: usize,
        /// Number of surfels.
        surfels: usize,
    },
    /// The estimator needs voxels and the surface has none.
    #[error("the normal estimator `{estimator}` needs voxels, and this surface is a mesh without voxels")]
    NotDigital {
        /// Name of the estimator.
        estimator: &'static str,
    },
    /// Exact normals are not known for this surface.
    #[error("exact normals are known only for generated digital shapes ({known}), not for this surface")]
    NotExact {
        /// Names of the generated digital shapes.
        known: String,
    },
    /// The input file gives no normals.
    #[error("the input gives no normals for all faces")]
    NotGiven,
}
