//! Where surfaces come from: mesh files, and generated surfaces by name.

use std::path::Path;

use crate::io::{self, ReadError, VertexText};
use crate::surface::Surface;
use crate::surface::generate::{GenerateError, generate, is_generated_name};

/// A surface with what its source tells beside it.
#[derive(Clone, Debug)]
pub struct Input {
    /// The path, or the full name of a generated surface.
    pub source: String,
    /// The surface.
    pub surface: Surface,
    /// The text of the vertices, where a file has one, so that it can be written as it was.
    pub vertex_text: Option<VertexText>,
    /// The exact conformal coordinates (`nv × 2`), of generated surfaces where they are known.
    pub exact: Option<Vec<[f64; 2]>>,
    /// The first face that has no usable normal, where the file gives normals to others.
    pub face_without_normal: Option<usize>,
}

/// No surface.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// A file that cannot be read as a mesh.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A name of no surface.
    #[error(transparent)]
    Generate(#[from] GenerateError),
}

impl Input {
    /// Reads the mesh file, or makes the generated surface, that `source` names.
    ///
    /// # Errors
    /// As the reader or the generator says.
    pub fn open(source: &str) -> Result<Self, InputError> {
        if is_generated_name(source) {
            let generated = generate(source)?;
            return Ok(Input {
                source: generated.name,
                surface: generated.surface,
                vertex_text: None,
                exact: generated.exact,
                face_without_normal: None,
            });
        }
        let file = io::read(Path::new(source))?;
        Ok(Input {
            source: source.to_owned(),
            surface: file.surface,
            vertex_text: file.vertex_text,
            exact: None,
            face_without_normal: file.face_without_normal,
        })
    }
}
