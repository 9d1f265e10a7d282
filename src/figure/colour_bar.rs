use super::colour::{Colour, error_colour, grey};
use super::drawing::{Drawing, TextAnchor, VectorShape};
use super::scale::Scale;
use super::{style, text};

/// The colours of a scale.
#[derive(Clone, Copy)]
pub(super) struct Colours {
    /// The colour of t ∈ [0, 1].
    pub(super) on_scale: fn(f64) -> Colour,
    /// The colour of values beyond the scale.
    pub(super) beyond: Colour,
}

impl Colours {
    /// The colour map for distortion.
    pub(super) const PLAIN: Colours = Colours { on_scale: error_colour, beyond: style::OVER };
    /// Greys, with [`style::MARK`] beyond the scale.
    pub(super) const MARKED: Colours = Colours { on_scale: grey, beyond: style::MARK };
}

/// The colour bar of a [`Scale`], to the right of a plot.
///
/// It has an arrow head for values beyond the scale, tick marks, a label, and a legend for flipped
/// faces.
pub(super) struct ColourBar {
    ticks: Vec<(f64, String)>,
    /// The label of the arrow head.
    beyond: Option<String>,
    label: String,
    colours: Colours,
    /// The label of the swatch for flipped faces.
    flipped: Option<String>,
}

/// Distance from the plot area to the bar.
const DISTANCE: f64 = 44.0;
/// Height of the arrow head, such that its label clears that of the bar's upper end.
const HEAD: f64 = 46.0;
/// Side of the legend's swatch.
const SWATCH: f64 = style::BAR;
/// Number of strips of different colour: more than there are colours.
const STRIPS: usize = 400;

impl ColourBar {
    pub(super) fn new(scale: &Scale, colours: Colours, label: &str, flipped: usize) -> ColourBar {
        ColourBar {
            ticks: scale.ticks(),
            beyond: scale.exceeded().then(|| format!("> {}", scale.upper_label())),
            label: label.to_owned(),
            colours,
            flipped: match flipped {
                0 => None,
                1 => Some("1 flipped face".to_owned()),
                n => Some(format!("{n} flipped faces")),
            },
        }
    }

    /// The distance from the plot area to the right end of all text.
    pub(super) fn width(&self) -> f64 {
        let label = if self.label.is_empty() { 0.0 } else { 2.0 * style::GAP + style::TEXT };
        let legend = self.flipped.as_ref().map_or(0.0, |l| 1.5 * style::GAP + text::width(l, style::SMALL_TEXT));
        DISTANCE + style::BAR + style::WIDER_FONT * legend.max(self.tick_width() + label)
    }

    fn tick_width(&self) -> f64 {
        let labels = self.ticks.iter().map(|(_, l)| l).chain(&self.beyond);
        style::TICK + style::GAP + labels.map(|l| text::width(l, style::SMALL_TEXT)).fold(0.0, f64::max)
    }

    /// Draws the bar beside a plot whose upper right corner is `corner`.
    pub(super) fn draw(&self, corner: [f64; 2], height: f64, drawing: &mut Drawing) {
        let (left, right) = (corner[0] + DISTANCE, corner[0] + DISTANCE + style::BAR);
        let text_left = right + style::TICK + style::GAP;
        let mut top = corner[1];
        let mut bottom = corner[1] + height;
        if let Some(legend) = &self.flipped {
            drawing.rectangle([left, bottom - SWATCH], [right, bottom], style::ALARM);
            drawing.frame([left, bottom - SWATCH], [right, bottom]);
            let middle = [right + 1.5 * style::GAP, bottom - SWATCH / 2.0];
            drawing.text(middle, TextAnchor::Start, style::SMALL_TEXT, legend.as_str());
            bottom -= 2.0 * SWATCH;
        }
        if let Some(beyond) = &self.beyond {
            let points = vec![[left, top + HEAD], [(left + right) / 2.0, top], [right, top + HEAD]];
            let stroke = Some((style::INK, style::LINE));
            drawing.shapes.push(VectorShape::Polygon { points, fill: self.colours.beyond, stroke });
            drawing.text(
                [text_left, top + HEAD - 1.25 * style::SMALL_TEXT],
                TextAnchor::Start,
                style::SMALL_TEXT,
                beyond.as_str(),
            );
            top += HEAD;
        }
        let length = bottom - top;
        // Each strip extends down to the bottom and is covered by the next, so that there are no
        // seams.
        for i in (0..STRIPS).rev() {
            let upper = (bottom - length * (i + 1) as f64 / STRIPS as f64).round();
            let t = (i as f64 + 0.5) / STRIPS as f64;
            drawing.rectangle([left, upper], [right, bottom], (self.colours.on_scale)(t));
        }
        drawing.frame([left, top], [right, bottom]);
        for (t, label) in &self.ticks {
            let y = (bottom - length * t).round();
            drawing.line([right, y], [right + style::TICK, y]);
            drawing.text([text_left, y], TextAnchor::Start, style::SMALL_TEXT, label.as_str());
        }
        if !self.label.is_empty() {
            let x = right + self.tick_width() + 2.0 * style::GAP + style::TEXT / 2.0;
            let size = style::TEXT.min(style::TEXT * height / (1.1 * text::width(&self.label, style::TEXT)).max(1.0));
            drawing.shapes.push(VectorShape::Text {
                middle: [x, (top + bottom) / 2.0],
                anchor: TextAnchor::Middle,
                size,
                upward: true,
                text: self.label.clone(),
            });
        }
    }
}
