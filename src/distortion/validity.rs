use num_complex::Complex64;

use crate::geometry::polygon::boundary_crossing;
use crate::geometry::predicate::orientation;
use crate::surface::edges::{Edges, next_in};
use crate::surface::oriented_mesh::OrientedMesh;

/// Whether a map is one-to-one: the exact check, on the very doubles that are given.
///
/// A map of a disc that is positive on every face, with a boundary that does not meet itself, is one-to-one: its degree over
/// each point is that of the boundary around it, 0 or 1, and no face takes anything away from it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Validity {
    /// The faces of which some corner does not turn left, ascending, as the source numbers them; [`OrientedMesh::NEW`] for those put into
    /// holes.
    pub folded: Vec<u32>,
    /// The vertices around which the faces lie more than once (at the boundary: once and more), where no face is folded; ascending, as
    /// the source numbers them.
    pub wound: Vec<u32>,
    /// Two boundary edges that meet where they should not, each by its first vertex, as the source numbers them.
    pub crossing: Option<[u32; 2]>,
}

impl Validity {
    /// Checks the map that puts corner `c` of the faces of `disc` at `place(c)`, beside the other corners of its face.
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

    /// Whether the map is one-to-one.
    pub fn is_one_to_one(&self) -> bool {
        self.is_locally_one_to_one() && self.crossing.is_none()
    }

    /// Whether it is one-to-one near every point: parts that are far from each other may overlap.
    pub fn is_locally_one_to_one(&self) -> bool {
        self.folded.is_empty() && self.wound.is_empty()
    }
}

/// The faces of `disc` of which some corner does not turn left, ascending, exactly.
pub fn folded_faces(disc: &OrientedMesh, place: impl Fn(usize) -> Complex64) -> Vec<u32> {
    let is_folded = |f: &u32| {
        let corners = disc.faces.corner_range(*f as usize);
        let n = corners.len();
        let at = |k: usize| place(corners.start + k % n);
        (0..if n == 3 { 1 } else { n }).any(|k| orientation(at(k), at(k + 1), at(k + 2)) <= 0.0)
    };
    (0..disc.faces.len() as u32).filter(is_folded).collect()
}

/// The vertices around which faces, all positive, lie more than once.
///
/// Seen from an inner vertex the opposite sides of its corners go round counter-clockwise: as often as they cross the ray to the right
/// of it upwards. Of a boundary vertex the corners lie one beside the other from its first edge on, and must not come back to that.
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
        // From the boundary edge that leaves the vertex on, corner after corner.
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
            // The edge that enters the vertex, seen from the face on its other side, leaves it.
            match edges.opposite(previous(f, c)) {
                Some(next) => c = next,
                None => break,
            }
        }
    }
    (0..turns.len()).filter(|&v| turns[v] != 1).map(|v| disc.source_vertex[v]).collect()
}
