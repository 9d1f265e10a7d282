use std::fmt::Write as _;

use base64::Engine as _;
use tiny_skia::{FillRule, LineCap, Paint, PathBuilder, Pixmap, Stroke, Transform};

use super::colour::Colour;
use super::{style, text};

/// The position of a text's reference point along it.
#[derive(Clone, Copy, Debug)]
pub(super) enum TextAnchor {
    Start,
    Middle,
    End,
}

/// A shape on paper. Coordinates are pixels, y downward.
#[derive(Clone, Debug)]
pub(super) enum VectorShape {
    /// A polygon filled by the nonzero rule; the stroke is centred on the outline.
    Polygon { points: Vec<[f64; 2]>, fill: Colour, stroke: Option<(Colour, f64)> },
    /// Separate line segments in one style, with round ends or with ends cut at the end points.
    Segments { segments: Vec<[[f64; 2]; 2]>, colour: Colour, width: f64, round: bool },
    /// A text. `middle` is its reference point at half the height of capitals; `upward` rotates it
    /// by 90°.
    Text { middle: [f64; 2], anchor: TextAnchor, size: f64, upward: bool, text: String },
    /// A PNG file stretched over a rectangle. Used for SVG only: for PNG, pictures are drawn on the
    /// pixels.
    Picture { corner: [f64; 2], size: [f64; 2], png: Vec<u8> },
}

/// Shapes on a sheet, later ones over earlier ones. Both output formats are made from it.
#[derive(Clone, Debug, Default)]
pub(super) struct Drawing {
    pub(super) shapes: Vec<VectorShape>,
}

impl Drawing {
    pub(super) fn rectangle(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2], fill: Colour) {
        let points = vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        self.shapes.push(VectorShape::Polygon { points, fill, stroke: None });
    }

    pub(super) fn line(&mut self, a: [f64; 2], b: [f64; 2]) {
        self.shapes.push(VectorShape::Segments {
            segments: vec![[a, b]],
            colour: style::INK,
            width: style::LINE,
            round: false,
        });
    }

    pub(super) fn stroke(&mut self, a: [f64; 2], b: [f64; 2], colour: Colour, width: f64) {
        self.shapes.push(VectorShape::Segments { segments: vec![[a, b]], colour, width, round: false });
    }

    pub(super) fn frame(&mut self, [x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) {
        // Horizontal sides are drawn over the corners.
        let h = style::LINE / 2.0;
        let segments = vec![
            [[x0 - h, y0], [x1 + h, y0]],
            [[x0 - h, y1], [x1 + h, y1]],
            [[x0, y0], [x0, y1]],
            [[x1, y0], [x1, y1]],
        ];
        self.shapes.push(VectorShape::Segments { segments, colour: style::INK, width: style::LINE, round: false });
    }

    pub(super) fn text(&mut self, middle: [f64; 2], anchor: TextAnchor, size: f64, text: impl Into<String>) {
        self.shapes.push(VectorShape::Text { middle, anchor, size, upward: false, text: text.into() });
    }

    /// Draws text rotated to run upward, centred at `middle`.
    pub(super) fn upward(&mut self, middle: [f64; 2], size: f64, text: impl Into<String>) {
        self.shapes.push(VectorShape::Text {
            middle,
            anchor: TextAnchor::Middle,
            size,
            upward: true,
            text: text.into(),
        });
    }

    /// Renders the drawing as an SVG file on white paper.
    pub(super) fn to_svg(&self, width: u32, height: u32) -> String {
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{}\">\n\
             <rect width=\"{width}\" height=\"{height}\" fill=\"{}\"/>\n",
            style::SVG_FONTS,
            style::PAPER
        );
        for shape in &self.shapes {
            // Writing to a String cannot fail.
            let _ = write_svg(&mut svg, shape);
        }
        svg.push_str("</svg>\n");
        svg
    }

    /// Paints the drawing over the contents of `sheet`, at `zoom` pixels per unit of its
    /// coordinates.
    pub(super) fn paint(&self, sheet: &mut Pixmap, zoom: usize) {
        let zoom = Transform::from_scale(zoom as f32, zoom as f32);
        for shape in &self.shapes {
            paint(sheet, shape, zoom);
        }
    }
}

