use super::Weighted;
use crate::sparse::Lists;
use crate::surface::edges::Edges;
use crate::surface::oriented_mesh::OrientedMesh;

/// The neighbours towards which weights pull a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Towards {
    /// All neighbours closer to the boundary.
    All,
    /// One of these, a different one for each vertex if possible.
    One,
}

/// Returns weights 1 towards vertices closer to the boundary and `others` towards all other
/// vertices, where distance is the number of edges.
///
/// # Rationale
/// A protrusion of length d and girth g has size `e^{−2πd/g}` in a harmonic map, and about that for
/// any symmetric or geometric weights. These weights pull each ring of a protrusion towards the
/// previous ring. With [`Towards::All`] a ring is still at most as large as the mean of its
/// neighbours in the previous one, a factor of 0.7 for rings of four vertices. With
/// [`Towards::One`] the shrinkage tends to zero with `others`.
pub fn outward(disc: &OrientedMesh, towards: Towards, others: f64) -> Vec<Weighted> {
    let edges = Edges::new(&disc.faces, disc.positions.len());
    let depth = depths(disc, &edges);
    let is_nearer = |neighbour: u32, vertex: u32| depth[neighbour as usize] < depth[vertex as usize];
    let chosen = match towards {
        Towards::All => Vec::new(),
        Towards::One => matched(&edges.ends, &is_nearer, disc.positions.len()),
    };
    let both = edges.ends.iter().flat_map(|&[a, b]| [(a, b), (b, a)]);
    let weighted = |(vertex, neighbour): (u32, u32)| {
        let counts = match towards {
            Towards::All => is_nearer(neighbour, vertex),
            Towards::One => chosen[vertex as usize] == neighbour,
        };
        Weighted { vertex, neighbour, weight: if counts { 1.0 } else { others } }
    };
    both.map(weighted).collect()
}

/// Returns for each vertex a neighbour closer to the boundary that as few other vertices as
/// possible have chosen, or `u32::MAX`.
///
/// If two vertices of a ring chose the same vertex of the previous ring, their images would nearly
/// coincide, and rings of three vertices would degenerate.
fn matched(ends: &[[u32; 2]], is_nearer: &dyn Fn(u32, u32) -> bool, vertices: usize) -> Vec<u32> {
    let mut nearer = vec![Vec::new(); vertices];
    for &[a, b] in ends {
        for (v, w) in [(a, b), (b, a)] {
            if is_nearer(w, v) {
                nearer[v as usize].push(w);
            }
        }
    }
    let mut taken = vec![0u32; vertices];
    let choose = |candidates: &Vec<u32>| match candidates.iter().min_by_key(|&&w| taken[w as usize]) {
        None => u32::MAX,
        Some(&w) => {
            taken[w as usize] += 1;
            w
        }
    };
    nearer.iter().map(choose).collect()
}

/// The smallest number of edges from each vertex to the boundary.
fn depths(disc: &OrientedMesh, edges: &Edges) -> Vec<u32> {
    let vertices = disc.positions.len();
    let both_ways = edges.ends.iter().flat_map(|&[a, b]| [(a, b), (b, a)]);
    let neighbours = Lists::new(vertices, both_ways);
    let mut depth = vec![u32::MAX; vertices];
    let mut queue = disc.boundary.clone();
    for &v in &queue {
        depth[v as usize] = 0;
    }
    let mut head = 0;
    while head < queue.len() {
        let v = queue[head] as usize;
        head += 1;
        for &w in neighbours.of(v as u32) {
            if depth[w as usize] == u32::MAX {
                depth[w as usize] = depth[v] + 1;
                queue.push(w);
            }
        }
    }
    depth
}
