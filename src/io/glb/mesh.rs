use std::io::{self, Write};
use std::ops::RangeInclusive;

use super::{GlbError, Model};
use crate::geometry::vector::{dot, sub};
use crate::sparse::Lists;
use crate::surface::Faces;

/// Allowed sizes: their squares, and those of a millionth of them, are 32-bit floats. Viewers
/// compute with these.
const SIZES: RangeInclusive<f64> = 1e-15..=1e15;

/// A mesh in the form of glTF, with one vertex for each combination of position, normal and texture
/// coordinate at a corner.
///
/// The copies of a vertex of the source have consecutive indices, in the order of the source.
pub(super) struct Mesh {
    pub(super) centre: [f64; 3],
    /// Positions relative to the centre.
    pub(super) positions: Vec<[f32; 3]>,
    pub(super) normals: Vec<[f32; 3]>,
    pub(super) texture: Vec<[f32; 2]>,
    pub(super) triangles: Vec<[u32; 3]>,
}

impl Mesh {
    pub(super) fn new(model: &Model) -> Result<Mesh, GlbError> {
        if model.faces.is_empty() {
            return Err(GlbError::NoFaces);
        }
        let vertex = model.faces.corners();
        let place = |c: usize| model.positions[vertex[c] as usize];
        let (centre, size) = centre(vertex.iter().map(|&v| model.positions[v as usize]));
        if !SIZES.contains(&size) {
            return Err(GlbError::Size { size });
        }
        let normal = |c: usize| model.normals.map(|normals| unit(normals[c]));
        let texture = |c: usize| model.map.map(|map| model.texture.at(map[c]).map(|x| x as f32));
        let (representative, of_corner) = merged(model, |c| (normal(c), texture(c)));
        let corners = || representative.iter().map(|&c| c as usize);
        Ok(Mesh {
            centre,
            positions: corners().map(|c| sub(place(c), centre).map(|x| x as f32)).collect(),
            normals: corners().filter_map(normal).collect(),
            texture: corners().filter_map(texture).collect(),
            triangles: triangles(model).map(|corners| corners.map(|c| of_corner[c])).collect(),
        })
    }

    /// The number of bytes that [`Mesh::write`] writes.
    pub(super) fn bytes(&self) -> u64 {
        let words = 3 * (self.positions.len() + self.normals.len() + self.triangles.len()) + 2 * self.texture.len();
        4 * words as u64
    }

    /// The lowest and highest position along each axis.
    pub(super) fn bounds(&self) -> [[f32; 3]; 2] {
        let bound = |start: f32, pick: fn(f32, f32) -> f32| {
            self.positions.iter().fold([start; 3], |m, p| [0, 1, 2].map(|k| pick(m[k], p[k])))
        };
        [bound(f32::INFINITY, f32::min), bound(f32::NEG_INFINITY, f32::max)]
    }

    /// Writes positions, normals, texture coordinates and indices, without gaps.
    pub(super) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut floats = |floats: &[f32]| floats.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()));
        self.positions.iter().try_for_each(|p| floats(p))?;
        self.normals.iter().try_for_each(|n| floats(n))?;
        self.texture.iter().try_for_each(|t| floats(t))?;
        self.triangles.iter().flatten().try_for_each(|i| out.write_all(&i.to_le_bytes()))
    }
}

/// Returns the centre of the bounding box and its longest side.
fn centre(points: impl Iterator<Item = [f64; 3]>) -> ([f64; 3], f64) {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in points {
        low = [0, 1, 2].map(|k| low[k].min(p[k]));
        high = [0, 1, 2].map(|k| high[k].max(p[k]));
    }
    let size = (0..3).fold(0.0, |size: f64, k| size.max(high[k] - low[k]));
    // The sum could overflow, so both are halved first.
    ([0, 1, 2].map(|k| low[k] / 2.0 + high[k] / 2.0), size)
}

/// Normalises in single precision. Faces without area have the normal 0, which glTF does not allow;
/// it is replaced by the third axis.
fn unit(normal: [f64; 3]) -> [f32; 3] {
    let length = dot(normal, normal).sqrt();
    if length > 0.0 { normal.map(|x| (x / length) as f32) } else { [0.0, 0.0, 1.0] }
}

/// Merges corners of one vertex with equal attributes; returns a representative corner of each
/// merged vertex, and the merged vertex of each corner.
fn merged<A: PartialEq>(model: &Model, attributes: impl Fn(usize) -> A) -> (Vec<u32>, Vec<u32>) {
    let vertex = model.faces.corners();
    let corners = Lists::new(model.positions.len(), vertex.iter().zip(0..).map(|(&v, c)| (v, c)));
    let (mut representative, mut of_corner) = (Vec::with_capacity(model.positions.len()), vec![0; vertex.len()]);
    for v in 0..corners.len() as u32 {
        let start = representative.len();
        for &c in corners.of(v) {
            let own = attributes(c as usize);
            let known = representative[start..].iter().position(|&other: &u32| attributes(other as usize) == own);
            let merged = start + known.unwrap_or(representative.len() - start);
            if known.is_none() {
                representative.push(c);
            }
            of_corner[c as usize] = merged as u32;
        }
    }
    (representative, of_corner)
}

/// Iterates over the triangles of all faces, as triples of corners.
fn triangles<'a>(model: &'a Model) -> impl Iterator<Item = [usize; 3]> + 'a {
    let Model { faces, positions, .. } = *model;
    (0..faces.len()).flat_map(move |f| {
        let first = faces.corner_range(f).start;
        let apex = apex(faces, positions, f);
        let n = faces.get(f).len();
        (1..n.saturating_sub(1)).map(move |k| [0, k, k + 1].map(|k| first + (apex + k) % n))
    })
}

/// Returns the corner, from 0, from which the triangles of a face fan out; for quads an end of the
/// shorter diagonal.
fn apex(faces: &Faces, positions: &[[f64; 3]], f: usize) -> usize {
    let &[a, b, c, d] = faces.get(f) else { return 0 };
    let length = |v: u32, w: u32| {
        let d = sub(positions[w as usize], positions[v as usize]);
        dot(d, d)
    };
    usize::from(length(b, d) < length(a, c))
}
