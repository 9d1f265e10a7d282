//! Binary glTF 2.0: a surface with its map as texture coordinates, and a picture as texture.
//!
//! ```text
//! file   = header (12 bytes)  JSON chunk  BIN chunk        little-endian, chunks of whole words
//! BIN    = positions 3 × f32 | normals 3 × f32 | texture coordinates 2 × f32 | indices u32 | picture
//! (s, t) = texture(u, v)      per corner, from the map; t points down in glTF
//! ```
//!
//! glTF has 32-bit floats. Positions are stored relative to the centre of the bounding box, which
//! becomes the translation of the node, so that surfaces far from the origin lose no precision.

mod document;
mod mesh;

use std::io::{self, Write};

use crate::surface::Faces;
use document::GltfDocument;
use mesh::Mesh;

/// A real affine map of the plane, `x ↦ M x + o`.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct Affine {
    /// M, by rows.
    pub matrix: [[f64; 2]; 2],
    /// The image o of the origin.
    pub origin: [f64; 2],
}

impl Affine {
    /// The map `(u, v) ↦ (u, 1 − v)`, with which a picture is upright on the unit square if v
    /// points up.
    pub const UPRIGHT: Affine = Affine { matrix: [[1.0, 0.0], [0.0, -1.0]], origin: [0.0, 1.0] };

    /// Returns M x + o.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let row = |k: usize| self.matrix[k][0] * x + self.matrix[k][1] * y + self.origin[k];
        [row(0), row(1)]
    }

    /// Returns the composition `x ↦ self(first(x))`.
    pub fn after(&self, first: &Affine) -> Affine {
        let ([[a, b], [c, d]], [[p, q], [r, s]]) = (self.matrix, first.matrix);
        Affine {
            matrix: [[a * p + b * r, a * q + b * s], [c * p + d * r, c * q + d * s]],
            origin: self.at(first.origin),
        }
    }

    /// Returns the inverse map; it is not finite if M is singular.
    pub fn inverse(&self) -> Affine {
        let [[a, b], [c, d]] = self.matrix;
        let det = a * d - b * c;
        let linear = Affine { matrix: [[d / det, -b / det], [-c / det, a / det]], origin: [0.0; 2] };
        Affine { origin: linear.at(self.origin.map(|x| -x)), ..linear }
    }
}

/// A surface to be written as binary glTF.
#[derive(Clone, Copy, Debug)]
pub struct Model<'a> {
    /// Positions (`nv × 3`); vertices of no face are omitted.
    pub positions: &'a [[f64; 3]],
    /// Polygons, counter-clockwise seen from outside. Quads are split along their shorter diagonal,
    /// larger polygons into a fan from their first corner.
    pub faces: &'a Faces,
    /// Whether the third axis points up (instead of the second, as in glTF).
    pub z_up: bool,
    /// Unit normals per corner, face after face. Without them viewers use those of the triangles.
    pub normals: Option<&'a [[f64; 3]]>,
    /// The map: (u, v) per corner, face after face.
    pub map: Option<&'a [[f64; 2]]>,
    /// The transformation from (u, v) to texture coordinates.
    pub texture: Affine,
    /// A PNG file that is repeated periodically over the texture coordinates. Ignored without a
    /// map.
    pub picture: Option<&'a [u8]>,
}

/// A surface cannot be written as binary glTF.
#[derive(Debug, thiserror::Error)]
pub enum GlbError {
    /// The surface has no faces.
    #[error("the surface has no faces, and a .glb file must have some: name it .obj or .ply")]
    NoFaces,
    /// All points coincide, or squares of lengths do not fit into 32-bit floats.
    #[error(
        "the surface is {size:e} across, and the 32-bit floats of glTF are accurate for 1e-15 to 1e15: change the unit, \
         or name it .obj or .ply"
    )]
    Size {
        /// The longest side of the bounding box.
        size: f64,
    },
    /// The file is longer than its 32-bit length fields allow.
    #[error("the file would have {bytes} bytes, and a .glb file has at most 4294967295: name it .obj or .ply")]
    TooLarge {
        /// Number of bytes of the file.
        bytes: u64,
    },
    /// The JSON part could not be made.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
}

/// A binary glTF file that is ready to be written.
pub struct Glb<'a> {
    mesh: Mesh,
    picture: &'a [u8],
    json: Vec<u8>,
}

impl<'a> Glb<'a> {
    /// Lays out the file.
    ///
    /// # Errors
    /// [`GlbError`] if the surface cannot be represented.
    pub fn new(model: &Model<'a>) -> Result<Glb<'a>, GlbError> {
        let mesh = Mesh::new(model)?;
        let picture = model.picture.filter(|_| model.map.is_some()).unwrap_or_default();
        let mut json = serde_json::to_vec(&GltfDocument::new(&mesh, model, picture.len()))?;
        json.resize(json.len().next_multiple_of(4), b' ');
        let glb = Glb { mesh, picture, json };
        match glb.bytes() {
            bytes if bytes > u64::from(u32::MAX) => Err(GlbError::TooLarge { bytes }),
            _ => Ok(glb),
        }
    }

    /// The length of the file in bytes.
    pub fn bytes(&self) -> u64 {
        12 + 8 + self.json.len() as u64 + 8 + self.binary()
    }

    fn binary(&self) -> u64 {
        (self.mesh.bytes() + self.picture.len() as u64).next_multiple_of(4)
    }

    /// Writes the file.
    ///
    /// # Errors
    /// Errors of `out`.
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
