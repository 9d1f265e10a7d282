//! Surfaces cut to discs.

use std::f64::consts::TAU;

use crate::common::*;
use crate::opening::*;
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use riemap::map::{Domain, MapError, MapOptions, Pin};
use riemap::solver::Silent;
use riemap::surface::Surface;
use riemap::surface::cut::{CutError, Opening};
use riemap::surface::digital::{Adjacency, Solid, boundary};
use riemap::surface::edges::Edges;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::Topology;
use riemap::surface::topology::diagnosis::{Diagnosis, Finding};
use riemap::surface::topology::tree_cotree::{EdgeGraph, TreeCotree};

fn lengths(s: &Surface, edges: &Edges) -> Vec<f64> {
    edges.ends.iter().map(|&[a, b]| distance(s.positions()[a as usize], s.positions()[b as usize])).collect()
}

#[test]
fn a_surface_of_genus_g_has_2g_loops_and_dual_loops_that_cross_them_in_pairs() {
    let holed = |s: &Surface| filtered(s, |f| f != 3 && f != 17);
    for (genus, s) in [
        (0, cube()),
        (0, holed(&generated("sphere?n=8"))),
        (1, generated("torus?n=12")),
        (1, generated("torus?n=7&mesh=triangle&diagonal=random&seed=3")),
        (1, holed(&sum_of_tori(1))),
        (2, sum_of_tori(2)),
        (3, triangulated(&holed(&sum_of_tori(3)))),
    ] {
        let edges = Edges::new(s.faces(), s.positions().len());
        let graph = EdgeGraph::new(s.faces(), &edges, s.positions().len(), lengths(&s, &edges));
        for root in [0, graph.node[s.faces().get(s.faces().len() / 2)[0] as usize]] {
            let system = TreeCotree::new(&graph, root);
            assert_eq!(system.left_over.len(), 2 * genus);
            for k in 0..2 * genus {
                let mut omega = vec![0i32; s.faces().corners().len()];
                for c in system.dual_loop(&graph, k) {
                    omega[c as usize] += 1;
                    omega[edges.opposite(c as usize).expect("an inner edge")] -= 1;
                }
                assert!(omega.iter().all(|w| w.abs() <= 1), "no edge is crossed twice");
                for f in 0..s.faces().len() {
                    assert_eq!(s.faces().corner_range(f).map(|c| omega[c]).sum::<i32>(), 0, "closed around face {f}");
                }
                for j in 0..2 * genus {
                    assert_eq!(along(&s, &graph, &omega, root, &system.loop_edges(&graph, j)).abs(), i32::from(j == k));
                }
            }
        }
    }
}

/// The sum of ω along a closed walk of edges from the node `root`.
fn along(s: &Surface, graph: &EdgeGraph, omega: &[i32], root: u32, walk: &[u32]) -> i32 {
    let (mut at, mut sum) = (root, 0);
    for &e in walk {
        let c = graph.edges.corners(e as usize)[0] as usize;
        let forward = graph.node[s.faces().corners()[c] as usize] == at;
        sum += if forward { omega[c] } else { -omega[c] };
        at = graph.across(e, at);
    }
    assert_eq!(at, root, "the walk is closed");
    sum
}

