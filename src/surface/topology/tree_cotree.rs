//! A tree of shortest paths on the vertices, a maximum spanning tree on the faces (the cotree), and
//! the 2g edges that belong to neither.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::sparse::Lists;
use crate::surface::edges::Edges;
use crate::surface::{Faces, UnionFind};

/// The graph of the vertices and inner edges of a connected, edge-manifold surface, in which every
/// boundary loop is contracted to one node.
///
/// After the contraction the surface is closed: nodes − inner edges + faces = 2 − 2g.
#[derive(Clone, Debug)]
pub struct EdgeGraph<'a> {
    /// The faces.
    pub faces: &'a Faces,
    /// The edges of `faces`, to which all edge indices below refer.
    pub edges: &'a Edges,
    /// The node of each vertex; the vertices of a boundary loop share one node.
    pub node: Vec<u32>,
    /// Number of nodes.
    pub nodes: usize,
    /// The nodes that are boundary loops.
    pub loops: Vec<u32>,
    /// The length of each edge.
    pub length: Vec<f64>,
    incident: Lists,
    neighbour: Lists,
}

impl<'a> EdgeGraph<'a> {
    /// Builds the graph of a surface with `vertices` vertices, each with one fan of faces; edge `e`
    /// has length `length[e]` ≥ 0.
    pub fn new(faces: &'a Faces, edges: &'a Edges, vertices: usize, length: Vec<f64>) -> Self {
        let mut joined = UnionFind::new(vertices);
        let mut on_boundary = Vec::new();
        for e in 0..edges.len() {
            if edges.corners(e).len() < 2 {
                let [a, b] = edges.ends[e];
                joined.unite(a, b);
                on_boundary.push(a);
            }
        }
        let (node, nodes) = joined.labels();
        let mut loops: Vec<u32> = on_boundary.iter().map(|&v| node[v as usize]).collect();
        loops.sort_unstable();
        loops.dedup();

        let inner = (0..edges.len()).filter(|&e| edges.corners(e).len() == 2);
        let ends = inner.map(|e| (e as u32, edges.ends[e].map(|v| node[v as usize])));
        let incident = Lists::new(nodes, ends.clone().flat_map(|(e, [a, b])| [(a, e), (b, e)]));
        let neighbour = Lists::new(nodes, ends.flat_map(|(_, [a, b])| [(a, b), (b, a)]));
        EdgeGraph { faces, edges, node, nodes, loops, length, incident, neighbour }
    }

    /// The nodes at the ends of edge `e`.
    pub fn ends(&self, e: u32) -> [u32; 2] {
        self.edges.ends[e as usize].map(|v| self.node[v as usize])
    }

    /// The node across edge `e` from node `n`.
    pub fn across(&self, e: u32, n: u32) -> u32 {
        let [a, b] = self.ends(e);
        if a == n { b } else { a }
    }

    /// The inner edges at node `n`; an edge from the node to itself occurs twice.
    pub fn edges_at(&self, n: u32) -> &[u32] {
        self.incident.of(n)
    }

    /// The nodes across the edges of [`Self::edges_at`], in the same order.
    pub fn neighbours(&self, n: u32) -> &[u32] {
        self.neighbour.of(n)
    }

    /// Whether edge `e` has a face on both sides.
    pub fn is_inner(&self, e: u32) -> bool {
        self.edges.corners(e as usize).len() == 2
    }

    /// The two faces of an inner edge.
    pub fn sides(&self, e: u32) -> [u32; 2] {
        let corners = self.edges.corners(e as usize);
        [corners[0], corners[corners.len() - 1]].map(|c| self.edges.face_of_corner[c as usize])
    }
}

/// Shortest paths from a set of source nodes to all others (Dijkstra).
#[derive(Clone, Debug)]
pub struct ShortestPaths {
    /// The distance of each node from the nearest source; infinite if no source is connected to it.
    pub distance: Vec<f64>,
    /// The last edge of the shortest path to each node; [`ShortestPaths::NONE`] at sources.
    pub parent: Vec<u32>,
}

