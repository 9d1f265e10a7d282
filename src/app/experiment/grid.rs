//! Tables of an experiment as cells, from which Markdown and HTML are made.

use serde_json::Value;

use super::{Config, Outcome, Record, fit, groups};

/// A table: cells of text, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Grid {
    /// Over the columns.
    pub headings: Vec<String>,
    /// As many cells each as there are headings.
    pub rows: Vec<Vec<String>>,
}

impl Grid {
    /// As Markdown, numbers to the right.
    pub fn markdown(&self) -> String {
        let mut text = format!("| {} |\n|{}\n", self.headings.join(" | "), " --: |".repeat(self.headings.len()));
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|").replace('\n', " ")).collect();
            text.push_str(&format!("| {} |\n", cells.join(" | ")));
        }
        text
    }
}

/// All tables of an experiment with what each is: of results, of times, and of the exponents fitted to both.
pub(super) fn grids(config: &Config, records: &[Record]) -> Vec<(String, Grid)> {
    let mut grids = Vec::new();
    for (timings, label) in [(false, "Results"), (true, "Times, on the machine that made these results")] {
        if let Some(grid) = of_records(config, records, timings).filter(|grid| !grid.rows.is_empty()) {
            grids.push((label.to_owned(), grid));
        }
        grids.extend(groups::grid(config, records, timings));
        grids.extend(fit::grids(config, records, timings));
    }
    grids
}

/// The records, one a row; `timings`: the columns that differ from run to run instead of the others. `None` if there are none
/// of these.
pub(super) fn of_records(config: &Config, records: &[Record], timings: bool) -> Option<Grid> {
    let is_timing = |key: &str| key.starts_with("timings.");
    let columns: Vec<_> = config.columns.iter().filter(|column| is_timing(&column.key) == timings).collect();
    if columns.is_empty() && timings {
        return None;
    }
    let heading = |key: &String| key.rsplit('.').next().unwrap_or(key).to_owned();
    let mut headings: Vec<String> = config.swept.iter().map(heading).collect();
    headings.extend(columns.iter().map(|column| column.label.clone()));
    if !timings {
        headings.push("outcome".to_owned());
    }
    let row = |record: &Record| {
        let keys = config.swept.iter().map(|key| format!("config.{key}"));
        let keys = keys.chain(columns.iter().map(|column| column.key.clone()));
        let mut cells: Vec<String> =
            keys.map(|key| record.get(&key).as_ref().map(number).unwrap_or_default()).collect();
        if !timings {
            cells.push(match (&record.outcome, &record.error) {
                (Outcome::Done, _) => "done".to_owned(),
                (outcome, error) => format!("{outcome:?}: {}", error.as_deref().unwrap_or_default()).to_lowercase(),
            });
        }
        cells
    };
    Some(Grid { headings, rows: records.iter().map(row).collect() })
}

/// Numbers to four digits, tables as `R = 5, r = 1.75`, everything else as it is.
pub(super) fn number(value: &Value) -> String {
    match value {
        Value::Null => "–".to_owned(),
        Value::String(text) => text.clone(),
        Value::Number(n) if n.is_f64() => four_digits(n.as_f64().unwrap_or(f64::NAN)),
        Value::Object(fields) => {
            fields.iter().map(|(name, field)| format!("{name} = {}", number(field))).collect::<Vec<_>>().join(", ")
        }
        other => other.to_string(),
    }
}

fn four_digits(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    if !(1e-3..1e5).contains(&x.abs()) {
        return format!("{x:.2e}");
    }
    let decimals = (3 - x.abs().log10().floor() as i32).max(0) as usize;
    let text = format!("{x:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}
