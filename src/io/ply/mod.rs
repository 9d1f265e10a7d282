mod header;
mod source;

use header::{Element, Encoding, PlyHeader, PropertyType, Scalar};
use source::{Ascii, Binary, ValueSource};

use super::error::{Defect, Fault, quote};
use super::mesh::{Parsed, VertexText, mean_normals, push_face};
use crate::surface::Faces;

/// Reads Stanford PLY, ascii or binary: `x y z` and `nx ny nz` of the vertices, `vertex_indices`
/// (or `vertex_index`) of the faces.
///
/// Other elements and properties are skipped. Counts in the header are not trusted beyond the
/// length of the file. Ascii values are read in double precision whatever their declared type, so
/// that no digit is lost.
pub(super) fn read(bytes: &[u8]) -> Result<Parsed, Fault> {
    let header = PlyHeader::read(bytes)?;
    let vertices = check(&header)?;
    match header.encoding {
        Encoding::Ascii => PlyBody::read(Ascii::new(bytes, header.end), &header, vertices),
        encoding => PlyBody::read(Binary::new(bytes, header.end, encoding), &header, vertices),
    }
}

/// Checks that the header declares a mesh and returns the number of vertices.
fn check(header: &PlyHeader) -> Result<u64, Fault> {
    let lacks = |what| Err(Fault::text(header.end.saturating_sub(1), Defect::HeaderLacks { what }));
    let named = |name| header.elements.iter().find(|e| e.name == name);
    let Some(vertex) = named("vertex") else {
        return lacks("element `vertex`");
    };
    let has_scalar =
        |name: &str| vertex.properties.iter().any(|p| p.name == name && matches!(p.kind, PropertyType::Scalar(_)));
    if !["x", "y", "z"].into_iter().all(has_scalar) {
        return lacks("scalar properties `x`, `y`, `z` for the element `vertex`");
    }
    match named("face") {
        None if named("tristrips").is_some() => {
            let what = "a mesh of triangle strips (element `tristrips`)";
            let advice = "save it with single faces, or convert the strips to triangles";
            return Err(Fault::text(header.end.saturating_sub(1), Defect::Unsupported { what, advice }));
        }
        None if vertex.count > 0 => {
            return Err(Fault::whole(Defect::NoFaces {
                vertices: usize::try_from(vertex.count).unwrap_or(usize::MAX),
            }));
        }
        None => return lacks("element `face`"),
        Some(face) => {
            if index_list(face).is_none() {
                return lacks("property list `vertex_indices` of whole numbers for the element `face`");
            }
        }
    }
    for name in ["vertex", "face"] {
        if header.elements.iter().filter(|e| e.name == name).count() > 1 {
            let defect = Defect::Unexpected { found: format!("element {name}"), wanted: "only one such element" };
            return Err(Fault::text(header.end.saturating_sub(1), defect));
        }
    }
    if vertex.count > u64::from(u32::MAX) {
        let defect = Defect::TooMany { what: "vertices", count: vertex.count };
        return Err(Fault::text(header.end.saturating_sub(1), defect));
    }
    Ok(vertex.count)
}

/// Returns the property of the faces that lists their vertices.
fn index_list(face: &Element) -> Option<usize> {
    let is_list = |kind| matches!(kind, PropertyType::List { item, .. } if !item.is_float());
    face.properties.iter().position(|p| (p.name == "vertex_indices" || p.name == "vertex_index") && is_list(p.kind))
}

/// The use of a property.
#[derive(Clone, Copy)]
enum Role {
    Position(usize),
    Normal(usize),
    Indices,
    Skip,
}

fn roles(element: &Element) -> Vec<(Role, PropertyType)> {
    let axis = |name: &str, names: [&str; 3]| names.iter().position(|&n| n == name);
    let indices = if element.name == "face" { index_list(element) } else { None };
    let is_vertex = element.name == "vertex";
    let role = |i: usize, name: &str, kind: PropertyType| match kind {
        PropertyType::Scalar(_) if is_vertex => match (axis(name, ["x", "y", "z"]), axis(name, ["nx", "ny", "nz"])) {
            (Some(k), _) => Role::Position(k),
            (_, Some(k)) => Role::Normal(k),
            _ => Role::Skip,
        },
        PropertyType::List { .. } if indices == Some(i) => Role::Indices,
        _ => Role::Skip,
    };
    element.properties.iter().enumerate().map(|(i, p)| (role(i, &p.name, p.kind), p.kind)).collect()
}

struct PlyBody<S> {
    source: S,
    vertices: u64,
    positions: Vec<[f64; 3]>,
    normals: Vec<[f64; 3]>,
    text: VertexText,
    faces: Faces,
    polygon: Vec<u32>,
}