#[test]
fn every_connected_surface_is_cut_to_a_disc() {
    let two_holes = |s: &Surface| filtered(s, |f| f != 3 && f != 17);
    for (name, s, genus, loops) in [
        ("cube", cube(), 0, 0),
        ("octahedron", octahedron(), 0, 0),
        ("tetrahedron", surface(scattered(4), [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]), 0, 0),
        ("torus of 3 × 3", quad_grid(3, 3, Sides::Torus), 1, 0),
        ("torus", generated("torus?n=20"), 1, 0),
        ("torus of triangles", generated("torus?n=13&mesh=triangle&diagonal=random&seed=4"), 1, 0),
        ("torus with holes", two_holes(&quad_grid(8, 5, Sides::Torus)), 1, 2),
        ("two tori", sum_of_tori(2), 2, 0),
        ("four tori with holes", triangulated(&two_holes(&sum_of_tori(4))), 4, 2),
        ("cylinder", quad_grid(6, 3, Sides::Cylinder), 0, 2),
        ("cylinder of one ring", quad_grid(6, 1, Sides::Cylinder), 0, 2),
        ("three holes", filtered(&quad_grid(9, 9, Sides::Free), |f| ![20, 24, 60].contains(&f)), 0, 4),
    ] {
        let (disc, record) = opened(name, &s, &cutting());
        assert_eq!((record.genus, record.boundary_loops), (genus, loops), "{name}");
        assert!(record.cut_edges > 0 && disc.boundary.len() >= 4, "{name}");
        assert_eq!(disc.faces.len(), s.faces().len(), "{name}");
        let rim: usize = Topology::new(&s).components[0].boundary_loops.iter().sum();
        assert_eq!(disc.boundary.len(), rim + 2 * record.cut_edges, "{name}");
    }
}

#[test]
fn public_meshes_of_one_component_are_cut_to_discs() {
    for (name, genus, loops) in [
        ("topology/torus.obj", 1, 0),
        ("topology/punctured-torus.obj", 1, 1),
        ("topology/annulus.obj", 0, 2),
        ("topology/spot.ply", 0, 0),
        ("topology/stl_box_ascii.stl", 0, 0),
        ("quad/horse_quad.obj", 0, 0),
        ("quad/fandisk_quads.off", 0, 0),
        ("bad/sliver_tet.ply", 0, 0),
        ("bad/inverted_triangles.obj", 0, 6),
        // touches itself in two vertices
        ("bad/beetle.off", 0, 11),
    ] {
        let Some(s) = file(name) else { return };
        let (_, record) = opened(name, &s, &cutting());
        assert_eq!((record.genus, record.boundary_loops), (genus, loops), "{name}");
        println!("{name}: {record}");
    }
}

#[test]
fn a_disc_is_left_as_it_is() {
    for s in [quad_grid(4, 3, Sides::Free), generated("sphere?n=6&mesh=triangle")] {
        let (disc, record) = opened("disc", &s, &Opening { cut: true, fill_holes: true, remove_faces: vec![] });
        assert!(record.is_empty() && !disc.is_cut());
        assert_eq!(disc.source_vertex, crate::common::disc(&s).source_vertex);
        assert_eq!(disc.boundary, crate::common::disc(&s).boundary);
    }
}

#[test]
fn a_torus_is_cut_along_its_shortest_meridian_and_its_inner_equator() {
    for name in ["torus?R=2&r=0.8&n=64", "torus?R=2&r=0.8&n=64&mesh=triangle"] {
        let s = generated(name);
        let (_, record) = opened(name, &s, &cutting());
        let shortest = 64.0 * 2.0 * (TAU / 128.0).sin() * (2.0 - 0.8 + 0.8);
        assert!((record.cut_length / shortest - 1.0).abs() < 1e-12, "{name}: {} {shortest}", record.cut_length);
        assert_eq!(record.cut_edges, 128);
    }
}

#[test]
fn an_annulus_is_cut_along_a_shortest_path() {
    // columns of a cylinder, one shorter than the others
    let mut s = quad_grid(12, 5, Sides::Cylinder);
    for (v, x) in s.positions_mut().iter_mut().enumerate() {
        let (i, j) = (v % 12, v / 12);
        let (sin, cos) = (TAU * i as f64 / 12.0).sin_cos();
        *x = [3.0 * cos, 3.0 * sin, j as f64 * if i == 7 { 0.9 } else { 1.0 }];
    }
    let (disc, record) = opened("cylinder", &s, &cutting());
    assert_eq!(record.cut_edges, 5);
    assert!((record.cut_length - 4.5).abs() < 1e-12);
    assert!((0..6).all(|j| disc.copies(12 * j + 7).len() == 2));
}

