use super::drawing::{Anchor, Drawing};
use super::scale::{decimals_of, exponent_label};
use super::{FigureError, style, text};

/// Plane → paper with the same scale on both axes, y upward in the plane, downward on paper.
///
/// The plot area begins at the paper's origin and is as large as the map at the largest scale that its longest side
/// admits, though never shorter than `style::PLOT_MIN`; then the map is centred in it.
#[derive(Clone, Debug)]
pub(super) struct Frame {
    /// Pixels.
    pub(super) size: [f64; 2],
    /// Middle of the map in the plane.
    centre: [f64; 2],
    /// Pixels per unit.
    scale: f64,
    /// Between ticks, the same on both axes, in units.
    step: f64,
}

/// Beyond this extent sums of coordinates may overflow.
const LARGEST_EXTENT: f64 = 1e300;

impl Frame {
    /// The frame of a map with the given bounding box, its longer side as given.
    pub(super) fn around(low: [f64; 2], high: [f64; 2], longest: f64) -> Result<Frame, FigureError> {
        let (width, height) = (high[0] - low[0], high[1] - low[1]);
        // A NaN fails this too.
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
        // The longer axis gets about seven ticks, the shorter one two at least if a finer step gives them.
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

    /// A point of the plane on paper.
    pub(super) fn place(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.size[0] / 2.0 + (x - self.centre[0]) * self.scale, self.size[1] / 2.0 - (y - self.centre[1]) * self.scale]
    }

    /// Round coordinates of axis `k` within the frame, as pixels and labels.
    pub(super) fn ticks(&self, k: usize) -> Vec<(f64, String)> {
        let half = self.size[k] / 2.0 / self.scale;
        let (low, high) = (self.centre[k] - half, self.centre[k] + half);
        let step = self.step;
        let label = labeller(low.abs().max(high.abs()), step);
        let first = (low / step).ceil();
        let mut ticks: Vec<(f64, String)> = Vec::new();
        // The count is small by the choice of the step; the bound is for offsets that swamp the step.
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

    /// Room that the labels of the y axis need left of the frame.
    pub(super) fn label_width(&self) -> f64 {
        let widest = self.ticks(1).iter().map(|(_, l)| text::width(l, style::SMALL_TEXT)).fold(0.0, f64::max);
        style::TICK + style::GAP + style::WIDER_FONT * widest
    }

    /// Room that the labels of the x axis need below the frame.
    pub(super) fn label_height() -> f64 {
        style::TICK + style::GAP + style::SMALL_TEXT
    }

    /// Draws the frame with coordinates; its upper left corner is at `corner`.
    pub(super) fn draw(&self, corner: [f64; 2], drawing: &mut Drawing) {
        let [left, top] = corner;
        let (right, bottom) = (left + self.size[0], top + self.size[1]);
        drawing.frame(corner, [right, bottom]);
        let mut free_from = f64::NEG_INFINITY;
        for (at, label) in self.ticks(0) {
            let x = left + at.round();
            drawing.line([x, bottom], [x, bottom + style::TICK]);
            // A label that would touch its neighbour is left out, its tick stays.
            let half = text::width(&label, style::SMALL_TEXT) / 2.0;
            if x - half >= free_from {
                free_from = x + half + 0.6 * style::SMALL_TEXT;
                let y = bottom + style::TICK + style::GAP + style::SMALL_TEXT / 2.0;
                drawing.text([x, y], Anchor::Middle, style::SMALL_TEXT, label);
            }
        }
        for (at, label) in self.ticks(1) {
            let y = top + at.round();
            drawing.line([left - style::TICK, y], [left, y]);
            drawing.text([left - style::TICK - style::GAP, y], Anchor::End, style::SMALL_TEXT, label);
        }
    }
}

/// The smallest of 1, 2, 2.5, 5 × power of ten that is not below `wanted`.
pub(super) fn round_step(wanted: f64) -> f64 {
    let power = 10f64.powf(wanted.log10().floor());
    [1.0, 2.0, 2.5, 5.0].into_iter().map(|m| m * power).find(|s| *s >= wanted).unwrap_or(10.0 * power)
}

/// Writes multiples of `step` up to `largest` with just the digits that tell them apart.
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

/// Decimals of a mantissa that tell multiples of `step` of size `largest` apart: at most what a double holds.
fn digits_apart(largest: f64, step: f64) -> usize {
    (0..16).find(|d| 10f64.powi(*d) * step >= largest / 10.0 * 0.999).map_or(16, |d| d as usize + 1)
}
