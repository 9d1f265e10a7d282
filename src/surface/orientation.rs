//! Connected components, patches, and their consistent orientation.

use super::Faces;
use super::edges::{Edges, next_in};
use super::union_find::UnionFind;

/// The connected components of a mesh and the flips that orient it consistently.
///
/// A *patch* is connected across edges of exactly two faces, through which an orientation can be
/// propagated. A *component* is connected across any edges.
#[derive(Clone, Debug)]
pub struct Orientation {
    /// The component of each face; components are numbered in the order of their first faces.
    pub component: Vec<u32>,
    /// Number of components.
    pub components: usize,
    /// For each face, whether it must be flipped so that neighbours across edges of two faces
    /// agree.
    ///
    /// Of the two possibilities the one that flips fewer faces of a patch is taken. Faces of
    /// non-orientable patches are not flipped.
    pub flip: Vec<bool>,
    /// For each component, an edge of two faces at which orientation fails, if there is one.
    pub contradiction: Vec<Option<u32>>,
}

impl Orientation {
    /// Propagates the orientation breadth first over the edges that exactly two faces share.
    pub fn new(faces: &Faces, edges: &Edges) -> Self {
        const UNSEEN: u32 = u32::MAX;
        let mut patch = vec![UNSEEN; faces.len()];
        let mut flip = vec![false; faces.len()];
        let mut patch_contradiction = Vec::new();
        let mut queue: Vec<u32> = Vec::with_capacity(faces.len());
        for seed in 0..faces.len() {
            if patch[seed] != UNSEEN {
                continue;
            }
            let id = patch_contradiction.len() as u32;
            let mut contradiction = None;
            patch[seed] = id;
            queue.clear();
            queue.push(seed as u32);
            let mut head = 0;
            while head < queue.len() {
                let f = queue[head] as usize;
                head += 1;
                for c in faces.corner_range(f) {
                    let Some(d) = edges.opposite(c) else { continue };
                    let g = edges.face_of_corner[d] as usize;
                    let wanted = flip[f] ^ same_direction(faces, (f, c), (g, d));
                    if patch[g] == UNSEEN {
                        patch[g] = id;
                        flip[g] = wanted;
                        queue.push(g as u32);
                    } else if flip[g] != wanted {
                        contradiction.get_or_insert(edges.of_corner[c]);
                    }
                }
            }
            let flipped = queue.iter().filter(|&&f| flip[f as usize]).count();
            for &f in &queue {
                let f = f as usize;
                flip[f] = contradiction.is_none() && (flip[f] ^ (2 * flipped > queue.len()));
            }
            patch_contradiction.push(contradiction);
        }

        let mut joined = UnionFind::new(patch_contradiction.len());
        for e in 0..edges.len() {
            for pair in edges.corners(e).windows(2) {
                let [a, b] = [pair[0], pair[1]].map(|c| patch[edges.face_of_corner[c as usize] as usize]);
                joined.unite(a, b);
            }
        }
        let (label, components) = joined.labels();
        let mut contradiction = vec![None; components];
        for (p, found) in patch_contradiction.iter().enumerate() {
            let slot = &mut contradiction[label[p] as usize];
            *slot = slot.or(*found);
        }
        let component = patch.iter().map(|&p| label[p as usize]).collect();
        Orientation { component, components, flip, contradiction }
    }
}

/// Whether two faces traverse their common edge in the same direction, that is, are oriented
/// inconsistently.
pub(super) fn same_direction(faces: &Faces, (f, c): (usize, usize), (g, d): (usize, usize)) -> bool {
    let vertex = faces.corners();
    vertex[c] == vertex[d] && vertex[next_in(faces, f, c)] == vertex[next_in(faces, g, d)]
}