#[test]
fn a_closed_sphere_is_cut_between_two_far_points() {
    let mut s = octahedron();
    s.positions_mut()[4][2] = 9.0;
    s.positions_mut()[5][2] = -9.0;
    let (disc, record) = opened("needle", &s, &cutting());
    assert_eq!(record.cut_edges, 2);
    assert_eq!((disc.copies(4).len(), disc.copies(5).len(), disc.boundary.len()), (1, 1, 4));
}

#[test]
fn faces_that_touch_at_a_vertex_are_parted_when_cut() {
    // two holes in one vertex, and a strip whose ends touch in one
    let grid = filtered(&quad_grid(4, 4, Sides::Free), |f| f != 5 && f != 10);
    assert!(matches!(open(&grid, &filling()), Err(CutError::NotADisc(_))));
    let (disc, record) = opened("touching holes", &grid, &cutting());
    assert_eq!((record.vertices_split, record.boundary_loops), (1, 3 - 1));
    assert!(disc.is_cut());
    let ends = filtered(&quad_grid(3, 3, Sides::Free), |f| f != 0 && f != 4);
    let (disc, record) = opened("touching ends", &ends, &cutting());
    assert_eq!((record.vertices_split, record.cut_edges), (1, 0));
    assert_eq!(disc.copies(5).len(), 2);
}

#[test]
fn what_no_cut_mends_is_refused_with_the_diagnosis_own_words() {
    for s in [
        union(&cube(), &octahedron()),
        union(&cube(), &cube()),
        quad_grid(9, 4, Sides::Moebius),
        surface(scattered(5), [[0, 1, 2], [0, 1, 3], [0, 1, 4]]),
    ] {
        let all = Opening { cut: true, fill_holes: true, remove_faces: vec![] };
        let Err(CutError::NotADisc(error)) = open(&s, &all) else { panic!("not refused") };
        assert!(!error.findings.is_empty());
        assert!(error.findings.iter().all(|f| !matches!(f, Finding::Closed { .. } | Finding::NotADisc { .. })));
    }
    let closed = open(&cube(), &Opening::default()).expect_err("closed").to_string();
    assert!(closed.contains("closed"), "{closed}");
}

#[test]
fn digital_surfaces_of_any_genus_are_cut_to_discs() {
    let mut ring = Solid::empty([3, 3, 1], [0.0; 3]);
    for (i, j) in [(0, 0), (1, 0), (2, 0), (0, 1), (2, 1), (0, 2), (1, 2), (2, 2)] {
        ring.insert([i, j, 0]);
    }
    let (s, _) = boundary(ring, Adjacency::Six, 0).expect("a ring of voxels");
    let (_, record) = opened("ring of voxels", &s, &cutting());
    // around the hole, and around one voxel's section
    assert_eq!((record.genus, record.cut_edges), (1, 4 + 4));
    let Some(folder) = data_folder() else { return };
    for (name, genus) in [("Al.100.vol", 2), ("cat10.vol", 0)] {
        let solid = riemap::io::read_volume(&folder.join("digital").join(name), &Default::default());
        let (s, _) = boundary(solid.expect(name), Adjacency::Six, 0).expect(name);
        let (_, record) = opened(name, &s, &cutting());
        assert_eq!((record.genus, record.boundary_loops), (genus, 0), "{name}");
        println!("{name}: {record}");
    }
}

#[test]
fn a_vertex_on_the_cut_cannot_be_pinned() {
    let s = generated("torus?n=8");
    let (disc, _) = opened("torus", &s, &cutting());
    let domain = Domain::of_positions(disc, &MapOptions::default()).expect("quads");
    let disc = &domain.disc;
    let on_cut = disc.source_vertex[disc.boundary[0] as usize];
    let off = (0..64).find(|&v| disc.copies(v).len() == 1).expect("most vertices");
    let pinned = |vertex| MapOptions { pins: vec![Pin { vertex, place: [0.1, 0.0] }], ..MapOptions::default() };
    let error = pinned(on_cut).map(&domain, None, &mut Silent).expect_err("several images");
    assert_eq!(error, MapError::OnTheCut { vertex: on_cut, copies: disc.copies(on_cut).len() });
    let map = pinned(off).map(&domain, None, &mut Silent).expect("one image");
    assert_eq!(map.z[disc.copies(off).start as usize].re, 0.1);
}

