//! Combinatorial properties of a mesh: components, boundary loops, Euler characteristics, genus,
//! vertex fans.

pub mod diagnosis;
mod finding;
pub mod homology;
pub mod tree_cotree;

pub(crate) use finding::{ZERO_AREA, has_no_area};

use super::edges::{Edges, next_in};
use super::orientation::Orientation;
use super::union_find::UnionFind;
use crate::surface::{Faces, Surface};

/// A part of a surface that is connected across edges.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Component {
    /// Its lowest face index.
    pub first_face: u32,
    /// Number of its faces.
    pub faces: usize,
    /// Number of vertices of its faces.
    pub vertices: usize,
    /// Number of fans of faces around these vertices; more than `vertices` if the surface touches
    /// itself.
    pub fans: usize,
    /// Number of its edges.
    pub edges: usize,
    /// Number of edges of each boundary loop, longest first; if some edge has more than two faces,
    /// of each chain of boundary edges.
    pub boundary_loops: Vec<usize>,
    /// Whether its faces can be oriented consistently.
    pub orientable: bool,
    /// Whether every edge has one or two faces.
    pub edge_manifold: bool,
    /// Whether the component is edge-manifold and every vertex has one fan of faces.
    pub manifold: bool,
}

impl Component {
    /// The Euler characteristic χ = vertices − edges + faces.
    pub fn euler(&self) -> i64 {
        self.vertices as i64 - self.edges as i64 + self.faces as i64
    }

    /// The genus g from `χ = 2 − 2g − b` (orientable; `b` boundary loops) or `χ = 2 − g − b` (not
    /// orientable).
    ///
    /// The surface is pulled apart at vertices where it touches itself. `None` if an edge has more
    /// than two faces.
    pub fn genus(&self) -> Option<u64> {
        let euler = self.fans as i64 - self.edges as i64 + self.faces as i64;
        let handles = 2 - self.boundary_loops.len() as i64 - euler;
        let genus = if self.orientable { handles / 2 } else { handles };
        (self.edge_manifold && genus >= 0).then_some(genus as u64)
    }

    /// Whether the component is a topological disc.
    pub fn is_disc(&self) -> bool {
        self.manifold && self.orientable && self.boundary_loops.len() == 1 && self.euler() == 1
    }
}

/// The topology of a polygon mesh.
#[derive(Clone, Debug)]
pub struct Topology {
    /// The undirected edges.
    pub edges: Edges,
    /// The components and the flips that orient the faces consistently.
    pub orientation: Orientation,
    /// One entry per component.
    pub components: Vec<Component>,
    /// Number of fans of faces around each vertex: 0 if unreferenced, 1 if manifold, more if the
    /// surface touches itself there.
    pub fans: Vec<u32>,
}

impl Topology {
    /// Analyses `surface` in linear time.
    pub fn new(surface: &Surface) -> Self {
        let faces = &surface.faces;
        let edges = Edges::new(faces, surface.positions.len());
        let orientation = Orientation::new(faces, &edges);
        let fan = fan_of_corner(faces, &edges);
        let fans = count_fans(faces, &fan, surface.positions.len());
        let components = components(faces, &edges, &orientation, &fan, &fans);
        Topology { edges, orientation, components, fans }
    }
}

/// Returns a representative corner of the fan of each corner.
///
/// A fan is a set of corners at one vertex that are connected across edges of exactly two faces.
fn fan_of_corner(faces: &Faces, edges: &Edges) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let vertex = faces.corners();
    let mut fan = vec![NONE; vertex.len()];
    let mut reached = Vec::new();
    for seed in 0..vertex.len() {
        if fan[seed] != NONE {
            continue;
        }
        fan[seed] = seed as u32;
        reached.push(seed);
        while let Some(c) = reached.pop() {
            // Across the edge ahead of the corner, and across the one behind it.
            let f = edges.face_of_corner[c] as usize;
            let before = before_in(faces, f, c);
            let next = |d: usize| next_in(faces, edges.face_of_corner[d] as usize, d);
            let ahead = edges.opposite(c).map(|d| if vertex[d] == vertex[c] { d } else { next(d) });
            let behind = edges.opposite(before).map(|d| if vertex[d] == vertex[before] { next(d) } else { d });
            for other in [ahead, behind].into_iter().flatten() {
                if fan[other] == NONE {
                    fan[other] = seed as u32;
                    reached.push(other);
                }
            }
        }
    }
    fan
}

