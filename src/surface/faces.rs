/// Polygons of any arity in one array: face `f` has the corners `offsets[f] .. offsets[f + 1]`.
///
/// A *corner* is a position in the flat array; the corner `c` of face `f` also names the directed edge from its
/// vertex to that of the face's next corner.
///
/// Which faces meet across an edge follows from the vertices, but where two edges have the same ends: voxels that touch
/// along an edge alone can bring four faces to it, two and two of which are neighbours. Such faces carry *twins*.
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
    /// No faces yet, room for `faces` of them with `corners` corners in all.
    pub fn with_capacity(faces: usize, corners: usize) -> Self {
        let mut offsets = Vec::with_capacity(faces + 1);
        offsets.push(0);
        Faces { offsets, corners: Vec::with_capacity(corners), twins: None }
    }

    /// Marks a corner whose edge is on the boundary, among [`Faces::twins`].
    pub const NO_TWIN: u32 = u32::MAX;

    /// The same faces with their neighbours stated: for each corner the one whose directed edge is the same edge of the
    /// other face, or [`Faces::NO_TWIN`].
    pub(crate) fn with_twins(self, twins: Vec<u32>) -> Self {
        Faces { twins: Some(twins), ..self }
    }

    /// The twin of every corner, where neighbours are stated.
    pub fn twins(&self) -> Option<&[u32]> {
        self.twins.as_deref()
    }

    /// Appends a polygon, given by its vertex indices in order. Twins that were stated are forgotten.
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

    /// Vertex indices of face `f`, in order.
    pub fn get(&self, f: usize) -> &[u32] {
        &self.corners[self.corner_range(f)]
    }

    /// Corners of face `f` as positions in [`Faces::corners`].
    pub fn corner_range(&self, f: usize) -> std::ops::Range<usize> {
        self.offsets[f] as usize..self.offsets[f + 1] as usize
    }

    /// The vertex index of every corner, face after face.
    pub fn corners(&self) -> &[u32] {
        &self.corners
    }

    /// All polygons in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[u32]> + '_ {
        (0..self.len()).map(|f| self.get(f))
    }

    /// The common number of corners, or `None` when the faces differ in it (or there is none).
    pub fn arity(&self) -> Option<usize> {
        let first = self.iter().next()?.len();
        self.iter().all(|p| p.len() == first).then_some(first)
    }

    /// The same polygons with every vertex `v` called `new[v]`.
    pub fn renumbered(&self, new: &[u32]) -> Faces {
        Faces {
            offsets: self.offsets.clone(),
            corners: self.corners.iter().map(|&v| new[v as usize]).collect(),
            twins: self.twins.clone(),
        }
    }

    /// Reverses the order of the corners of face `f` behind its first one.
    pub fn flip(&mut self, f: usize) {
        let range = self.corner_range(f);
        self.corners[range.start + 1..range.end].reverse();
        if let Some(twins) = &mut self.twins {
            // The edges come in reverse order, each named by its other end.
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