fn write_svg(svg: &mut String, shape: &VectorShape) -> std::fmt::Result {
    match shape {
        VectorShape::Polygon { points, fill, stroke } => {
            write!(svg, "<polygon fill=\"{fill}\"")?;
            if let Some((colour, width)) = stroke {
                write!(svg, " stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\"")?;
            }
            svg.push_str(" points=\"");
            for (i, p) in points.iter().enumerate() {
                write!(svg, "{}{} {}", if i == 0 { "" } else { "," }, Decimal(p[0]), Decimal(p[1]))?;
            }
            svg.push_str("\"/>\n");
        }
        VectorShape::Segments { segments, colour, width, round } => {
            write!(svg, "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"")?;
            svg.push_str(if *round { "round\" d=\"" } else { "butt\" d=\"" });
            for [a, b] in segments {
                write!(svg, "M{} {}L{} {}", Decimal(a[0]), Decimal(a[1]), Decimal(b[0]), Decimal(b[1]))?;
            }
            svg.push_str("\"/>\n");
        }
        VectorShape::Text { middle, anchor, size, upward, text } => {
            let anchor = match anchor {
                TextAnchor::Start => "start",
                TextAnchor::Middle => "middle",
                TextAnchor::End => "end",
            };
            let [x, y] = middle.map(Decimal);
            // The baseline is computed here, because viewers disagree about dominant-baseline.
            let shift = Decimal(text::CAP_HEIGHT / 2.0 * size);
            let turn = if *upward { " rotate(-90)" } else { "" };
            write!(svg, "<text transform=\"translate({x} {y}){turn}\" y=\"{shift}\" font-size=\"{size}\" ")?;
            writeln!(svg, "text-anchor=\"{anchor}\" fill=\"{}\">{}</text>", style::INK, escaped(text))?;
        }
        VectorShape::Picture { corner, size, png } => {
            let [x, y] = corner.map(Decimal);
            write!(svg, "<image x=\"{x}\" y=\"{y}\" width=\"{}\" height=\"{}\" ", Decimal(size[0]), Decimal(size[1]))?;
            svg.push_str("preserveAspectRatio=\"none\" href=\"data:image/png;base64,");
            base64::engine::general_purpose::STANDARD.encode_string(png, svg);
            svg.push_str("\"/>\n");
        }
    }
    Ok(())
}

/// A coordinate rounded to hundredths of a pixel, without trailing zeros, to keep SVG files small.
struct Decimal(f64);

impl std::fmt::Display for Decimal {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", (self.0 * 100.0).round() / 100.0 + 0.0)
    }
}

/// Escapes text as XML character data; characters that XML 1.0 forbids become U+FFFD.
fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '<' => xml.push_str("&lt;"),
            '>' => xml.push_str("&gt;"),
            '&' => xml.push_str("&amp;"),
            '\t' | '\n' | '\r' => xml.push(' '),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => xml.push('\u{fffd}'),
            _ => xml.push(c),
        }
    }
    xml
}

fn paint(sheet: &mut Pixmap, shape: &VectorShape, zoom: Transform) {
    let mut path = PathBuilder::new();
    match shape {
        VectorShape::Polygon { points, fill, stroke } => {
            for (i, [x, y]) in points.iter().enumerate() {
                if i == 0 { path.move_to(*x as f32, *y as f32) } else { path.line_to(*x as f32, *y as f32) }
            }
            path.close();
            let Some(path) = path.finish() else { return };
            sheet.fill_path(&path, &solid(*fill), FillRule::Winding, zoom, None);
            if let Some((colour, width)) = stroke {
                let stroke = Stroke { width: *width as f32, ..Stroke::default() };
                sheet.stroke_path(&path, &solid(*colour), &stroke, zoom, None);
            }
        }
        VectorShape::Segments { segments, colour, width, round } => {
            for [a, b] in segments {
                path.move_to(a[0] as f32, a[1] as f32);
                path.line_to(b[0] as f32, b[1] as f32);
            }
            let Some(path) = path.finish() else { return };
            let line_cap = if *round { LineCap::Round } else { LineCap::Butt };
            let stroke = Stroke { width: *width as f32, line_cap, ..Stroke::default() };
            sheet.stroke_path(&path, &solid(*colour), &stroke, zoom, None);
        }
        VectorShape::Text { middle, anchor, size, upward, text } => {
            let back = match anchor {
                TextAnchor::Start => 0.0,
                TextAnchor::Middle => 0.5,
                TextAnchor::End => 1.0,
            };
            let (along, below) = (-back * text::width(text, *size), text::CAP_HEIGHT / 2.0 * size);
            text::outlines(text, *size, &mut path);
            let Some(path) = path.finish() else { return };
            let turn = if *upward { -90.0 } else { 0.0 };
            let place = Transform::from_translate(along as f32, below as f32)
                .post_rotate(turn)
                .post_translate(middle[0] as f32, middle[1] as f32)
                .post_concat(zoom);
            sheet.fill_path(&path, &solid(style::INK), FillRule::Winding, place, None);
        }
        VectorShape::Picture { .. } => {}
    }
}

fn solid(Colour([r, g, b]): Colour) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(r, g, b, 255);
    paint.anti_alias = true;
    paint
}
