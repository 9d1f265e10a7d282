use serde::Deserialize;
use serde_json::Value;

use super::Selection;
use super::grid::number;

/// `[[without]]`: runs of the sweep that are not made, with the reason, which the table of the
/// experiment states.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Without {
    /// The runs, by swept keys.
    pub runs: Selection,
    /// The reason.
    pub because: String,
}

/// The sentences that say which runs are left out.
pub(super) fn sentences(without: &[Without]) -> Vec<String> {
    let name = |key: &String| key.rsplit('.').next().unwrap_or(key).to_owned();
    let value = |value: &Value| match value {
        Value::Array(any) => any.iter().map(number).collect::<Vec<_>>().join(" or "),
        one => number(one),
    };
    let sentence = |Without { runs, because }: &Without| {
        let which: Vec<String> = runs.0.iter().map(|(key, v)| format!("{} {}", name(key), value(v))).collect();
        format!("Left out: {}: {because}", which.join(", "))
    };
    without.iter().map(sentence).collect()
}
