//! The tables of an experiment: of its records, of groups of them, and of the exponents fitted to
//! its plots.

use std::collections::HashSet;
use std::fmt::Write as _;

use super::grid::{Grid, number};
use super::{Config, Outcome, Record, fit, groups, without};

/// The tables of `records` and the fitted exponents as Markdown. With `timings`, the columns that
/// differ from run to run instead of the others. `None` if there are none of these.
pub fn table(config: &Config, records: &[Record], timings: bool) -> Option<String> {
    let grid = of_records(config, records, timings);
    let more: Vec<_> =
        groups::grid(config, records, timings).into_iter().chain(fit::grids(config, records, timings)).collect();
    if grid.is_none() && more.is_empty() {
        return None;
    }
    let mut text = format!("# {}\n\n", config.title);
    if !config.claim.is_empty() {
        let _ = writeln!(text, "{}\n", config.claim);
    }
    if timings {
        text.push_str("Measured on the machine that made these results; they differ from run to run.\n\n");
    }
    let made = made(config, records);
    if made < config.runs.len() {
        let _ = writeln!(text, "{made} of {} runs.\n", config.runs.len());
    }
    text.push_str(&grid.map(|grid| grid.markdown()).unwrap_or_default());
    for sentence in without::sentences(&config.without) {
        let _ = writeln!(text, "\n{sentence}");
    }
    for (title, grid) in more {
        let _ = write!(text, "\n## {title}\n\n{}", grid.markdown());
    }
    Some(text)
}

/// All tables of an experiment with their labels: of results, of times, and of the exponents fitted
/// to both.
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

/// The table with one record per row. With `timings`, the columns that differ from run to run
/// instead of the others. `None` if there are none of these.
fn of_records(config: &Config, records: &[Record], timings: bool) -> Option<Grid> {
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

/// The number of runs to be made that have a record.
pub(super) fn made(config: &Config, records: &[Record]) -> usize {
    let recorded: HashSet<&str> = records.iter().map(|record| record.run.as_str()).collect();
    config.runs.iter().filter(|run| recorded.contains(run.name.as_str())).count()
}
