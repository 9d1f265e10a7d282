//! Plots with several panels, one for each value of one or two keys.

use serde::Deserialize;
use serde_json::Value;

use super::Record;
use super::grid::number;
use crate::figure::Series;

/// `panels` of a plot: one for each combination of values that runs have at the keys.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PanelSpec {
    /// Dotted keys whose values vary from row to row.
    pub rows: Vec<String>,
    /// Dotted keys whose values vary from column to column.
    pub columns: Vec<String>,
}

/// The runs of a panel.
pub(super) struct Cell<'a> {
    pub title: String,
    pub records: Vec<&'a Record>,
}

impl PanelSpec {
    pub(super) fn keys(&self) -> impl Iterator<Item = &String> {
        self.rows.iter().chain(&self.columns)
    }

    /// The panels of `records`, row by row, and the number of columns.
    pub(super) fn cells<'a>(&self, records: &[&'a Record]) -> (Vec<Cell<'a>>, usize) {
        let distinct = |keys: &[String]| {
            let mut distinct: Vec<Vec<Value>> = Vec::new();
            for values in records.iter().map(|record| values(record, keys)) {
                if !distinct.contains(&values) {
                    distinct.push(values);
                }
            }
            distinct
        };
        let (rows, columns) = (distinct(&self.rows), distinct(&self.columns));
        let mut cells = Vec::new();
        for row in &rows {
            for column in &columns {
                let names: Vec<String> =
                    self.keys().zip(row.iter().chain(column)).map(|(key, value)| title(key, value)).collect();
                let of_cell = |r: &&&Record| values(r, &self.rows) == *row && values(r, &self.columns) == *column;
                let records = records.iter().filter(of_cell).copied().collect();
                cells.push(Cell { title: names.join(", "), records });
            }
        }
        (cells, columns.len())
    }
}

fn values(record: &Record, keys: &[String]) -> Vec<Value> {
    keys.iter().map(|key| record.get(key).unwrap_or_default()).collect()
}

/// Words as they are, numbers with the last part of their key: `n = 17`.
fn title(key: &str, value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        _ => format!("{} = {}", key.rsplit('.').next().unwrap_or(key), number(value)),
    }
}

/// Subtracts the lowest y of all, E*, from `series` unless it is negligible, below 10⁻⁸ of the
/// highest. Returns what was subtracted. A point with the lowest y becomes 0 and is not drawn on a
/// logarithmic axis.
pub(super) fn above_lowest(series: &mut [Series]) -> f64 {
    /// Energies that can vanish end between 10⁻³⁰ and, on coarse meshes, 10⁻⁹ of the start's;
    /// minima of the others above 10⁻³.
    const VANISHING: f64 = 1e-8;
    let all = || series.iter().flat_map(|s| s.points.iter().map(|p| p[1])).filter(|y| y.is_finite());
    let (lowest, highest) = (all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max));
    if !lowest.is_finite() || lowest <= VANISHING * highest {
        return 0.0;
    }
    series.iter_mut().flat_map(|s| &mut s.points).for_each(|p| p[1] -= lowest);
    lowest
}
