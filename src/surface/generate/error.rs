use crate::surface::parameters::ParameterError;

/// Why a name does not give a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// No row of that name.
    #[error("`{name}` is neither a file nor a generated surface; known surfaces: {known}")]
    UnknownSurface {
        /// What was asked for.
        name: String,
        /// All names.
        known: String,
    },
    /// Something is wrong with the parameters.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The Delaunay triangulation left points out or is not a disc.
    #[error("the Delaunay triangulation of {points} points has {found} faces instead of {expected}; try another seed")]
    Triangulation {
        /// Number of points.
        points: usize,
        /// 2 points − 2 − boundary points.
        expected: usize,
        /// Faces of positive area.
        found: usize,
    },
    /// A digitised shape without the surface that was asked for.
    #[error(transparent)]
    Digital(#[from] crate::surface::digital::DigitalError),
}
