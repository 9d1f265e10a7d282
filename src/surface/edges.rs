//! The undirected edges of a polygon mesh.

use super::Faces;

/// The undirected edges of a polygon mesh and the corners whose directed edges lie on each of them.
///
/// Edges are ordered by (smaller end, larger end), the corners of an edge by their position. Two
/// edges can have the same ends if the faces carry [twins](Faces::twins). Construction takes linear
/// time: directed edges are bucketed by their smaller vertex.
#[derive(Clone, Debug)]
pub struct Edges {
    /// End vertices of each edge, the smaller first (`ne × 2`). Equal ends mean that a face repeats
    /// a vertex.
    pub ends: Vec<[u32; 2]>,
    /// The edge on which the directed edge of each corner lies (one per corner).
    pub of_corner: Vec<u32>,
    /// The face of each corner (one per corner).
    pub face_of_corner: Vec<u32>,
    offsets: Vec<u32>,
    corners: Vec<u32>,
}

impl Edges {
    /// Finds the edges of `faces`, whose vertex indices are below `vertices`.
    pub fn new(faces: &Faces, vertices: usize) -> Self {
        let corner_vertex = faces.corners();
        let total = corner_vertex.len();
        let mut face_of_corner = vec![0u32; total];
        // The ends of each corner's edge.
        let ends_in = |range: &std::ops::Range<usize>, c: usize| {
            let next = if c + 1 == range.end { range.start } else { c + 1 };
            [corner_vertex[c], corner_vertex[next]]
        };
        let mut bucket = vec![0u32; vertices + 1];
        for f in 0..faces.len() {
            let range = faces.corner_range(f);
            for c in range.clone() {
                let [a, b] = ends_in(&range, c);
                face_of_corner[c] = f as u32;
                bucket[a.min(b) as usize + 1] += 1;
            }
        }
        for v in 0..vertices {
            bucket[v + 1] += bucket[v];
        }
        // Larger end and corner in one number, which sorts by both.
        let mut keys = vec![0u64; total];
        let mut cursor = bucket.clone();
        for f in 0..faces.len() {
            let range = faces.corner_range(f);
            for c in range.clone() {
                let [a, b] = ends_in(&range, c);
                let slot = &mut cursor[a.min(b) as usize];
                keys[*slot as usize] = u64::from(a.max(b)) << 32 | c as u64;
                *slot += 1;
            }
        }

        let mut ends = Vec::with_capacity(total / 2 + 1);
        let mut offsets = Vec::with_capacity(total / 2 + 2);
        let mut of_corner = vec![0u32; total];
        let mut corners = Vec::with_capacity(total);
        for v in 0..vertices {
            let bucket = &mut keys[bucket[v] as usize..bucket[v + 1] as usize];
            // Corners of one edge agree in this.
            let name = |key: u64| (key >> 32, faces.twins().map(|twins| (key as u32).min(twins[key as u32 as usize])));
            match faces.twins() {
                None => bucket.sort_unstable(),
                Some(_) => bucket.sort_unstable_by_key(|&key| (name(key), key)),
            }
            let mut last = None;
            for &key in &*bucket {
                if last.replace(name(key)) != Some(name(key)) {
                    ends.push([v as u32, (key >> 32) as u32]);
                    offsets.push(corners.len() as u32);
                }
                of_corner[key as u32 as usize] = ends.len() as u32 - 1;
                corners.push(key as u32);
            }
        }
        offsets.push(total as u32);
        Edges { ends, of_corner, face_of_corner, offsets, corners }
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no edge.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The corners whose directed edges lie on edge `e`: one on a boundary edge, two inside a
    /// manifold.
    pub fn corners(&self, e: usize) -> &[u32] {
        &self.corners[self.offsets[e] as usize..self.offsets[e + 1] as usize]
    }

    /// Returns the corner of the same edge in the neighbouring face; `None` unless exactly two
    /// faces meet.
    pub fn opposite(&self, c: usize) -> Option<usize> {
        match *self.corners(self.of_corner[c] as usize) {
            [a, b] => Some(if a as usize == c { b as usize } else { a as usize }),
            _ => None,
        }
    }
}

/// Returns the corner that follows `c` in face `f`.
pub(crate) fn next_in(faces: &Faces, f: usize, c: usize) -> usize {
    let range = faces.corner_range(f);
    if c + 1 == range.end { range.start } else { c + 1 }
}
