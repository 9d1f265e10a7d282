use std::sync::OnceLock;

use tiny_skia::PathBuilder;
use ttf_parser::{Face, OutlineBuilder};

/// Inter Regular, reduced to Latin, Greek, superscripts and mathematical signs; SIL Open Font
/// License, see font/OFL.txt.
static INTER: &[u8] = include_bytes!("font/Inter-Regular-subset.otf");

/// Height of capitals and digits in units of the text size.
pub(super) const CAP_HEIGHT: f64 = 2048.0 / 2816.0;

/// The embedded font; `None` only if the embedded bytes were damaged, which a test excludes.
fn inter() -> Option<&'static Face<'static>> {
    static FACE: OnceLock<Option<Face<'static>>> = OnceLock::new();
    FACE.get_or_init(|| Face::parse(INTER, 0).ok()).as_ref()
}

/// The width of `text` at `size`, in pixels.
pub(super) fn width(text: &str, size: f64) -> f64 {
    let Some(face) = inter() else { return 0.6 * size * text.chars().count() as f64 };
    let advance: f64 = text.chars().map(|c| f64::from(advance(face, c))).sum();
    advance * size / f64::from(face.units_per_em())
}

/// Appends the outlines of `text` at `size`, with its baseline along +x from the origin, y
/// downward.
pub(super) fn outlines(text: &str, size: f64, path: &mut PathBuilder) {
    let Some(face) = inter() else { return };
    let scale = size as f32 / f32::from(face.units_per_em());
    let mut pen = Pen { path, scale, x: 0.0 };
    for c in text.chars() {
        // Glyph 0 is the box for missing characters.
        let glyph = face.glyph_index(c).unwrap_or_default();
        face.outline_glyph(glyph, &mut pen);
        pen.x += f32::from(advance(face, c)) * scale;
    }
}

fn advance(face: &Face, c: char) -> u16 {
    face.glyph_hor_advance(face.glyph_index(c).unwrap_or_default()).unwrap_or(0)
}

struct Pen<'a> {
    path: &'a mut PathBuilder,
    scale: f32,
    x: f32,
}

impl Pen<'_> {
    fn at(&self, x: f32, y: f32) -> (f32, f32) {
        (self.x + x * self.scale, -y * self.scale)
    }
}

impl OutlineBuilder for Pen<'_> {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.at(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let ((x1, y1), (x, y)) = (self.at(x1, y1), self.at(x, y));
        self.path.quad_to(x1, y1, x, y);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let ((x1, y1), (x2, y2), (x, y)) = (self.at(x1, y1), self.at(x2, y2), self.at(x, y));
        self.path.cubic_to(x1, y1, x2, y2, x, y);
    }

    fn close(&mut self) {
        self.path.close();
    }
}

/// Wraps `text` to at most `lines` lines of at most `limit` pixels; text that does not fit ends in
/// `…`.
pub(super) fn wrap(text: &str, size: f64, limit: f64, lines: usize) -> Vec<String> {
    let mut wrapped: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        let longer = wrapped.last().map(|line| format!("{line} {word}"));
        match (longer, wrapped.len()) {
            (Some(longer), n) if n >= lines || width(&longer, size) <= limit => wrapped[n - 1] = longer,
            _ => wrapped.push(word.to_owned()),
        }
    }
    wrapped.iter().map(|line| cut(line, size, limit)).collect()
}

fn cut(line: &str, size: f64, limit: f64) -> String {
    if width(line, size) <= limit {
        return line.to_owned();
    }
    let room = limit - width("…", size);
    let mut used = 0.0;
    let kept = line.chars().take_while(|c| {
        used += width(c.encode_utf8(&mut [0; 4]), size);
        used <= room
    });
    kept.chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_font_has_all_that_our_labels_use() {
        let face = inter().expect("the embedded font is read");
        for c in "Quasi-conformal error σ₁/σ₂ ρ τ π |∂z̄| ×10⁻⁰¹²³⁴⁵⁶⁷⁸⁹ −>≥≤≈∞·…²".chars()
        {
            // Combining marks are not part of the subset.
            assert!(c == '\u{304}' || face.glyph_index(c).is_some(), "{c}");
        }
    }

    #[test]
    fn titles_are_broken_between_words_and_cut_when_even_that_fails() {
        assert_eq!(wrap("one two", 10.0, 1000.0, 2), ["one two"]);
        assert_eq!(wrap("one two", 10.0, 25.0, 2), ["one", "two"]);
        assert!(wrap("", 10.0, 25.0, 2).is_empty());
        let lines = wrap(&"word ".repeat(50), 10.0, 100.0, 2);
        assert_eq!(lines.len(), 2);
        assert!(lines[1].ends_with('…'));
        assert!(lines.iter().all(|l| width(l, 10.0) <= 100.0));
    }
}
