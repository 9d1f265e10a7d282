use super::error::{Defect, Fault, quote};
use super::mesh::{Parsed, VertexText, mean_normals, push_face};
use super::token::{Syntax, Tokens, coordinate, integer, number};
use crate::surface::Faces;

/// Reads Wavefront OBJ: the records `v`, `vn` and `f`. Other records are ignored, and so are the
/// weights `w`, which have no meaning for polygons.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, Fault> {
    let mut tokens = Tokens::new(bytes, Syntax::CommentsAndContinuation);
    let mut reader = Reader::default();
    while tokens.position() < bytes.len() {
        match tokens.next_on_line() {
            Some(b"v") => reader.vertex(bytes, &mut tokens)?,
            Some(b"f" | b"fo") => reader.face(&mut tokens)?,
            Some(b"vn") => reader.normal(&mut tokens)?,
            _ => {}
        }
        tokens.end_line();
    }
    reader.finish(bytes)
}

struct Reader {
    positions: Vec<[f64; 3]>,
    text: VertexText,
    faces: Faces,
    normals: Vec<[f64; 3]>,
    /// The normal of every corner so far, or the first face that has a corner without normal.
    corner_normals: Result<Vec<u32>, usize>,
    /// Largest vertex and normal indices (from 0) used so far: their definitions can follow later
    /// in the file.
    largest: [Option<u32>; 2],
    polygon: Vec<u32>,
    words: Vec<(usize, usize)>,
}

impl Default for Reader {
    fn default() -> Self {
        Reader {
            positions: Vec::new(),
            text: VertexText::new(),
            faces: Faces::default(),
            normals: Vec::new(),
            corner_normals: Ok(Vec::new()),
            largest: [None; 2],
            polygon: Vec::new(),
            words: Vec::new(),
        }
    }
}

const KINDS: [&str; 2] = ["vertex", "normal"];

impl Reader {
    fn vertex(&mut self, bytes: &[u8], tokens: &mut Tokens) -> Result<(), Fault> {
        let start = tokens.start();
        let mut position = [0.0; 3];
        let mut found = 0;
        self.words.clear();
        while let Some(token) = tokens.next_on_line() {
            let x = coordinate(token).map_err(|e| tokens.fault(e))?;
            if let Some(p) = position.get_mut(found) {
                *p = x;
            }
            self.words.push((tokens.start(), tokens.position()));
            found += 1;
        }
        if found < 3 {
            return Err(Fault::text(start, Defect::MissingCoordinates { found }));
        }
        if self.positions.len() >= u32::MAX as usize {
            let count = self.positions.len() as u64 + 1;
            return Err(Fault::text(start, Defect::TooMany { what: "vertices", count }));
        }
        self.positions.push(position);
        if tokens.continued() {
            self.text.push_words(self.words.iter().map(|&(a, b)| &bytes[a..b]));
        } else {
            self.text.push_line(&bytes[start..tokens.line_end()]);
        }
        Ok(())
    }

    fn normal(&mut self, tokens: &mut Tokens) -> Result<(), Fault> {
        let mut normal = [0.0; 3];
        for (found, x) in normal.iter_mut().enumerate() {
            let Some(token) = tokens.next_on_line() else {
                return Err(tokens.fault(Defect::MissingCoordinates { found }));
            };
            *x = number(token, "a coordinate of a normal").map_err(|e| tokens.fault(e))?;
        }
        self.normals.push(normal);
        Ok(())
    }

    fn face(&mut self, tokens: &mut Tokens) -> Result<(), Fault> {
        let start = tokens.start();
        self.polygon.clear();
        while let Some(token) = tokens.next_on_line() {
            self.corner(token).map_err(|e| tokens.fault(e))?;
        }
        push_face(&mut self.faces, &self.polygon).map_err(|e| Fault::text(start, e))
    }

    /// Reads a corner `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    #[inline]
    fn corner(&mut self, token: &[u8]) -> Result<(), Defect> {
        let mut parts = token.splitn(3, |&b| b == b'/');
        let vertex = self.index(0, parts.next().unwrap_or_default(), token)?;
        self.polygon.push(vertex);
        if let Some(texture) = parts.next()
            && !texture.is_empty()
            && integer(texture).is_none()
        {
            return Err(not_an_index(token));
        }
        let normal = match parts.next() {
            None | Some(b"") => None,
            Some(normal) => Some(self.index(1, normal, token)?),
        };
        match (&mut self.corner_normals, normal) {
            (Ok(all), Some(n)) => all.push(n),
            (Ok(_), None) => self.corner_normals = Err(self.faces.len()),
            (Err(_), _) => {}
        }
        Ok(())
    }

    /// Returns the index from 0 of a vertex (`kind` 0) or normal (`kind` 1).
    #[inline]
    fn index(&mut self, kind: usize, part: &[u8], token: &[u8]) -> Result<u32, Defect> {
        let count = if kind == 0 { self.positions.len() } else { self.normals.len() };
        let stated = integer(part).ok_or_else(|| not_an_index(token))?;
        let index = match stated {
            0 => return Err(Defect::IndexZero { token: quote(token) }),
            1.. => stated - 1,
            _ => count as i64 + stated,
        };
        let out_of_range = |_| Defect::IndexOutOfRange { what: KINDS[kind], index: stated, count, base: 1 };
        let index = u32::try_from(index).map_err(out_of_range)?;
        if index as usize >= count {
            self.largest[kind] = self.largest[kind].max(Some(index));
        }
        Ok(index)
    }

    fn finish(mut self, bytes: &[u8]) -> Result<Parsed, Fault> {
        let has_normals = !self.normals.is_empty();
        for (kind, count) in [self.positions.len(), self.normals.len()].into_iter().enumerate() {
            if self.largest[kind].is_some_and(|i| i as usize >= count) {
                return Err(locate_out_of_range(bytes, kind, count));
            }
        }
        self.positions.shrink_to_fit();
        self.text.shrink();
        let normals = has_normals.then(|| {
            let corners = self.corner_normals?;
            mean_normals(&self.faces, |c| self.normals[corners[c] as usize])
        });
        Ok(Parsed { positions: self.positions, faces: self.faces, normals, text: Some(self.text) })
    }
}

fn not_an_index(token: &[u8]) -> Defect {
    Defect::NotANumber { token: quote(token), wanted: "a corner such as 7, 7/3, 7//5 or 7/3/5" }
}

/// Finds the first index beyond `count`, in a second pass that is needed only for defective files.
fn locate_out_of_range(bytes: &[u8], kind: usize, count: usize) -> Fault {
    let mut tokens = Tokens::new(bytes, Syntax::CommentsAndContinuation);
    while tokens.position() < bytes.len() {
        if let Some(b"f" | b"fo") = tokens.next_on_line() {
            while let Some(token) = tokens.next_on_line() {
                let part = token.split(|&b| b == b'/').nth(2 * kind).unwrap_or_default();
                if let Some(index) = integer(part).filter(|&i| i > count as i64) {
                    return tokens.fault(Defect::IndexOutOfRange { what: KINDS[kind], index, count, base: 1 });
                }
            }
        }
        tokens.end_line();
    }
    Fault::whole(Defect::IndexOutOfRange { what: KINDS[kind], index: i64::MAX, count, base: 1 })
}
