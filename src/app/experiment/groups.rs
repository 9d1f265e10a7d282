use serde::Deserialize;
use serde_json::Value;

use super::grid::{Grid, number};
use super::{Config, Outcome, Record};
use crate::app::measure::median::median;

/// `[groups]`: a table with a row for each value of some keys, which sums up the runs that have it.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupSpec {
    /// Dotted keys whose values define the groups.
    pub by: Vec<String>,
    /// The columns of the table.
    pub columns: Vec<GroupColumn>,
}

/// A column of the table of groups.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GroupColumn {
    /// Dotted key of the records.
    pub key: String,
    /// The statistic of the values.
    pub take: Take,
    /// Heading.
    pub label: String,
}

/// A statistic of the values at a key in a group. Runs without a number there do not count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Take {
    /// The mean.
    Mean,
    /// The median.
    Median,
    /// The largest.
    Max,
    /// The number of runs in which the value is true, such as `5 of 6`.
    Count,
}

impl Take {
    fn of(self, records: &[&Record], key: &str) -> String {
        let values: Vec<Value> = records.iter().filter_map(|record| record.get(key)).collect();
        if self == Take::Count {
            let count = values.iter().filter(|value| **value == Value::Bool(true)).count();
            return format!("{count} of {}", records.len());
        }
        let numbers: Vec<f64> = values.iter().filter_map(Value::as_f64).collect();
        let mean = |numbers: Vec<f64>| numbers.iter().sum::<f64>() / numbers.len() as f64;
        let taken = match self {
            Take::Mean => Some(mean(numbers)).filter(|mean| mean.is_finite()),
            Take::Median => median(numbers),
            Take::Max | Take::Count => numbers.into_iter().max_by(f64::total_cmp),
        };
        taken.map_or_else(|| "–".to_owned(), |x| number(&x.into()))
    }
}

impl GroupSpec {
    /// Every dotted key that it reads.
    pub(super) fn keys(&self) -> impl Iterator<Item = &String> {
        self.by.iter().chain(self.columns.iter().map(|column| &column.key))
    }

    /// The table of the groups, in the order of their first runs. With `timings`, the columns that
    /// differ from run to run instead of the others. `None` if there are none of these.
    fn grid(&self, records: &[Record], timings: bool) -> Option<Grid> {
        let columns: Vec<&GroupColumn> =
            self.columns.iter().filter(|column| column.key.starts_with("timings.") == timings).collect();
        if columns.is_empty() {
            return None;
        }
        let mut groups: Vec<(Vec<String>, Vec<&Record>)> = Vec::new();
        for record in records {
            let name: Vec<String> =
                self.by.iter().map(|key| record.get(key).as_ref().map(number).unwrap_or_default()).collect();
            match groups.iter_mut().find(|(known, _)| *known == name) {
                Some((_, group)) => group.push(record),
                None => groups.push((name, vec![record])),
            }
        }
        let last = |key: &String| key.rsplit('.').next().unwrap_or(key).to_owned();
        let mut headings: Vec<String> = self.by.iter().map(last).collect();
        headings.push("runs".to_owned());
        headings.extend(columns.iter().map(|column| column.label.clone()));
        let row = |(name, group): (Vec<String>, Vec<&Record>)| {
            let without = group.iter().filter(|record| record.outcome == Outcome::Failed).count();
            let runs = match without {
                0 => group.len().to_string(),
                n => format!("{} ({n} failed)", group.len()),
            };
            let cells = columns.iter().map(|column| column.take.of(&group, &column.key));
            name.into_iter().chain([runs]).chain(cells).collect()
        };
        Some(Grid { headings, rows: groups.into_iter().map(row).collect() })
    }
}

/// The table of the groups with its title, where the config has one.
pub(super) fn grid(config: &Config, records: &[Record], timings: bool) -> Option<(String, Grid)> {
    let title = if timings { "Times, summed up" } else { "Summed up" };
    Some((title.to_owned(), config.groups.as_ref()?.grid(records, timings)?))
}
