use tiny_skia::{PixmapPaint, Transform};

use super::drawing::{Anchor, Drawing};
use super::page::Page;
use super::raster::{blank_sheet, encode_png};
use super::{FigureError, FlatMap, SurfaceView, style, text};

/// A map, flat, on the left; its checkerboard on the surface on the right; a caption below.
///
/// The titles of both stand over them, and may be empty. The figure is as wide as a page, in twice as many pixels as other
/// figures, since both share its width.
#[derive(Clone, Copy, Debug)]
pub struct Pair<'a> {
    /// Left.
    pub flat: &'a FlatMap<'a>,
    /// Right.
    pub view: &'a SurfaceView<'a>,
    /// Longest side of either picture in units of paper; [`Pair::SIDE`] fills a page's width.
    pub side: f64,
    /// Below; may be empty. It is broken where it has line breaks, and where it is too long.
    pub caption: &'a str,
}

/// Pixels per unit of paper.
const ZOOM: usize = 2;

impl Pair<'_> {
    /// The side of a figure for a page.
    pub const SIDE: f64 = 640.0;

    /// The figure as the bytes of a PNG file.
    ///
    /// # Errors
    /// Those of both parts.
    pub fn render(&self) -> Result<Vec<u8>, FigureError> {
        let left = Page::of(self.flat, self.side)?.sheet(ZOOM)?;
        let title = if self.view.title.is_empty() { 0.0 } else { 2.0 * style::TITLE_LINE };
        let right =
            self.view.sheet([self.side + 2.0 * style::MARGIN, self.side + 2.0 * style::MARGIN + title], ZOOM)?;

        // The middles of both pictures are on one level.
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
            drawing.text([f64::from(width) / 2.0, y], Anchor::Middle, style::TEXT, line.as_str());
        }
        drawing.paint(&mut sheet, ZOOM);
        encode_png(&sheet, ZOOM as u32)
    }
}
