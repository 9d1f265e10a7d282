use serde::Deserialize;
use serde_json::Value;

use super::grid::number;
use super::panels::above_lowest;
use super::{FitSpec, Fitted, PanelSpec, Record, Selection};
use crate::figure::{Axis, Panels, Plot, Reference, Series};

/// `[plots.NAME]`: a plot over the runs of an experiment.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotSpec {
    /// The title of the plot.
    #[serde(default)]
    pub title: String,
    /// The x axis; `key` is the dotted key of the records.
    pub x: AxisSpec,
    /// The y axis; the keys are those of the series.
    pub y: AxisSpec,
    /// The series that are drawn.
    pub series: Vec<SeriesSpec>,
    /// Only runs with these values at these dotted keys are drawn; a list allows any of its values.
    #[serde(default)]
    pub only: Selection,
    /// Dashed lines for the comparison of slopes.
    #[serde(default)]
    pub reference: Vec<ReferenceSpec>,
    /// Several small plots side by side instead of one.
    #[serde(default)]
    pub panels: PanelSpec,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisSpec {
    /// The dotted key, for the x axis only.
    pub key: Option<String>,
    /// The label of the axis.
    pub label: String,
    /// Whether the axis is logarithmic; values that are not positive are then left out.
    #[serde(default)]
    pub log: bool,
    /// For y only: the distance to the lowest value in the panel, E*, which its title then states.
    /// E* = 0 where the lowest is as good as 0, below 10⁻⁸ of the highest.
    #[serde(default)]
    pub above_lowest: bool,
}

/// One series, or one for each value of `by`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeriesSpec {
    /// The dotted key of the y values.
    pub y: String,
    /// Dotted key that tells series apart.
    pub by: Option<String>,
    /// Name in the legend; `{}` stands for the value of `by`.
    pub label: String,
    /// Restricts this series as `only` restricts the plot.
    #[serde(default)]
    pub only: Selection,
    /// Whether the points are drawn without lines between them.
    #[serde(default)]
    pub cloud: bool,
    /// The exponent that is fitted to the series; both axes must be logarithmic.
    pub fit: Option<FitSpec>,
}

/// A dashed line.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ReferenceSpec {
    /// y ∝ x^slope.
    pub slope: f64,
    /// A point of the line; without one it runs just below all points.
    pub through: Option<[f64; 2]>,
    /// Name in the legend.
    pub label: String,
}

impl PlotSpec {
    /// Every dotted key that the plot reads.
    pub fn keys(&self) -> impl Iterator<Item = &String> {
        let series = self.series.iter().flat_map(|s| std::iter::once(&s.y).chain(&s.by).chain(s.only.0.keys()));
        self.x.key.iter().chain(series).chain(self.only.0.keys()).chain(self.panels.keys())
    }

    /// Whether it shows times, which differ from run to run.
    pub fn is_of_timings(&self) -> bool {
        self.keys().any(|key| key.starts_with("timings."))
    }

    /// The reason why a plot of this name is contradictory, if it is.
    pub(super) fn contradiction(&self, name: &str) -> Option<&'static str> {
        if self.series.iter().any(|series| series.fit.is_some()) && !(self.x.log && self.y.log) {
            return Some("`fit` is the exponent of a power law and needs both axes logarithmic (log = true)");
        }
        // The names of files that are not kept with the results.
        if self.is_of_timings() && name != "timings" && !name.ends_with("-timings") {
            return Some("it shows times, which differ from run to run: its name must end in `-timings`");
        }
        None
    }

    /// The plot of `records`. A run whose value is an array is a series of its own points.
    pub fn plot(&self, records: &[Record]) -> Panels {
        let axis = |spec: &AxisSpec| Axis { label: spec.label.clone(), log: spec.log };
        let reference = |r: &ReferenceSpec| Reference { slope: r.slope, through: r.through, label: r.label.clone() };
        let kept = self.kept(records);
        let (cells, columns) = self.panels.cells(&kept);
        // Panels share a legend, and each has exponents of its own: the table has them.
        let single = cells.len() == 1;
        let plots = cells.into_iter().map(|cell| {
            let fitted = self.fitted(&cell.records).into_iter();
            let mut series: Vec<Series> =
                fitted.map(|(series, fitted)| named(series, fitted.filter(|_| single))).collect();
            let mut title = cell.title;
            if self.y.above_lowest {
                title = format!("{title}{}E* = {}", if title.is_empty() { "" } else { ", " }, lowered(&mut series));
            }
            Plot {
                title,
                x: axis(&self.x),
                y: axis(&self.y),
                series,
                references: self.reference.iter().map(reference).collect(),
            }
        });
        Panels { title: self.title.clone(), plots: plots.collect(), columns }
    }

    /// The exponents that the plot's series have, with their labels; empty where none is asked for.
    pub fn fits(&self, records: &[Record]) -> Vec<(String, Option<Fitted>)> {
        if self.series.iter().all(|series| series.fit.is_none()) {
            return Vec::new();
        }
        let kept = self.kept(records);
        let mut fits = Vec::new();
        for cell in self.panels.cells(&kept).0 {
            let title = if cell.title.is_empty() { String::new() } else { format!("{}: ", cell.title) };
            let of_cell = self.fitted(&cell.records).into_iter();
            fits.extend(of_cell.map(|(series, fitted)| (format!("{title}{}", series.label), fitted)));
        }
        fits
    }

    fn kept<'a>(&self, records: &'a [Record]) -> Vec<&'a Record> {
        records.iter().filter(|record| self.only.holds(|key| record.get(key))).collect()
    }

    /// The series without their exponents in the label, and these.
    fn fitted(&self, records: &[&Record]) -> Vec<(Series, Option<Fitted>)> {
        let mut fitted = Vec::new();
        for spec in &self.series {
            for series in self.series(spec, records) {
                let fit = spec.fit.and_then(|fit| fit.fit(&series.points));
                fitted.push((series, fit));
            }
        }
        fitted
    }

    fn series(&self, spec: &SeriesSpec, records: &[&Record]) -> Vec<Series> {
        let mut series: Vec<Series> = Vec::new();
        for record in records.iter().filter(|record| spec.only.holds(|key| record.get(key))) {
            let by = spec.by.as_ref().and_then(|key| record.get(key));
            let label = spec.label.replace("{}", &by.as_ref().map(number).unwrap_or_default());
            let x = self.x.key.as_ref().and_then(|key| record.get(key));
            let points: Vec<[f64; 2]> = match (x, record.get(&spec.y)) {
                (Some(Value::Array(x)), Some(Value::Array(y))) => x.iter().zip(&y).filter_map(point).collect(),
                (Some(x), Some(y)) => point((&x, &y)).into_iter().collect(),
                _ => Vec::new(),
            };
            match series.iter_mut().find(|s| s.label == label) {
                Some(known) => known.points.extend(points),
                None => series.push(Series { label, points, cloud: spec.cloud }),
            }
        }
        series
    }
}

fn named(series: Series, fitted: Option<Fitted>) -> Series {
    match fitted {
        Some(fitted) => Series { label: format!("{}, {fitted}", series.label), ..series },
        None => series,
    }
}

/// The subtracted lowest value, as titles state it.
fn lowered(series: &mut [Series]) -> String {
    let lowest = above_lowest(series);
    match lowest {
        0.0 => "0".to_owned(),
        _ if (1e-3..1e6).contains(&lowest) => format!("{lowest:.6}"),
        _ => format!("{lowest:.3e}"),
    }
}

fn point((x, y): (&Value, &Value)) -> Option<[f64; 2]> {
    Some([x.as_f64()?, y.as_f64()?])
}
