use std::io::{self, Write};
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::glb::{Affine, Glb, GlbError, Model};
use super::{Staged, VertexText, can_be_written, stage};
use crate::surface::Surface;

/// Texture coordinates, which are the map.
#[derive(Clone, Copy, Debug)]
pub enum Uv<'a> {
    /// One pair per vertex (`nv × 2`).
    PerVertex(&'a [[f64; 2]]),
    /// Pairs referred to by corners, for surfaces that were cut.
    PerCorner {
        /// The pairs.
        coordinates: &'a [[f64; 2]],
        /// For every corner, face after face, the index of its pair.
        corners: &'a [u32],
    },
}

/// A file could not be written. An existing file is unchanged and no partial file remains.
#[derive(Debug, Error)]
pub enum WriteError {
    /// The operating system refused.
    #[error("cannot write {}: {source}", path.display())]
    Io {
        /// The requested file.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// The extension does not belong to a format that can be written.
    #[error("cannot write {}: unknown mesh format; known extensions: .obj, .ply, .glb", path.display())]
    UnknownFormat {
        /// The requested file.
        path: PathBuf,
    },
    /// Texture coordinates or vertex text do not belong to this surface.
    #[error("cannot write {}: {found} {what} for {expected} of the surface", path.display())]
    Mismatch {
        /// The requested file.
        path: PathBuf,
        /// `texture coordinates`, `corner indices`, `vertex lines`.
        what: &'static str,
        /// The number that was given.
        found: usize,
        /// The number that is needed.
        expected: usize,
    },
    /// A corner refers to a pair of coordinates that does not exist.
    #[error("cannot write {}: corner {corner} has the texture coordinate {index} of {count}", path.display())]
    CornerOutOfRange {
        /// The requested file.
        path: PathBuf,
        /// Position in the flat list of corners.
        corner: usize,
        /// The index of the corner's pair.
        index: u32,
        /// Number of texture coordinates.
        count: usize,
    },
    /// A texture coordinate is NaN or infinite.
    #[error("cannot write {}: texture coordinate {index} (0-based) is ({}, {})", path.display(), value[0], value[1])]
    NotFinite {
        /// The requested file.
        path: PathBuf,
        /// Index of the pair.
        index: usize,
        /// The pair.
        value: [f64; 2],
    },
    /// The surface cannot be represented in binary glTF.
    #[error("cannot write {}: {source}", path.display())]
    Glb {
        /// The requested file.
        path: PathBuf,
        /// The reason.
        source: GlbError,
    },
}

/// Writes a surface with its texture coordinates, if any. The extension determines the format:
/// `.obj`, `.ply` (binary, little-endian) or `.glb`.
///
/// Vertices and faces keep their order and number of corners. The vertices in OBJ are the lines of
/// `text` if given; all other numbers are the shortest text that reads back as the same double. PLY
/// has doubles. Binary glTF has triangles and single precision, see [`glb`](super::glb); (u, v)
/// becomes (u, 1 − v), as its axes require, and there is no picture. [`stage_glb`] writes it with a
/// picture and normals.
///
/// # Errors
/// [`WriteError`]; nothing is written then.
pub fn write(path: &Path, surface: &Surface, text: Option<&VertexText>, uv: Option<Uv>) -> Result<(), WriteError> {
    stage_mesh(path, surface, text, uv)?.publish()
}

/// Does the same as [`write()`] but stages the file, see [`stage`].
///
/// # Errors
/// [`WriteError`].
pub fn stage_mesh(
    path: &Path,
    surface: &Surface,
    text: Option<&VertexText>,
    uv: Option<Uv>,
) -> Result<Staged, WriteError> {
    let writer = writer(path)?;
    check(path, surface, text, uv)?;
    match writer {
        Writer::Plain(writer) => stage(path, |out| writer(out, surface, text, uv)),
        Writer::Glb => {
            let corner = |pairs: &[[f64; 2]], of: &[u32]| of.iter().map(|&k| pairs[k as usize]).collect::<Vec<_>>();
            let map = uv.map(|uv| match uv {
                Uv::PerVertex(coordinates) => corner(coordinates, surface.faces.corners()),
                Uv::PerCorner { coordinates, corners } => corner(coordinates, corners),
            });
            let (positions, faces) = (&surface.positions, &surface.faces);
            let texture = Affine::UPRIGHT;
            let model =
                Model { positions, faces, z_up: false, normals: None, map: map.as_deref(), texture, picture: None };
            stage_glb(path, &model)
        }
    }
}

/// Stages a binary glTF file with normals and a picture, see [`stage`].
///
/// # Errors
/// [`WriteError::Glb`], [`WriteError::Io`].
pub fn stage_glb(path: &Path, model: &Model) -> Result<Staged, WriteError> {
    let glb = Glb::new(model).map_err(|source| WriteError::Glb { path: path.to_owned(), source })?;
    stage(path, |out| glb.write(out))
}

/// Checks whether a mesh can be written under this name, so that a long computation does not end in
/// an error.
///
/// # Errors
/// [`WriteError::UnknownFormat`] if the extension does not belong to a format that can be written;
/// otherwise as [`can_be_written`].
pub fn writable(path: &Path) -> Result<(), WriteError> {
    writer(path)?;
    can_be_written(path)
}

fn writer(path: &Path) -> Result<Writer, WriteError> {
    let is = |known: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(known));
    match () {
        () if is("obj") => Ok(Writer::Plain(obj)),
        () if is("ply") => Ok(Writer::Plain(ply)),
        () if is_glb(path) => Ok(Writer::Glb),
        () => Err(WriteError::UnknownFormat { path: path.to_owned() }),
    }
}

