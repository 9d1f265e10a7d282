//! Holes filled, faces removed.

use std::f64::consts::TAU;

use crate::common::*;
use crate::opening::*;
use riemap::distortion::{Distortion, Image};
use riemap::map::{Domain, MapOptions};
use riemap::solver::Silent;
use riemap::surface::Surface;
use riemap::surface::cut::{CutError, Opening};
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::Topology;
use riemap::surface::topology::diagnosis::Diagnosis;

#[test]
fn holes_are_filled_with_faces_of_the_mesh_s_kind() {
    let grid = generated("graph:cos+cos?n=9");
    let triangles = generated("graph:cos+cos?n=9&mesh=triangle");
    for (name, s, faces, added, filled) in [
        ("a quad in place of a quad", &grid, &[20][..], 1, 1),
        ("three quads around one", &grid, &[20, 21], 3, 1),
        ("two holes", &grid, &[20, 35], 2, 2),
        ("a triangle in place of a triangle", &triangles, &[40], 1, 1),
        ("four triangles in place of two", &triangles, &[40, 41], 4, 1),
    ] {
        let s = filtered(s, |f| !faces.contains(&f));
        let rim = Topology::new(&s).components[0].boundary_loops[0];
        let (disc, record) = opened(name, &s, &filling());
        assert_eq!((record.faces_added, record.holes_filled, disc.filled), (added, filled, added), "{name}");
        assert_eq!(disc.boundary.len(), rim, "{name}: the longest loop stays");
        assert_eq!(disc.source_faces(), s.faces().len(), "{name}");
        sound(name, &disc);
        assert!(!disc.is_cut());
    }
}

#[test]
fn closing_fills_every_hole() {
    let torus = generated("torus?n=12");
    let triangles = generated("torus?n=12&mesh=triangle");
    for (name, s, genus) in [
        ("torus", torus.clone(), 1),
        ("torus with holes", filtered(&torus, |f| ![3, 17, 18, 90].contains(&f)), 1),
        ("torus of triangles with holes", filtered(&triangles, |f| ![3, 17, 200, 90].contains(&f)), 1),
        ("cube without a lid", filtered(&cube(), |f| f != 0), 0),
        // the other side of the pillow is the same triangle, or quad, again
        ("triangle", surface(scattered(3), [[0, 1, 2]]), 0),
        ("quad", surface(scattered(4), [[0, 1, 2, 3]]), 0),
    ] {
        let (closed, record) =
            OrientedMesh::closed(&s, &Diagnosis::new(&s), true).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert!(closed.boundary.is_empty(), "{name}");
        assert_eq!(record.faces_added, closed.filled, "{name}");
        let diagnosis = sound(name, &closed);
        let part = &diagnosis.topology.components[0];
        assert!(part.manifold && part.boundary_loops.is_empty(), "{name}");
        assert_eq!(part.genus(), Some(genus), "{name}");
    }
    let holed = filtered(&torus, |f| f != 3);
    let error = OrientedMesh::closed(&holed, &Diagnosis::new(&holed), false).expect_err("a hole");
    assert_eq!(error, CutError::NotClosed { boundary_loops: vec![4] });
}

#[test]
fn holes_in_public_meshes_are_filled() {
    for (name, filled) in [("topology/annulus.obj", 1), ("bad/inverted_triangles.obj", 5)] {
        let Some(s) = file(name) else { return };
        let (disc, record) = opened(name, &s, &filling());
        assert_eq!((record.holes_filled, record.cut_edges), (filled, 0));
        sound(name, &disc);
    }
    let Some(s) = file("topology/punctured-torus.obj") else { return };
    let error = open(&s, &filling()).expect_err("a handle");
    assert_eq!(error, CutError::NoDiscLeft { boundary_loops: vec![16], genus: 1 });
    let (closed, _) = OrientedMesh::closed(&s, &Diagnosis::new(&s), true).expect("a torus");
    assert_eq!(sound("torus", &closed).topology.components[0].genus(), Some(1));
    let (disc, record) = opened("punctured", &s, &Opening { cut: true, fill_holes: true, ..Opening::default() });
    assert_eq!((record.holes_filled, record.genus, record.boundary_loops), (0, 1, 1));
    assert_eq!(disc.filled, 0);
}

#[test]
fn an_edge_that_points_at_the_middle_of_a_hole_does_not_make_a_flat_face() {
    // symmetric about the origin, with two edges on the x axis
    let half = [[1.0, -1.0], [1.0, 0.0], [0.5, 0.0], [0.5, 1.0]];
    let mut positions: Vec<[f64; 3]> = half.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    positions.extend(half.iter().map(|&[x, y]| [-x, -y, 0.0]));
    for k in 0..8 {
        let (sin, cos) = (TAU * (f64::from(k) - 1.0) / 8.0).sin_cos();
        positions.push([4.0 * cos, 4.0 * sin, 1.0]);
    }
    let ring = (0..8).flat_map(|k| {
        let next = (k + 1) % 8;
        [[k + 8, next + 8, k], [next + 8, next, k]]
    });
    let s = surface(positions, ring);
    let (disc, record) = opened("star", &s, &filling());
    assert_eq!(record.faces_added, 8);
    sound("star", &disc);
    let centre = disc.positions.last().expect("a new vertex");
    assert!(disc.source_vertex.last() == Some(&OrientedMesh::NEW) && centre[2].abs() > 0.05, "{centre:?}");
}

