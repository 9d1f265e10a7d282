//! Colours and sizes shared by all figures. Lengths are pixels, 254 per inch on paper: text of 30
//! px prints at 8.5 pt, and a figure of 1600 px fills the text width of a page.

use super::colour::Colour;

/// Resolution written into PNG files: 254 pixels per inch.
pub(super) const PIXELS_PER_METRE: u32 = 10_000;

/// Colour of text, frame and ticks.
pub(super) const INK: Colour = Colour([32, 34, 38]);
/// Colour of the paper.
pub(super) const PAPER: Colour = Colour([255, 255, 255]);
/// Colour of mesh edges: visible on pale and on dark faces.
pub(super) const MESH: Colour = Colour([84, 84, 92]);
/// Colour of faces whose value exceeds the scale: darker than every colour on it.
pub const OVER: Colour = Colour([3, 19, 38]);
/// Colour of flipped faces: a hue that the colour map does not contain and that red- and
/// green-blind readers distinguish from it.
pub const ALARM: Colour = Colour([0, 205, 235]);

/// Colour of faces with large distortion, on a scale of greys or among the squares of a
/// checkerboard: darker than most of both, and of a hue that neither has.
pub const MARK: Colour = Colour([206, 22, 36]);

/// Margin around everything.
pub(super) const MARGIN: f64 = 32.0;
/// Longest side of the plot area.
pub(super) const PLOT: f64 = 1200.0;
/// Shortest side of the plot area: room for a colour bar and its label beside an elongated map.
pub(super) const PLOT_MIN: f64 = 480.0;
/// Space between the map and its frame.
pub(super) const PADDING: f64 = 24.0;
/// Width of frame and tick lines.
pub(super) const LINE: f64 = 2.0;
/// Length of a tick.
pub(super) const TICK: f64 = 10.0;
/// Distance between a tick and its label.
pub(super) const GAP: f64 = 8.0;
/// Size of tick labels and legends.
pub(super) const SMALL_TEXT: f64 = 28.0;
/// Size of labels of axes and scales.
pub(super) const TEXT: f64 = 31.0;
/// Size of titles.
pub(super) const TITLE: f64 = 38.0;
/// Distance between lines of the title, and from the last to the plot.
pub(super) const TITLE_LINE: f64 = 52.0;
/// Distance between lines of a caption.
pub(super) const CAPTION_LINE: f64 = 44.0;
/// Width of a colour bar.
pub(super) const BAR: f64 = 36.0;
/// Fonts requested from SVG viewers, best first; the last one always exists.
pub(super) const SVG_FONTS: &str = "Inter, Helvetica, Arial, sans-serif";
/// Factor by which the viewer's font can be wider (as DejaVu Sans is); SVG texts are set in that
/// font.
pub(super) const WIDER_FONT: f64 = 1.13;