/// Whether the extension is that of binary glTF.
pub fn is_glb(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb"))
}

type Plain = fn(&mut dyn Write, &Surface, Option<&VertexText>, Option<Uv>) -> io::Result<()>;

enum Writer {
    Plain(Plain),
    Glb,
}

fn check(path: &Path, surface: &Surface, text: Option<&VertexText>, uv: Option<Uv>) -> Result<(), WriteError> {
    let path = || path.to_owned();
    let same = |what, found, expected| {
        if found == expected { Ok(()) } else { Err(WriteError::Mismatch { path: path(), what, found, expected }) }
    };
    let vertices = surface.positions.len();
    if let Some(text) = text {
        same("vertex lines", text.len(), vertices)?;
    }
    let coordinates = match uv {
        None => return Ok(()),
        Some(Uv::PerVertex(coordinates)) => {
            same("texture coordinates", coordinates.len(), vertices)?;
            coordinates
        }
        Some(Uv::PerCorner { coordinates, corners }) => {
            same("corner indices", corners.len(), surface.faces.corners().len())?;
            let count = coordinates.len();
            if let Some((corner, &index)) = corners.iter().enumerate().find(|&(_, &i)| i as usize >= count) {
                return Err(WriteError::CornerOutOfRange { path: path(), corner, index, count });
            }
            coordinates
        }
    };
    match coordinates.iter().enumerate().find(|(_, uv)| !(uv[0].is_finite() && uv[1].is_finite())) {
        Some((index, &value)) => Err(WriteError::NotFinite { path: path(), index, value }),
        None => Ok(()),
    }
}

fn obj(out: &mut dyn Write, surface: &Surface, text: Option<&VertexText>, uv: Option<Uv>) -> io::Result<()> {
    for (v, p) in surface.positions.iter().enumerate() {
        match text.and_then(|t| t.line(v)) {
            Some(line) => {
                out.write_all(line)?;
                out.write_all(b"\n")?;
            }
            None => writeln!(out, "v {:?} {:?} {:?}", p[0], p[1], p[2])?,
        }
    }
    let (coordinates, texture): (&[[f64; 2]], Option<&[u32]>) = match uv {
        None => (&[], None),
        Some(Uv::PerVertex(coordinates)) => (coordinates, Some(surface.faces.corners())),
        Some(Uv::PerCorner { coordinates, corners }) => (coordinates, Some(corners)),
    };
    for [u, v] in coordinates {
        writeln!(out, "vt {u:?} {v:?}")?;
    }
    for (f, polygon) in surface.faces.iter().enumerate() {
        out.write_all(b"f")?;
        for (c, &vertex) in surface.faces.corner_range(f).zip(polygon) {
            // Indices count from 1; 64 bits, because the last one may not fit into 32.
            let vertex = u64::from(vertex) + 1;
            match texture {
                Some(texture) => write!(out, " {vertex}/{}", u64::from(texture[c]) + 1)?,
                None => write!(out, " {vertex}")?,
            }
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}

fn ply(out: &mut dyn Write, surface: &Surface, _: Option<&VertexText>, uv: Option<Uv>) -> io::Result<()> {
    let most = surface.faces.iter().map(<[u32]>::len).max().unwrap_or(0);
    let count = |most: usize| if most <= 255 { "uchar" } else { "int" };
    writeln!(out, "ply\nformat binary_little_endian 1.0\ncomment written by riemap")?;
    writeln!(out, "element vertex {}", surface.positions.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z")?;
    if let Some(Uv::PerVertex(_)) = uv {
        writeln!(out, "property double s\nproperty double t")?;
    }
    writeln!(out, "element face {}", surface.faces.len())?;
    writeln!(out, "property list {} uint vertex_indices", count(most))?;
    if let Some(Uv::PerCorner { .. }) = uv {
        writeln!(out, "property list {} double texcoord", count(2 * most))?;
    }
    writeln!(out, "end_header")?;
    for (v, position) in surface.positions.iter().enumerate() {
        numbers(out, position)?;
        if let Some(Uv::PerVertex(coordinates)) = uv {
            numbers(out, &coordinates[v])?;
        }
    }
    for (f, polygon) in surface.faces.iter().enumerate() {
        length(out, polygon.len(), most)?;
        for vertex in polygon {
            out.write_all(&vertex.to_le_bytes())?;
        }
        if let Some(Uv::PerCorner { coordinates, corners }) = uv {
            length(out, 2 * polygon.len(), 2 * most)?;
            for &i in &corners[surface.faces.corner_range(f)] {
                numbers(out, &coordinates[i as usize])?;
            }
        }
    }
    Ok(())
}

fn numbers(out: &mut dyn Write, numbers: &[f64]) -> io::Result<()> {
    numbers.iter().try_for_each(|x| out.write_all(&x.to_le_bytes()))
}

/// Writes the length of a list whose type was chosen for lists up to `most`.
fn length(out: &mut dyn Write, length: usize, most: usize) -> io::Result<()> {
    if most <= 255 { out.write_all(&[length as u8]) } else { out.write_all(&(length as u32).to_le_bytes()) }
}
