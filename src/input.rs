//! Where surfaces come from: mesh files, volume files, and generated surfaces by name.

use std::path::Path;

use serde::Deserialize;

use crate::io::{self, ReadError, Sample, VertexText, VolumeError, VolumeOptions};
use crate::surface::Surface;
use crate::surface::digital::{self, Adjacency, Digital, DigitalError};
use crate::surface::generate::{GenerateError, generate, is_generated_name};
use crate::surface::topology::diagnosis::{Diagnosis, Finding};

/// A surface with what its source tells beside it.
#[derive(Clone, Debug)]
pub struct Input {
    /// The path, or the full name of a generated surface.
    pub source: String,
    /// The surface.
    pub surface: Surface,
    /// Digital surfaces: the voxels and the surfels.
    pub digital: Option<Digital>,
    /// The text of the vertices, where a file has one, so that it can be written as it was.
    pub vertex_text: Option<VertexText>,
    /// The exact conformal coordinates (`nv × 2`), of generated surfaces where they are known.
    pub exact: Option<Vec<[f64; 2]>>,
    /// The exact ratio of periods, of generated surfaces of genus 1 where it is known.
    pub period: Option<[f64; 2]>,
    /// The first face that has no usable normal, where the file gives normals to others.
    pub face_without_normal: Option<usize>,
}

/// How a volume file is made into a surface. All `None` for meshes and generated surfaces.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct InputOptions {
    /// Voxels of larger values are inside; by default 0.
    pub threshold: Option<f64>,
    /// Raw volumes: voxels along each axis.
    pub size: Option<[usize; 3]>,
    /// Raw volumes: what a voxel is.
    #[serde(rename = "type")]
    pub sample: Option<Sample>,
    /// What becomes of edges where four surfels meet.
    pub adjacency: Option<Adjacency>,
    /// Which component of the boundary, by number of surfels; by default 0, the largest.
    pub component: Option<usize>,
}

/// No surface.
#[derive(Debug, thiserror::Error)]
pub enum InputError {
    /// A file that cannot be read as a mesh.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A file that cannot be read as a volume.
    #[error(transparent)]
    Volume(#[from] VolumeError),
    /// A volume that bounds no surface.
    #[error("{path}")]
    Digital {
        /// The file.
        path: String,
        /// What is wrong.
        source: DigitalError,
    },
    /// A name of no surface.
    #[error(transparent)]
    Generate(#[from] GenerateError),
    /// Options of volume files for something else.
    #[error(
        "{name} is no volume file, and threshold, size, type, adjacency and component are for these: leave them out"
    )]
    NotAVolume {
        /// What was named.
        name: String,
    },
}

impl Input {
    /// Reads the mesh or volume file, or makes the generated surface, that `source` names.
    ///
    /// # Errors
    /// As the reader or the generator says.
    pub fn open(source: &str) -> Result<Self, InputError> {
        Input::open_with(source, &InputOptions::default())
    }

    /// The same with choices for volume files.
    ///
    /// # Errors
    /// As the reader or the generator says; choices where there is no volume file.
    pub fn open_with(source: &str, options: &InputOptions) -> Result<Self, InputError> {
        let path = Path::new(source);
        let generated = is_generated_name(source);
        if !generated && io::is_volume(path) {
            return Input::from_volume(source, options);
        }
        if *options != InputOptions::default() {
            return Err(InputError::NotAVolume { name: source.to_owned() });
        }
        if generated {
            let generated = generate(source)?;
            return Ok(Input {
                digital: generated.digital,
                exact: generated.exact,
                period: generated.period,
                ..Input::of(generated.name, generated.surface)
            });
        }
        let file = io::read(path)?;
        Ok(Input {
            vertex_text: file.vertex_text,
            face_without_normal: file.face_without_normal,
            ..Input::of(source.to_owned(), file.surface)
        })
    }

    fn from_volume(source: &str, options: &InputOptions) -> Result<Self, InputError> {
        let volume = VolumeOptions { threshold: options.threshold, size: options.size, sample: options.sample };
        let solid = io::read_volume(Path::new(source), &volume)?;
        let adjacency = options.adjacency.unwrap_or_default();
        let (surface, digital) = digital::boundary(solid, adjacency, options.component.unwrap_or(0))
            .map_err(|reason| InputError::Digital { path: source.to_owned(), source: reason })?;
        Ok(Input { digital: Some(digital), ..Input::of(source.to_owned(), surface) })
    }

    /// What the surface is and what is wrong with it.
    pub fn diagnosis(&self) -> Diagnosis {
        let mut diagnosis = Diagnosis::new(&self.surface);
        if self.digital.is_some() {
            // Where voxels touch at a vertex or an edge, the vertices are copied on purpose.
            diagnosis.findings.retain(|finding| !matches!(finding, Finding::CoincidentVertices { .. }));
        }
        diagnosis
    }

    /// A surface of which nothing more is known.
    pub fn of(source: String, surface: Surface) -> Self {
        Input {
            source,
            surface,
            digital: None,
            vertex_text: None,
            exact: None,
            period: None,
            face_without_normal: None,
        }
    }
}
