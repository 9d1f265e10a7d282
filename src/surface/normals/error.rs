use super::NormalSpecError;
use crate::surface::parameters::ParameterError;

/// No normals.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NormalError {
    /// The text names no estimator.
    #[error(transparent)]
    Spec(#[from] NormalSpecError),
    /// An estimator's own mistake.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A face that has no direction.
    #[error("face {face} has no area, hence no normal: remove it")]
    NoArea {
        /// Index of the face.
        face: usize,
    },
    /// Surfels that are not those of the faces.
    #[error("{faces} faces, but {surfels} surfels: they belong to different surfaces")]
    OtherSurfels {
        /// Number of faces.
        faces: usize,
        /// Number of surfels.
        surfels: usize,
    },
    /// An estimator that looks at voxels.
    #[error("normals by `{estimator}` are made of voxels, and this surface is a mesh without them")]
    NotDigital {
        /// Its name.
        estimator: &'static str,
    },
    /// Exact normals of a shape that is not known.
    #[error("exact normals are known for generated digital shapes alone ({known}), not for this surface")]
    NotExact {
        /// Names of generated digital shapes.
        known: String,
    },
    /// Normals of the file, which has none.
    #[error("the input gives no normals for all faces")]
    NotGiven,
}
