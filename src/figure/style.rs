//! Colours and sizes shared by all figures. Lengths are pixels; 254 pixels are one inch on paper, so that text of 30 px
//! prints at 8.5 pt and a figure 1600 px wide fills a page's text width.

use super::colour::Colour;

/// Pixels per metre, written into PNG files: 254 per inch.
pub(super) const PIXELS_PER_METRE: u32 = 10_000;

/// Text, frame and ticks.
pub(super) const INK: Colour = Colour([32, 34, 38]);
/// Paper.
pub(super) const PAPER: Colour = Colour([255, 255, 255]);
/// Edges of the mesh: visible on pale and on dark faces.
pub(super) const MESH: Colour = Colour([84, 84, 92]);
/// Faces whose value exceeds the scale: darker than every colour on it.
pub const OVER: Colour = Colour([3, 19, 38]);
/// Flipped faces: a hue that the colour map does not contain, told from it also by red- and green-blind readers.
pub const ALARM: Colour = Colour([0, 205, 235]);

/// Faces whose error is to be seen at once, on a scale of greys or among the squares of a checkerboard: darker than most of
/// both, and of a hue that neither has.
pub const MARK: Colour = Colour([206, 22, 36]);

/// Around everything.
pub(super) const MARGIN: f64 = 32.0;
/// Longest side of the plot area.
pub(super) const PLOT: f64 = 1200.0;
/// Shortest side of the plot area: room for a colour bar and its label beside an elongated map.
pub(super) const PLOT_MIN: f64 = 480.0;
/// Between the map and its frame.
pub(super) const PADDING: f64 = 24.0;
/// Width of frame and tick lines.
pub(super) const LINE: f64 = 2.0;
/// Length of a tick.
pub(super) const TICK: f64 = 10.0;
/// Between a tick and its label.
pub(super) const GAP: f64 = 8.0;
/// Tick labels and legends.
pub(super) const SMALL_TEXT: f64 = 28.0;
/// Labels of axes and scales.
pub(super) const TEXT: f64 = 31.0;
/// Titles.
pub(super) const TITLE: f64 = 38.0;
/// From one line of the title to the next, and from the last to the plot.
pub(super) const TITLE_LINE: f64 = 52.0;
/// From one line of a caption to the next.
pub(super) const CAPTION_LINE: f64 = 44.0;
/// Width of a colour bar.
pub(super) const BAR: f64 = 36.0;
/// What an SVG viewer is asked for, best first; the last one always exists.
pub(super) const SVG_FONTS: &str = "Inter, Helvetica, Arial, sans-serif";
/// Texts of an SVG are set in the viewer's own font, which may be wider by as much (DejaVu Sans is).
pub(super) const WIDER_FONT: f64 = 1.13;
