//! Names with parameters, `name?parameter=value&…`, for generated surfaces and normal estimators.
//!
//! [`Parameter`]s declare what can follow the `?`; [`Arguments`] are their values, all within their
//! ranges.

mod arguments;
mod error;
mod parameter;

pub use arguments::Arguments;
pub use error::ParameterError;
pub use parameter::{Parameter, Values};

/// Formats the parameters with their defaults as they would follow the `?`.
pub fn synopsis<'a>(declared: impl IntoIterator<Item = &'a Parameter>) -> String {
    let pairs: Vec<String> = declared.into_iter().map(|p| format!("{}={}", p.name, p.values.default_text())).collect();
    pairs.join("&")
}
