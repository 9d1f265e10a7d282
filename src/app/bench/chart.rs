//! The record as plots against the number of vertices, with a panel for each case and a line for
//! each contestant.

use super::record::{Entry, Measured, Record};
use super::{BenchError, CONTESTANTS};
use crate::figure::{Axis, Format, Panels, Plot, Series};

/// Function that takes a number from a median.
type Reading = fn(&Measured) -> Option<f64>;

/// Name of the file, title, label of the axis, and the plotted number.
const PLOTS: [(&str, &str, &str, Reading); 2] = [
    ("solve", "From the mesh in memory to the map", "processor seconds", |m| m.solve?.cpu),
    ("memory", "The most memory held at once", "bytes", |m| Some(m.peak_bytes? as f64)),
];

/// Names of all possible files.
pub(super) fn files() -> impl Iterator<Item = String> {
    PLOTS.iter().map(|(name, ..)| file(name))
}

fn file(name: &str) -> String {
    format!("{name}.svg")
}

/// Draws the plots as SVG, each with the name of its file. Plots without data are left out.
///
/// # Errors
/// Those of [`Panels::render`].
pub fn plots(record: &Record) -> Result<Vec<(String, Vec<u8>)>, BenchError> {
    let mut files = Vec::new();
    for (name, title, label, reading) in PLOTS {
        let mut cases: Vec<&str> = Vec::new();
        for case in record.entries.iter().filter(|e| e.median().is_some_and(|m| reading(m).is_some())).map(|e| e.case) {
            if !cases.contains(&case) && sizes(record, case) > 1 {
                cases.push(case);
            }
        }
        if cases.is_empty() {
            continue;
        }
        let axis = |label: &str| Axis { label: label.to_owned(), log: true };
        let plot = |case: &str| Plot {
            title: case.to_owned(),
            x: axis("vertices"),
            y: axis(label),
            series: series(record, case, reading),
            references: Vec::new(),
        };
        let plots: Vec<Plot> = cases.iter().map(|case| plot(case)).collect();
        let panels = Panels { title: title.to_owned(), columns: plots.len().min(2), plots };
        files.push((file(name), panels.render(Format::Svg)?));
    }
    Ok(files)
}

/// Returns the number of sizes of a case; a single one makes no line.
fn sizes(record: &Record, case: &str) -> usize {
    let mut sizes: Vec<usize> = record.entries.iter().filter(|e| e.case == case).map(|e| e.size).collect();
    sizes.sort_unstable();
    sizes.dedup();
    sizes.len()
}

/// Returns one line for each contestant that has a median in any panel, so that all panels have the
/// same legend.
fn series(record: &Record, case: &str, reading: Reading) -> Vec<Series> {
    let known = |entry: &Entry| Some([entry.vertices as f64, reading(entry.median()?)?]);
    let points = |name: &str, case: Option<&str>| -> Vec<[f64; 2]> {
        let of = record.entries.iter().filter(|e| e.contestant == name && case.is_none_or(|case| e.case == case));
        of.filter_map(known).collect()
    };
    let present = CONTESTANTS.iter().map(|c| c.name).filter(|name| !points(name, None).is_empty());
    present.map(|name| Series { label: name.to_owned(), points: points(name, Some(case)), cloud: false }).collect()
}
