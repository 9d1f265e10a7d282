//! A table as cells, from which Markdown and HTML are made.

use serde_json::Value;

/// A table: cells of text, row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Grid {
    /// The headings of the columns.
    pub headings: Vec<String>,
    /// The rows; each has as many cells as there are headings.
    pub rows: Vec<Vec<String>>,
}

impl Grid {
    /// Formats the table as Markdown, aligned to the right.
    pub fn markdown(&self) -> String {
        let mut text = format!("| {} |\n|{}\n", self.headings.join(" | "), " --: |".repeat(self.headings.len()));
        for row in &self.rows {
            let cells: Vec<String> = row.iter().map(|cell| cell.replace('|', "\\|").replace('\n', " ")).collect();
            text.push_str(&format!("| {} |\n", cells.join(" | ")));
        }
        text
    }
}

/// Formats a value: numbers to four digits, tables as `R = 5, r = 1.75`, everything else unchanged.
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
