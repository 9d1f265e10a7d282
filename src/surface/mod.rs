//! Surfaces to be mapped: positions, polygons and their combinatorial properties.

pub mod cut;
pub mod digital;
pub mod edges;
mod error;
mod faces;
pub mod generate;
pub mod normals;
pub mod orientation;
pub mod oriented_mesh;
pub mod parameters;
mod surrogate;
pub mod topology;
mod union_find;

pub use error::SurfaceError;
pub use faces::Faces;
pub use surrogate::Surrogates;
pub(crate) use union_find::UnionFind;

/// A polygon mesh as given by its source.
///
/// Every face has at least three corners and every vertex index is valid; no other property is
/// guaranteed. [`Diagnosis`](topology::diagnosis::Diagnosis) finds its defects.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Vertex positions in R³ (`nv × 3`, in the unit of the source).
    pub(crate) positions: Vec<[f64; 3]>,
    /// Polygons as lists of vertex indices, each index `< nv`, in the order of the source.
    pub(crate) faces: Faces,
    /// One unit normal per face (`nf × 3`), if the source gives normals: the normalised mean of the
    /// normals at the corners of the face.
    pub(crate) face_normals: Option<Vec<[f64; 3]>>,
}

impl Surface {
    /// Makes a surface from vertex positions (`nv × 3`) and polygons (`nf` lists of vertex indices,
    /// counted from 0, counter-clockwise seen from outside).
    ///
    /// ```
    /// use riemap::Surface;
    ///
    /// let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    /// assert!(Surface::new(corners.clone(), vec![vec![0, 1, 2]]).is_ok());
    /// let error = Surface::new(corners, vec![vec![0, 1, 3]]).unwrap_err();
    /// assert_eq!(error.to_string(), "face 0 has the vertex 3, and there are 3 vertices (they count from 0)");
    /// ```
    ///
    /// # Errors
    /// A face with fewer than three corners, a vertex index out of range, or more vertices or
    /// corners than 32-bit indices can number.
    pub fn new(positions: Vec<[f64; 3]>, faces: Vec<Vec<u32>>) -> Result<Self, SurfaceError> {
        Surface::from_polygons(positions, &faces)
    }

    /// Makes a surface as [`Surface::new`] does, from any sequence of polygons.
    ///
    /// # Errors
    /// As for [`Surface::new`].
    pub fn from_polygons<P: AsRef<[u32]>>(
        positions: Vec<[f64; 3]>,
        polygons: impl IntoIterator<Item = P>,
    ) -> Result<Self, SurfaceError> {
        let vertices = positions.len();
        // The largest index is reserved: it marks missing corners and vertices.
        if vertices >= u32::MAX as usize {
            return Err(SurfaceError::TooManyVertices { vertices });
        }
        let mut faces = Faces::default();
        for (face, polygon) in polygons.into_iter().enumerate() {
            let polygon = polygon.as_ref();
            if polygon.len() < 3 {
                return Err(SurfaceError::TooFewCorners { face, corners: polygon.len() });
            }
            if let Some(&vertex) = polygon.iter().find(|&&v| v as usize >= vertices) {
                return Err(SurfaceError::NoSuchVertex { face, vertex, vertices });
            }
            if polygon.len() >= u32::MAX as usize - faces.corners().len() {
                return Err(SurfaceError::TooManyCorners { face });
            }
            faces.push(polygon);
        }
        Ok(Surface { positions, faces, face_normals: None })
    }

    /// Returns the same surface with one unit normal per face (`nf × 3`).
    ///
    /// # Errors
    /// The number of normals is not the number of faces.
    pub fn with_face_normals(self, normals: Vec<[f64; 3]>) -> Result<Self, SurfaceError> {
        match normals.len() == self.faces.len() {
            true => Ok(Surface { face_normals: Some(normals), ..self }),
            false => Err(SurfaceError::NormalCount { normals: normals.len(), faces: self.faces.len() }),
        }
    }

    /// Vertex positions in R³ (`nv × 3`, in the unit of the source).
    pub fn positions(&self) -> &[[f64; 3]] {
        &self.positions
    }

    /// Mutable vertex positions in R³ (`nv × 3`).
    pub fn positions_mut(&mut self) -> &mut [[f64; 3]] {
        &mut self.positions
    }

    /// Polygons as lists of vertex indices, in the order of the source.
    pub fn faces(&self) -> &Faces {
        &self.faces
    }

    /// One unit normal per face (`nf × 3`), if the source gives normals.
    pub fn face_normals(&self) -> Option<&[[f64; 3]]> {
        self.face_normals.as_deref()
    }
}
