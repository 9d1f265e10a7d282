/// The part behind the `?` of `name?parameter=value&…` is wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// There is no such parameter.
    #[error("{subject} has no parameter `{parameter}`; known: {known}")]
    UnknownParameter {
        /// The name before the `?`.
        subject: &'static str,
        /// The parameter that was requested.
        parameter: String,
        /// The known parameters with their defaults.
        known: String,
    },
    /// A part between two `&` is not of the form `parameter=value`.
    #[error("{subject}: `{text}` is not of the form parameter=value; parameters: {known}")]
    NotAPair {
        /// The name before the `?`.
        subject: &'static str,
        /// The part.
        text: String,
        /// The known parameters with their defaults.
        known: String,
    },
    /// A parameter is given twice.
    #[error("{subject}: parameter `{parameter}` is given twice")]
    Repeated {
        /// The name before the `?`.
        subject: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
    /// A value is not a number of the required type.
    #[error("{subject}: {parameter}={value}: `{value}` is not a {expected}; allowed: {range}")]
    Malformed {
        /// The name before the `?`.
        subject: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// The value that was given.
        value: String,
        /// "whole number" or "number".
        expected: &'static str,
        /// The allowed values.
        range: String,
    },
    /// A number is outside of its range, or a word is not among the choices.
    #[error("{subject}: {parameter}={value} is not allowed{circumstance}; allowed: {range}")]
    OutOfRange {
        /// The name before the `?`.
        subject: &'static str,
        /// The parameter.
        parameter: &'static str,
        /// The value that was given.
        value: String,
        /// The condition under which this range holds (" with mesh=delaunay"); empty if it always
        /// holds.
        circumstance: String,
        /// The allowed values.
        range: String,
    },
    /// A parameter has no effect in combination with the others.
    #[error("{subject}: {parameter} has no effect with {condition}={value}; it needs {condition}={needed}")]
    NoEffect {
        /// The name before the `?`.
        subject: &'static str,
        /// The parameter without effect.
        parameter: &'static str,
        /// The parameter that decides whether there is an effect.
        condition: &'static str,
        /// The value of that parameter.
        value: String,
        /// The values of that parameter that would give an effect.
        needed: String,
    },
    /// A row of the table uses a parameter that it does not declare with this type (a programming
    /// error).
    #[error("the table is wrong: {subject} uses the parameter `{parameter}` but does not declare it with this type")]
    Undeclared {
        /// The name before the `?`.
        subject: &'static str,
        /// The parameter.
        parameter: &'static str,
    },
}