impl ShortestPaths {
    /// Marks the absence of an edge.
    pub const NONE: u32 = u32::MAX;

    /// Computes the shortest paths from the nearest of `sources`, which are nodes of `graph`.
    pub fn new(graph: &EdgeGraph, sources: impl IntoIterator<Item = u32>) -> Self {
        let mut distance = vec![f64::INFINITY; graph.nodes];
        let mut parent = vec![Self::NONE; graph.nodes];
        // The bits of non-negative doubles have the same order as their values.
        let mut queue: BinaryHeap<Reverse<(u64, u32)>> = BinaryHeap::new();
        for n in sources {
            distance[n as usize] = 0.0;
            queue.push(Reverse((0, n)));
        }
        while let Some(Reverse((bits, n))) = queue.pop() {
            let d = f64::from_bits(bits);
            if d > distance[n as usize] {
                continue;
            }
            for (&e, &m) in graph.edges_at(n).iter().zip(graph.neighbours(n)) {
                let there = d + graph.length[e as usize];
                if there < distance[m as usize] {
                    distance[m as usize] = there;
                    parent[m as usize] = e;
                    queue.push(Reverse((there.to_bits(), m)));
                }
            }
        }
        ShortestPaths { distance, parent }
    }

    /// Iterates over the edges of the shortest path from node `n` back to its source.
    pub fn path<'a>(&'a self, graph: &'a EdgeGraph, mut n: u32) -> impl Iterator<Item = u32> + 'a {
        std::iter::from_fn(move || {
            let e = self.parent[n as usize];
            if e == Self::NONE {
                return None;
            }
            n = graph.across(e, n);
            Some(e)
        })
    }
}

/// The greedy system of loops of a surface of genus g (Erickson, Whittlesey, *Greedy optimal
/// homotopy and homology generators*, SODA 2005).
///
/// The tree consists of the shortest paths from a root. The cotree is a spanning tree of the faces;
/// it crosses edges uv that are not in the tree, of greatest total d(u) + |uv| + d(v), the length
/// of the shortest loop from the root through uv. Each of the 2g remaining edges closes one loop
/// with the tree. Together these are the shortest loops from the root that cut the surface to a
/// disc, where boundary loops count as points.
#[derive(Clone, Debug)]
pub struct TreeCotree {
    /// The node from which all paths start.
    pub root: u32,
    /// The tree: the distance of each node, and the edge from it toward the root.
    pub tree: ShortestPaths,
    /// The cotree: the edge to cross from each face toward face 0; [`ShortestPaths::NONE`] at face
    /// 0.
    pub face_parent: Vec<u32>,
    /// The 2g edges that belong to neither tree, in the order of the lengths of their loops.
    pub left_over: Vec<u32>,
}

impl TreeCotree {
    /// Computes the system of loops from the node `root`.
    pub fn new(graph: &EdgeGraph, root: u32) -> Self {
        let tree = ShortestPaths::new(graph, [root]);
        let mut in_tree = vec![false; graph.edges.len()];
        for &e in tree.parent.iter().filter(|&&e| e != ShortestPaths::NONE) {
            in_tree[e as usize] = true;
        }
        let loop_length = |e: u32| {
            let [a, b] = graph.ends(e).map(|n| tree.distance[n as usize]);
            a + graph.length[e as usize] + b
        };
        let mut others: Vec<(u64, u32)> = (0..graph.edges.len() as u32)
            .filter(|&e| graph.is_inner(e) && !in_tree[e as usize])
            .map(|e| (loop_length(e).to_bits(), e))
            .collect();
        others.sort_unstable();
        let mut joined = UnionFind::new(graph.faces.len());
        let mut in_cotree = in_tree;
        in_cotree.fill(false);
        let mut left_over = Vec::new();
        for &(_, e) in others.iter().rev() {
            let [f, g] = graph.sides(e);
            if joined.find(f) == joined.find(g) {
                left_over.push(e);
            } else {
                joined.unite(f, g);
                in_cotree[e as usize] = true;
            }
        }
        left_over.reverse();
        TreeCotree { root, tree, face_parent: toward_first_face(graph, &in_cotree), left_over }
    }

