use std::ops::Range;

use plotters::coord::ranged1d::{KeyPointHint, NoDefaultFormatting, Ranged, ValueFormatter};

use crate::figure::FigureError;
use crate::figure::frame::{labeller, round_step};
use crate::figure::scale::exponent_label;

/// The visible range of an axis with its ticks, as plotters requires it.
#[derive(Clone, Debug)]
pub(super) struct Ruler {
    low: f64,
    high: f64,
    log: bool,
    /// Values with a label and a grid line.
    major: Vec<(f64, String)>,
    /// Values with a thin grid line.
    minor: Vec<f64>,
}

/// Space between the outermost points and the frame, relative to the length of the axis.
const ROOM: f64 = 0.06;
/// Approximate number of labels on an axis.
const LABELS: f64 = 7.0;
/// Shortest range of an axis, in decades or relative to its values.
const NARROWEST: f64 = 1e-6;
/// Shortest range in absolute terms, so that steps between ticks are normal numbers.
const SMALLEST: f64 = 1e-300;
/// Ranges of at least this many decades have labels only at powers of ten.
const DECADES: f64 = 2.2;

impl Ruler {
    /// Makes an axis that shows `values`, which must be finite, and positive if `log`.
    pub(super) fn around(values: impl Iterator<Item = f64> + Clone, log: bool) -> Result<Ruler, FigureError> {
        let low = values.clone().fold(f64::INFINITY, f64::min);
        let high = values.fold(f64::NEG_INFINITY, f64::max);
        if low > high {
            return Err(FigureError::NoPoints);
        }
        let (from, to) = if log { (low.log10(), high.log10()) } else { (low, high) };
        let extent = match to - from {
            // A single value is in the middle of a decade, or of an interval of its own size.
            0.0 if log => 1.0,
            0.0 if to != 0.0 => to.abs(),
            0.0 => 1.0,
            // Values that differ by less are drawn as one, because labels could not distinguish
            // them.
            extent => extent.max(if log { NARROWEST } else { NARROWEST * from.abs().max(to.abs()) }),
        };
        let narrow = (extent - (to - from)).max(0.0) / 2.0;
        // A range that begins at zero does not extend far below zero.
        let (below, above) = if !log && low == 0.0 { (0.02, 2.0 * narrow) } else { (ROOM, narrow) };
        let (from, to) = (from + above - 2.0 * narrow - below * extent, to + above + ROOM * extent);
        let (low, high) = if log { (10f64.powf(from), 10f64.powf(to)) } else { (from, to) };
        let spread = if log { to - from } else { high - low };
        if !(low.is_finite() && high.is_finite() && spread.is_finite() && spread > SMALLEST && (!log || low > 0.0)) {
            return Err(FigureError::PlotRange { low, high });
        }
        let mut ruler = Ruler { low, high, log, major: Vec::new(), minor: Vec::new() };
        match (log, to - from) {
            (true, decades) if decades >= DECADES => ruler.mark_decades(decades),
            (true, _) => ruler.mark_mantissas(),
            (false, _) => ruler.mark_evenly(),
        }
        Ok(ruler)
    }

    /// Places ticks at powers of ten, thinned to about [`LABELS`], and minor ticks at 2 … 9 of each
    /// decade or at the powers left out.
    fn mark_decades(&mut self, decades: f64) {
        let step = (decades / LABELS).ceil().max(1.0) as i32;
        for power in self.low.log10().floor() as i32..=self.high.log10().ceil() as i32 {
            let value = 10f64.powi(power);
            if power.rem_euclid(step) == 0 {
                self.major.push((value, exponent_label(value, 0)));
            } else {
                self.minor.push(value);
            }
            if step == 1 {
                self.minor.extend((2..10).map(|m| f64::from(m) * value));
            }
        }
        self.keep_visible();
    }

    /// Places ticks at round mantissas, more of them for fewer decades; in even steps within half a
    /// decade.
    fn mark_mantissas(&mut self) {
        let powers = self.low.log10().floor() as i32..=self.high.log10().ceil() as i32;
        for mantissas in [&[1.0, 2.0, 5.0][..], &[1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0]] {
            let values = powers.clone().flat_map(|p| mantissas.iter().map(move |m| m * 10f64.powi(p)));
            self.major = values.map(|v| (v, plain(v))).collect();
            self.keep_visible();
            if self.major.len() >= 4 {
                break;
            }
        }
        if self.major.len() < 3 {
            self.mark_evenly();
            return;
        }
        self.minor = powers.flat_map(|p| (1..10).map(move |m| f64::from(m) * 10f64.powi(p))).collect();
        self.keep_visible();
    }

    fn mark_evenly(&mut self) {
        let step = round_step((self.high - self.low) / LABELS);
        let label = labeller(self.low.abs().max(self.high.abs()), step);
        let first = (self.low / step).ceil();
        // The choice of the step keeps the count small; the bound is for offsets that absorb it.
        let values: Vec<f64> = (0..20).map(|i| (first + f64::from(i)) * step).collect();
        self.minor = values.iter().map(|v| v - step / 2.0).collect();
        self.major = values.into_iter().map(|v| (v, label(v))).collect();
        self.keep_visible();
    }

    fn keep_visible(&mut self) {
        let range = self.low..=self.high;
        self.major.retain(|(v, _)| range.contains(v));
        self.minor.retain(|v| range.contains(v));
    }

    pub(super) fn labels(&self) -> impl Iterator<Item = &str> {
        self.major.iter().map(|(_, label)| label.as_str())
    }

    /// The position of `value` on the axis, from 0 to 1.
    fn position(&self, value: f64) -> f64 {
        if self.log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        }
    }
}

fn plain(value: f64) -> String {
    if (1e-3..1e4).contains(&value) {
        // Two significant digits, or one if that is exact.
        let decimals = (1 - value.log10().floor() as i32).max(0) as usize;
        let text = format!("{value:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    } else {
        exponent_label(value, usize::from(format!("{value:.1e}").contains(".5")))
    }
}

impl Ranged for Ruler {
    type FormatOption = NoDefaultFormatting;
    type ValueType = f64;

    fn map(&self, value: &f64, (from, to): (i32, i32)) -> i32 {
        from + (f64::from(to - from) * self.position(*value)).round() as i32
    }

    fn key_points<H: KeyPointHint>(&self, hint: H) -> Vec<f64> {
        let major = self.major.iter().map(|(v, _)| *v);
        if hint.weight().allow_light_points() {
            self.minor.iter().copied().chain(major).collect()
        } else {
            major.collect()
        }
    }

    fn range(&self) -> Range<f64> {
        self.low..self.high
    }
}

impl ValueFormatter<f64> for Ruler {
    fn format_ext(&self, value: &f64) -> String {
        self.major.iter().find(|(v, _)| v == value).map(|(_, label)| label.clone()).unwrap_or_default()
    }
}
