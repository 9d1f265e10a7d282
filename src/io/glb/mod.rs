//! Binary glTF 2.0: a surface with its map as texture coordinates, and a picture that these lay on it.
//!
//! ```text
//! file   = header (12 bytes)  JSON chunk  BIN chunk        little-endian, chunks of whole words
//! BIN    = positions 3 × f32 | normals 3 × f32 | texture coordinates 2 × f32 | indices u32 | picture
//! (s, t) = texture(u, v)      per corner, from the map; t points down in glTF
//! ```
//!
//! glTF has floats of 32 bits: positions are counted from the middle of the surface's box, which is the translation of the
//! node, so that what is far from the origin loses nothing.

mod document;
mod mesh;

use std::io::{self, Write};

use crate::surface::Faces;
use document::Document;
use mesh::Mesh;

/// A real affine map of the plane, `x ↦ M x + o`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Affine {
    /// M, by rows.
    pub matrix: [[f64; 2]; 2],
    /// o.
    pub origin: [f64; 2],
}

impl Affine {
    /// `(u, v) ↦ (u, 1 − v)`: a picture stands upright on the unit square where v points up.
    pub const UPRIGHT: Affine = Affine { matrix: [[1.0, 0.0], [0.0, -1.0]], origin: [0.0, 1.0] };

    /// M x + o
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let row = |k: usize| self.matrix[k][0] * x + self.matrix[k][1] * y + self.origin[k];
        [row(0), row(1)]
    }

    /// `x ↦ self(first(x))`
    pub fn after(&self, first: &Affine) -> Affine {
        let ([[a, b], [c, d]], [[p, q], [r, s]]) = (self.matrix, first.matrix);
        Affine {
            matrix: [[a * p + b * r, a * q + b * s], [c * p + d * r, c * q + d * s]],
            origin: self.at(first.origin),
        }
    }

    /// The map that undoes it; not finite where M is singular.
    pub fn inverse(&self) -> Affine {
        let [[a, b], [c, d]] = self.matrix;
        let det = a * d - b * c;
        let linear = Affine { matrix: [[d / det, -b / det], [-c / det, a / det]], origin: [0.0; 2] };
        Affine { origin: linear.at(self.origin.map(|x| -x)), ..linear }
    }
}

/// What is written.
#[derive(Clone, Copy, Debug)]
pub struct Model<'a> {
    /// `nv × 3`; those of no face are left out.
    pub positions: &'a [[f64; 3]],
    /// Polygons, counter-clockwise seen from outside. One of four corners is split along its shorter diagonal, one of more is
    /// a fan from its first corner.
    pub faces: &'a Faces,
    /// Whether the third axis points up, and not the second as in glTF.
    pub z_up: bool,
    /// Per corner, face after face, a unit vector; none: viewers take those of the triangles.
    pub normals: Option<&'a [[f64; 3]]>,
    /// The map: per corner, face after face, (u, v).
    pub map: Option<&'a [[f64; 2]]>,
    /// (u, v) to texture coordinates.
    pub texture: Affine,
    /// A PNG file that repeats on the unit square of texture coordinates. Without a map it is left out.
    pub picture: Option<&'a [u8]>,
}

/// Why a surface does not fit into a file of binary glTF.
#[derive(Debug, thiserror::Error)]
pub enum GlbError {
    /// There is nothing to be shown.
    #[error("the surface has no faces, and a .glb file must have some: name it .obj or .ply")]
    NoFaces,
    /// All points are the same, or squares of lengths do not fit 32-bit floats.
    #[error(
        "the surface is {size:e} across, and the 32-bit floats of glTF are good for 1e-15 to 1e15: change the unit, \
         or name it .obj or .ply"
    )]
    Size {
        /// The longest side of its box.
        size: f64,
    },
    /// Lengths within the file are words of 32 bits.
    #[error("the file would have {bytes} bytes, and a .glb file has at most 4294967295: name it .obj or .ply")]
    TooLarge {
        /// How many it would have.
        bytes: u64,
    },
    /// The description could not be made.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

/// A file that is ready to be written.
pub struct Glb<'a> {
    mesh: Mesh,
    picture: &'a [u8],
    json: Vec<u8>,
}

impl<'a> Glb<'a> {
    /// Lays the file out.
    ///
    /// # Errors
    /// What does not fit into it.
    pub fn new(model: &Model<'a>) -> Result<Glb<'a>, GlbError> {
        let mesh = Mesh::new(model)?;
        let picture = model.picture.filter(|_| model.map.is_some()).unwrap_or_default();
        let mut json = serde_json::to_vec(&Document::new(&mesh, model, picture.len()))?;
        json.resize(json.len().next_multiple_of(4), b' ');
        let glb = Glb { mesh, picture, json };
        match glb.bytes() {
            bytes if bytes > u64::from(u32::MAX) => Err(GlbError::TooLarge { bytes }),
            _ => Ok(glb),
        }
    }

    /// The length of the file.
    pub fn bytes(&self) -> u64 {
        12 + 8 + self.json.len() as u64 + 8 + self.binary()
    }

    fn binary(&self) -> u64 {
        (self.mesh.bytes() + self.picture.len() as u64).next_multiple_of(4)
    }

    /// Writes it.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut word = |word: u64| out.write_all(&(word as u32).to_le_bytes());
        word(0x4654_6C67)?; // glTF
        word(2)?;
        word(self.bytes())?;
        word(self.json.len() as u64)?;
        word(0x4E4F_534A)?; // JSON
        out.write_all(&self.json)?;
        out.write_all(&(self.binary() as u32).to_le_bytes())?;
        out.write_all(b"BIN\0")?;
        self.mesh.write(out)?;
        out.write_all(self.picture)?;
        let padding = self.binary() - self.mesh.bytes() - self.picture.len() as u64;
        out.write_all(&[0; 4][..padding as usize])
    }
}
