//! Short graphs of edges along which a surface is cut to a disc.

use std::collections::HashSet;

use crate::surface::UnionFind;
use crate::surface::topology::tree_cotree::{EdgeGraph, ShortestPaths, TreeCotree};

/// Bound on (number of faces) × (number of systems of loops tried): a million take about a second.
const EFFORT: usize = 3_000_000;

/// Smallest and largest number of systems of loops that are tried.
const SYSTEMS: (usize, usize) = (3, 40);

/// Lengths whose relative difference is below this are taken as equal: it is rounding.
const SAME: f64 = 1e-9;

/// Number of roots tried on a ring around the best root before the ring shrinks.
const AROUND: usize = 4;

/// Returns inner edges of `graph` whose removal turns the surface into a disc; none if it is one.
///
/// - `genus` > 0: the shortest of several greedy systems of loops, pruned of dangling branches,
///   joined by shortest paths to the boundary loops that it does not meet.
/// - genus 0 with boundary loops: a tree of paths that joins the loops, at most twice as long as
///   the shortest one.
/// - sphere: a shortest path between two vertices far from each other.
pub(super) fn cut_graph(graph: &EdgeGraph, genus: u64) -> Vec<u32> {
    match (genus, graph.loops.as_slice()) {
        (0, []) => far_points(graph),
        (0, _) => joined(graph, Vec::new()),
        _ => shortest_system(graph),
    }
}

/// A set of edges whose removal leaves a disc, with its total length.
struct LoopSystem {
    edges: Vec<u32>,
    length: f64,
    /// The node on the system's loops that is farthest from the root.
    farthest: u32,
    /// Distance of each node from the root.
    distance: Vec<f64>,
}

/// Returns the shortest of several systems of loops; the size of the surface limits how many are
/// tried.
///
/// Roots are chosen in two phases. First, the next root is the farthest point on the best system so
/// far, until this no longer shortens it. Then roots on a ring around the best root are tried, with
/// a radius that starts at an eighth of the system's length and is halved when no root on it helps.
///
/// # Rationale
/// The length as a function of the root has local minima: on a torus every loop near the inner
/// equator is one if the detour to the equator is longer than what it would save.
fn shortest_system(graph: &EdgeGraph) -> Vec<u32> {
    let most = (EFFORT / graph.faces.len().max(1)).clamp(SYSTEMS.0, SYSTEMS.1);
    let start = graph.loops.first().copied().unwrap_or(graph.node[graph.faces.corners()[0] as usize]);
    let mut best = system(graph, start);
    let mut tried = HashSet::from([start]);
    let mut another = |root: u32| (tried.len() < most && tried.insert(root)).then(|| system(graph, root));
    while let Some(other) = another(best.farthest) {
        let (shorter, longer) = (other.length < best.length * (1.0 - SAME), other.length > best.length * (1.0 + SAME));
        if !longer {
            best = other;
        }
        if !shorter {
            break;
        }
    }
    let shortest_edge = graph.length.iter().copied().fold(f64::INFINITY, f64::min);
    let mut radius = best.length / 8.0;
    for _ in 0..most {
        if radius < shortest_edge {
            break;
        }
        let circle: Vec<u32> = (0..graph.nodes as u32)
            .filter(|&n| (0.75 * radius..=radius).contains(&best.distance[n as usize]))
            .collect();
        let step = circle.len().div_ceil(AROUND).max(1);
        let shorter = |other: &LoopSystem| other.length < best.length * (1.0 - SAME);
        match circle.iter().step_by(step).find_map(|&root| another(root).filter(shorter)) {
            Some(other) => best = other,
            None => radius *= 0.5,
        }
    }
    best.edges
}

/// Computes the greedy system of loops from `root`, prunes it and joins the boundary loops to it.
fn system(graph: &EdgeGraph, root: u32) -> LoopSystem {
    let loops = TreeCotree::new(graph, root);
    let mut chosen = vec![false; graph.edges.len()];
    let mut edges = Vec::new();
    for &e in &loops.left_over {
        chosen[e as usize] = true;
        edges.push(e);
        for n in graph.ends(e) {
            for e in loops.tree.path(graph, n) {
                // The rest of the path to the root has already been added.
                if std::mem::replace(&mut chosen[e as usize], true) {
                    break;
                }
                edges.push(e);
            }
        }
    }
    prune(graph, &mut edges, &mut chosen);
    let distance = loops.tree.distance;
    let nodes = edges.iter().flat_map(|&e| graph.ends(e));
    let farthest = nodes.max_by(|&a, &b| distance[a as usize].total_cmp(&distance[b as usize])).unwrap_or(root);
    let edges = joined(graph, edges);
    LoopSystem { length: edges.iter().map(|&e| graph.length[e as usize]).sum(), edges, farthest, distance }
}

