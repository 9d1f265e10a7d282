use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::Selection;

/// `[expect]`: the bounds that the claim sets on every result, by dotted key.
pub type Bounds = BTreeMap<String, Bound>;

/// `[[expect-where]]`: bounds on the results of some runs, which replace the bounds of `[expect]`
/// on the same keys.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expectation {
    /// The runs, by swept keys.
    pub runs: Selection,
    /// The bounds, by dotted key of the record.
    pub bounds: Bounds,
}

/// Adds the bounds of `[[expect-where]]` on this run to `expect` of its resolved config and returns
/// them.
pub(super) fn resolve(config: &mut Value, expectations: &[Expectation]) -> Bounds {
    let chosen: Vec<bool> = expectations.iter().map(|some| some.runs.holds_config(config)).collect();
    let written = config.as_object_mut().and_then(|config| config.remove("expect-where"));
    let written = written.iter().filter_map(Value::as_array).flatten().zip(&chosen);
    for bounds in written.filter(|(_, chosen)| **chosen).filter_map(|(some, _)| some["bounds"].as_object()) {
        if config.get("expect").is_none() {
            config["expect"] = Value::Object(Default::default());
        }
        if let Some(all) = config["expect"].as_object_mut() {
            all.extend(bounds.clone());
        }
    }
    let bounds = expectations.iter().zip(chosen).filter(|(_, chosen)| *chosen).flat_map(|(some, _)| &some.bounds);
    bounds.map(|(key, bound)| (key.clone(), bound.clone())).collect()
}

/// A bound on one number or word of the result.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bound {
    /// The value is at least this.
    pub min: Option<f64>,
    /// The value is at most this.
    pub max: Option<f64>,
    /// The value is this.
    pub equal: Option<Value>,
}

impl Bound {
    /// Says how `value` violates the bound; `None` if it does not.
    pub fn violation(&self, value: &Value) -> Option<String> {
        if let Some(wanted) = self.equal.as_ref().filter(|wanted| *wanted != value) {
            return Some(format!("is {value}, expected {wanted}"));
        }
        if self.min.is_none() && self.max.is_none() {
            return None;
        }
        let Some(number) = value.as_f64() else { return Some(format!("is {value}, expected a number")) };
        // No number lies in a range that a NaN bounds.
        if let Some(min) = self.min.filter(|min| !(*min..).contains(&number)) {
            return Some(format!("is {number:e}, expected {min:e} or more"));
        }
        self.max
            .filter(|max| !(..=*max).contains(&number))
            .map(|max| format!("is {number:e}, expected {max:e} or less"))
    }
}
