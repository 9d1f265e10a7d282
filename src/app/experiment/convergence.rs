//! Convergence of minimisations: the iterations in records, and plots of them.

use std::fmt;

use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::{Value, json};

use super::{AxisSpec, ConfigError, Document, PanelSpec, PlotSpec, SeriesSpec};
use crate::app::measure::stopwatch::Traced;

/// `convergence` in `[figures]`: one plot over all runs, every run a curve. Panels and legend
/// follow from the sweep: the solvers, or the last of the swept keys, stand in the legend, the last
/// of the others beside each other, the rest below each other. Runs then have `result.trace` and
/// `timings.trace`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Convergence {
    /// The x axis.
    pub x: ConvergenceX,
    /// The y axis.
    pub y: ConvergenceY,
}

/// The progress of a minimisation. The axis is logarithmic, so that the start is not drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ConvergenceX {
    /// Iterations made: `convergence.svg`.
    Iteration,
    /// Wall-clock seconds since the run began: `convergence-timings.svg`.
    Seconds,
}

/// The quantity that converges, on a logarithmic axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ConvergenceY {
    /// E.
    Total,
    /// E − E*, E* the lowest of the panel; 0 where that is as good as 0.
    Excess,
    /// |∇E|.
    GradientNorm,
}

/// The largest number of iterations that a record keeps.
const MOST: usize = 150;

/// The iterations as `result.trace` and `timings.trace` have them: arrays of one length, at most
/// 150; of more iterations the first and the last, and those between evenly on a logarithmic axis.
/// Stages count on. `total`, the energy of the finished map, is that of the last one: solvers sum
/// it with other roundings.
pub fn trace(iterations: &[Traced], total: Option<f64>) -> (Value, Value) {
    let mut before = 0;
    let mut last = 0;
    let numbers: Vec<usize> = iterations
        .iter()
        .map(|t| {
            if t.iteration.number == 0 {
                before = last;
            }
            last = before + t.iteration.number;
            last
        })
        .collect();
    let kept = thinned(iterations.len());
    let of = |value: &dyn Fn(&Traced) -> f64| kept.iter().map(|&k| value(&iterations[k])).collect::<Vec<f64>>();
    let mut totals = of(&|t| t.iteration.total);
    if let (Some(last), Some(total)) = (totals.last_mut(), total) {
        *last = total;
    }
    let result = json!({
        "iteration": kept.iter().map(|&k| numbers[k]).collect::<Vec<usize>>(),
        "total": totals,
        "gradient_norm": of(&|t| t.iteration.gradient_norm),
    });
    (result, json!({ "seconds": of(&|t| t.seconds) }))
}

/// Indices below n, ascending: the first, the last, and at most [`MOST`] in all.
fn thinned(n: usize) -> Vec<usize> {
    if n <= MOST {
        return (0..n).collect();
    }
    let last = (n - 1) as f64;
    let mut kept: Vec<usize> =
        (0..MOST - 1).map(|k| last.powf(k as f64 / (MOST - 2) as f64).round() as usize).collect();
    kept.insert(0, 0);
    kept.dedup();
    kept
}

/// The part of `[figures]` that concerns all runs together.
#[derive(Deserialize)]
struct Figures {
    #[serde(default, deserialize_with = "one_or_more")]
    convergence: Vec<Convergence>,
}

/// The plots that `[figures] convergence` asks for, with their names. `swept`: the keys of the
/// sweep, and whether their values are words.
pub(super) fn plots(document: &Document, swept: &[(String, bool)]) -> Result<Vec<(String, PlotSpec)>, ConfigError> {
    let asked = document.optional::<Figures>("figures")?.map(|figures| figures.convergence).unwrap_or_default();
    Ok(asked.into_iter().map(|asked| (asked.name().to_owned(), asked.plot(swept))).collect())
}

impl Convergence {
    fn name(self) -> &'static str {
        match self.x {
            ConvergenceX::Iteration => "convergence",
            ConvergenceX::Seconds => "convergence-timings",
        }
    }

    fn plot(self, swept: &[(String, bool)]) -> PlotSpec {
        let (x, x_label) = match self.x {
            ConvergenceX::Iteration => ("result.trace.iteration", "iteration"),
            ConvergenceX::Seconds => ("timings.trace.seconds", "seconds since the run began"),
        };
        let (y, y_label) = match self.y {
            ConvergenceY::Total => ("result.trace.total", "energy E"),
            ConvergenceY::Excess => ("result.trace.total", "E − E*"),
            ConvergenceY::GradientNorm => ("result.trace.gradient_norm", "|∇E|"),
        };
        let mut rest: Vec<&(String, bool)> = swept.iter().collect();
        let curves = match swept.iter().position(|(key, _)| key == "solver.name") {
            Some(k) => Some(rest.remove(k)),
            None => rest.pop(),
        };
        let (by, label) = match curves {
            None => ("result.solver.backend".to_owned(), "{}".to_owned()),
            Some((key, true)) => (format!("config.{key}"), "{}".to_owned()),
            Some((key, false)) => {
                (format!("config.{key}"), format!("{} = {{}}", key.rsplit('.').next().unwrap_or(key)))
            }
        };
        let mut panels: Vec<String> = rest.into_iter().map(|(key, _)| format!("config.{key}")).collect();
        let columns = panels.split_off(panels.len().saturating_sub(1));
        let axis = |key: Option<&str>, label: &str| AxisSpec {
            key: key.map(str::to_owned),
            label: label.to_owned(),
            log: true,
            above_lowest: key.is_none() && self.y == ConvergenceY::Excess,
        };
        PlotSpec {
            title: match self.x {
                ConvergenceX::Iteration => "Convergence by iteration".to_owned(),
                ConvergenceX::Seconds => "Convergence in time".to_owned(),
            },
            x: axis(Some(x), x_label),
            y: axis(None, y_label),
            series: vec![SeriesSpec {
                y: y.to_owned(),
                by: Some(by),
                label,
                only: Default::default(),
                cloud: false,
                fit: None,
            }],
            only: Default::default(),
            reference: Vec::new(),
            panels: PanelSpec { rows: panels, columns },
        }
    }
}

/// One table, or an array of them.
pub(super) fn one_or_more<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Convergence>, D::Error> {
    struct OneOrMore;

    impl<'de> Visitor<'de> for OneOrMore {
        type Value = Vec<Convergence>;

        fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
            f.write_str("a table such as { x = \"iteration\", y = \"total\" }, or an array of these")
        }

        fn visit_map<M: MapAccess<'de>>(self, map: M) -> Result<Self::Value, M::Error> {
            Ok(vec![Convergence::deserialize(MapAccessDeserializer::new(map))?])
        }

        fn visit_seq<S: SeqAccess<'de>>(self, mut sequence: S) -> Result<Self::Value, S::Error> {
            let mut all = Vec::new();
            while let Some(one) = sequence.next_element::<Convergence>()? {
                if all.iter().any(|known: &Convergence| known.x == one.x) {
                    return Err(serde::de::Error::custom("two plots over the same x would have the same name"));
                }
                all.push(one);
            }
            Ok(all)
        }
    }

    deserializer.deserialize_any(OneOrMore)
}