/// Removes the branches that end at a node of degree one.
fn prune(graph: &EdgeGraph, edges: &mut Vec<u32>, chosen: &mut [bool]) {
    let mut degree = vec![0u32; graph.nodes];
    for n in edges.iter().flat_map(|&e| graph.ends(e)) {
        degree[n as usize] += 1;
    }
    let mut ends: Vec<u32> = edges.iter().flat_map(|&e| graph.ends(e)).filter(|&n| degree[n as usize] == 1).collect();
    while let Some(n) = ends.pop() {
        let Some(&e) = graph.edges_at(n).iter().find(|&&e| chosen[e as usize]) else { continue };
        chosen[e as usize] = false;
        for m in graph.ends(e) {
            degree[m as usize] -= 1;
        }
        let m = graph.across(e, n);
        if degree[m as usize] == 1 {
            ends.push(m);
        }
    }
    edges.retain(|&e| chosen[e as usize]);
}

/// Extends the connected set `edges` by paths that join all boundary loops to it, or to each other.
///
/// The result is a shortest spanning tree of the complete graph on these sets whose edge lengths
/// are their distances (K. Mehlhorn, *A faster approximation algorithm for the Steiner problem in
/// graphs*, 1988).
fn joined(graph: &EdgeGraph, mut edges: Vec<u32>) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    let mut nearest = vec![NONE; graph.nodes];
    for n in edges.iter().flat_map(|&e| graph.ends(e)) {
        nearest[n as usize] = 0;
    }
    let mut count = u32::from(!edges.is_empty());
    for &n in &graph.loops {
        if nearest[n as usize] == NONE {
            nearest[n as usize] = count;
            count += 1;
        }
    }
    if count < 2 {
        return edges;
    }
    let sources = (0..graph.nodes as u32).filter(|&n| nearest[n as usize] != NONE);
    let paths = ShortestPaths::new(graph, sources);
    let mut way = Vec::new();
    for n in 0..graph.nodes as u32 {
        let mut at = n;
        while nearest[at as usize] == NONE && paths.parent[at as usize] != ShortestPaths::NONE {
            way.push(at);
            at = graph.across(paths.parent[at as usize], at);
        }
        for passed in way.drain(..) {
            nearest[passed as usize] = nearest[at as usize];
        }
    }
    let mut between: Vec<(u64, u32)> = (0..graph.edges.len() as u32)
        .filter(|&e| graph.is_inner(e))
        .filter_map(|e| {
            let ends = graph.ends(e);
            let [a, b] = ends.map(|n| nearest[n as usize]);
            let [da, db] = ends.map(|n| paths.distance[n as usize]);
            (a != b).then(|| ((da + graph.length[e as usize] + db).to_bits(), e))
        })
        .collect();
    between.sort_unstable();
    let mut together = UnionFind::new(count as usize);
    let mut chosen: HashSet<u32> = edges.iter().copied().collect();
    for (_, e) in between {
        let [a, b] = graph.ends(e).map(|n| nearest[n as usize]);
        if together.find(a) != together.find(b) {
            together.unite(a, b);
            let paths = graph.ends(e).map(|n| paths.path(graph, n));
            let added = std::iter::once(e).chain(paths.into_iter().flatten());
            edges.extend(added.filter(|&e| chosen.insert(e)));
        }
    }
    edges
}

/// Returns a path of at least two edges: the shortest path from the node `a` that is farthest from
/// an arbitrary node to the node that is farthest from `a`.
fn far_points(graph: &EdgeGraph) -> Vec<u32> {
    let farthest = |paths: &ShortestPaths, from: u32| {
        let others = (0..graph.nodes as u32).filter(|&n| n != from && paths.distance[n as usize].is_finite());
        others.max_by(|&a, &b| paths.distance[a as usize].total_cmp(&paths.distance[b as usize])).unwrap_or(from)
    };
    let from = graph.node[graph.faces.corners()[0] as usize];
    let a = farthest(&ShortestPaths::new(graph, [from]), from);
    let paths = ShortestPaths::new(graph, [a]);
    let b = farthest(&paths, a);
    let mut edges: Vec<u32> = paths.path(graph, b).collect();
    if edges.len() == 1 {
        // Cutting a closed surface along a single edge does not open it.
        let beside = [a, b].into_iter().find_map(|n| {
            graph.edges_at(n).iter().copied().find(|&e| {
                let m = graph.across(e, n);
                m != a && m != b
            })
        });
        edges.extend(beside);
    }
    edges
}
