use crate::io::error::{Defect, Fault};
use crate::io::mesh::{Parsed, mean_normals, push_face};
use crate::io::off::VertexAttributes;
use crate::surface::Faces;

/// A variant of the format `OFF BINARY`, which writers interpret differently.
#[derive(Clone, Copy)]
struct Dialect {
    big_endian: bool,
    /// Every face is followed by a count and that many floats.
    face_colours: bool,
    /// Coordinates have 8 bytes.
    doubles: bool,
}

/// Geomview's own dialect first, then that of pmp-library (little-endian, no colours), then the
/// others.
const DIALECTS: [Dialect; 8] = [
    Dialect { big_endian: true, face_colours: true, doubles: false },
    Dialect { big_endian: false, face_colours: false, doubles: false },
    Dialect { big_endian: false, face_colours: true, doubles: false },
    Dialect { big_endian: true, face_colours: false, doubles: false },
    Dialect { big_endian: false, face_colours: false, doubles: true },
    Dialect { big_endian: false, face_colours: true, doubles: true },
    Dialect { big_endian: true, face_colours: true, doubles: true },
    Dialect { big_endian: true, face_colours: false, doubles: true },
];

/// Reads `OFF BINARY` from the byte after its first line.
///
/// Such files differ in byte order, in the width of coordinates and in whether faces carry a colour
/// count. The dialect is the first of [`DIALECTS`] in which every number is valid and the data ends
/// exactly at the end of the file. If none fits, the error is that of the dialect that got
/// furthest.
pub(super) fn read(bytes: &[u8], start: usize, attributes: VertexAttributes) -> Result<Parsed, Fault> {
    let mut furthest: Option<(usize, Fault)> = None;
    for dialect in DIALECTS {
        let mut body = OffBinary { bytes, position: start, dialect };
        match body.read(attributes) {
            Ok(parsed) => return Ok(parsed),
            Err(defect) => {
                let at = body.position;
                if furthest.as_ref().is_none_or(|(best, _)| at > *best) {
                    furthest = Some((at, Fault::binary(at, defect)));
                }
            }
        }
    }
    Err(furthest.map_or_else(|| Fault::whole(Defect::Empty), |(_, fault)| fault))
}

struct OffBinary<'a> {
    bytes: &'a [u8],
    position: usize,
    dialect: Dialect,
}

impl OffBinary<'_> {
    /// Reads counts, vertices and faces. After an error `position` is the offending byte.
    fn read(&mut self, attributes: VertexAttributes) -> Result<Parsed, Defect> {
        let end = |wanted| Defect::UnexpectedEnd { wanted, what: "header numbers", done: 0, expected: 3 };
        let mut header = || self.word().map(u64::from).ok_or_else(|| end("a count"));
        let (vertices, faces, _edges) = (header()?, header()?, header()?);
        let width = if self.dialect.doubles { 8 } else { 4 };
        let numbers = 3
            + if attributes.normals { 3 } else { 0 }
            + if attributes.colours { 4 } else { 0 }
            + if attributes.texture { 2 } else { 0 };
        self.must_fit("vertices", vertices, numbers * width)?;
        let mut positions = Vec::with_capacity(vertices as usize);
        let mut normals = Vec::new();
        for done in 0..vertices {
            let wanted = "a coordinate";
            let end = || Defect::UnexpectedEnd { wanted, what: "vertices", done, expected: vertices };
            let position = self.vector().ok_or_else(end)?;
            if let Some(x) = position.iter().find(|x| !x.is_finite()) {
                self.position -= 3 * width as usize;
                return Err(Defect::NotFinite { token: x.to_string() });
            }
            positions.push(position);
            if attributes.normals {
                normals.push(self.vector().ok_or_else(end)?);
            }
            let rest = numbers - if attributes.normals { 6 } else { 3 };
            self.position += (rest * width) as usize;
        }
        self.must_fit("faces", faces, if self.dialect.face_colours { 20 } else { 16 })?;
        let mut all = Faces::with_capacity(faces as usize, 0);
        let mut polygon = Vec::new();
        for done in 0..faces {
            let end = |wanted| Defect::UnexpectedEnd { wanted, what: "faces", done, expected: faces };
            self.face(&mut polygon, positions.len(), end)?;
            push_face(&mut all, &polygon)?;
        }
        let left = self.left();
        if left > 0 {
            return Err(Defect::TrailingBytes { bytes: left });
        }
        let normals = attributes.normals.then(|| mean_normals(&all, |c| normals[all.corners()[c] as usize]));
        Ok(Parsed { positions, faces: all, normals, text: None })
    }

    fn face(
        &mut self,
        polygon: &mut Vec<u32>,
        vertices: usize,
        end: impl Fn(&'static str) -> Defect,
    ) -> Result<(), Defect> {
        let corners = self.word().ok_or_else(|| end("the number of a face's corners"))?;
        polygon.clear();
        for _ in 0..corners {
            let index = self.word().ok_or_else(|| end("a vertex index"))?;
            if index as usize >= vertices {
                self.position -= 4;
                let index = i64::from(index);
                return Err(Defect::IndexOutOfRange { what: "vertex", index, count: vertices, base: 0 });
            }
            polygon.push(index);
        }
        if self.dialect.face_colours {
            let colours = self.word().ok_or_else(|| end("the number of a face's colour components"))?;
            // Geomview allows 0 to 4 components.
            if colours > 4 {
                self.position -= 4;
                return Err(Defect::NotACount { value: f64::from(colours), wanted: "number of colour components" });
            }
            for _ in 0..colours {
                self.word().ok_or_else(|| end("a colour component"))?;
            }
        }
        Ok(())
    }

    fn left(&self) -> u64 {
        self.bytes.len().saturating_sub(self.position) as u64
    }

    fn must_fit(&self, what: &str, count: u64, bytes_each: u64) -> Result<(), Defect> {
        let left = self.left();
        if count.saturating_mul(bytes_each) > left {
            return Err(Defect::Truncated { what: what.to_owned(), count, bytes_each, left });
        }
        Ok(())
    }

    fn word(&mut self) -> Option<u32> {
        let four = *self.bytes.get(self.position..)?.first_chunk::<4>()?;
        self.position += 4;
        Some(if self.dialect.big_endian { u32::from_be_bytes(four) } else { u32::from_le_bytes(four) })
    }

    fn vector(&mut self) -> Option<[f64; 3]> {
        let mut vector = [0.0; 3];
        for x in &mut vector {
            *x = if self.dialect.doubles {
                let eight = *self.bytes.get(self.position..)?.first_chunk::<8>()?;
                self.position += 8;
                if self.dialect.big_endian { f64::from_be_bytes(eight) } else { f64::from_le_bytes(eight) }
            } else {
                f64::from(f32::from_bits(self.word()?))
            };
        }
        Some(vector)
    }
}
