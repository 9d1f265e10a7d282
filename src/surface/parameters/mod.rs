//! Names with parameters, `name?parameter=value&…`: of generated surfaces, of normal estimators.
//!
//! What may stand behind the `?` is declared by [`Parameter`]s; [`Arguments`] are their values, all within their ranges.

mod arguments;
mod error;
mod parameter;

pub use arguments::Arguments;
pub use error::ParameterError;
pub use parameter::{Parameter, Values};

/// The parameters with their defaults, as they would stand behind the `?`.
pub fn synopsis<'a>(declared: impl IntoIterator<Item = &'a Parameter>) -> String {
    let pairs: Vec<String> = declared.into_iter().map(|p| format!("{}={}", p.name, p.values.default_text())).collect();
    pairs.join("&")
}
