//! What the tests share: meshes by construction, a seeded random source, shorthand for the pipeline.
#![allow(dead_code)] // each test file uses a part

use std::path::PathBuf;

use num_complex::Complex64;
use riemap::constraint::Fixed;
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, DualPoint, dual_point};
use riemap::solver::{Iteration, Observer, Phase};
use riemap::surface::generate::generate;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::diagnosis::Diagnosis;
use riemap::surface::{Faces, Surface};

/// splitmix64: the same numbers everywhere.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    }

    /// Below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    /// In [−1, 1).
    pub fn real(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    pub fn complex(&mut self) -> Complex64 {
        Complex64::new(self.real(), self.real())
    }

    pub fn vector(&mut self) -> [f64; 3] {
        [self.real(), self.real(), self.real()]
    }

    pub fn unit_vector(&mut self) -> [f64; 3] {
        loop {
            let v = self.vector();
            let l = dot(v, v).sqrt();
            if (0.1..1.0).contains(&l) {
                return v.map(|x| x / l);
            }
        }
    }

    /// A rotation: three orthonormal rows of determinant 1.
    pub fn rotation(&mut self) -> [[f64; 3]; 3] {
        let a = self.unit_vector();
        loop {
            let c = cross(a, self.unit_vector());
            let l = dot(c, c).sqrt();
            if l > 0.1 {
                let b = c.map(|x| x / l);
                return [a, b, cross(a, b)];
            }
        }
    }

    pub fn permutation(&mut self, n: usize) -> Vec<u32> {
        let mut order: Vec<u32> = (0..n as u32).collect();
        for k in (1..n).rev() {
            order.swap(k, self.below(k + 1));
        }
        order
    }
}

pub fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub fn sub(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = sub(a, b);
    dot(d, d).sqrt()
}

pub fn rotate(rows: [[f64; 3]; 3], x: [f64; 3]) -> [f64; 3] {
    rows.map(|row| dot(row, x))
}

/// A surface with these vertices and faces.
pub fn surface<P: AsRef<[u32]>>(positions: Vec<[f64; 3]>, faces: impl IntoIterator<Item = P>) -> Surface {
    Surface::from_polygons(positions, faces).unwrap_or_else(|error| panic!("{error}"))
}

/// `vertices` points in general position: no two coincide, no three are collinear (with certainty enough).
pub fn scattered(vertices: usize) -> Vec<[f64; 3]> {
    let mut random = Random(vertices as u64);
    (0..vertices).map(|_| random.vector()).collect()
}

/// How opposite sides of a grid are identified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sides {
    Free,
    /// Left to right.
    Cylinder,
    /// Left to right, reversed.
    Moebius,
    /// Left to right, bottom to top.
    Torus,
}

/// `columns × rows` quads with sides identified, consistently oriented (the band: but for its seam).
pub fn quad_grid(columns: u32, rows: u32, sides: Sides) -> Surface {
    let wraps = sides != Sides::Free;
    let across = if wraps { columns } else { columns + 1 };
    let up = if sides == Sides::Torus { rows } else { rows + 1 };
    let vertex = |i: u32, j: u32| {
        let j = if sides == Sides::Moebius && i == columns { rows - j } else { j };
        (j % up) * across + i % across
    };
    let faces = (0..rows).flat_map(|j| {
        (0..columns).map(move |i| [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)])
    });
    surface(scattered((across * up) as usize), faces)
}

/// Every quad split along its first diagonal.
pub fn triangulated(quads: &Surface) -> Surface {
    let faces = quads.faces().iter().flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]);
    surface(quads.positions().to_vec(), faces)
}

