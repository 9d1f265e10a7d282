//! A surface that can be mapped to the plane in one piece.

use super::edges::next_in;
use super::{Faces, Surface, Surrogates};
use crate::surface::topology::diagnosis::{Diagnosis, Finding};

/// One consistently oriented topological disc of triangles or of quads, vertices numbered without gaps; or, from
/// [`OrientedMesh::closed`], a closed surface.
#[derive(Clone, Debug)]
pub struct OrientedMesh {
    /// Vertex positions (`nv × 3`), those in use only.
    pub positions: Vec<[f64; 3]>,
    /// The faces, in the order of the source, all counter-clockwise seen from the same side. The last `filled` ones close
    /// holes of the source.
    pub faces: Faces,
    /// Unit normals per face (`nf × 3`), turned over with their faces, where the source gives them.
    pub face_normals: Option<Vec<[f64; 3]>>,
    /// The boundary loop, with the surface on its left, from the vertex of lowest index. Empty where there is none.
    pub boundary: Vec<u32>,
    /// For each vertex its index in the source, ascending. One on a cut is there several times, one behind the other;
    /// those put into holes come last and have [`OrientedMesh::NEW`].
    pub source_vertex: Vec<u32>,
    /// For each face its index in the source, ascending; those put into holes come last and have [`OrientedMesh::NEW`].
    pub source_face: Vec<u32>,
    /// Number of faces that were put into holes. They take part in the map, but not in what is written or measured.
    pub filled: usize,
    /// The faces without area that are given a shape; none unless that is asked for.
    pub surrogates: Surrogates,
}

/// The surface is no disc, or too badly formed to be mapped: all that stands against it.
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
    /// Marks what the source has not: vertices and faces put into holes; and, of corners, what the disc has not.
    pub const NEW: u32 = u32::MAX;

    /// The disc that `surface` is, with the orientation its diagnosis asks for.
    ///
    /// # Errors
    /// All fatal findings of the diagnosis, where there are some.
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

    /// The mesh as a surface of its own, filled holes included.
    pub fn to_surface(&self) -> Surface {
        Surface {
            positions: self.positions.clone(),
            faces: self.faces.clone(),
            face_normals: self.face_normals.clone(),
        }
    }

    /// Number of faces that the source has too; they come first.
    pub fn source_faces(&self) -> usize {
        self.faces.len() - self.filled
    }

    /// The vertices that vertex `source` of the source became: none where no face uses it, several where it was cut.
    pub fn copies(&self, source: u32) -> std::ops::Range<u32> {
        let first = self.source_vertex.partition_point(|&v| v < source);
        let count = self.source_vertex[first..].iter().take_while(|&&v| v == source && v != Self::NEW).count();
        first as u32..(first + count) as u32
    }

    /// Whether some vertex of the source is there several times.
    pub fn is_cut(&self) -> bool {
        self.source_vertex.windows(2).any(|pair| pair[0] == pair[1] && pair[0] != Self::NEW)
    }

    /// For every corner of `surface`, from which this was made, the vertex there; [`OrientedMesh::NEW`] at faces that were removed.
    pub fn corner_vertices(&self, surface: &Surface) -> Vec<u32> {
        let mut corners = self.corners_of(surface);
        for c in corners.iter_mut().filter(|c| **c != Self::NEW) {
            *c = self.faces.corners()[*c as usize];
        }
        corners
    }

    /// For every corner of `surface`, from which this was made, the corner here, a position in the corners of
    /// [`OrientedMesh::faces`]; [`OrientedMesh::NEW`] at faces that were removed.
    pub fn corners_of(&self, surface: &Surface) -> Vec<u32> {
        let mut corners = vec![Self::NEW; surface.faces.corners().len()];
        for (f, &source) in self.source_face.iter().enumerate().take(self.source_faces()) {
            let range = surface.faces.corner_range(source as usize);
            let (theirs, ours) = (surface.faces.get(source as usize), self.faces.get(f));
            let (first, n) = (self.faces.corner_range(f).start, ours.len());
            // A face that was turned over keeps its first corner.
            let turned = self.source_vertex[ours[1] as usize] != theirs[1];
            for (k, c) in range.enumerate() {
                corners[c] = (first + if turned { (n - k) % n } else { k }) as u32;
            }
        }
        corners
    }
}

/// The boundary loop in the direction of the oriented faces. A disc has one, and each of its vertices one edge ahead.
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
        // Edges come sorted by their smaller ends.
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
