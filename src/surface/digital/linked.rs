use super::direction::{EDGE_ON, SIDES, corner, opposite, step};
use super::scan::Scan;
use super::{Adjacency, DigitalError, Solid, Surfel};
use crate::surface::{Faces, Surface, UnionFind};

/// Surfels and their adjacency: corner `4 f + k` stands for edge `k` of surfel `f`.
pub(super) struct Linked {
    pub surfels: Vec<Surfel>,
    /// For each corner, the corner of the same edge in the neighbouring surfel, or
    /// [`Faces::NO_TWIN`].
    twins: Vec<u32>,
    /// For each edge at which four surfels meet, a corner of each of the two pairs of neighbours.
    fours: Vec<[u32; 2]>,
}

impl Linked {
    /// Finds all surfels of the boundary and their neighbours.
    ///
    /// The four voxels around an edge determine the neighbour. With `v` the inner voxel, `v + n`
    /// the outer voxel and `t` the side of the surfel on which the edge lies:
    ///
    /// | v + t | v + t + n | neighbour of (v, n) |
    /// |---|---|---|
    /// | out | out | (v, t) |
    /// | in | out | (v + t, n) |
    /// | in | in | (v + t + n, −t) |
    /// | out | in | (v, t) with the same inner voxel, or (v + t + n, −t) with the same outer voxel, by `adjacency` |
    pub fn new(solid: &Solid, adjacency: Adjacency) -> Result<Self, DigitalError> {
        let scan = Scan::new(solid)?;
        let mut twins = vec![Faces::NO_TWIN; 4 * scan.surfels.len()];
        let mut fours = Vec::new();
        let find = |voxel, direction: u8, side: u8| match scan.find(solid, voxel, direction) {
            Some(f) => 4 * f + u32::from(EDGE_ON[usize::from(direction)][usize::from(side)]),
            None => Faces::NO_TWIN,
        };
        for (f, surfel) in scan.surfels.iter().enumerate() {
            let (v, n) = (surfel.voxel, surfel.direction());
            for (edge, t) in SIDES[usize::from(n)].into_iter().enumerate() {
                let (beside, across) = (step(v, t), step(step(v, t), n));
                let corner = 4 * f + edge;
                twins[corner] = match (solid.contains(beside), solid.contains(across)) {
                    (false, false) => find(v, t, n),
                    (true, false) => find(beside, n, opposite(t)),
                    (true, true) => find(across, opposite(t), opposite(n)),
                    (false, true) => {
                        let (same_inner, same_outer) = (find(v, t, n), find(across, opposite(t), opposite(n)));
                        let (twin, other) = match adjacency {
                            Adjacency::Six => (same_inner, same_outer),
                            Adjacency::Eighteen => (same_outer, same_inner),
                        };
                        if corner < other as usize {
                            fours.push([corner as u32, other]);
                        }
                        twin
                    }
                };
            }
        }
        Ok(Linked { surfels: scan.surfels, twins, fours })
    }

    /// Returns the component of every surfel and the number of surfels of each component.
    ///
    /// Components are numbered by decreasing size, those of equal size in the order of their first
    /// surfels.
    pub fn components(&self) -> (Vec<u32>, Vec<usize>) {
        let mut joined = UnionFind::new(self.surfels.len());
        for (c, &twin) in
            self.twins.iter().enumerate().filter(|&(c, &twin)| c < twin as usize && twin != Faces::NO_TWIN)
        {
            joined.unite(c as u32 / 4, twin / 4);
        }
        let (mut label, count) = joined.labels();
        let mut size = vec![0_usize; count];
        label.iter().for_each(|&l| size[l as usize] += 1);
        let mut order: Vec<u32> = (0..count as u32).collect();
        // The sort is stable and labels are in the order of first surfels.
        order.sort_by_key(|&l| std::cmp::Reverse(size[l as usize]));
        let mut rank = vec![0; count];
        for (place, &l) in order.iter().enumerate() {
            rank[l as usize] = place as u32;
        }
        label.iter_mut().for_each(|l| *l = rank[*l as usize]);
        size.sort_unstable_by_key(|&n| std::cmp::Reverse(n));
        (label, size)
    }

    /// Returns the `wanted` surfels in the same order.
    pub fn keep(self, wanted: impl Fn(usize) -> bool) -> Self {
        let mut new = vec![Faces::NO_TWIN; self.surfels.len()];
        let mut surfels = Vec::new();
        let mut twins = Vec::new();
        for f in (0..self.surfels.len()).filter(|&f| wanted(f)) {
            new[f] = surfels.len() as u32;
            surfels.push(self.surfels[f]);
            twins.extend_from_slice(&self.twins[4 * f..4 * f + 4]);
        }
        let renumbered = |c: u32| match new.get(c as usize / 4) {
            None | Some(&Faces::NO_TWIN) => Faces::NO_TWIN,
            Some(&f) => 4 * f + c % 4,
        };
        twins.iter_mut().for_each(|c| *c = renumbered(*c));
        let fours = self.fours.iter().map(|pair| pair.map(renumbered));
        let fours = fours.filter(|pair| !pair.contains(&Faces::NO_TWIN)).collect();
        Linked { surfels, twins, fours }
    }

    /// Makes the quad mesh; its vertices are numbered in the order of the corners.
    ///
    /// There is one vertex for each *umbrella*, a chain of neighbouring surfels around a pointel. A
    /// pointel at which the surface touches itself has several.
    pub fn mesh(self, solid: &Solid) -> (Surface, Vec<Surfel>) {
        const NONE: u32 = u32::MAX;
        let corners = self.twins.len();
        let mut vertex = vec![NONE; corners];
        let mut positions = Vec::with_capacity(self.surfels.len() + 2);
        for c in 0..corners {
            if vertex[c] != NONE {
                continue;
            }
            let v = positions.len() as u32;
            let surfel = self.surfels[c / 4];
            let (centre, offset) = (solid.centre(surfel.voxel), corner(surfel.direction(), c % 4));
            positions.push([0, 1, 2].map(|k| centre[k] + offset[k]));
            // Counter-clockwise until the umbrella closes; if it meets the boundary, then also
            // clockwise.
            let mut next = Some(c);
            while let Some(d) = next.filter(|&d| vertex[d] == NONE) {
                vertex[d] = v;
                next = self.twin(previous_corner(d));
            }
            next = self.twin(c).map(next_corner);
            while let Some(d) = next.filter(|&d| vertex[d] == NONE) {
                vertex[d] = v;
                next = self.twin(d).map(next_corner);
            }
        }
        let ends = |c: u32| {
            let (a, b) = (vertex[c as usize], vertex[next_corner(c as usize)]);
            [a.min(b), a.max(b)]
        };
        let ambiguous = self.fours.iter().any(|&[c, d]| ends(c) == ends(d));
        let mut faces = Faces::with_capacity(self.surfels.len(), corners);
        vertex.chunks_exact(4).for_each(|quad| faces.push(quad));
        let faces = if ambiguous { faces.with_twins(self.twins) } else { faces };
        (Surface { positions, faces, face_normals: None }, self.surfels)
    }

    fn twin(&self, c: usize) -> Option<usize> {
        Some(self.twins[c]).filter(|&twin| twin != Faces::NO_TWIN).map(|twin| twin as usize)
    }
}

fn next_corner(c: usize) -> usize {
    c / 4 * 4 + (c + 1) % 4
}

fn previous_corner(c: usize) -> usize {
    c / 4 * 4 + (c + 3) % 4
}
