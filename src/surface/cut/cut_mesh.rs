//! A mesh during cutting: its corners, their vertices and their twins.

use crate::geometry::vector::scale;
use crate::surface::edges::Edges;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Topology;
use crate::surface::{Faces, Surface, Surrogates, UnionFind};

/// A consistently oriented mesh of triangles or of quads that can be cut and extended.
pub(in crate::surface) struct CutMesh {
    /// Number of corners of each face.
    pub arity: usize,
    /// The vertex of each corner, face after face.
    pub corners: Vec<u32>,
    /// For each corner, the corner of the same edge in the neighbouring face, or
    /// [`Faces::NO_TWIN`].
    pub twins: Vec<u32>,
    /// The position of each vertex.
    pub positions: Vec<[f64; 3]>,
    /// For each vertex its index in the source, ascending; new vertices come last and have
    /// [`OrientedMesh::NEW`].
    pub source_vertex: Vec<u32>,
    /// For each face its index in the source, ascending; new faces come last and have
    /// [`OrientedMesh::NEW`].
    pub source_face: Vec<u32>,
    /// Unit normals per face, if the source gives them.
    pub face_normals: Option<Vec<[f64; 3]>>,
}

/// The vertices at which the surface touched itself.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Pinches {
    /// Number of such vertices.
    pub count: usize,
    /// The first such vertex as an index of the source, and its number of fans.
    pub first: Option<(u32, u32)>,
}

impl CutMesh {
    /// Takes the faces of `surface` that are not `removed`, flipped as `topology` requires.
    pub fn new(surface: &Surface, topology: &Topology, removed: &[bool]) -> Self {
        let faces = &surface.faces;
        let arity = if faces.is_empty() { 3 } else { faces.get(0).len() };
        let flip = &topology.orientation.flip;
        let source_face: Vec<u32> = (0..faces.len() as u32).filter(|&f| !removed[f as usize]).collect();
        // The new corner of each directed edge of the source.
        let mut moved = vec![Faces::NO_TWIN; faces.corners().len()];
        let mut corners = Vec::with_capacity(arity * source_face.len());
        for &f in &source_face {
            let (range, base) = (faces.corner_range(f as usize), corners.len());
            for k in 0..arity {
                // A flipped face keeps its first corner; its edges are in reverse order.
                let (corner, edge) = if flip[f as usize] { ((arity - k) % arity, arity - 1 - k) } else { (k, k) };
                corners.push(faces.corners()[range.start + corner]);
                moved[range.start + edge] = (base + k) as u32;
            }
        }
        let mut twins = vec![Faces::NO_TWIN; corners.len()];
        for (c, &new) in moved.iter().enumerate().filter(|(_, new)| **new != Faces::NO_TWIN) {
            if let Some(d) = topology.edges.opposite(c) {
                twins[new as usize] = moved[d];
            }
        }
        let face_normals = surface.face_normals.as_ref().map(|normals| {
            let turned = |&f: &u32| scale(if flip[f as usize] { -1.0 } else { 1.0 }, normals[f as usize]);
            source_face.iter().map(turned).collect()
        });
        CutMesh {
            arity,
            corners,
            twins,
            positions: surface.positions.clone(),
            source_vertex: (0..surface.positions.len() as u32).collect(),
            source_face,
            face_normals,
        }
    }

    /// Returns the corner that follows `c` in its face.
    pub fn next(&self, c: usize) -> usize {
        if (c + 1).is_multiple_of(self.arity) { c + 1 - self.arity } else { c + 1 }
    }

    /// Gives each fan of faces its own vertex and drops unreferenced vertices.
    ///
    /// Copies of a vertex get consecutive indices.
    pub(super) fn split_fans(&mut self) -> Pinches {
        let mut fan = UnionFind::new(self.corners.len());
        for (c, &d) in self.twins.iter().enumerate() {
            if d != Faces::NO_TWIN {
                fan.unite(c as u32, self.next(d as usize) as u32);
            }
        }
        let mut first = vec![0u32; self.positions.len() + 1];
        for c in 0..self.corners.len() {
            first[self.corners[c] as usize + 1] += u32::from(fan.find(c as u32) == c as u32);
        }
        let mut pinches = Pinches::default();
        for (v, &fans) in first[1..].iter().enumerate().filter(|(_, fans)| **fans > 1) {
            pinches.count += 1;
            pinches.first.get_or_insert((self.source_vertex[v], fans));
        }
        for v in 0..self.positions.len() {
            first[v + 1] += first[v];
        }
        let count = first[self.positions.len()] as usize;
        let (mut positions, mut source_vertex) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for v in 0..self.positions.len() {
            for _ in first[v]..first[v + 1] {
                positions.push(self.positions[v]);
                source_vertex.push(self.source_vertex[v]);
            }
        }
        // The first corner of a fan represents it, so its vertex is assigned before those of the
        // others.
        for c in 0..self.corners.len() {
            let root = fan.find(c as u32) as usize;
            self.corners[c] = if root == c {
                let slot = &mut first[self.corners[c] as usize];
                *slot += 1;
                *slot - 1
            } else {
                self.corners[root]
            };
        }
        self.positions = positions;
        self.source_vertex = source_vertex;
        pinches
    }

