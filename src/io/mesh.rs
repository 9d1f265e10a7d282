use super::error::Defect;
use crate::surface::{Faces, Surface};

/// The OBJ `v` line of every vertex with the digits of its file, so that they are written back
/// unchanged.
///
/// From OBJ it is the line itself, from the `v` to the line end, with colours and comment. From OFF
/// and ascii PLY it is `v` and the three coordinates.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VertexText {
    bytes: Vec<u8>,
    ends: Vec<usize>,
}

impl VertexText {
    pub(super) fn new() -> Self {
        VertexText { bytes: Vec::new(), ends: Vec::new() }
    }

    pub(super) fn push_line(&mut self, line: &[u8]) {
        self.bytes.extend_from_slice(line);
        self.ends.push(self.bytes.len());
    }

    pub(super) fn push_words<'a>(&mut self, words: impl IntoIterator<Item = &'a [u8]>) {
        self.bytes.push(b'v');
        for word in words {
            self.bytes.push(b' ');
            self.bytes.extend_from_slice(word);
        }
        self.ends.push(self.bytes.len());
    }

    pub(super) fn shrink(&mut self) {
        self.bytes.shrink_to_fit();
        self.ends.shrink_to_fit();
    }

    /// Number of vertices.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no vertex.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The line of vertex `v`, without its line end; `None` if there is no such vertex.
    pub fn line(&self, v: usize) -> Option<&[u8]> {
        let end = *self.ends.get(v)?;
        let start = if v == 0 { 0 } else { self.ends[v - 1] };
        self.bytes.get(start..end)
    }
}

/// Face normals, or the first face without a normal.
pub(super) type Normals = Result<Vec<[f64; 3]>, usize>;

/// Returns the normalised mean of the normals at each face's corners.
///
/// `at(c)` is the normal at corner `c` (a position in [`Faces::corners`]). The error is the first
/// face whose mean is zero or not finite.
pub(super) fn mean_normals(faces: &Faces, at: impl Fn(usize) -> [f64; 3]) -> Normals {
    let mean = |f: usize| {
        let mut sum = [0.0; 3];
        for c in faces.corner_range(f) {
            let n = at(c);
            (0..3).for_each(|k| sum[k] += n[k]);
        }
        unit(sum).ok_or(f)
    };
    (0..faces.len()).map(mean).collect()
}

/// Returns `n / |n|`, or `None` if that is undefined.
pub(super) fn unit(n: [f64; 3]) -> Option<[f64; 3]> {
    // Scaled first, because a normal of length 1e-200 is valid too.
    let scale = n.iter().fold(0.0, |a: f64, x| a.max(x.abs()));
    if !(scale > 0.0 && scale.is_finite() && n.iter().all(|x| x.is_finite())) {
        return None;
    }
    let n = n.map(|x| x / scale);
    let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
    Some(n.map(|x| x / length))
}

/// Appends a polygon after checking the properties that [`Surface`] guarantees.
#[inline]
pub(super) fn push_face(faces: &mut Faces, polygon: &[u32]) -> Result<(), Defect> {
    if polygon.len() < 3 {
        return Err(Defect::TooFewCorners { corners: polygon.len() });
    }
    let corners = faces.corners().len() as u64 + polygon.len() as u64;
    if corners > u64::from(u32::MAX) {
        return Err(Defect::TooMany { what: "corners", count: corners });
    }
    faces.push(polygon);
    Ok(())
}

/// The result of every reader.
pub(super) struct Parsed {
    pub positions: Vec<[f64; 3]>,
    pub faces: Faces,
    /// `None` when the file has no normals.
    pub normals: Option<Normals>,
    pub text: Option<VertexText>,
}

impl Parsed {
    pub fn into_surface(self) -> (Surface, Option<VertexText>, Option<usize>) {
        let (face_normals, face_without_normal) = match self.normals {
            None => (None, None),
            Some(Ok(normals)) => (Some(normals), None),
            Some(Err(face)) => (None, Some(face)),
        };
        let surface = Surface { positions: self.positions, faces: self.faces, face_normals };
        (surface, self.text, face_without_normal)
    }
}
