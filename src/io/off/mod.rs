mod binary;

use super::error::{Defect, Fault, quote};
use super::mesh::{Normals, Parsed, VertexText, mean_normals, push_face};
use super::token::{Syntax, Tokens, coordinate, integer, number};
use crate::surface::Faces;

/// The vertex attributes that the letters before `OFF` declare; they follow the position in this
/// order.
#[derive(Clone, Copy, Default)]
pub(super) struct VertexAttributes {
    /// `N`: a normal.
    pub normals: bool,
    /// `C`: a colour, four numbers in binary files.
    pub colours: bool,
    /// `ST`: texture coordinates.
    pub texture: bool,
}

#[derive(Clone, Copy)]
struct Counts {
    vertices: u64,
    faces: u64,
}

/// The role of line ends.
#[derive(Clone, Copy, PartialEq)]
enum LineLayout {
    /// A record can begin and break anywhere, but only its colour follows it on the line where it
    /// ends.
    Lines,
    /// Records follow one another regardless of lines; faces have no colours.
    Stream,
}

/// Reads Geomview OFF, text or binary (<http://www.geomview.org/docs/html/OFF.html>).
///
/// The format is free-form except that the colour of a face, whose length is not declared, ends
/// with its line. This is [`LineLayout::Lines`]; if it does not fit, [`LineLayout::Stream`] is accepted if
/// it fits to the last word.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, Fault> {
    let mut tokens = Tokens::new(bytes, Syntax::Comments);
    let attributes = header(&mut tokens)?;
    let mut ahead = tokens.clone();
    if ahead.next_on_line().is_some_and(|t| t.eq_ignore_ascii_case(b"BINARY")) {
        ahead.end_line();
        return binary::read(bytes, ahead.position(), attributes);
    }
    let counts = counts(&mut tokens)?;
    OffText::read(tokens.clone(), attributes, counts, LineLayout::Lines)
        .or_else(|fault| OffText::read(tokens, attributes, counts, LineLayout::Stream).map_err(|_| fault))
}

/// Reads `[ST][C][N][4][n]OFF`, which is optional; the counts can follow without a blank.
fn header(tokens: &mut Tokens) -> Result<VertexAttributes, Fault> {
    let mut attributes = VertexAttributes::default();
    let before = tokens.clone();
    let Some(word) = tokens.next() else {
        return Err(Fault::whole(Defect::Empty));
    };
    if integer(word).is_some() {
        *tokens = before;
        return Ok(attributes);
    }
    let mut rest = word;
    loop {
        match rest {
            [b'S', b'T', more @ ..] => (attributes.texture, rest) = (true, more),
            [b'C', more @ ..] => (attributes.colours, rest) = (true, more),
            [b'N', more @ ..] => (attributes.normals, rest) = (true, more),
            [b'4' | b'n', ..] if rest.ends_with(b"OFF") => {
                let what = "vertices in four or n dimensions (4OFF, nOFF)";
                return Err(tokens.fault(Defect::Unsupported { what, advice: "save the mesh with x y z only" }));
            }
            _ => break,
        }
    }
    match rest {
        b"OFF" | b"off" => {}
        [b'O', b'F', b'F', digits @ ..] if integer(digits).is_some() => tokens.step_back(digits.len()),
        _ => return Err(tokens.fault(Defect::Unexpected { found: quote(word), wanted: "the keyword OFF" })),
    }
    Ok(attributes)
}

/// Reads the numbers of vertices, faces and edges. The last is not used and can be missing if the
/// first two share a line.
fn counts(tokens: &mut Tokens) -> Result<Counts, Fault> {
    let vertices = count(tokens, "the number of vertices")?;
    let one_line = !tokens.at_line_end();
    let faces = count(tokens, "the number of faces")?;
    if !(one_line && tokens.at_line_end()) {
        count(tokens, "the number of edges")?;
    }
    if vertices > u64::from(u32::MAX) {
        return Err(tokens.fault(Defect::TooMany { what: "vertices", count: vertices }));
    }
    Ok(Counts { vertices, faces })
}

fn count(tokens: &mut Tokens, wanted: &'static str) -> Result<u64, Fault> {
    let Some(token) = tokens.next() else {
        return Err(tokens.fault(Defect::UnexpectedEnd { wanted, what: "header words", done: 0, expected: 3 }));
    };
    let value = integer(token).and_then(|n| u64::try_from(n).ok());
    value.ok_or_else(|| tokens.fault(Defect::NotANumber { token: quote(token), wanted }))
}

struct OffText<'a> {
    tokens: Tokens<'a>,
    attributes: VertexAttributes,
    layout: LineLayout,
}

