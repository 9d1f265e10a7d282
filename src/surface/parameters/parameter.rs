use std::fmt;

/// A parameter of a named item: a generated surface or a normal estimator.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The part before the `=`.
    pub name: &'static str,
    /// A description of one line.
    pub about: &'static str,
    /// Type, default and range.
    pub values: Values,
    /// `(name, values)`: the parameter has an effect only if the parameter `name`, declared
    /// earlier, has one of these values.
    pub only_with: Option<(&'static str, &'static [&'static str])>,
}

/// Type, default and range of a parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Values {
    /// An integer, min ≤ value ≤ max.
    Whole {
        /// Default.
        default: u64,
        /// Smallest value.
        min: u64,
        /// Largest value.
        max: u64,
    },
    /// A real number, min ≤ value ≤ max.
    Real {
        /// Default.
        default: f64,
        /// Smallest value.
        min: f64,
        /// Largest value.
        max: f64,
    },
    /// A word from a list; the first is the default.
    Choice(&'static [&'static str]),
}

impl Parameter {
    /// Declares a whole number.
    pub const fn whole(name: &'static str, default: u64, min: u64, max: u64, about: &'static str) -> Self {
        Parameter { name, about, values: Values::Whole { default, min, max }, only_with: None }
    }

    /// Declares a real number.
    pub const fn real(name: &'static str, default: f64, min: f64, max: f64, about: &'static str) -> Self {
        Parameter { name, about, values: Values::Real { default, min, max }, only_with: None }
    }

    /// Declares a choice between words; the first is the default.
    pub const fn choice(name: &'static str, words: &'static [&'static str], about: &'static str) -> Self {
        Parameter { name, about, values: Values::Choice(words), only_with: None }
    }

    /// Restricts the parameter to some values of a parameter that is declared earlier.
    pub const fn only_with(self, name: &'static str, values: &'static [&'static str]) -> Self {
        Parameter { only_with: Some((name, values)), ..self }
    }
}

impl Values {
    /// The default, as it is written in a name.
    pub fn default_text(&self) -> String {
        match self {
            Values::Whole { default, .. } => default.to_string(),
            Values::Real { default, .. } => default.to_string(),
            Values::Choice(words) => words.first().copied().unwrap_or_default().to_string(),
        }
    }
}

/// The allowed values.
impl fmt::Display for Values {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Values::Whole { min, max: u64::MAX, .. } => write!(f, "{min} and above"),
            Values::Whole { min, max, .. } => write!(f, "{min} to {max}"),
            Values::Real { min, max, .. } => write!(f, "{min} to {max}"),
            Values::Choice(words) => f.write_str(&words.join(", ")),
        }
    }
}
