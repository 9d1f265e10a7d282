//! The mesh of a contest as files, in triangles for peers, and the measurement of their maps.

use std::f64::consts::TAU;
use std::path::{Path, PathBuf};

use num_complex::Complex64;

use super::BenchError;
use super::record::Quality;
use crate::constraint::Fixed;
use crate::distortion::{Distortion, Image};
use crate::input::Input;
use crate::io;
use crate::map::{Domain, MapOptions};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::{Faces, Surface};

/// A disc written to a folder.
pub(super) struct Target {
    /// Name or path of the source.
    pub name: String,
    /// Number of vertices.
    pub vertices: usize,
    /// Number of faces.
    pub faces: usize,
    /// Path of an OBJ file of `v` and `f` lines.
    pub mesh: PathBuf,
    /// Path of the same mesh in triangles, which is `mesh` if its faces are triangles.
    pub triangles: PathBuf,
    domain: Domain,
}

impl Target {
    /// Writes the files of the mesh `input` into `folder`.
    pub fn new(input: Input, folder: &Path) -> Result<Target, BenchError> {
        let disc = OrientedMesh::new(&input.surface, &input.diagnosis())?;
        // The disc and no more: each of its vertices on a face, in one orientation.
        let surface = Surface { face_normals: None, ..disc.to_surface() };
        let mesh = folder.join("mesh.obj");
        io::write(&mesh, &surface, None, None)?;
        let triangles = match surface.faces.arity() {
            Some(3) => mesh.clone(),
            _ => {
                let path = folder.join("triangles.obj");
                io::write(&path, &Surface { faces: split(&surface.faces), ..surface }, None, None)?;
                path
            }
        };
        let (vertices, faces) = (disc.positions.len(), disc.faces.len());
        let domain = Domain::of_positions(disc, &MapOptions::default())?;
        Ok(Target { name: input.source, vertices, faces, mesh, triangles, domain })
    }

    /// Returns the quality of a map given as two little-endian doubles per vertex, or its fault.
    pub fn quality(&self, bytes: &[u8]) -> Result<Quality, String> {
        let (numbers, rest) = bytes.as_chunks::<8>();
        if numbers.len() != 2 * self.vertices || !rest.is_empty() {
            return Err(format!(
                "its map has {} bytes, not two doubles for each of {} vertices",
                bytes.len(),
                self.vertices
            ));
        }
        let numbers: Vec<f64> = numbers.iter().map(|&bytes| f64::from_le_bytes(bytes)).collect();
        if let Some(k) = numbers.iter().position(|x| !x.is_finite()) {
            return Err(format!("its map is {} at vertex {} (0-based)", numbers[k], k / 2));
        }
        Ok(self.measure(numbers.as_chunks::<2>().0.iter().map(|&[x, y]| Complex64::new(x, y)).collect()))
    }

    /// Measures a map with finite values, one a vertex.
    pub fn measure(&self, z: Vec<Complex64>) -> Quality {
        // Dual vertices, which peers know nothing of, go where measuring wants them: it looks at
        // faces of the mesh.
        let z = self.domain.with_dual_vertices(z, &Fixed::default());
        let Domain { disc, graph, .. } = &self.domain;
        Quality::of(&Distortion::new(disc, graph, None, &Image::of_disc(&z)))
    }
}

/// Splits every face into the triangles at its first corner.
fn split(faces: &Faces) -> Faces {
    let of = |f: &[u32]| (1..f.len() - 1).map(|k| [f[0], f[k], f[k + 1]]).collect::<Vec<_>>();
    faces.iter().flat_map(of).collect()
}

/// A flat cone of that many triangles around its apex, as steep as a roof of one in five.
pub(super) fn fan(triangles: usize) -> Surface {
    let rim = (0..triangles).map(|k| {
        let (y, x) = (TAU * k as f64 / triangles as f64).sin_cos();
        [x, y, 0.0]
    });
    let count = triangles as u32;
    let faces = (0..count).map(|k| [0, 1 + k, 1 + (k + 1) % count]).collect();
    Surface { positions: std::iter::once([0.0, 0.0, 0.2]).chain(rim).collect(), faces, face_normals: None }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bytes(uv: impl IntoIterator<Item = [f64; 2]>) -> Vec<u8> {
        uv.into_iter().flatten().flat_map(f64::to_le_bytes).collect()
    }

    #[test]
    fn a_map_of_a_peer_is_measured_on_the_faces_of_the_mesh() {
        let folder = tempfile::tempdir().expect("a folder");
        for (mesh, faces) in [("quad", 36), ("triangle", 72)] {
            let flat = Input::open(&format!("graph:flat?n=7&mesh={mesh}")).expect("a flat square");
            let target = Target::new(flat, folder.path()).expect("a flat square");
            assert_eq!((target.vertices, target.faces), (49, faces));
            let triangles = Input::open(&target.triangles.to_string_lossy()).expect("triangles");
            assert_eq!((triangles.surface.faces.arity(), triangles.surface.faces.len()), (Some(3), 72));

            let flat: Vec<[f64; 2]> = target.domain.disc.positions.iter().map(|p| [p[0], p[1]]).collect();
            let stretched = |by: f64| target.quality(&bytes(flat.iter().map(|[x, y]| [by * x, *y]))).expect("finite");
            for error in [1.0, 2.0] {
                let quality = stretched(error);
                // To rounding of a few operations.
                assert!((quality.quasi_conformal.expect("known") - error).abs() < 1e-12, "{quality:?}");
                assert!((quality.area.expect("known") - 1.0).abs() < 1e-12 && quality.flipped == 0, "{quality:?}");
            }
            let mirrored = stretched(-1.0);
            assert!(mirrored.quasi_conformal.is_none() && mirrored.flipped == faces, "{mirrored:?}");

            assert!(target.quality(&bytes(flat[1..].iter().copied())).is_err());
            assert!(target.quality(&bytes(flat.iter().map(|[x, _]| [*x, f64::NAN]))).is_err());
        }
    }
}
