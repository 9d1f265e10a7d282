//! Mesh and volume files.
//!
//! Reads OBJ, OFF, PLY and STL; writes OBJ, PLY and binary glTF with texture coordinates. Volumes:
//! DGtal, PGM3D, NumPy, raw. Readers take the whole file as bytes and check every number and index,
//! so that the result has the properties that [`Surface`] guarantees; nothing is repaired. Errors
//! name the line (or byte) and the text that was found.

mod atomic;
mod boundary_lengths;
mod error;
pub mod glb;
mod matrix_market;
mod mesh;
mod obj;
mod off;
mod ply;
mod positions;
mod stl;
mod token;
mod volume;
mod write;

use std::fs;
use std::path::Path;

use crate::surface::Surface;

pub use atomic::{Staged, atomically, can_be_written, stage};
pub use boundary_lengths::{BoundaryLengths, BoundaryLengthsError, LengthUnit, PerEdge, read_boundary_lengths};
pub use error::{Defect, ParseError, Place, ReadError};
pub use matrix_market::write_matrix_market;
pub use mesh::VertexText;
pub use positions::{Places, PositionsError, read_positions};
pub use volume::{Sample, VolumeError, VolumeFormat, VolumeOptions, is_volume, parse_volume, read_volume, write_vol};
pub use write::{Uv, WriteError, is_glb, stage_glb, stage_mesh, writable, write};

use error::Fault;
use mesh::Parsed;

/// The content of a mesh file.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFile {
    /// Positions, polygons, and face normals if every face has one.
    pub surface: Surface,
    /// The vertices with the digits of the file (OBJ, text OFF and ascii PLY).
    pub vertex_text: Option<VertexText>,
    /// If the file has normals but `surface.face_normals` is `None`: the first face (from 0) that
    /// has a corner without normal, or whose normals cancel or are not finite.
    pub face_without_normal: Option<usize>,
    /// The format of the file.
    pub format: Format,
}

/// The mesh file formats that are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Geomview OFF, text or binary.
    Off,
    /// Stanford PLY, ascii or binary.
    Ply,
    /// Stereolithography, text or binary.
    Stl,
}

impl Format {
    /// Every format.
    pub const ALL: [Format; 4] = [Format::Obj, Format::Off, Format::Ply, Format::Stl];

    /// The file name extension in lower case.
    pub fn extension(self) -> &'static str {
        match self {
            Format::Obj => "obj",
            Format::Off => "off",
            Format::Ply => "ply",
            Format::Stl => "stl",
        }
    }

    /// Returns the format of a path's extension, in upper or lower case.
    pub fn of(path: &Path) -> Option<Format> {
        let extension = path.extension()?;
        Format::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }

    /// Lists all extensions for messages: `.obj, .off, …`.
    pub fn known() -> String {
        Format::ALL.map(|format| format!(".{}", format.extension())).join(", ")
    }

    fn reader(self) -> fn(&[u8]) -> Result<Parsed, Fault> {
        match self {
            Format::Obj => obj::read,
            Format::Off => off::read,
            Format::Ply => ply::read,
            Format::Stl => stl::read,
        }
    }
}

/// Reads a mesh; the extension determines the format.
///
/// # Errors
/// [`ReadError`] if the path is not a readable file, the extension is unknown, or the content is
/// not a mesh in its format.
pub fn read(path: &Path) -> Result<MeshFile, ReadError> {
    let owned = || path.to_owned();
    let io = |source| ReadError::Io { path: owned(), source };
    if fs::metadata(path).map_err(io)?.is_dir() {
        return Err(ReadError::Directory { path: owned() });
    }
    let format = Format::of(path).ok_or_else(|| ReadError::UnknownFormat { path: owned() })?;
    let bytes = fs::read(path).map_err(io)?;
    parse(&bytes, format).map_err(|source| ReadError::Parse { path: owned(), source })
}

/// Reads a mesh from the content of a file.
///
/// # Errors
/// [`ParseError`] with the line or byte at which the content is not a mesh in this format.
pub fn parse(bytes: &[u8], format: Format) -> Result<MeshFile, ParseError> {
    let parsed = (format.reader())(bytes).map_err(|fault| fault.locate(bytes))?;
    if parsed.faces.is_empty() {
        let vertices = parsed.positions.len();
        let blank = bytes.iter().all(u8::is_ascii_whitespace);
        let defect = if blank { Defect::Empty } else { Defect::NoFaces { vertices } };
        return Err(Fault::whole(defect).locate(bytes));
    }
    let (surface, vertex_text, face_without_normal) = parsed.into_surface();
    Ok(MeshFile { surface, vertex_text, face_without_normal, format })
}