impl<'a, S: ValueSource<'a>> PlyBody<S> {
    fn read(source: S, header: &PlyHeader, vertices: u64) -> Result<Parsed, Fault> {
        let mut body = PlyBody {
            source,
            vertices,
            positions: Vec::new(),
            normals: Vec::new(),
            text: VertexText::new(),
            faces: Faces::default(),
            polygon: Vec::new(),
        };
        for element in &header.elements {
            body.element(element, header.encoding)?;
        }
        body.source.end()?;
        body.text.shrink();
        let PlyBody { positions, normals, faces, text, .. } = body;
        let normals = (!normals.is_empty()).then(|| mean_normals(&faces, |c| normals[faces.corners()[c] as usize]));
        let text = (header.encoding == Encoding::Ascii).then_some(text);
        Ok(Parsed { positions, faces, normals, text })
    }

    fn element(&mut self, element: &Element, encoding: Encoding) -> Result<(), Fault> {
        let (count, bytes_each, left) = (element.count, element.shortest(encoding), self.source.left());
        if bytes_each == 0 {
            return Ok(());
        }
        if count.saturating_mul(bytes_each) > left {
            return Err(self.source.fault(Defect::Truncated { what: plural(&element.name), count, bytes_each, left }));
        }
        let roles = roles(element);
        let is_vertex = element.name == "vertex";
        let has_normals = (0..3).all(|k| roles.iter().any(|(r, _)| matches!(r, Role::Normal(n) if *n == k)));
        if is_vertex {
            self.positions.reserve(count as usize);
        } else if element.name == "face" {
            self.faces = Faces::with_capacity(count as usize, 0);
        }
        for record in 0..count {
            let what = if is_vertex { "vertices" } else { "faces or other elements" };
            let end = || Defect::UnexpectedEnd { wanted: "a value", what, done: record, expected: count };
            let mut position = [0.0; 3];
            let mut normal = [0.0; 3];
            let mut words: [&[u8]; 3] = [b""; 3];
            for &(role, kind) in &roles {
                match (role, kind) {
                    (Role::Position(k), PropertyType::Scalar(kind)) => {
                        position[k] = self.finite(kind, end)?;
                        words[k] = self.source.text();
                    }
                    (Role::Normal(k), PropertyType::Scalar(kind)) => {
                        normal[k] = self.source.scalar(kind)?.ok_or_else(|| self.source.fault(end()))?;
                    }
                    (Role::Indices, PropertyType::List { count, item }) => self.indices(count, item, end)?,
                    (_, PropertyType::Scalar(kind)) => self.skip(kind, 1, end)?,
                    (_, PropertyType::List { count, item }) => {
                        let length = self.length(count, end)?;
                        self.skip(item, length, end)?;
                    }
                }
            }
            if is_vertex {
                self.positions.push(position);
                if encoding == Encoding::Ascii {
                    self.text.push_words(words);
                }
                if has_normals {
                    self.normals.push(normal);
                }
            }
            self.source.end_record(&element.name)?;
        }
        Ok(())
    }

    fn finite(&mut self, kind: Scalar, end: impl Fn() -> Defect) -> Result<f64, Fault> {
        let x = self.source.scalar(kind)?.ok_or_else(|| self.source.fault(end()))?;
        if x.is_finite() {
            return Ok(x);
        }
        let token = match self.source.text() {
            b"" => x.to_string(),
            text => quote(text),
        };
        Err(self.source.fault(Defect::NotFinite { token }))
    }

    fn skip(&mut self, kind: Scalar, values: u64, end: impl Fn() -> Defect) -> Result<(), Fault> {
        if self.source.skip(kind, values) { Ok(()) } else { Err(self.source.fault(end())) }
    }

    fn length(&mut self, kind: Scalar, end: impl Fn() -> Defect) -> Result<u64, Fault> {
        let length = self.source.whole(kind)?.ok_or_else(|| self.source.fault(end()))?;
        u64::try_from(length)
            .map_err(|_| self.source.fault(Defect::NotACount { value: length as f64, wanted: "length of a list" }))
    }

    fn indices(&mut self, count: Scalar, item: Scalar, end: impl Fn() -> Defect) -> Result<(), Fault> {
        let length = self.length(count, &end)?;
        self.polygon.clear();
        for _ in 0..length {
            let index = self.source.whole(item)?.ok_or_else(|| self.source.fault(end()))?;
            match u32::try_from(index) {
                Ok(i) if u64::from(i) < self.vertices => self.polygon.push(i),
                _ => {
                    let count = self.vertices as usize;
                    return Err(self.source.fault(Defect::IndexOutOfRange { what: "vertex", index, count, base: 0 }));
                }
            }
        }
        push_face(&mut self.faces, &self.polygon).map_err(|e| self.source.fault(e))
    }
}

fn plural(element: &str) -> String {
    match element {
        "vertex" => "vertices".to_owned(),
        "face" => "faces".to_owned(),
        other => format!("elements `{other}`"),
    }
}
