use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::chart::matches;
use super::grid::number;

/// `[[without]]`: runs of the sweep that are not made, and why; the table of the experiment says so too.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Without {
    /// Dotted keys with their values, or lists of these: left out is a run that has them all.
    pub runs: BTreeMap<String, Value>,
    /// Why.
    pub because: String,
}

impl Without {
    /// Whether the run of this resolved config is left out.
    pub(super) fn holds(&self, config: &Value) -> bool {
        let at = |key: &String| key.split('.').try_fold(config, |value, name| value.get(name));
        self.runs.iter().all(|(key, wanted)| at(key).is_some_and(|value| matches(value, wanted)))
    }
}

/// What is left out, a sentence each.
pub(super) fn sentences(without: &[Without]) -> Vec<String> {
    let name = |key: &String| key.rsplit('.').next().unwrap_or(key).to_owned();
    let value = |value: &Value| match value {
        Value::Array(any) => any.iter().map(number).collect::<Vec<_>>().join(" or "),
        one => number(one),
    };
    let sentence = |Without { runs, because }: &Without| {
        let which: Vec<String> = runs.iter().map(|(key, v)| format!("{} {}", name(key), value(v))).collect();
        format!("Left out: {}: {because}", which.join(", "))
    };
    without.iter().map(sentence).collect()
}