#[test]
fn odd_holes_of_quad_meshes_are_named_with_a_vertex() {
    // two triangles' worth of hole: corners merged so that two loops are odd
    let s = odd_annulus();
    let error = open(&s, &filling()).expect_err("an odd hole");
    let CutError::OddHole { vertex, edges: 3 } = error else { panic!("{error:?}") };
    assert!(vertex < 3);
    assert!(error.to_string().contains(&format!("{vertex}")), "{error}");
    let (_, record) = opened("odd annulus", &s, &cutting());
    assert_eq!(record.boundary_loops, 2);
}

/// A ring of three quads: two boundary loops of three edges, the outer one longer.
fn odd_annulus() -> Surface {
    let mut s = quad_grid(3, 1, Sides::Cylinder);
    for v in 0..6 {
        let (sin, cos) = (TAU * v as f64 / 3.0).sin_cos();
        let r = if v < 3 { 1.0 } else { 2.0 };
        s.positions_mut()[v] = [r * cos, r * sin, 0.0];
    }
    s
}

#[test]
fn removed_faces_open_a_closed_surface_and_leave_everything_else() {
    for s in [cube(), octahedron(), generated("torus?n=9")] {
        let torus = s.faces().len() == 81;
        let opening = Opening { cut: torus, ..removing(&[2]) };
        let (disc, record) = opened("without face 2", &s, &opening);
        assert_eq!((record.faces_removed, disc.faces.len()), (1, s.faces().len() - 1));
        assert!(!disc.source_face.contains(&2));
        assert_eq!(disc.is_cut(), torus);
    }
    // a hole next to the boundary, which then runs around it
    let (disc, _) = opened("grid", &quad_grid(4, 4, Sides::Free), &removing(&[1]));
    assert_eq!((disc.boundary.len(), disc.source_face[1]), (18, 2));
}

#[test]
fn faces_whose_removal_leaves_no_disc_are_refused() {
    let grid = quad_grid(4, 4, Sides::Free);
    for (s, faces, expected) in [
        (&cube(), &[6][..], CutError::NoSuchFace { face: 6, faces: 6 }),
        (&cube(), &[0, 1, 2, 3, 4, 5], CutError::NothingLeft),
        (&cube(), &[0, 1], CutError::NoDiscLeft { boundary_loops: vec![4, 4], genus: 0 }),
        (&generated("torus?n=5"), &[7], CutError::NoDiscLeft { boundary_loops: vec![4], genus: 1 }),
        (&grid, &[1, 5, 9, 13], CutError::Pieces { pieces: 2 }),
        (&grid, &[1, 4], CutError::Pieces { pieces: 2 }),
        (&grid, &[5, 10], CutError::Pinched { vertex: 12, fans: 2 }),
    ] {
        let error = open(s, &removing(faces)).expect_err("no disc");
        assert_eq!(error, expected);
    }
    // the same surfaces, cut
    opened("two lids", &cube(), &Opening { cut: true, ..removing(&[0, 1]) });
    let (_, record) = opened("pinched", &grid, &Opening { cut: true, ..removing(&[5, 10]) });
    assert_eq!(record.vertices_split, 1);
}

#[test]
fn maps_of_cut_and_filled_surfaces_are_measured_where_the_source_is() {
    let torus = generated("torus?n=16");
    let holes = filtered(&generated("graph:cos+cos?n=13&mesh=triangle"), |f| ![100, 101, 140].contains(&f));
    for (name, s, opening) in [("torus", torus, cutting()), ("holes", holes, filling())] {
        let (disc, _) = opened(name, &s, &opening);
        let options = MapOptions::default();
        let domain = Domain::of_positions(disc, &options).unwrap_or_else(|error| panic!("{name}: {error}"));
        let map = options.map(&domain, None, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"));
        let (disc, graph, image) = (&domain.disc, &domain.graph, Image::of_disc(&map.z));
        let distortion = Distortion::new(disc, graph, None, &image);
        assert_eq!(distortion.flipped, 0, "{name}");
        let faces = riemap::distortion::face_maps(disc, graph, &image);
        assert_eq!(faces.len(), s.faces().len(), "{name}");
        // ½ |d02 × d13| of each quad, or of each triangle
        let area: f64 = s
            .faces()
            .iter()
            .map(|f| {
                let x: Vec<[f64; 3]> = f.iter().map(|&v| s.positions()[v as usize]).collect();
                let n = x.len();
                let c = if n == 3 {
                    cross(sub(x[1], x[0]), sub(x[2], x[0]))
                } else {
                    cross(sub(x[2], x[0]), sub(x[3], x[1]))
                };
                0.5 * dot(c, c).sqrt()
            })
            .sum();
        let total: f64 = faces.iter().map(|f| f.area).sum();
        // sums in different orders
        assert!((total / area - 1.0).abs() < 1e-12, "{name}: {total} {area}");
    }
}
