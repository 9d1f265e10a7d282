use std::collections::HashMap;

use super::error::{Defect, Fault, quote};
use super::mesh::{Parsed, push_face, unit};
use super::token::{Syntax, Tokens, coordinate, number};
use crate::surface::Faces;

/// Lengths of the header with the count, and of one facet, in binary STL.
const PREFACE: usize = 84;
const FACET: usize = 50;

/// Reads STL, text or binary; corners at the same position become one vertex.
///
/// A file whose length matches its facet count is binary, even if it begins with `solid` (such
/// files exist). Otherwise it is text if it begins with `solid` and its first bytes are text.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, Fault> {
    let count = bytes.get(80..PREFACE).and_then(|b| b.first_chunk::<4>()).map(|b| u64::from(u32::from_le_bytes(*b)));
    if count.is_some_and(|n| n * FACET as u64 + PREFACE as u64 == bytes.len() as u64) {
        return binary(&bytes[PREFACE..]);
    }
    let mut tokens = Tokens::new(bytes, Syntax::Plain);
    let first = tokens.next();
    let head = &bytes[..bytes.len().min(512)];
    let is_text = !head.contains(&0);
    match (first, count) {
        (None, _) => Err(Fault::whole(Defect::Empty)),
        (Some(word), _) if is_text && word.eq_ignore_ascii_case(b"solid") => text(tokens),
        (_, Some(count)) if !is_text => {
            let left = (bytes.len() - PREFACE) as u64;
            let defect = if count * FACET as u64 > left {
                Defect::Truncated { what: "facets".to_owned(), count, bytes_each: FACET as u64, left }
            } else {
                Defect::TrailingBytes { bytes: left - count * FACET as u64 }
            };
            Err(Fault::binary(80, defect))
        }
        (Some(word), _) => {
            let wanted = "`solid` (or a binary STL, whose length fits its count)";
            Err(tokens.fault(Defect::Unexpected { found: quote(word), wanted }))
        }
    }
}

#[derive(Default)]
struct Welder {
    positions: Vec<[f64; 3]>,
    index: HashMap<[u64; 3], u32>,
    faces: Faces,
    normals: Vec<[f64; 3]>,
    without_normal: Option<usize>,
}

impl Welder {
    fn facet(&mut self, normal: [f64; 3], corners: [[f64; 3]; 3]) -> Result<(), Defect> {
        let mut polygon = [0; 3];
        for (p, corner) in polygon.iter_mut().zip(corners) {
            // Adding zero turns −0 into +0.
            let corner = corner.map(|x| x + 0.0);
            let next = u32::try_from(self.positions.len())
                .map_err(|_| Defect::TooMany { what: "vertices", count: self.positions.len() as u64 })?;
            *p = *self.index.entry(corner.map(f64::to_bits)).or_insert(next);
            if *p == next {
                self.positions.push(corner);
            }
        }
        match unit(normal) {
            Some(n) => self.normals.push(n),
            None => self.without_normal = self.without_normal.or(Some(self.faces.len())),
        }
        push_face(&mut self.faces, &polygon)
    }

    fn finish(self) -> Parsed {
        let normals = Some(self.without_normal.map_or(Ok(self.normals), Err));
        Parsed { positions: self.positions, faces: self.faces, normals, text: None }
    }
}

fn binary(facets: &[u8]) -> Result<Parsed, Fault> {
    let mut welder = Welder::default();
    for (f, facet) in facets.chunks_exact(FACET).enumerate() {
        let at = PREFACE + f * FACET;
        let (floats, _) = facet.as_chunks::<4>();
        let vector =
            |k: usize| [0, 1, 2].map(|i| floats.get(3 * k + i).map_or(0.0, |b| f64::from(f32::from_le_bytes(*b))));
        let corners = [1, 2, 3].map(vector);
        if let Some(x) = corners.iter().flatten().find(|x| !x.is_finite()) {
            return Err(Fault::binary(at, Defect::NotFinite { token: x.to_string() }));
        }
        welder.facet(vector(0), corners).map_err(|e| Fault::binary(at, e))?;
    }
    Ok(welder.finish())
}

/// Reads one or more `solid … endsolid`; the first `solid` has already been read.
fn text(mut tokens: Tokens) -> Result<Parsed, Fault> {
    let mut welder = Welder::default();
    tokens.end_line();
    let mut inside = true;
    while let Some(word) = tokens.next() {
        if inside && word.eq_ignore_ascii_case(b"facet") {
            let done = welder.faces.len();
            let (normal, corners) = facet(&mut tokens, done)?;
            welder.facet(normal, corners).map_err(|e| tokens.fault(e))?;
        } else if inside && word.eq_ignore_ascii_case(b"endsolid") {
            tokens.end_line();
            inside = false;
        } else if !inside && word.eq_ignore_ascii_case(b"solid") {
            tokens.end_line();
            inside = true;
        } else {
            let wanted = if inside { "`facet` or `endsolid`" } else { "`solid` or the end of the file" };
            return Err(tokens.fault(Defect::Unexpected { found: quote(word), wanted }));
        }
    }
    if inside {
        return Err(end(&tokens, "`facet` or `endsolid`", welder.faces.len()));
    }
    Ok(welder.finish())
}

fn facet(tokens: &mut Tokens, done: usize) -> Result<([f64; 3], [[f64; 3]; 3]), Fault> {
    keyword(tokens, b"normal", "`normal`", done)?;
    let mut normal = [0.0; 3];
    for x in &mut normal {
        let word = tokens.next().ok_or_else(|| end(tokens, "a coordinate of a normal", done))?;
        *x = number(word, "a coordinate of a normal").map_err(|e| tokens.fault(e))?;
    }
    keyword(tokens, b"outer", "`outer loop`", done)?;
    keyword(tokens, b"loop", "`outer loop`", done)?;
    let mut corners = [[0.0; 3]; 3];
    for corner in &mut corners {
        keyword(tokens, b"vertex", "one of three lines `vertex x y z`", done)?;
        for x in corner {
            let word = tokens.next().ok_or_else(|| end(tokens, "a coordinate", done))?;
            *x = coordinate(word).map_err(|e| tokens.fault(e))?;
        }
    }
    keyword(tokens, b"endloop", "`endloop` after three vertices", done)?;
    keyword(tokens, b"endfacet", "`endfacet`", done)?;
    Ok((normal, corners))
}

fn keyword(tokens: &mut Tokens, keyword: &[u8], wanted: &'static str, done: usize) -> Result<(), Fault> {
    match tokens.next() {
        Some(word) if word.eq_ignore_ascii_case(keyword) => Ok(()),
        Some(word) => Err(tokens.fault(Defect::Unexpected { found: quote(word), wanted })),
        None => Err(end(tokens, wanted, done)),
    }
}

/// Text STL has no facet count, so the error of an early end names the missing item.
fn end(tokens: &Tokens, wanted: &'static str, done: usize) -> Fault {
    tokens.fault(Defect::OpenEnd { wanted, what: "facets", done: done as u64 })
}
