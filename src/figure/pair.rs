use tiny_skia::{PixmapPaint, Transform};

use super::drawing::{Drawing, TextAnchor};
use super::flat_page::FlatPage;
use super::raster::{blank_sheet, encode_png};
use super::{FigureError, FlatMap, SurfaceView, style, text};

/// A flat map on the left, its checkerboard on the surface on the right, and a caption below.
///
/// The titles of both are above them, and can be empty. The figure has the width of a page and
/// twice the resolution of other figures, because the parts share the width.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// The left part.
    pub flat: &'a FlatMap<'a>,
    /// The right part.
    pub view: &'a SurfaceView<'a>,
    /// Longest side of either picture, in units of paper; [`Pair::SIDE`] fills the width of a page.
    pub side: f64,
    /// Text below; possibly empty. It is broken at line breaks and where it is too long.
    pub caption: &'a str,
}

/// Pixels per unit of paper.
const ZOOM: usize = 2;

impl Pair<'_> {
    /// The value of `side` for a figure of page width.
    pub const SIDE: f64 = 640.0;

    /// Renders the figure to the bytes of a PNG file.
    ///
    /// # Errors
    /// Errors of both parts.
    pub fn render(&self) -> Result<Vec<u8>, FigureError> {
        let left = FlatPage::of(self.flat, self.side)?.sheet(ZOOM)?;
        let title = if self.view.title.is_empty() { 0.0 } else { 2.0 * style::TITLE_LINE };
        let right =
            self.view.sheet([self.side + 2.0 * style::MARGIN, self.side + 2.0 * style::MARGIN + title], ZOOM)?;

        // The centres of both pictures are at the same height.
        let level = left.middle.max(right.middle);
        let tops = [&left, &right].map(|part| ((level - part.middle) * ZOOM as f64).round() as u32);
        let bottom = (tops[0] + left.pixels.height()).max(tops[1] + right.pixels.height()).div_ceil(ZOOM as u32);
        let width = (left.pixels.width() + right.pixels.width()).div_ceil(ZOOM as u32);
        let room = f64::from(width) - 2.0 * style::MARGIN;
        let lines: Vec<String> =
            self.caption.lines().flat_map(|line| text::wrap(line, style::TEXT, room, usize::MAX)).collect();
        let below = lines.len() as f64 * style::CAPTION_LINE;
        let height = bottom + below as u32;

        let mut sheet = blank_sheet(width * ZOOM as u32, height * ZOOM as u32)?;
        let (paint, here) = (PixmapPaint::default(), Transform::identity());
        sheet.draw_pixmap(0, tops[0] as i32, left.pixels.as_ref(), &paint, here, None);
        sheet.draw_pixmap(left.pixels.width() as i32, tops[1] as i32, right.pixels.as_ref(), &paint, here, None);
        let mut drawing = Drawing::default();
        for (i, line) in lines.iter().enumerate() {
            let y = f64::from(bottom) + (i as f64 + 0.2) * style::CAPTION_LINE;
            drawing.text([f64::from(width) / 2.0, y], TextAnchor::Middle, style::TEXT, line.as_str());
        }
        drawing.paint(&mut sheet, ZOOM);
        encode_png(&sheet, ZOOM as u32)
    }
}