/// The cube's surface, six quads seen from outside.
pub fn cube() -> Surface {
    let positions = (0..8u32).map(|v| [v & 1, v >> 1 & 1, v >> 2].map(f64::from)).collect();
    surface(positions, [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
}

/// The octahedron's surface, seen from outside.
pub fn octahedron() -> Surface {
    let positions = vec![[1., 0., 0.], [-1., 0., 0.], [0., 1., 0.], [0., -1., 0.], [0., 0., 1.], [0., 0., -1.]];
    let faces = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    surface(positions, faces)
}

/// Both surfaces side by side.
pub fn union(a: &Surface, b: &Surface) -> Surface {
    let shift = a.positions().len() as u32;
    let moved = b.positions().iter().map(|&[x, y, z]| [x + 10.0, y, z]);
    let faces = a.faces().iter().map(<[u32]>::to_vec);
    let faces = faces.chain(b.faces().iter().map(|f| f.iter().map(|v| v + shift).collect()));
    surface(a.positions().iter().copied().chain(moved).collect(), faces)
}

/// The connected sum: face `in_a` and face `in_b` removed, their rims sewn together. Leaves the rim of `in_b` unused.
pub fn connected_sum(a: &Surface, in_a: usize, b: &Surface, in_b: usize) -> Surface {
    let both = union(a, b);
    let rim_a = both.faces().get(in_a).to_vec();
    let in_b = a.faces().len() + in_b;
    let rim_b = both.faces().get(in_b).to_vec();
    let n = rim_a.len();
    assert_eq!(n, rim_b.len());
    let sewn = |v: u32| rim_b.iter().position(|&w| w == v).map_or(v, |k| rim_a[(n - k) % n]);
    let kept = both.faces().iter().enumerate().filter(|(f, _)| *f != in_a && *f != in_b);
    surface(both.positions().to_vec(), kept.map(|(_, f)| f.iter().map(|&v| sewn(v)).collect::<Vec<_>>()))
}

/// The faces for which `keep` holds; vertices stay.
pub fn filtered(s: &Surface, keep: impl Fn(usize) -> bool) -> Surface {
    surface(s.positions().to_vec(), s.faces().iter().enumerate().filter(|(f, _)| keep(*f)).map(|(_, f)| f))
}

/// The faces of `which` turned over.
pub fn flipped(s: &Surface, which: impl IntoIterator<Item = usize>) -> Surface {
    let mut faces = s.faces().clone();
    which.into_iter().for_each(|f| faces.flip(f));
    let turned = surface(s.positions().to_vec(), faces.iter());
    match s.face_normals() {
        Some(normals) => turned.with_face_normals(normals.to_vec()).expect("one for each face"),
        None => turned,
    }
}

/// The same surface with faces in the order `order` and vertex v called `name[v]`.
pub fn shuffled(s: &Surface, order: &[u32], name: &[u32]) -> Surface {
    let mut positions = s.positions().to_vec();
    for (v, &new) in name.iter().enumerate() {
        positions[new as usize] = s.positions()[v];
    }
    let named = s.faces().renumbered(name);
    surface(positions, order.iter().map(|&f| named.get(f as usize)))
}

/// A disc grown face by face on its boundary, of faces with `arity` 3 or 4, at random places of R³.
pub fn grown_disc(arity: usize, steps: usize, random: &mut Random) -> Surface {
    let mut rim: Vec<u32> = (0..arity as u32).collect();
    let mut faces = Faces::from_iter([rim.clone()]);
    let mut vertices = arity as u32;
    let mut joined = std::collections::HashSet::new();
    let join = |joined: &mut std::collections::HashSet<[u32; 2]>, f: &[u32]| {
        for k in 0..f.len() {
            let (a, b) = (f[k], f[(k + 1) % f.len()]);
            joined.insert([a.min(b), a.max(b)]);
        }
    };
    join(&mut joined, &rim);
    for _ in 0..steps {
        // Sew the new face to `on` consecutive edges of the rim, which then become interior.
        let on = 1 + random.below(arity - 1);
        if rim.len() < on + 3 {
            continue;
        }
        let turn = random.below(rim.len());
        rim.rotate_left(turn);
        let new: Vec<u32> = (0..(arity - 1 - on) as u32).map(|k| vertices + k).collect();
        let (first, last) = (rim[0], rim[on]);
        if new.is_empty() && joined.contains(&[first.min(last), first.max(last)]) {
            continue;
        }
        vertices += new.len() as u32;
        // The rim has the surface on its left; the new face runs along it the other way.
        let face: Vec<u32> = rim[..=on].iter().rev().chain(&new).copied().collect();
        join(&mut joined, &face);
        faces.push(&face);
        rim.splice(1..on, new);
    }
    let positions = (0..vertices).map(|_| random.vector()).collect();
    surface(positions, faces.iter())
}

/// The disc that `s` is.
#[track_caller]
pub fn disc(s: &Surface) -> OrientedMesh {
    OrientedMesh::new(s, &Diagnosis::new(s)).unwrap_or_else(|error| panic!("{error}"))
}

/// The generated disc of that name.
#[track_caller]
pub fn disc_of(name: &str) -> OrientedMesh {
    disc(&generate(name).unwrap_or_else(|error| panic!("{error}")).surface)
}

/// The quad graph of a quad mesh, or of a triangle mesh with the dual point of that name and midpoints.
#[track_caller]
pub fn graph_of(disc: &OrientedMesh, dual: &str) -> QuadGraph {
    let graph = match disc.faces.arity() {
        Some(4) => QuadGraph::from_quads(disc, None),
        _ => QuadGraph::from_triangles(disc, dual_point(dual).expect(dual), BoundaryDual::Midpoint),
    };
    graph.unwrap_or_else(|error| panic!("{error}"))
}

/// Where the vertices of the quad graph of a *planar* triangle mesh lie: the mesh's, the dual points, the duals on
/// boundary edges.
pub fn planar_places(disc: &OrientedMesh, dual: &dyn DualPoint, boundary_dual: BoundaryDual) -> Vec<Complex64> {
    let mut z: Vec<Complex64> = disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect();
    let primal = z.clone();
    let mut dual_of_edge = std::collections::HashMap::new();
    for f in disc.faces.iter() {
        let corner = [0, 1, 2].map(|k| primal[f[k] as usize]);
        let length = [0, 1, 2].map(|k| (corner[(k + 2) % 3] - corner[(k + 1) % 3]).norm());
        let w = dual.weights(length);
        let c = (corner[0] * w[0] + corner[1] * w[1] + corner[2] * w[2]) / (w[0] + w[1] + w[2]);
        z.push(c);
        for k in 0..3 {
            dual_of_edge.insert((f[k], f[(k + 1) % 3]), c);
        }
    }
    for (k, &v) in disc.boundary.iter().enumerate() {
        let w = disc.boundary[(k + 1) % disc.boundary.len()];
        let (a, b) = (primal[v as usize], primal[w as usize]);
        let along = match boundary_dual {
            BoundaryDual::Midpoint => 0.5,
            BoundaryDual::Foot => ((dual_of_edge[&(v, w)] - a) / (b - a)).re,
        };
        z.push(a + along * (b - a));
    }
    z
}

/// Every boundary vertex held at its place in `z`.
pub fn hold_boundary(graph: &QuadGraph, z: &[Complex64]) -> Fixed {
    hold(graph.boundary.iter().copied(), z)
}

/// Every second boundary vertex held (all of one diagonal class: of a triangle mesh, its own vertices) and one between
/// them, so that (2) is square.
pub fn hold_every_second(graph: &QuadGraph, z: &[Complex64]) -> Fixed {
    let second = graph.boundary.iter().step_by(2);
    hold(second.chain(&graph.boundary[1..2]).copied(), z)
}

/// These vertices held at their places in `z`.
pub fn hold(vertices: impl IntoIterator<Item = u32>, z: &[Complex64]) -> Fixed {
    let mut fixed = Fixed::default();
    for v in vertices {
        fixed.hold(v, z[v as usize]);
    }
    fixed
}

/// max |a − b| over the first `a.len()` values.
pub fn largest_difference(a: &[Complex64], b: &[Complex64]) -> f64 {
    assert!(a.len() <= b.len());
    // A NaN must not get lost.
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, |m: f64, d| if d <= m { m } else { d })
}

/// The slope of log(error) over log(h), least squares; h = 1/n.
pub fn fitted_order(n: &[f64], error: &[f64]) -> f64 {
    let x: Vec<f64> = n.iter().map(|n| -n.ln()).collect();
    let y: Vec<f64> = error.iter().map(|e| e.ln()).collect();
    let mean = |v: &[f64]| v.iter().sum::<f64>() / v.len() as f64;
    let (mx, my) = (mean(&x), mean(&y));
    let xy: f64 = x.iter().zip(&y).map(|(x, y)| (x - mx) * (y - my)).sum();
    xy / x.iter().map(|x| (x - mx).powi(2)).sum::<f64>()
}

/// The folder of public meshes, where there is one.
pub fn data_folder() -> Option<PathBuf> {
    let named = std::env::var_os("RIEMAP_DATA").filter(|name| !name.is_empty()).map(PathBuf::from);
    let beside = ["../shared/data", "data"].map(|folder| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(folder));
    let folders = named.map_or(beside.to_vec(), |folder| vec![folder]);
    folders.into_iter().find(|folder| folder.join("tri").is_dir())
}

/// Every mesh with every dual point it has.
pub fn graphs() -> Vec<(String, QuadGraph)> {
    let mut graphs = Vec::new();
    for name in ["graph:cos+cos?n=9", "sphere?n=8&jitter=0.3&seed=1"] {
        graphs.push((name.to_string(), graph_of(&disc_of(name), "")));
    }
    for name in [
        "enneper?n=6&mesh=triangle&diagonal=random&jitter=0.3&seed=2",
        "sphere?n=7&mesh=delaunay&seed=3",
        "plane?n=7&mesh=delaunay&points=random&seed=4",
        // steep: half of the edges have obtuse pairs, with circumcentres a negative ρ
        "graph:saddle?n=8&amplitude=4&mesh=triangle",
    ] {
        for dual in ["barycentre", "circumcentre", "incentre"] {
            graphs.push((format!("{name} {dual}"), graph_of(&disc_of(name), dual)));
        }
    }
    graphs
}

/// Asks for a stop after this many iterations in all.
pub struct Stopper(pub usize);

impl Observer for Stopper {
    fn phase(&mut self, _phase: Phase) {}

    fn iteration(&mut self, _iteration: &Iteration) {
        self.0 = self.0.saturating_sub(1);
    }

    fn stop_requested(&self) -> bool {
        self.0 == 0
    }
}
