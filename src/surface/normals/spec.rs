use std::fmt;
use std::str::FromStr;

use super::{Facets, NORMAL_ESTIMATORS, NormalError, NormalEstimator};
use crate::surface::parameters::{Arguments, ParameterError};

/// An estimator with its parameters, written as `name?parameter=value&…`.
#[derive(Clone)]
pub struct NormalSpec {
    estimator: &'static dyn NormalEstimator,
    arguments: Arguments,
}

/// A text does not specify an estimator.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NormalSpecError {
    /// No estimator has this name.
    #[error("unknown normal estimator `{name}`; known: {known}")]
    Unknown {
        /// The name that was requested.
        name: String,
        /// All known names.
        known: String,
    },
    /// The parameters are wrong.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
}

impl NormalSpec {
    /// Parses the specification of an estimator of `table`.
    ///
    /// # Errors
    /// An unknown name or parameter, or a value out of range; the message lists what is possible.
    pub fn parse_from(table: &[&'static dyn NormalEstimator], text: &str) -> Result<Self, NormalSpecError> {
        let (name, query) = text.split_once('?').unwrap_or((text, ""));
        let estimator = table.iter().copied().find(|e| e.name() == name).ok_or_else(|| {
            let known: Vec<&str> = table.iter().map(|e| e.name()).collect();
            NormalSpecError::Unknown { name: name.to_string(), known: known.join(", ") }
        })?;
        let arguments = Arguments::parse(estimator.name(), estimator.parameters(), query)?;
        Ok(NormalSpec { estimator, arguments })
    }

    /// The estimator's name without parameters.
    pub fn name(&self) -> &'static str {
        self.estimator.name()
    }

    /// Estimates the normals (`nf × 3`).
    ///
    /// # Errors
    /// The surface does not suit the estimator.
    pub fn estimate(&self, facets: &Facets) -> Result<Vec<[f64; 3]>, NormalError> {
        self.estimator.estimate(facets, &self.arguments)
    }
}

impl Default for NormalSpec {
    fn default() -> Self {
        let estimator: &'static dyn NormalEstimator = &super::auto::Auto;
        NormalSpec { estimator, arguments: Arguments::defaults(estimator.name(), estimator.parameters()) }
    }
}

impl FromStr for NormalSpec {
    type Err = NormalSpecError;

    fn from_str(text: &str) -> Result<Self, NormalSpecError> {
        NormalSpec::parse_from(NORMAL_ESTIMATORS, text)
    }
}

/// The canonical form, in which every parameter that has an effect is spelled out.
impl fmt::Display for NormalSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.arguments.canonical())
    }
}

impl fmt::Debug for NormalSpec {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "NormalSpec({self})")
    }
}

impl PartialEq for NormalSpec {
    fn eq(&self, other: &Self) -> bool {
        self.arguments == other.arguments
    }
}

impl serde::Serialize for NormalSpec {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> serde::Deserialize<'de> for NormalSpec {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(serde::de::Error::custom)
    }
}
