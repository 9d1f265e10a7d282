//! What holds of every surface: Euler's formula, independence of numbering and of orientation, no panic.

use std::collections::{BTreeMap, HashMap, HashSet};

use crate::common::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::Topology;
use riemap::surface::topology::diagnosis::{Diagnosis, Finding};
use riemap::surface::{Faces, Surface};

/// A grid of any kind, of quads or triangles, with each face removed with probability `holes`/8.
fn sieve() -> impl Strategy<Value = (Surface, Sides)> {
    let sides = prop::sample::select(vec![Sides::Free, Sides::Cylinder, Sides::Moebius, Sides::Torus]);
    (sides, 3u32..8, 3u32..7, any::<bool>(), 0u64..5, any::<u64>()).prop_map(|(sides, m, n, split, holes, seed)| {
        let quads = quad_grid(m, n, sides);
        let whole = if split { triangulated(&quads) } else { quads };
        let mut random = Random(seed);
        let keep: Vec<bool> = (0..whole.faces().len()).map(|_| random.bits() % 8 >= holes).collect();
        (filtered(&whole, |f| keep[f]), sides)
    })
}

/// Polygons of 3 to 6 corners on few vertices, repetitions and all, at places of a small lattice.
fn soup() -> impl Strategy<Value = Surface> {
    (1u32..9).prop_flat_map(|vertices| {
        let place = prop::array::uniform3(-2i8..3).prop_map(|x| x.map(f64::from));
        let polygon = prop::collection::vec(0..vertices, 3..=6);
        let triangles = prop::collection::vec(prop::collection::vec(0..vertices, 3), 0..9);
        let polygons = prop_oneof![prop::collection::vec(polygon, 0..9), triangles];
        (prop::collection::vec(place, vertices as usize), polygons).prop_map(|(x, faces)| surface(x, faces))
    })
}

fn seed() -> impl Strategy<Value = u64> {
    any::<u64>()
}

/// The findings without any index: what must not depend on numbering.
fn counts(diagnosis: &Diagnosis) -> Vec<String> {
    let mut all: Vec<String> = diagnosis
        .findings
        .iter()
        .map(|finding| match finding {
            Finding::NoFaces => "no faces".to_string(),
            Finding::NotFinite { count, .. } => format!("not finite {count}"),
            Finding::Polygons { arities, .. } => format!("polygons {arities:?}"),
            Finding::RepeatedVertex { count, .. } => format!("repeated {count}"),
            Finding::DuplicateFaces { count, .. } => format!("duplicate {count}"),
            Finding::ZeroLengthEdges { count, fatal, .. } => format!("zero length {count} {fatal}"),
            Finding::ZeroAreaFaces { count, .. } => format!("zero area {count}"),
            Finding::Surrogates { count, .. } => format!("surrogates {count}"),
            Finding::NonManifoldEdges { count, .. } => format!("edges {count}"),
            Finding::NonManifoldVertices { count, .. } => format!("vertices {count}"),
            Finding::NonOrientable { .. } => "not orientable".to_string(),
            Finding::Reoriented { count, .. } => format!("reoriented {count}"),
            Finding::Components { count, faces } => format!("components {count} {faces:?}"),
            Finding::Closed { genus } => format!("closed {genus}"),
            Finding::NotADisc { boundary_loops, genus } => format!("not a disc {boundary_loops:?} {genus}"),
            Finding::Unreferenced { count, .. } => format!("unreferenced {count}"),
            Finding::OutOfRange { .. } => "out of range".to_owned(),
            Finding::CoincidentVertices { count, .. } => format!("coincident {count}"),
        })
        .collect();
    all.sort();
    let mut parts: Vec<String> = diagnosis
        .topology
        .components
        .iter()
        .map(|c| {
            let numbers = (c.faces, c.vertices, c.edges, c.orientable, c.manifold);
            format!("{numbers:?} {:?} {:?}", c.boundary_loops, c.genus())
        })
        .collect();
    parts.sort();
    all.extend(parts);
    all
}

/// Directed edges of faces that agree in orientation, each with how often it occurs.
fn directed(faces: &Faces) -> HashMap<(u32, u32), usize> {
    let mut count = HashMap::new();
    for f in faces.iter() {
        for k in 0..f.len() {
            *count.entry((f[k], f[(k + 1) % f.len()])).or_insert(0) += 1;
        }
    }
    count
}

