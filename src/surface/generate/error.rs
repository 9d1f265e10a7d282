use crate::surface::parameters::ParameterError;

/// A surface cannot be generated from a name.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GenerateError {
    /// No kind of surface has this name.
    #[error("`{name}` is neither a file nor a generated surface; known surfaces: {known}")]
    UnknownSurface {
        /// The name that was requested.
        name: String,
        /// All known names.
        known: String,
    },
    /// The parameters are wrong.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// The Delaunay triangulation omitted points or is not a disc.
    #[error("the Delaunay triangulation of {points} points has {found} faces instead of {expected}; try another seed")]
    Triangulation {
        /// Number of points.
        points: usize,
        /// Expected number of faces: 2 points − 2 − boundary points.
        expected: usize,
        /// Number of faces of positive area.
        found: usize,
    },
    /// The digitised shape does not have the requested surface.
    #[error(transparent)]
    Digital(#[from] crate::surface::digital::DigitalError),
}
