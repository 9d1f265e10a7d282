//! Short graphs along which a surface is cut to a disc.

use std::collections::HashSet;

use crate::surface::UnionFind;
use crate::surface::topology::tree_cotree::{EdgeGraph, ShortestPaths, TreeCotree};

/// Faces times systems of loops that may be tried: about a second for each million.
const EFFORT: usize = 3_000_000;

/// Bounds of the number of systems.
const SYSTEMS: (usize, usize) = (3, 40);

/// Relative difference of lengths that is rounding.
const SAME: f64 = 1e-9;

/// Roots tried around the best one, before those nearer to it are.
const AROUND: usize = 4;

/// Inner edges of `graph` whose removal leaves a disc, of a surface of this genus; none for a disc.
///
/// With handles: the shortest of some greedy systems of loops, without dangling branches, then shortest paths to the
/// boundary loops it does not meet. Without: the shortest tree of paths that joins the loops (within a factor of two); on
/// a sphere a shortest path between two points far from each other.
pub(super) fn cut_graph(graph: &EdgeGraph, genus: u64) -> Vec<u32> {
    match (genus, graph.loops.as_slice()) {
        (0, []) => far_points(graph),
        (0, _) => joined(graph, Vec::new()),
        _ => shortest_system(graph),
    }
}

/// A set of edges and their total length.
struct System {
    edges: Vec<u32>,
    length: f64,
    /// The node of its loops farthest from the root.
    farthest: u32,
    /// The distance of each node from the root.
    distance: Vec<f64>,
}

/// The best of as many systems of loops as the size of the surface allows.
///
/// First from the farthest point on the best one so far, as long as this helps and once more; then from points around its
/// root, from an eighth of its length down. The lengths have local minima: on a torus every loop beside the inner equator,
/// when the way there and back is longer than what it would save.
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
        let shorter = |other: &System| other.length < best.length * (1.0 - SAME);
        match circle.iter().step_by(step).find_map(|&root| another(root).filter(shorter)) {
            Some(other) => best = other,
            None => radius *= 0.5,
        }
    }
    best.edges
}

/// The greedy system of loops from `root`, pruned, and the boundary loops joined to it.
fn system(graph: &EdgeGraph, root: u32) -> System {
    let loops = TreeCotree::new(graph, root);
    let mut chosen = vec![false; graph.edges.len()];
    let mut edges = Vec::new();
    for &e in &loops.left_over {
        chosen[e as usize] = true;
        edges.push(e);
        for n in graph.ends(e) {
            for e in loops.tree.path(graph, n) {
                // From here on the path is there already.
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
    System { length: edges.iter().map(|&e| graph.length[e as usize]).sum(), edges, farthest, distance }
}

/// Removes branches that end at a node.
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

/// `edges`, which are connected, and paths that join all boundary loops to them, or to each other: a shortest tree with the
/// distances between these as lengths (K. Mehlhorn, *A faster approximation algorithm for the Steiner problem in graphs*,
/// 1988).
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

/// A shortest path of two edges at least: from the point farthest from some point to the one farthest from there.
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
        // One edge alone does not open a surface.
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
