use std::collections::BTreeMap;

use serde::Deserialize;
use serde_json::Value;

use super::Record;
use super::summary::number;
use crate::figure::{Axis, Plot, Reference, Series};

/// `[plots.NAME]`: a plot over the runs of an experiment.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlotSpec {
    /// Over the plot.
    #[serde(default)]
    pub title: String,
    /// What goes right: `key` is the dotted key of the records.
    pub x: AxisSpec,
    /// What goes up; the keys are those of the series.
    pub y: AxisSpec,
    /// What is drawn.
    pub series: Vec<SeriesSpec>,
    /// Runs whose value at a dotted key is another are left out.
    #[serde(default)]
    pub only: BTreeMap<String, Value>,
    /// Dashed lines to compare slopes with.
    #[serde(default)]
    pub reference: Vec<ReferenceSpec>,
}

/// An axis.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxisSpec {
    /// Dotted key; for x only.
    pub key: Option<String>,
    /// What stands beside it.
    pub label: String,
    /// Whether it is logarithmic; values that are not positive are then left out.
    #[serde(default)]
    pub log: bool,
}

/// One series, or one for each value of `by`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SeriesSpec {
    /// Dotted key of what goes up.
    pub y: String,
    /// Dotted key that tells series apart.
    pub by: Option<String>,
    /// Name in the legend; `{}` stands for the value of `by`.
    pub label: String,
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
        let series = self.series.iter().flat_map(|s| std::iter::once(&s.y).chain(&s.by));
        self.x.key.iter().chain(series).chain(self.only.keys())
    }

    /// The plot of `records`. A run whose value is an array is a series of its own points.
    pub fn plot(&self, records: &[Record]) -> Plot {
        let kept = |r: &&Record| self.only.iter().all(|(key, wanted)| r.get(key).is_some_and(|v| same(&v, wanted)));
        let kept: Vec<&Record> = records.iter().filter(kept).collect();
        let axis = |spec: &AxisSpec| Axis { label: spec.label.clone(), log: spec.log };
        let reference = |r: &ReferenceSpec| Reference { slope: r.slope, through: r.through, label: r.label.clone() };
        Plot {
            title: self.title.clone(),
            x: axis(&self.x),
            y: axis(&self.y),
            series: self.series.iter().flat_map(|series| self.series(series, &kept)).collect(),
            references: self.reference.iter().map(reference).collect(),
        }
    }

    fn series(&self, spec: &SeriesSpec, records: &[&Record]) -> Vec<Series> {
        let mut series: Vec<Series> = Vec::new();
        for record in records {
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
                None => series.push(Series { label, points }),
            }
        }
        series
    }
}

fn point((x, y): (&Value, &Value)) -> Option<[f64; 2]> {
    Some([x.as_f64()?, y.as_f64()?])
}

/// 33 and 33.0 are the same.
fn same(a: &Value, b: &Value) -> bool {
    a == b || (a.is_number() && a.as_f64() == b.as_f64())
}
