//! Exponents of power laws, fitted to series.

use std::fmt;

use serde::de::value::{MapAccessDeserializer, StrDeserializer};
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::grid::Grid;
use super::{Config, Record};

/// `fit` of a series: the exponent of a power law through its last points, least squares over the
/// logarithms of both coordinates. It stands in the legend, and below the table of the experiment.
///
/// `fit = "cells"`, or `fit = { x = "cells", last = 4 }`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct FitSpec {
    /// The meaning of x.
    pub x: Abscissa,
    /// The number of points, 3 by default.
    pub last: usize,
}

/// The meaning of x, which decides the asymptotic end of the axis and the sign of the exponent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Abscissa {
    /// A number of cells along a side, n: the order p of y ∝ n⁻ᵖ, over the largest x.
    Cells,
    /// A mesh width, h: the order p of y ∝ hᵖ, over the smallest x.
    Width,
    /// A size that something costs time for: the exponent p of y ∝ xᵖ, over the largest x.
    Size,
}

/// An exponent fitted to a series.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fitted {
    /// The exponent p.
    pub exponent: f64,
    /// The number of points, at least 2.
    pub points: usize,
    /// The meaning of x.
    pub x: Abscissa,
}

impl Abscissa {
    /// The name of the exponent.
    pub fn name(self) -> &'static str {
        match self {
            Abscissa::Cells | Abscissa::Width => "order",
            Abscissa::Size => "exponent",
        }
    }
}

impl FitSpec {
    /// The fit to `points`, of those with two positive coordinates; `None` where fewer than two
    /// places are left.
    pub fn fit(self, points: &[[f64; 2]]) -> Option<Fitted> {
        let usable = |p: &&[f64; 2]| p.iter().all(|c| *c > 0.0 && c.is_finite());
        let mut logs: Vec<[f64; 2]> = points.iter().filter(usable).map(|p| p.map(f64::ln)).collect();
        logs.sort_by(|a, b| a[0].total_cmp(&b[0]));
        if self.x != Abscissa::Width {
            logs.reverse();
        }
        logs.truncate(self.last);
        let n = logs.len() as f64;
        let [x, y] = [0, 1].map(|k| logs.iter().map(|p| p[k]).sum::<f64>() / n);
        let (mut xx, mut xy) = (0.0, 0.0);
        for p in &logs {
            xx += (p[0] - x) * (p[0] - x);
            xy += (p[0] - x) * (p[1] - y);
        }
        let exponent = if self.x == Abscissa::Cells { -xy / xx } else { xy / xx };
        // No points, or all at one x, leave 0/0.
        exponent.is_finite().then_some(Fitted { exponent, points: logs.len(), x: self.x })
    }
}

/// Formats the fit as in a legend: `order 1.97`.
impl fmt::Display for Fitted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.x.name(), format!("{:.2}", self.exponent).replace('-', "−"))
    }
}

/// The titled tables of fitted exponents, one for each plot with fits. With `timings`, those of
/// plots of times instead of the others.
pub(super) fn grids(config: &Config, records: &[Record], timings: bool) -> Vec<(String, Grid)> {
    let mut grids = Vec::new();
    for (name, plot) in config.plots.iter().filter(|(_, plot)| plot.is_of_timings() == timings) {
        let fits = plot.fits(records);
        let Some(word) = fits.iter().find_map(|(_, fit)| Some(fit.as_ref()?.x.name())) else { continue };
        let title = if plot.title.is_empty() { name } else { &plot.title };
        let rows = fits.into_iter().map(|(series, fit)| match fit {
            Some(fit) => vec![series, format!("{:.3}", fit.exponent), fit.points.to_string()],
            None => vec![series, "–".to_owned(), "–".to_owned()],
        });
        let headings = ["series", word, "points"].map(str::to_owned).to_vec();
        grids.push((format!("{title}: fitted {word}s"), Grid { headings, rows: rows.collect() }));
    }
    grids
}

impl<'de> Deserialize<'de> for FitSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NameOrTable)
    }
}

/// The two ways of writing a fit.
struct NameOrTable;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Table {
    x: Abscissa,
    last: usize,
}

impl<'de> Visitor<'de> for NameOrTable {
    type Value = FitSpec;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("what x is (\"cells\", \"width\" or \"size\"), or { x = \"cells\", last = 4 }")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<FitSpec, E> {
        Abscissa::deserialize(StrDeserializer::new(text)).map(|x| FitSpec { x, last: 3 })
    }

    fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<FitSpec, M::Error> {
        let Table { x, last } = Table::deserialize(MapAccessDeserializer::new(map))?;
        if last < 2 {
            return Err(M::Error::custom(format!("a fit over the last {last} points: it needs 2 or more")));
        }
        Ok(FitSpec { x, last })
    }
}
