/// Polygons of any arity in one flat array: face `f` has the corners `offsets[f] .. offsets[f +
/// 1]`.
///
/// A *corner* is a position in the flat array. Corner `c` of face `f` also stands for the directed
/// edge from its vertex to the vertex of the next corner of the face.
///
/// Usually the vertices determine which faces meet across an edge. They do not if two edges have
/// the same ends: where voxels touch along an edge only, four faces can meet at it, which form two
/// pairs of neighbours. Such faces carry *twins*.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faces {
    offsets: Vec<u32>,
    corners: Vec<u32>,
    twins: Option<Vec<u32>>,
}

impl Default for Faces {
    fn default() -> Self {
        Faces { offsets: vec![0], corners: Vec::new(), twins: None }
    }
}

impl Faces {
    /// Returns an empty list with capacity for `faces` faces with `corners` corners in total.
    pub fn with_capacity(faces: usize, corners: usize) -> Self {
        let mut offsets = Vec::with_capacity(faces + 1);
        offsets.push(0);
        Faces { offsets, corners: Vec::with_capacity(corners), twins: None }
    }

    /// The twin of a corner whose edge is on the boundary; see [`Faces::twins`].
    pub const NO_TWIN: u32 = u32::MAX;

    /// Returns the same faces with explicit neighbours: `twins[c]` is the corner of the same edge
    /// in the neighbouring face, or [`Faces::NO_TWIN`].
    pub(crate) fn with_twins(self, twins: Vec<u32>) -> Self {
        Faces { twins: Some(twins), ..self }
    }

    /// The twin of every corner, if neighbours are explicit.
    pub fn twins(&self) -> Option<&[u32]> {
        self.twins.as_deref()
    }

    /// Appends a polygon, given by its vertex indices in order. Discards twins.
    pub fn push(&mut self, polygon: &[u32]) {
        self.twins = None;
        self.corners.extend_from_slice(polygon);
        self.offsets.push(self.corners.len() as u32);
    }

    /// Number of polygons.
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Whether there is no polygon.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The vertex indices of face `f`, in order.
    pub fn get(&self, f: usize) -> &[u32] {
        &self.corners[self.corner_range(f)]
    }

    /// The corners of face `f` as a range of positions in [`Faces::corners`].
    pub fn corner_range(&self, f: usize) -> std::ops::Range<usize> {
        self.offsets[f] as usize..self.offsets[f + 1] as usize
    }

    /// The vertex index of every corner, face after face.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// Iterates over the polygons in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + '_ {
        (0..self.len()).map(|f| self.get(f))
    }

    /// The common number of corners; `None` if faces differ in it or there is no face.
    pub fn arity(&self) -> Option<usize> {
        let first = self.iter().next()?.len();
        self.iter().all(|p| p.len() == first).then_some(first)
    }

    /// Returns the same polygons with every vertex `v` replaced by `new[v]`.
    pub fn renumbered(&self, new: &[u32]) -> Faces {
        Faces {
            offsets: self.offsets.clone(),
            corners: self.corners.iter().map(|&v| new[v as usize]).collect(),
            twins: self.twins.clone(),
        }
    }

    /// Reverses the orientation of face `f`; its first corner stays first.
    pub fn flip(&mut self, f: usize) {
        let range = self.corner_range(f);
        self.corners[range.start + 1..range.end].reverse();
        if let Some(twins) = &mut self.twins {
            // The edges are in reverse order, and each is represented by its other end.
            let last = range.start + range.end - 1;
            twins[range.clone()].reverse();
            for c in range.clone() {
                match twins[c] {
                    Self::NO_TWIN => {}
                    other if range.contains(&(other as usize)) => twins[c] = (last - other as usize) as u32,
                    other => twins[other as usize] = c as u32,
                }
            }
        }
    }
}

impl<P: AsRef<[u32]>> FromIterator<P> for Faces {
    fn from_iter<I: IntoIterator<Item = P>>(polygons: I) -> Self {
        let mut faces = Faces::default();
        for polygon in polygons {
            faces.push(polygon.as_ref());
        }
        faces
    }
}
