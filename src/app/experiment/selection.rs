use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

/// A selection of the runs of a sweep: dotted keys with their values, or lists of allowed values. A
/// run is selected if it matches all keys.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(transparent)]
pub struct Selection(pub BTreeMap<String, Value>);

impl Selection {
    /// Whether a run with the value `at(key)` at every dotted key is selected.
    pub(super) fn holds(&self, at: impl Fn(&str) -> Option<Value>) -> bool {
        self.0.iter().all(|(key, wanted)| at(key).is_some_and(|value| matches(&value, wanted)))
    }

    /// Whether the run with this resolved config is selected.
    pub(super) fn holds_config(&self, config: &Value) -> bool {
        self.holds(|key| key.split('.').try_fold(config, |value, name| value.get(name)).cloned())
    }
}

/// Whether `value` is the wanted one, or one of a list of these.
fn matches(value: &Value, wanted: &Value) -> bool {
    match wanted {
        Value::Array(any) => any.iter().any(|wanted| same(value, wanted)),
        _ => same(value, wanted),
    }
}

/// Whether two values are equal; 33 and 33.0 are.
fn same(a: &Value, b: &Value) -> bool {
    a == b || (a.is_number() && a.as_f64() == b.as_f64())
}
