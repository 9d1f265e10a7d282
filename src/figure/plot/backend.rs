use std::convert::Infallible;

use plotters_backend::text_anchor::VPos;
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontTransform,
    text_anchor::HPos,
};

use crate::figure::colour::Colour;
use crate::figure::drawing::{Drawing, TextAnchor, VectorShape};
use crate::figure::{style, text};

/// Units of plotters' integer coordinates per pixel of paper: plots are positioned to a sixteenth
/// of a pixel.
pub(super) const FINE: f64 = 16.0;

type Done = Result<(), DrawingErrorKind<Infallible>>;

/// A backend with which plotters draws on a [`Drawing`], so that plots have the font, the SVG
/// output and the anti-aliasing of all figures.
pub(super) struct PlotSheet<'a> {
    pub(super) drawing: &'a mut Drawing,
    /// Size in pixels of paper.
    pub(super) size: [f64; 2],
}

/// Converts pixels of paper to units of plotters.
pub(super) fn fine(pixels: f64) -> i32 {
    (pixels * FINE).round() as i32
}

pub(super) fn place((x, y): BackendCoord) -> [f64; 2] {
    [f64::from(x) / FINE, f64::from(y) / FINE]
}

/// Blends a transparent colour with white paper, because drawings have only opaque colours.
fn colour(BackendColor { alpha, rgb: (r, g, b) }: BackendColor) -> Colour {
    let Colour(paper) = style::PAPER;
    let mix = |c: u8, p: u8| (f64::from(c) * alpha + f64::from(p) * (1.0 - alpha)).round() as u8;
    Colour([mix(r, paper[0]), mix(g, paper[1]), mix(b, paper[2])])
}

impl PlotSheet<'_> {
    fn segments(&mut self, points: impl IntoIterator<Item = BackendCoord>, colour: Colour, width: u32) {
        let points: Vec<[f64; 2]> = points.into_iter().map(place).collect();
        let segments = points.windows(2).map(|w| [w[0], w[1]]).collect();
        // Curves have round ends and joints; axes and grid lines are cut at their ends.
        let round = points.len() > 2;
        self.drawing.shapes.push(VectorShape::Segments { segments, colour, width: f64::from(width) / FINE, round });
    }
}

impl DrawingBackend for PlotSheet<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        let [width, height] = self.size.map(|s| fine(s).unsigned_abs());
        (width, height)
    }

    fn ensure_prepared(&mut self) -> Done {
        Ok(())
    }

    fn present(&mut self) -> Done {
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, pixel: BackendColor) -> Done {
        let [x, y] = place(point);
        self.drawing.rectangle([x, y], [x + 1.0 / FINE, y + 1.0 / FINE], colour(pixel));
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Done {
        self.segments([from, to], colour(style.color()), style.stroke_width());
        Ok(())
    }

    fn draw_rect<S: BackendStyle>(&mut self, a: BackendCoord, b: BackendCoord, style: &S, fill: bool) -> Done {
        if fill {
            self.drawing.rectangle(place(a), place(b), colour(style.color()));
        } else {
            self.segments([a, (b.0, a.1), b, (a.0, b.1), a], colour(style.color()), style.stroke_width());
        }
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        self.segments(path, colour(style.color()), style.stroke_width());
        Ok(())
    }

    fn fill_polygon<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(&mut self, path: I, style: &S) -> Done {
        let points = path.into_iter().map(place).collect();
        self.drawing.shapes.push(VectorShape::Polygon { points, fill: colour(style.color()), stroke: None });
        Ok(())
    }

    fn draw_text<T: BackendTextStyle>(&mut self, text: &str, style: &T, at: BackendCoord) -> Done {
        let size = style.size() / FINE;
        let anchor = match style.anchor().h_pos {
            HPos::Left => TextAnchor::Start,
            HPos::Center => TextAnchor::Middle,
            HPos::Right => TextAnchor::End,
        };
        let below = match style.anchor().v_pos {
            VPos::Top => size / 2.0,
            VPos::Center => 0.0,
            VPos::Bottom => -size / 2.0,
        };
        let [x, y] = place(at);
        let upward = matches!(style.transform(), FontTransform::Rotate270);
        // The top of a text that runs upward is its left side.
        let middle = if upward { [x + below, y] } else { [x, y + below] };
        self.drawing.shapes.push(VectorShape::Text { middle, anchor, size, upward, text: text.to_owned() });
        Ok(())
    }

    fn estimate_text_size<T: BackendTextStyle>(
        &self,
        text: &str,
        style: &T,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        Ok((text::width(text, style.size()).ceil() as u32, style.size().ceil() as u32))
    }
}
