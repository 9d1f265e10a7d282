//! A surface that can be mapped to the plane in one piece.

use super::edges::next_in;
use super::{Faces, Surface, Surrogates};
use crate::surface::topology::diagnosis::{Diagnosis, Finding};

/// A consistently oriented topological disc made of triangles or of quads, or a closed surface
/// (from [`OrientedMesh::closed`]).
///
/// Vertices are numbered without gaps.
#[derive(Clone, Debug)]
pub struct OrientedMesh {
    /// Positions of the vertices (`nv × 3`); all vertices belong to faces.
    pub positions: Vec<[f64; 3]>,
    /// The faces in the order of the source, all counter-clockwise seen from the same side. The
    /// last `filled` of them fill holes of the source.
    pub faces: Faces,
    /// Unit normals per face (`nf × 3`), flipped with their faces, if the source gives them.
    pub face_normals: Option<Vec<[f64; 3]>>,
    /// The boundary loop with the surface on its left, from the vertex of lowest index; empty on
    /// closed surfaces.
    pub boundary: Vec<u32>,
    /// For each vertex its index in the source, ascending.
    ///
    /// A vertex on a cut has several copies with consecutive indices. Vertices that fill holes come
    /// last and have [`OrientedMesh::NEW`].
    pub source_vertex: Vec<u32>,
    /// For each face its index in the source, ascending; faces that fill holes come last and have
    /// [`OrientedMesh::NEW`].
    pub source_face: Vec<u32>,
    /// Number of faces that fill holes. They take part in the map, but are neither written nor
    /// measured.
    pub filled: usize,
    /// The faces without area that are mapped with a surrogate shape; empty unless requested.
    pub surrogates: Surrogates,
}

/// The surface is not a disc or is too degenerate to be mapped; all reasons are listed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", lines(.findings))]
pub struct NotADisc {
    /// The fatal findings of the diagnosis.
    pub findings: Vec<Finding>,
}

fn lines(findings: &[Finding]) -> String {
    findings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n")
}

impl OrientedMesh {
    /// The index in the source of a vertex or face that fills a hole; also marks corners of faces
    /// that were removed.
    pub const NEW: u32 = u32::MAX;

    /// Converts a surface that is a disc, with the orientation that its diagnosis requires.
    ///
    /// # Errors
    /// All fatal findings of the diagnosis, if there are any.
    pub fn new(surface: &Surface, diagnosis: &Diagnosis) -> Result<Self, NotADisc> {
        let findings: Vec<Finding> = diagnosis.fatal().cloned().collect();
        if !findings.is_empty() {
            return Err(NotADisc { findings });
        }
        let topology = &diagnosis.topology;
        let source_vertex: Vec<u32> =
            (0..surface.positions.len() as u32).filter(|&v| topology.fans[v as usize] > 0).collect();
        let mut compact = vec![u32::MAX; surface.positions.len()];
        for (new, &old) in source_vertex.iter().enumerate() {
            compact[old as usize] = new as u32;
        }
        let mut faces = surface.faces.renumbered(&compact);
        let mut face_normals = surface.face_normals.clone();
        let flipped = topology.orientation.flip.iter().enumerate().filter(|(_, flip)| **flip);
        for (f, _) in flipped {
            faces.flip(f);
            if let Some(normals) = &mut face_normals {
                normals[f] = crate::geometry::vector::scale(-1.0, normals[f]);
            }
        }
        let boundary = boundary(surface, diagnosis, &compact);
        let positions = source_vertex.iter().map(|&v| surface.positions[v as usize]).collect();
        let source_face = (0..faces.len() as u32).collect();
        Ok(OrientedMesh {
            positions,
            faces,
            face_normals,
            boundary,
            source_vertex,
            source_face,
            filled: 0,
            surrogates: Surrogates::default(),
        })
    }

    /// Returns the mesh as a surface, including the faces that fill holes.
    pub fn to_surface(&self) -> Surface {
        Surface {
            positions: self.positions.clone(),
            faces: self.faces.clone(),
            face_normals: self.face_normals.clone(),
        }
    }

    /// Number of faces that belong to the source; they come first.
    pub fn source_faces(&self) -> usize {
        self.faces.len() - self.filled
    }

    /// The copies of vertex `source` of the source: none if no face uses it, several if it lies on
    /// a cut.
    pub fn copies(&self, source: u32) -> std::ops::Range<u32> {
        let first = self.source_vertex.partition_point(|&v| v < source);
        let count = self.source_vertex[first..].iter().take_while(|&&v| v == source && v != Self::NEW).count();
        first as u32..(first + count) as u32
    }

    /// Whether some vertex of the source has several copies.
    pub fn is_cut(&self) -> bool {
        self.source_vertex.windows(2).any(|pair| pair[0] == pair[1] && pair[0] != Self::NEW)
    }

    /// For every corner of `surface`, the source of this mesh, returns the vertex there, or
    /// [`OrientedMesh::NEW`] at faces that were removed.
    pub fn corner_vertices(&self, surface: &Surface) -> Vec<u32> {
        let mut corners = self.corners_of(surface);
        for c in corners.iter_mut().filter(|c| **c != Self::NEW) {
            *c = self.faces.corners()[*c as usize];
        }
        corners
    }

    /// For every corner of `surface`, the source of this mesh, returns the corresponding position
    /// in the corners of [`OrientedMesh::faces`], or [`OrientedMesh::NEW`] at faces that were
    /// removed.
    pub fn corners_of(&self, surface: &Surface) -> Vec<u32> {
        let mut corners = vec![Self::NEW; surface.faces.corners().len()];
        for (f, &source) in self.source_face.iter().enumerate().take(self.source_faces()) {
            let range = surface.faces.corner_range(source as usize);
            let (theirs, ours) = (surface.faces.get(source as usize), self.faces.get(f));
            let (first, n) = (self.faces.corner_range(f).start, ours.len());
            // A flipped face keeps its first corner.
            let turned = self.source_vertex[ours[1] as usize] != theirs[1];
            for (k, c) in range.enumerate() {
                corners[c] = (first + if turned { (n - k) % n } else { k }) as u32;
            }
        }
        corners
    }
}

/// Returns the boundary loop in the direction of the oriented faces. A disc has one loop, and one
/// outgoing edge at each of its vertices.
fn boundary(surface: &Surface, diagnosis: &Diagnosis, compact: &[u32]) -> Vec<u32> {
    let topology = &diagnosis.topology;
    let vertex = surface.faces.corners();
    let mut ahead = vec![u32::MAX; compact.len()];
    let mut first = None;
    for e in 0..topology.edges.len() {
        let &[c] = topology.edges.corners(e) else { continue };
        let f = topology.edges.face_of_corner[c as usize] as usize;
        let (mut a, mut b) = (vertex[c as usize], vertex[next_in(&surface.faces, f, c as usize)]);
        if topology.orientation.flip[f] {
            std::mem::swap(&mut a, &mut b);
        }
        ahead[a as usize] = b;
        // Edges are sorted by their smaller ends.
        first.get_or_insert(topology.edges.ends[e][0]);
    }
    let mut boundary = Vec::new();
    let mut next = first;
    while let Some(v) = next {
        boundary.push(compact[v as usize]);
        next = Some(ahead[v as usize]).filter(|&w| Some(w) != first);
    }
    boundary
}