impl<'a> OffText<'a> {
    fn read(
        tokens: Tokens<'a>,
        attributes: VertexAttributes,
        counts: Counts,
        layout: LineLayout,
    ) -> Result<Parsed, Fault> {
        // A vertex or face takes at least six bytes; memory for larger declared counts is not
        // reserved.
        let room = |claimed: u64| claimed.min(tokens.left() as u64 / 6) as usize;
        let mut positions = Vec::with_capacity(room(counts.vertices));
        let mut faces = Faces::with_capacity(room(counts.faces), 0);
        let mut text = VertexText::new();
        let mut normals = Vec::new();
        let mut body = OffText { tokens, attributes, layout };
        for v in 0..counts.vertices {
            let end = |wanted| Defect::UnexpectedEnd { wanted, what: "vertices", done: v, expected: counts.vertices };
            positions.push(body.position(&mut text, end)?);
            if attributes.normals {
                normals.push(body.normal(end)?);
            }
            body.vertex_tail(end)?;
        }
        let mut polygon = Vec::new();
        for f in 0..counts.faces {
            let end = |wanted| Defect::UnexpectedEnd { wanted, what: "faces", done: f, expected: counts.faces };
            body.face(&mut polygon, positions.len(), end)?;
            push_face(&mut faces, &polygon).map_err(|e| body.tokens.fault(e))?;
        }
        if let Some(token) = body.tokens.next() {
            return Err(body.tokens.fault(Defect::Trailing { token: quote(token) }));
        }
        text.shrink();
        let normals: Option<Normals> =
            attributes.normals.then(|| mean_normals(&faces, |c| normals[faces.corners()[c] as usize]));
        Ok(Parsed { positions, faces, normals, text: Some(text) })
    }

    fn position(&mut self, text: &mut VertexText, end: impl Fn(&'static str) -> Defect) -> Result<[f64; 3], Fault> {
        let mut words: [&[u8]; 3] = [b""; 3];
        let mut position = [0.0; 3];
        for (word, x) in words.iter_mut().zip(&mut position) {
            *word = self.word("a coordinate", &end)?;
            *x = coordinate(word).map_err(|e| self.tokens.fault(e))?;
        }
        text.push_words(words);
        Ok(position)
    }

    fn normal(&mut self, end: impl Fn(&'static str) -> Defect) -> Result<[f64; 3], Fault> {
        let mut normal = [0.0; 3];
        for x in &mut normal {
            let word = self.word("a coordinate of a normal", &end)?;
            *x = number(word, "a coordinate of a normal").map_err(|e| self.tokens.fault(e))?;
        }
        Ok(normal)
    }

    /// Skips the colours and texture coordinates of a vertex.
    fn vertex_tail(&mut self, end: impl Fn(&'static str) -> Defect) -> Result<(), Fault> {
        if self.layout == LineLayout::Lines {
            self.tokens.end_line();
            return Ok(());
        }
        let words = if self.attributes.colours { 4 } else { 0 } + if self.attributes.texture { 2 } else { 0 };
        (0..words).try_for_each(|_| self.word("a colour or texture coordinate", &end).map(drop))
    }

    fn face(
        &mut self,
        polygon: &mut Vec<u32>,
        vertices: usize,
        end: impl Fn(&'static str) -> Defect,
    ) -> Result<(), Fault> {
        let wanted = "the number of a face's corners";
        let word = self.word(wanted, &end)?;
        let not_a_count = || Defect::NotANumber { token: quote(word), wanted };
        let corners = integer(word).filter(|&n| n >= 0).ok_or_else(|| self.tokens.fault(not_a_count()))?;
        if corners < 3 {
            return Err(self.tokens.fault(Defect::TooFewCorners { corners: corners as usize }));
        }
        polygon.clear();
        for _ in 0..corners {
            let word = self.word("a vertex index", &end)?;
            polygon.push(vertex_index(word, vertices).map_err(|e| self.tokens.fault(e))?);
        }
        if self.layout == LineLayout::Lines {
            self.tokens.end_line();
        }
        Ok(())
    }

    #[inline]
    fn word(&mut self, wanted: &'static str, end: impl Fn(&'static str) -> Defect) -> Result<&'a [u8], Fault> {
        self.tokens.next().ok_or_else(|| self.tokens.fault(end(wanted)))
    }
}

/// Parses a vertex index counted from 0.
pub(super) fn vertex_index(word: &[u8], vertices: usize) -> Result<u32, Defect> {
    let Some(index) = integer(word) else {
        return Err(Defect::NotANumber { token: quote(word), wanted: "a vertex index" });
    };
    match u32::try_from(index) {
        Ok(i) if (i as usize) < vertices => Ok(i),
        _ => Err(Defect::IndexOutOfRange { what: "vertex", index, count: vertices, base: 0 }),
    }
}
