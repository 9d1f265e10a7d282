use num_complex::Complex64;

use crate::geometry::polygon::boundary_crossing;
use crate::geometry::predicate::orientation;
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;

/// The result of the exact test of whether a map is injective, for the given floating-point
/// coordinates.
///
/// A map of a disc that is positive on every face and whose boundary does not meet itself is
/// injective: its degree at a point is the winding number of the boundary around it, 0 or 1, and
/// each positive face contributes to the degree.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Validity {
    /// The faces with a corner that does not turn left, ascending, as indices of the source;
    /// [`OrientedMesh::NEW`] for faces that fill holes.
    pub folded: Vec<u32>,
    /// The vertices around which the faces wind more than once (at the boundary: overlap), if no
    /// face is flipped; ascending, as indices of the source.
    pub wound: Vec<u32>,
    /// Two boundary edges that cross or touch, each by its first vertex, as an index of the source.
    pub crossing: Option<[u32; 2]>,
}

impl Validity {
    /// Checks the map with the image `place(c)` of each corner `c` of the faces of `disc`; the
    /// corners of a face must be in the same copy of the cover.
    pub fn new(disc: &OrientedMesh, place: impl Fn(usize) -> Complex64) -> Self {
        let faces = &disc.faces;
        let folded: Vec<u32> = folded_faces(disc, &place).into_iter().map(|f| disc.source_face[f as usize]).collect();
        let mut corner_of = vec![0; disc.positions.len()];
        for (c, &v) in faces.corners().iter().enumerate() {
            corner_of[v as usize] = c;
        }
        let boundary: Vec<Complex64> = disc.boundary.iter().map(|&v| place(corner_of[v as usize])).collect();
        let source = |k: usize| disc.source_vertex[disc.boundary[k] as usize];
        let wound = if folded.is_empty() { wound(disc, &place) } else { Vec::new() };
        Validity { folded, wound, crossing: boundary_crossing(&boundary).map(|pair| pair.map(source)) }
    }

    /// Whether the map is injective.
    pub fn is_one_to_one(&self) -> bool {
        self.is_locally_one_to_one() && self.crossing.is_none()
    }

    /// Whether the map is locally injective: distant parts can overlap.
    pub fn is_locally_one_to_one(&self) -> bool {
        self.folded.is_empty() && self.wound.is_empty()
    }
}

/// Returns the faces of `disc` with a corner that does not turn left, ascending, by an exact
/// predicate.
pub fn folded_faces(disc: &OrientedMesh, place: impl Fn(usize) -> Complex64) -> Vec<u32> {
    let is_folded = |f: &u32| {
        let corners = disc.faces.corner_range(*f as usize);
        let n = corners.len();
        let at = |k: usize| place(corners.start + k % n);
        (0..if n == 3 { 1 } else { n }).any(|k| orientation(at(k), at(k + 1), at(k + 2)) <= 0.0)
    };
    (0..disc.faces.len() as u32).filter(is_folded).collect()
}

/// Returns the vertices around which faces, all positive, wind more than once.
///
/// Seen from an inner vertex, the sides opposite its corners run counter-clockwise; their winding
/// number is the number of times that they cross the ray to the right upwards. The corners at a
/// boundary vertex follow one another from its first edge, and must not reach that edge again.
fn wound(disc: &OrientedMesh, place: &impl Fn(usize) -> Complex64) -> Vec<u32> {
    let faces = &disc.faces;
    let previous =
        |f: usize, c: usize| if c == faces.corner_range(f).start { faces.corner_range(f).end - 1 } else { c - 1 };
    let mut turns = vec![0u32; disc.positions.len()];
    for f in 0..faces.len() {
        for c in faces.corner_range(f) {
            let height = place(c).im;
            let rises = place(next_in(faces, f, c)).im <= height && place(previous(f, c)).im > height;
            turns[faces.corners()[c] as usize] += u32::from(rises);
        }
    }
    for &v in &disc.boundary {
        turns[v as usize] = 1;
    }
    let edges = Edges::new(faces, disc.positions.len());
    for corner in (0..faces.corners().len()).filter(|&c| edges.opposite(c).is_none() && !disc.boundary.is_empty()) {
        // From the boundary edge that leaves the vertex, corner after corner.
        let v = faces.corners()[corner];
        let centre = place(corner);
        let first = place(next_in(faces, edges.face_of_corner[corner] as usize, corner));
        let (mut c, mut behind) = (corner, false);
        loop {
            let f = edges.face_of_corner[c] as usize;
            let side = orientation(centre, first, place(previous(f, c)));
            if behind && side >= 0.0 {
                turns[v as usize] = 2;
                break;
            }
            behind = side < 0.0;
            // The edge that enters the vertex leaves it when seen from the face on the other side.
            match edges.opposite(previous(f, c)) {
                Some(next) => c = next,
                None => break,
            }
        }
    }
    (0..turns.len()).filter(|&v| turns[v] != 1).map(|v| disc.source_vertex[v]).collect()
}