proptest! {
    #![proptest_config(ProptestConfig {
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn sums_of_tori_with_random_holes_shapes_and_numbers_are_cut_to_discs(
        tori in 0usize..4, holes in 0usize..6, split in any::<bool>(), seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let sphere = connected_sum(&cube(), 0, &cube(), 0);
        let torus = quad_grid(3 + random.below(5) as u32, 3 + random.below(4) as u32, Sides::Torus);
        let mut s = sphere;
        for _ in 0..tori {
            s = connected_sum(&s, random.below(s.faces().len()), &torus, random.below(torus.faces().len()));
        }
        s = if split { triangulated(&s) } else { s };
        // any places at all: only the lengths change
        for x in s.positions_mut() {
            *x = random.vector();
        }
        let turned: Vec<usize> = (0..s.faces().len()).filter(|_| random.below(3) == 0).collect();
        let order = random.permutation(s.faces().len());
        let name = random.permutation(s.positions().len());
        let s = shuffled(&flipped(&s, turned), &order, &name);
        let remove_faces: Vec<u32> = (0..holes).map(|_| random.below(s.faces().len()) as u32).collect();
        let opening = Opening { cut: true, remove_faces, fill_holes: random.below(4) == 0 };
        // Random gluing may make edges of more faces; random holes may leave pieces, or be of no fillable shape.
        let diagnosis = Diagnosis::new(&s);
        let refused = match OrientedMesh::open(&s, &diagnosis, &opening) {
            Err(CutError::NotADisc(_)) => diagnosis.fatal().any(|f| !matches!(f, Finding::Closed { .. })),
            Err(CutError::Pieces { .. }) => holes > 1,
            Err(CutError::FlatHole { .. } | CutError::OddHole { .. }) => opening.fill_holes,
            _ => false,
        };
        if !refused {
            let (disc, record) = opened("sum of tori", &s, &opening);
            prop_assert!(record.genus <= tori as u64 && disc.boundary.len() >= 3);
            prop_assert!(s.faces().arity() != Some(4) || disc.boundary.len() % 2 == 0);
        }
    }

    #[test]
    fn boundaries_of_random_voxels_are_cut_to_discs(
        size in prop::array::uniform3(1usize..6), density in 1u64..8, joined in any::<bool>(), holes in 0usize..3,
        seed in any::<u64>(),
    ) {
        let mut random = Random(seed);
        let mut solid = Solid::empty(size, [0.0; 3]);
        for k in 0..size[2] {
            for j in 0..size[1] {
                for i in 0..size[0] {
                    if random.bits() % 8 < density {
                        solid.insert([i as i32, j as i32, k as i32]);
                    }
                }
            }
        }
        prop_assume!(!solid.is_empty());
        let adjacency = if joined { Adjacency::Eighteen } else { Adjacency::Six };
        let (s, _) = boundary(solid, adjacency, 0).expect("not empty");
        let diagnosis = Diagnosis::new(&s);
        let genus = diagnosis.topology.components[0].genus();
        let remove_faces: Vec<u32> = (0..holes).map(|_| random.below(s.faces().len()) as u32).collect();
        let opening = Opening { cut: true, fill_holes: random.below(3) == 0, remove_faces };
        match OrientedMesh::open(&s, &diagnosis, &opening) {
            Err(CutError::Pieces { .. }) => prop_assert!(holes > 1),
            _ => {
                let (disc, record) = opened("voxels", &s, &opening);
                // nothing is cut where a removed face opens a sphere
                prop_assert!(record.cut_edges == 0 || Some(record.genus) <= genus);
                prop_assert!(disc.boundary.len() >= 4 && disc.boundary.len().is_multiple_of(2));
            }
        }
    }
}
