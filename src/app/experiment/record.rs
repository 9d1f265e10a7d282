use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Outcome {
    /// The run has a result within its bounds.
    Done,
    /// The run has a result that `[expect]` excludes.
    Refuted,
    /// The run has no result.
    Failed,
}

/// The record of one run: a line of `records.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Name of the config.
    pub experiment: String,
    /// Name of the run within it: the swept values.
    pub run: String,
    /// The resolved config, with swept values and settings applied.
    pub config: Value,
    /// The outcome.
    pub outcome: Outcome,
    /// The reason of a failure or refutation.
    pub error: Option<String>,
    /// The result; null if there is none.
    pub result: Value,
    /// Its pictures: files in `figures/`.
    #[serde(default)]
    pub pictures: Vec<String>,
    /// Seconds. They differ from run to run, and are not in `records.jsonl`.
    #[serde(default, skip_serializing_if = "Value::is_null")]
    pub timings: Value,
    /// Versions of public files and of other programs that took part. They are not in
    /// `records.jsonl`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub versions: BTreeMap<String, String>,
}

impl Record {
    /// The record without timings and versions: the part that is the same on every run of the same
    /// program.
    pub fn same_on_every_run(&self) -> Record {
        Record { timings: Value::Null, versions: BTreeMap::new(), ..self.clone() }
    }

    /// Whether two records are equal but for timings and versions.
    pub fn same_numbers(&self, other: &Record) -> bool {
        self.same_on_every_run() == other.same_on_every_run()
    }

    /// The value at a dotted key: `config.…`, `result.…`, `timings.…`, or `run`, `outcome`,
    /// `error`.
    pub fn get(&self, key: &str) -> Option<Value> {
        let (first, rest) = key.split_once('.').map_or((key, None), |(first, rest)| (first, Some(rest)));
        let whole = match first {
            "config" => &self.config,
            "result" => &self.result,
            "timings" => &self.timings,
            "run" => return Some(self.run.clone().into()),
            "error" => return Some(self.error.clone().into()),
            "outcome" => return serde_json::to_value(self.outcome).ok(),
            _ => return None,
        };
        let mut value = whole;
        for name in rest.into_iter().flat_map(|rest| rest.split('.')) {
            value = value.get(name)?;
        }
        Some(value.clone())
    }

    /// All dotted keys below `config`, `result` and `timings` that have a value.
    pub fn keys(&self) -> Vec<String> {
        fn collect(value: &Value, key: String, keys: &mut Vec<String>) {
            match value {
                Value::Object(fields) => {
                    fields.iter().for_each(|(name, field)| collect(field, format!("{key}.{name}"), keys));
                }
                _ => keys.push(key),
            }
        }
        let mut keys = Vec::new();
        for (name, part) in [("config", &self.config), ("result", &self.result), ("timings", &self.timings)] {
            if part.is_object() {
                collect(part, name.to_owned(), &mut keys);
            }
        }
        keys
    }
}
