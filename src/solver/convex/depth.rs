use super::Weighted;
use crate::surface::edges::Edges;
use crate::surface::oriented_mesh::OrientedMesh;

/// To which neighbours weights draw a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Towards {
    /// To all that are nearer to the boundary.
    All,
    /// To one of them, another one each as far as that goes.
    One,
}

/// 1 towards vertices nearer to the boundary, `others` towards all others, nearness counted in edges.
///
/// A deep part of the surface, a finger of length d and girth g, has the size `e^{−2πd/g}` in a harmonic map, and with any weights that
/// are symmetric or see geometry about that. Here each ring of it is drawn out to the one before. With [`Towards::All`] it still is no
/// larger than the mean of its neighbours there, of four vertices a ring 0.7 of it; with [`Towards::One`] it shrinks as little as `others` is small.
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

/// For each vertex a neighbour nearer to the boundary, one that as few others have chosen as can be: where two vertices of a ring go to one of
/// the ring before, they come to lie on each other, and rings of three are done for. `u32::MAX` where there is none.
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

/// The least number of edges from each vertex to the boundary.
fn depths(disc: &OrientedMesh, edges: &Edges) -> Vec<u32> {
    let vertices = disc.positions.len();
    let mut offsets = vec![0u32; vertices + 1];
    for &v in edges.ends.iter().flatten() {
        offsets[v as usize + 1] += 1;
    }
    for v in 0..vertices {
        offsets[v + 1] += offsets[v];
    }
    let mut neighbours = vec![0; 2 * edges.len()];
    let mut cursor = offsets.clone();
    for &[a, b] in &edges.ends {
        for (v, other) in [(a, b), (b, a)] {
            neighbours[cursor[v as usize] as usize] = other;
            cursor[v as usize] += 1;
        }
    }
    let mut depth = vec![u32::MAX; vertices];
    let mut queue = disc.boundary.clone();
    for &v in &queue {
        depth[v as usize] = 0;
    }
    let mut head = 0;
    while head < queue.len() {
        let v = queue[head] as usize;
        head += 1;
        for &w in &neighbours[offsets[v] as usize..offsets[v + 1] as usize] {
            if depth[w as usize] == u32::MAX {
                depth[w as usize] = depth[v] + 1;
                queue.push(w);
            }
        }
    }
    depth
}
