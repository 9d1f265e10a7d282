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
    /// The kind has no such parameter.
    #[error("{surface} has no parameter `{parameter}`; known: {known}")]
    UnknownParameter {
        /// Kind of surface.
        surface: &'static str,
        /// What was asked for.
        parameter: String,
        /// Its parameters with their defaults.
        known: String,
    },
    /// A part between `&`s that is not `parameter=value`.
    #[error("{surface}: `{text}` is not of the form parameter=value; parameters: {known}")]
    NotAPair {
        /// Kind of surface.
        surface: &'static str,
        /// The part.
        text: String,
        /// Its parameters with their defaults.
        known: String,
    },
    /// A parameter that stands twice.
    #[error("{surface}: parameter `{parameter}` is given twice")]
    Repeated {
        /// Kind of surface.
        surface: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
    /// Not a number of the right kind.
    #[error("{surface}: {parameter}={value}: `{value}` is not a {expected}; allowed: {range}")]
    Malformed {
        /// Kind of surface.
        surface: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// What was given.
        value: String,
        /// "whole number" or "number".
        expected: &'static str,
        /// Allowed values.
        range: String,
    },
    /// A number outside of the parameter's range, or a word that is not among its choices.
    #[error("{surface}: {parameter}={value} is not allowed{circumstance}; allowed: {range}")]
    OutOfRange {
        /// Kind of surface.
        surface: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// What was given.
        value: String,
        /// When the range depends on another parameter: which (" with mesh=delaunay"), else empty.
        circumstance: String,
        /// Allowed values.
        range: String,
    },
    /// A parameter that does nothing beside the others.
    #[error("{surface}: {parameter} has no effect with {condition}={value}; it needs {condition}={needed}")]
    NoEffect {
        /// Kind of surface.
        surface: &'static str,
        /// The parameter without effect.
        parameter: &'static str,
        /// The parameter that decides.
        condition: &'static str,
        /// Its value.
        value: String,
        /// Values that would give the parameter an effect.
        needed: String,
    },
    /// A closed form that asks for a parameter its own row does not declare with that type.
    #[error("the table of surfaces is wrong: {surface} uses the parameter `{parameter}` but does not declare it so")]
    Undeclared {
        /// Kind of surface.
        surface: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
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
}
