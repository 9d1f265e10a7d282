use super::drawing::{Drawing, TextAnchor};
use super::scale::{decimals_of, exponent_label};
use super::{FigureError, style, text};

/// A transformation from the plane to paper with equal units on both axes; y points upward in the
/// plane and downward on paper.
///
/// The plot area begins at the paper's origin. Its longer side is given, and its shorter side is at
/// least `style::PLOT_MIN`; the map is centred in it.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Size of the plot area in pixels.
    pub(super) size: [f64; 2],
    /// Centre of the map in the plane.
    centre: [f64; 2],
    /// Pixels per unit.
    scale: f64,
    /// Distance between ticks in units of the plane, equal on both axes.
    step: f64,
}

/// Largest extent for which sums of coordinates cannot overflow.
const LARGEST_EXTENT: f64 = 1e300;

impl Frame {
    /// Makes the frame of a map with the given bounding box; its longer side has `longest` pixels.
    pub(super) fn around(low: [f64; 2], high: [f64; 2], longest: f64) -> Result<Frame, FigureError> {
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        // This fails for NaN too.
        if !(width <= LARGEST_EXTENT && height <= LARGEST_EXTENT) {
            return Err(FigureError::Extent { width, height });
        }
        let room = longest - 2.0 * style::PADDING;
        let scale = room / width.max(height);
        if !scale.is_finite() {
            return Err(FigureError::NoExtent { x: low[0], y: low[1] });
        }
        let side = |extent: f64| (extent * scale + 2.0 * style::PADDING).max(style::PLOT_MIN).round();
        let centre = [0, 1].map(|k| low[k] / 2.0 + high[k] / 2.0);
        let mut frame = Frame { size: [side(width), side(height)], centre, scale, step: 0.0 };
        // The longer axis gets about seven ticks, the shorter one at least two if a finer step
        // allows it.
        let mut spacing = frame.size[0].max(frame.size[1]) / 7.0;
        for _ in 0..3 {
            frame.step = round_step(spacing / scale);
            if (0..2).all(|k| frame.ticks(k).len() >= 2) {
                break;
            }
            spacing = frame.step * scale / 2.1;
        }
        Ok(frame)
    }

    /// Transforms a point of the plane to paper.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.size[0] / 2.0 + (x - self.centre[0]) * self.scale, self.size[1] / 2.0 - (y - self.centre[1]) * self.scale]
    }

    /// Returns the ticks of axis `k`, as pixels and labels.
    pub(super) fn ticks(&self, k: usize) -> Vec<(f64, String)> {
        let half = self.size[k] / 2.0 / self.scale;
        let (low, high) = (self.centre[k] - half, self.centre[k] + half);
        let step = self.step;
        let label = labeller(low.abs().max(high.abs()), step);
        let first = (low / step).ceil();
        let mut ticks: Vec<(f64, String)> = Vec::new();
        // The choice of the step keeps the count small; the bound is for offsets that absorb the
        // step.
        for i in 0..20 {
            let value = (first + f64::from(i)) * step;
            if value > high {
                break;
            }
            let at = self.place([value; 2])[k];
            if ticks.last().is_none_or(|(last, _)| (at - last).abs() > 1.0) {
                ticks.push((at, label(value)));
            }
        }
        ticks
    }

    /// The width needed for the labels of the y axis, left of the frame.
    pub(super) fn label_width(&self) -> f64 {
        let widest = self.ticks(1).iter().map(|(_, l)| text::width(l, style::SMALL_TEXT)).fold(0.0, f64::max);
        style::TICK + style::GAP + style::WIDER_FONT * widest
    }

    /// The height needed for the labels of the x axis, below the frame.
    pub(super) fn label_height() -> f64 {
        style::TICK + style::GAP + style::SMALL_TEXT
    }

    /// Draws the frame with its coordinates; its upper left corner is at `corner`.
    pub(super) fn draw(&self, corner: [f64; 2], drawing: &mut Drawing) {
        let [left, top] = corner;
        let (right, bottom) = (left + self.size[0], top + self.size[1]);
        drawing.frame(corner, [right, bottom]);
        let mut free_from = f64::NEG_INFINITY;
        for (at, label) in self.ticks(0) {
            let x = left + at.round();
            drawing.line([x, bottom], [x, bottom + style::TICK]);
            // A label that would touch its neighbour is omitted; its tick remains.
            let half = text::width(&label, style::SMALL_TEXT) / 2.0;
            if x - half >= free_from {
                free_from = x + half + 0.6 * style::SMALL_TEXT;
                let y = bottom + style::TICK + style::GAP + style::SMALL_TEXT / 2.0;
                drawing.text([x, y], TextAnchor::Middle, style::SMALL_TEXT, label);
            }
        }
        for (at, label) in self.ticks(1) {
            let y = top + at.round();
            drawing.line([left - style::TICK, y], [left, y]);
            drawing.text([left - style::TICK - style::GAP, y], TextAnchor::End, style::SMALL_TEXT, label);
        }
    }
}

/// Returns the smallest number of the form 1, 2, 2.5, 5 × power of ten that is at least `wanted`.
pub(super) fn round_step(wanted: f64) -> f64 {
    let power = 10f64.powf(wanted.log10().floor());
    [1.0, 2.0, 2.5, 5.0].into_iter().map(|m| m * power).find(|s| *s >= wanted).unwrap_or(10.0 * power)
}

/// Formats multiples of `step` up to `largest` with as many digits as distinguish them.
pub(super) fn labeller(largest: f64, step: f64) -> impl Fn(f64) -> String {
    let plain = (1e-3..1e5).contains(&largest);
    let digits = if plain { decimals_of(step) } else { digits_apart(largest, step) };
    move |value| {
        // Multiples of the step that are zero up to rounding.
        if value.abs() < step / 2.0 {
            "0".to_owned()
        } else if plain {
            format!("{value:.digits$}").replace('-', "−")
        } else {
            exponent_label(value, digits)
        }
    }
}

/// Number of decimals of a mantissa that distinguish multiples of `step` of size `largest`; at most
/// the precision of a double.
fn digits_apart(largest: f64, step: f64) -> usize {
    (0..16).find(|d| 10f64.powi(*d) * step >= largest / 10.0 * 0.999).map_or(16, |d| d as usize + 1)
}
