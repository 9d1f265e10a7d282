/// What is wrong with the part behind the `?` of `name?parameter=value&…`.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// No such parameter.
    #[error("{subject} has no parameter `{parameter}`; known: {known}")]
    UnknownParameter {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
        /// What was asked for.
        parameter: String,
        /// Its parameters with their defaults.
        known: String,
    },
    /// A part between `&`s that is not `parameter=value`.
    #[error("{subject}: `{text}` is not of the form parameter=value; parameters: {known}")]
    NotAPair {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
        /// The part.
        text: String,
        /// Its parameters with their defaults.
        known: String,
    },
    /// A parameter that stands twice.
    #[error("{subject}: parameter `{parameter}` is given twice")]
    Repeated {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
    /// Not a number of the right kind.
    #[error("{subject}: {parameter}={value}: `{value}` is not a {expected}; allowed: {range}")]
    Malformed {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
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
    #[error("{subject}: {parameter}={value} is not allowed{circumstance}; allowed: {range}")]
    OutOfRange {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
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
    #[error("{subject}: {parameter} has no effect with {condition}={value}; it needs {condition}={needed}")]
    NoEffect {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
        /// The parameter without effect.
        parameter: &'static str,
        /// The parameter that decides.
        condition: &'static str,
        /// Its value.
        value: String,
        /// Values that would give the parameter an effect.
        needed: String,
    },
    /// A parameter that is asked for by the very row that does not declare it with that type.
    #[error("the table is wrong: {subject} uses the parameter `{parameter}` but does not declare it so")]
    Undeclared {
        /// Whose parameter: the name before the `?`.
        subject: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
}
