/// Polygons of any arity in one array: face `f` has the corners `offsets[f] .. offsets[f + 1]`.
///
/// A *corner* is a position in the flat array; the corner `c` of face `f` also names the directed edge from its
/// vertex to that of the face's next corner.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faces {
    offsets: Vec<u32>,
    corners: Vec<u32>,
}

impl Default for Faces {
    fn default() -> Self {
        Faces { offsets: vec![0], corners: Vec::new() }
    }
}

impl Faces {
    /// No faces yet, room for `faces` of them with `corners` corners in all.
    pub fn with_capacity(faces: usize, corners: usize) -> Self {
        let mut offsets = Vec::with_capacity(faces + 1);
        offsets.push(0);
        Faces { offsets, corners: Vec::with_capacity(corners) }
    }

    /// Appends a polygon, given by its vertex indices in order.
    pub fn push(&mut self, polygon: &[u32]) {
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
        Faces { offsets: self.offsets.clone(), corners: self.corners.iter().map(|&v| new[v as usize]).collect() }
    }

    /// Reverses the order of the corners of face `f` behind its first one.
    pub fn flip(&mut self, f: usize) {
        let range = self.corner_range(f);
        self.corners[range.start + 1..range.end].reverse();
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