/// Boundary loops of an oriented manifold by walking from each boundary edge to the next.
fn walked_loops(faces: &Faces) -> Vec<usize> {
    let edges = directed(faces);
    let ahead: BTreeMap<u32, u32> = edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))).copied().collect();
    let mut seen = HashSet::new();
    let mut lengths = Vec::new();
    for &start in ahead.keys() {
        let (mut v, mut length) = (start, 0);
        while seen.insert(v) {
            v = ahead[&v];
            length += 1;
        }
        if length > 0 {
            lengths.push(length);
        }
    }
    lengths.sort_unstable_by(|a, b| b.cmp(a));
    lengths
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn euler_s_formula_holds_on_every_manifold_component((s, sides) in sieve()) {
        let topology = Topology::new(&s);
        for part in topology.components.iter().filter(|c| c.manifold) {
            let handles = 2 - part.boundary_loops.len() as i64 - part.euler();
            let genus = part.genus().expect("a manifold has a genus") as i64;
            prop_assert!(handles >= 0);
            prop_assert_eq!(handles, if part.orientable { 2 * genus } else { genus });
            // no piece of a surface has more genus than the whole
            match sides {
                Sides::Free | Sides::Cylinder => prop_assert!(part.orientable && genus == 0),
                Sides::Torus => prop_assert!(part.orientable && genus <= 1),
                Sides::Moebius => prop_assert!(genus == i64::from(!part.orientable)),
            }
        }
        prop_assert_eq!(topology.components.iter().map(|c| c.faces).sum::<usize>(), s.faces().len());
        prop_assert_eq!(topology.components.iter().map(|c| c.edges).sum::<usize>(), topology.edges.len());
        let edges: HashSet<(u32, u32)> = directed(s.faces()).into_keys().map(|(a, b)| (a.min(b), a.max(b))).collect();
        prop_assert_eq!(edges.len(), topology.edges.len());
    }

    #[test]
    fn boundary_loops_are_those_that_a_walk_finds((s, sides) in sieve()) {
        let topology = Topology::new(&s);
        prop_assume!(sides != Sides::Moebius && topology.components.iter().all(|c| c.manifold));
        prop_assume!(topology.fans.iter().all(|&k| k <= 1));
        let mut loops: Vec<usize> = topology.components.iter().flat_map(|c| c.boundary_loops.clone()).collect();
        loops.sort_unstable_by(|a, b| b.cmp(a));
        prop_assert_eq!(loops, walked_loops(s.faces()));
    }

    #[test]
    fn sums_of_tori_with_holes_have_the_genus_and_the_loops_they_were_given(
        tori in 0usize..4, holes in 0usize..4, split in any::<bool>(), seed in seed(),
    ) {
        // a cylinder capped at both ends is a sphere with many quads
        let torus = quad_grid(7, 6, Sides::Torus);
        let mut s = connected_sum(&cube(), 0, &cube(), 0);
        for _ in 0..tori {
            s = connected_sum(&s, s.faces().len() / 2, &torus, 10);
        }
        // faces without common vertices, from a torus at the end; without one, the sphere gets one hole at most
        let apart = [0usize, 14, 28];
        let first = s.faces().len() - if tori > 0 { 41 } else { 10 };
        let holes = if tori > 0 { holes.min(3) } else { holes.min(1) };
        let mut random = Random(seed);
        let s = filtered(&s, |f| !apart[..holes].iter().any(|&k| first + k == f));
        let s = if split { triangulated(&s) } else { s };
        let turned: Vec<usize> = (0..s.faces().len()).filter(|_| random.below(3) == 0).collect();
        let topology = Topology::new(&flipped(&s, turned));
        prop_assert_eq!(topology.components.len(), 1);
        let part = &topology.components[0];
        prop_assert!(part.orientable && part.manifold);
        prop_assert_eq!(part.genus(), Some(tori as u64));
        prop_assert_eq!(&part.boundary_loops, &vec![4; holes]);
        prop_assert_eq!(part.euler(), 2 - 2 * tori as i64 - holes as i64);
        prop_assert_eq!(part.is_disc(), tori == 0 && holes == 1);
    }

    #[test]
    fn the_diagnosis_depends_neither_on_the_order_of_faces_nor_on_vertex_numbers(
        s in prop_oneof![soup(), sieve().prop_map(|(s, _)| s)], seed in seed(),
    ) {
        let mut random = Random(seed);
        // flips in the input, so that there is something to repair
        let turned: Vec<usize> = (0..s.faces().len()).filter(|_| random.below(4) == 0).collect();
        let s = flipped(&s, turned);
        let order = random.permutation(s.faces().len());
        let name = random.permutation(s.positions().len());
        let t = shuffled(&s, &order, &name);
        prop_assert_eq!(counts(&Diagnosis::new(&s)), counts(&Diagnosis::new(&t)));
    }

    #[test]
    fn flipping_any_faces_of_a_disc_leaves_the_same_disc(
        arity in 3usize..5, steps in 0usize..40, seed in seed(), some in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let s = grown_disc(arity, steps, &mut random);
        let turned: Vec<usize> = (0..s.faces().len()).filter(|f| some >> (f % 64) & 1 == 1).collect();
        let (before, after) = (disc(&s), disc(&flipped(&s, turned)));
        prop_assert_eq!(&before.positions, &after.positions);
        if before.faces == after.faces {
            prop_assert_eq!(&before.boundary, &after.boundary);
        } else {
            let mirrored = flipped(&s, 0..s.faces().len());
            // a face turned over twice starts at the same corner
            prop_assert_eq!(&disc(&mirrored).faces, &after.faces);
            prop_assert_eq!(before.boundary[0], after.boundary[0]);
            let mut reversed = before.boundary.clone();
            reversed[1..].reverse();
            prop_assert_eq!(&reversed, &after.boundary);
        }
    }

    #[test]
    fn the_boundary_of_a_disc_is_a_closed_walk_with_the_surface_on_its_left(
        arity in 3usize..5, steps in 0usize..60, seed in seed(),
    ) {
        let mut random = Random(seed);
        let s = grown_disc(arity, steps, &mut random);
        let turned: Vec<usize> = (0..s.faces().len()).filter(|_| random.below(2) == 0).collect();
        let disc = disc(&flipped(&s, turned));
        let edges = directed(&disc.faces);
        // one or two corners on every edge, in opposite directions
        prop_assert!(edges.values().all(|&k| k == 1));
        let next = disc.boundary.iter().cycle().skip(1);
        for (&v, &w) in disc.boundary.iter().zip(next) {
            prop_assert!(edges.contains_key(&(v, w)) && !edges.contains_key(&(w, v)));
        }
        let on_boundary = edges.keys().filter(|(a, b)| !edges.contains_key(&(*b, *a))).count();
        prop_assert_eq!(disc.boundary.len(), on_boundary);
        let distinct: HashSet<&u32> = disc.boundary.iter().collect();
        prop_assert_eq!(distinct.len(), on_boundary);
        prop_assert_eq!(disc.boundary.iter().min(), disc.boundary.first());
        prop_assert_eq!(walked_loops(&disc.faces), vec![on_boundary]);
    }

    #[test]
    fn no_polygons_make_the_diagnosis_panic(s in soup()) {
        let diagnosis = Diagnosis::new(&s);
        for finding in &diagnosis.findings {
            prop_assert!(!finding.to_string().is_empty());
        }
        if let Ok(disc) = OrientedMesh::new(&s, &diagnosis) {
            prop_assert!(directed(&disc.faces).values().all(|&k| k == 1));
            prop_assert_eq!(walked_loops(&disc.faces), vec![disc.boundary.len()]);
            let edges = Topology::new(&s).edges.len();
            prop_assert_eq!(disc.positions.len() + disc.faces.len(), edges + 1);
        }
    }

    #[test]
    fn coordinates_of_any_bits_make_no_panic_and_no_zero_area_disc(bits in prop::array::uniform12(any::<u64>())) {
        let x: Vec<f64> = bits.iter().map(|&b| f64::from_bits(b)).collect();
        let positions = x.chunks(3).map(|p| [p[0], p[1], p[2]]).collect();
        let s = surface(positions, [[0, 1, 2], [2, 1, 3]]);
        if let Ok(disc) = OrientedMesh::new(&s, &Diagnosis::new(&s)) {
            prop_assert!(disc.positions.iter().flatten().all(|t| t.is_finite()));
        }
    }
}