    /// Number of components that are connected across edges.
    pub fn pieces(&self) -> usize {
        let mut joined = UnionFind::new(self.source_face.len());
        for (c, &d) in self.twins.iter().enumerate().filter(|(_, d)| **d != Faces::NO_TWIN) {
            joined.unite((c / self.arity) as u32, d / self.arity as u32);
        }
        joined.labels().1
    }

    /// Returns the corners along every boundary loop, with the surface on the left, longest loop
    /// first.
    ///
    /// Every vertex must have one fan of faces.
    pub fn boundary_loops(&self) -> Vec<Vec<u32>> {
        let mut ahead = vec![Faces::NO_TWIN; self.positions.len()];
        let boundary = || (0..self.twins.len()).filter(|&c| self.twins[c] == Faces::NO_TWIN);
        for c in boundary() {
            ahead[self.corners[c] as usize] = c as u32;
        }
        let mut loops = Vec::new();
        for c in boundary() {
            let mut along = Vec::new();
            let mut v = self.corners[c] as usize;
            while ahead[v] != Faces::NO_TWIN {
                along.push(ahead[v]);
                let next = self.corners[self.next(ahead[v] as usize)] as usize;
                ahead[v] = Faces::NO_TWIN;
                v = next;
            }
            if !along.is_empty() {
                loops.push((along.iter().map(|&c| self.length(c as usize)).sum::<f64>(), along));
            }
        }
        loops.sort_by(|a, b| b.0.total_cmp(&a.0));
        loops.into_iter().map(|(_, along)| along).collect()
    }

    /// The length of the edge that starts at corner `c`.
    pub fn length(&self, c: usize) -> f64 {
        let [a, b] = [c, self.next(c)].map(|c| self.positions[self.corners[c] as usize]);
        crate::geometry::vector::norm(crate::geometry::vector::sub(b, a))
    }

    /// The Euler characteristic χ = vertices − edges + faces.
    pub fn euler(&self) -> i64 {
        let boundary = self.twins.iter().filter(|&&d| d == Faces::NO_TWIN).count();
        let edges = (self.twins.len() + boundary) / 2;
        self.positions.len() as i64 - edges as i64 + self.source_face.len() as i64
    }

    /// Returns the faces with their twins.
    pub fn faces(&self) -> Faces {
        let mut faces = Faces::with_capacity(self.source_face.len(), self.corners.len());
        for polygon in self.corners.chunks(self.arity) {
            faces.push(polygon);
        }
        faces.with_twins(self.twins.clone())
    }

    /// Returns the length of each of `edges`.
    pub fn lengths(&self, edges: &Edges) -> Vec<f64> {
        (0..edges.len()).map(|e| self.length(edges.corners(e)[0] as usize)).collect()
    }

    /// Cuts the surface along edges, given by their corners (both corners of each edge).
    pub fn part(&mut self, corners: impl Iterator<Item = u32>) {
        for c in corners {
            self.twins[c as usize] = Faces::NO_TWIN;
        }
        self.split_fans();
    }

    /// Converts to the disc with the boundary loop `boundary`, or to a closed surface if it is
    /// empty.
    pub fn into_disc(self, boundary: &[u32]) -> OrientedMesh {
        let mut boundary: Vec<u32> = boundary.iter().map(|&c| self.corners[c as usize]).collect();
        let lowest = (0..boundary.len()).min_by_key(|&k| boundary[k]).unwrap_or(0);
        boundary.rotate_left(lowest);
        OrientedMesh {
            faces: self.faces(),
            boundary,
            filled: self.source_face.iter().rev().take_while(|&&f| f == OrientedMesh::NEW).count(),
            positions: self.positions,
            face_normals: self.face_normals,
            source_vertex: self.source_vertex,
            source_face: self.source_face,
            surrogates: Surrogates::default(),
        }
    }
}