    /// The `k`-th loop as a closed walk of edges from the root: a path of the tree, a remaining
    /// edge, and a path back. The two paths can begin with the same edges.
    pub fn loop_edges(&self, graph: &EdgeGraph, k: usize) -> Vec<u32> {
        let e = self.left_over[k];
        let [a, b] = graph.ends(e);
        let mut walk: Vec<u32> = self.tree.path(graph, a).collect();
        walk.reverse();
        walk.push(e);
        walk.extend(self.tree.path(graph, b));
        walk
    }

    /// The closed walk through faces that crosses the `k`-th remaining edge and otherwise only
    /// edges of the cotree. It is given by the corners whose edges it crosses, each a corner of the
    /// face that it leaves. No edge is crossed twice.
    ///
    /// The integers `ω(c) = 1` on these corners, −1 on their opposite corners and 0 elsewhere sum
    /// to zero around every face. On a consistently oriented surface ω is a closed 1-form whose
    /// integral is ±1 along the `k`-th loop and 0 along all other loops.
    pub fn dual_loop(&self, graph: &EdgeGraph, k: usize) -> Vec<u32> {
        let edges = graph.edges;
        let &[c, d] = edges.corners(self.left_over[k] as usize) else { return Vec::new() };
        let [mut from, mut back] = [c, d].map(|c| self.toward_root(graph, edges.face_of_corner[c as usize]));
        // The common part of the two paths to the root of the cotree cancels.
        while let (Some(&a), Some(&b)) = (from.last(), back.last())
            && a == b
        {
            from.pop();
            back.pop();
        }
        // The walk leaves c's face across the remaining edge, reaches the common face, and returns
        // to c's face.
        let opposite = |c: &u32| edges.opposite(*c as usize).map(|o| o as u32);
        let mut walk = vec![c];
        walk.extend(back);
        walk.extend(from.iter().rev().filter_map(opposite));
        walk
    }

    /// The corners whose edges are crossed from face `f` to the root of the cotree, each a corner
    /// of the face that is left.
    fn toward_root(&self, graph: &EdgeGraph, mut f: u32) -> Vec<u32> {
        let mut way = Vec::new();
        while self.face_parent[f as usize] != ShortestPaths::NONE {
            let corners = graph.edges.corners(self.face_parent[f as usize] as usize);
            let face = |c: u32| graph.edges.face_of_corner[c as usize];
            let (out, into) = if face(corners[0]) == f { (corners[0], corners[1]) } else { (corners[1], corners[0]) };
            way.push(out);
            f = face(into);
        }
        way
    }
}

/// Returns for each face the edge of the cotree toward face 0.
fn toward_first_face(graph: &EdgeGraph, in_cotree: &[bool]) -> Vec<u32> {
    let edges = graph.edges;
    let mut parent = vec![ShortestPaths::NONE; graph.faces.len()];
    let mut queue = Vec::with_capacity(graph.faces.len());
    queue.extend((!graph.faces.is_empty()).then_some(0u32));
    let mut head = 0;
    while head < queue.len() {
        let f = queue[head];
        head += 1;
        for c in graph.faces.corner_range(f as usize) {
            let e = edges.of_corner[c];
            if !in_cotree[e as usize] || parent[f as usize] == e {
                continue;
            }
            let Some(d) = edges.opposite(c) else { continue };
            let g = edges.face_of_corner[d];
            parent[g as usize] = e;
            queue.push(g);
        }
    }
    parent
}
