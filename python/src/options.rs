//! Options, from JSON.

use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use riemap::MapOptions;
use riemap::map::FlatOptions;
use serde_json::{Map, Value};

use crate::error::{Class, of_map, raise};

/// The options of a map, from a JSON object with the keys of [`FlatOptions`].
///
/// # Errors
/// `TypeError` for an unknown key, as Python raises it for unknown keyword arguments; `OptionError` for a wrong value, which is
/// named, and for options that contradict each other.
pub fn map_options(py: Python<'_>, json: &str) -> PyResult<MapOptions> {
    let flat: FlatOptions = serde_json::from_str(json).map_err(|error| refused(py, json, &error))?;
    MapOptions::try_from(flat).map_err(|error| of_map(py, &error.into()))
}

/// The error for options that [`FlatOptions`] does not read: serde says what is wrong, and trying one key at a time says where.
fn refused(py: Python<'_>, json: &str, error: &serde_json::Error) -> PyErr {
    let given: Map<String, Value> = serde_json::from_str(json).unwrap_or_default();
    let first = given.into_iter().find_map(|(key, value)| {
        let alone = Value::Object(Map::from_iter([(key.clone(), value)]));
        serde_json::from_value::<FlatOptions>(alone).err().map(|error| (key, error.to_string()))
    });
    let (key, message) = first.unwrap_or_else(|| ("options".to_owned(), error.to_string()));
    if message.starts_with("unknown field") {
        return PyTypeError::new_err(message.replacen("field", "option", 1).replace('-', "_"));
    }
    raise(py, Class::Option, &format!("{}: {message}", key.replace('-', "_")), "value", &[], &[])
}