/// The corner before `c` in face `f`.
fn before_in(faces: &Faces, f: usize, c: usize) -> usize {
    let range = faces.corner_range(f);
    if c == range.start { range.end - 1 } else { c - 1 }
}

fn count_fans(faces: &Faces, fan: &[u32], vertices: usize) -> Vec<u32> {
    let mut fans = vec![0; vertices];
    for (c, &v) in faces.corners().iter().enumerate() {
        fans[v as usize] += u32::from(fan[c] == c as u32);
    }
    fans
}

fn components(faces: &Faces, edges: &Edges, orientation: &Orientation, fan: &[u32], fans: &[u32]) -> Vec<Component> {
    let mut components: Vec<Component> = orientation
        .contradiction
        .iter()
        .map(|contradiction| Component {
            first_face: u32::MAX,
            faces: 0,
            vertices: 0,
            fans: 0,
            edges: 0,
            boundary_loops: Vec::new(),
            orientable: contradiction.is_none(),
            edge_manifold: true,
            manifold: true,
        })
        .collect();
    let mut last_seen_by = vec![u32::MAX; fans.len()];
    let mut in_component_order: Vec<u32> = (0..faces.len() as u32).collect();
    if components.len() > 1 {
        in_component_order.sort_by_key(|&f| orientation.component[f as usize]);
    }
    for &f in &in_component_order {
        let id = orientation.component[f as usize];
        let part = &mut components[id as usize];
        part.faces += 1;
        part.first_face = part.first_face.min(f);
        part.fans += faces.corner_range(f as usize).filter(|&c| fan[c] == c as u32).count();
        for &v in faces.get(f as usize) {
            if std::mem::replace(&mut last_seen_by[v as usize], id) != id {
                part.vertices += 1;
                part.manifold &= fans[v as usize] == 1;
            }
        }
    }
    for e in 0..edges.len() {
        let corners = edges.corners(e);
        let part = &mut components[orientation.component[edges.face_of_corner[corners[0] as usize] as usize] as usize];
        part.edges += 1;
        part.edge_manifold &= corners.len() <= 2;
    }
    for (id, length) in boundary_loops(faces, edges, orientation, fan) {
        components[id as usize].boundary_loops.push(length);
    }
    for part in &mut components {
        part.manifold &= part.edge_manifold;
        part.boundary_loops.sort_unstable_by(|a, b| b.cmp(a));
    }
    components
}

/// Returns the component and the number of edges of every boundary loop.
///
/// Boundary edges are joined if they end in the same fan. This needs no orientation and separates
/// loops that merely touch at a vertex.
fn boundary_loops(faces: &Faces, edges: &Edges, orientation: &Orientation, fan: &[u32]) -> Vec<(u32, usize)> {
    let boundary: Vec<usize> = (0..edges.len()).filter(|&e| edges.corners(e).len() == 1).collect();
    let mut loops = UnionFind::new(boundary.len());
    let mut ends: Vec<(u32, u32)> = Vec::with_capacity(2 * boundary.len());
    for (k, &e) in boundary.iter().enumerate() {
        let c = edges.corners(e)[0] as usize;
        let ahead = next_in(faces, edges.face_of_corner[c] as usize, c);
        ends.extend([(fan[c], k as u32), (fan[ahead], k as u32)]);
    }
    ends.sort_unstable();
    for pair in ends.windows(2) {
        if pair[0].0 == pair[1].0 {
            loops.unite(pair[0].1, pair[1].1);
        }
    }
    let (label, count) = loops.labels();
    let mut found = vec![(0, 0); count];
    for (k, &e) in boundary.iter().enumerate() {
        let slot = &mut found[label[k] as usize];
        slot.0 = orientation.component[edges.face_of_corner[edges.corners(e)[0] as usize] as usize];
        slot.1 += 1;
    }
    found
}
