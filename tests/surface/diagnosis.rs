//! What is said about defective and about sound surfaces: kind, first offender, count, severity.

use crate::common::*;
use riemap::surface::Surface;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::diagnosis::{Diagnosis, Finding, Severity};

fn findings(s: &Surface) -> Vec<Finding> {
    Diagnosis::new(s).findings
}

/// A flat strip of `n` unit squares.
fn strip(n: u32) -> Surface {
    let positions = [0.0, 1.0].into_iter().flat_map(|y| (0..=n).map(move |x| [f64::from(x), y, 0.0])).collect();
    surface(positions, (0..n).map(|i| [i, i + 1, n + 2 + i, n + 1 + i]))
}

#[test]
fn sound_discs_have_no_findings() {
    for s in [strip(3), triangulated(&strip(3)), quad_grid(4, 3, Sides::Free), filtered(&cube(), |f| f != 2)] {
        assert_eq!(findings(&s), []);
        assert!(Diagnosis::new(&s).topology.components[0].is_disc());
    }
}

#[test]
fn a_mesh_without_faces_is_told_so() {
    assert_eq!(findings(&Surface::default()), [Finding::NoFaces]);
    let only_points = surface(scattered(5), [[0u32; 3]; 0]);
    assert_eq!(findings(&only_points), [Finding::NoFaces, Finding::Unreferenced { vertex: 0, count: 5 }]);
}

#[test]
fn coordinates_that_are_no_numbers_are_counted_and_silence_the_other_geometry() {
    let mut s = triangulated(&strip(3));
    s.positions_mut()[5] = [f64::NAN, 0.0, 0.0];
    s.positions_mut()[2][2] = f64::INFINITY;
    s.positions_mut()[7][1] = f64::NEG_INFINITY;
    assert_eq!(findings(&s), [Finding::NotFinite { vertex: 2, count: 3 }]);
}

#[test]
fn mixed_and_large_polygons_are_refused() {
    let mixed = surface(scattered(7), [vec![0, 1, 2], vec![2, 1, 3], vec![1, 4, 5, 3], vec![4, 6, 5]]);
    assert_eq!(findings(&mixed), [Finding::Polygons { arities: vec![(3, 3), (4, 1)], first: 2 }]);
    let quads_first = surface(scattered(7), [vec![1, 4, 5, 3], vec![4, 6, 5], vec![0, 1, 2], vec![2, 1, 3]]);
    assert_eq!(findings(&quads_first), [Finding::Polygons { arities: vec![(3, 3), (4, 1)], first: 1 }]);
    let pentagon = surface(scattered(5), [[0, 1, 2, 3, 4]]);
    assert_eq!(findings(&pentagon), [Finding::Polygons { arities: vec![(5, 1)], first: 0 }]);
}

#[test]
fn a_face_with_a_repeated_vertex_is_named_and_its_consequences_are_not() {
    // face 1 runs 0, 0, 2: its other two edges both lie on the edge 0–2 of face 0
    let s = surface(vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]], [[0, 1, 2], [0, 0, 2]]);
    assert_eq!(
        findings(&s),
        [Finding::RepeatedVertex { face: 1, vertex: 0, count: 1 }, Finding::ZeroAreaFaces { face: 1, count: 1 }]
    );
    let three = surface(scattered(4), [[0, 1, 2], [3, 3, 3], [0, 2, 3], [1, 2, 1]]);
    assert!(findings(&three).contains(&Finding::RepeatedVertex { face: 1, vertex: 3, count: 2 }));
    let quad = surface(scattered(4), [[0, 1, 2, 1]]);
    assert_eq!(findings(&quad)[0], Finding::RepeatedVertex { face: 0, vertex: 1, count: 1 });
}

#[test]
fn duplicate_faces_are_found_whatever_their_orientation_and_first_corner() {
    let s = surface(scattered(6), [[0, 1, 2], [2, 1, 3], [3, 1, 2], [4, 3, 5], [1, 2, 3]]);
    let duplicates: Vec<_> = findings(&s).into_iter().filter(|f| matches!(f, Finding::DuplicateFaces { .. })).collect();
    assert_eq!(duplicates, [Finding::DuplicateFaces { first: [1, 2], count: 2 }]);
    // a pillow: two faces back to back are a sphere, and duplicates all the same
    let pillow = surface(scattered(3), [[0, 1, 2], [0, 2, 1]]);
    assert_eq!(findings(&pillow), [Finding::DuplicateFaces { first: [0, 1], count: 1 }, Finding::Closed { genus: 0 }]);
}

#[test]
fn zero_length_edges_spoil_triangles_but_not_quads() {
    let mut s = triangulated(&strip(2));
    s.positions_mut()[1] = s.positions()[2];
    // the edge 1–2 belongs to face 2 = (1, 2, 5)
    assert_eq!(s.faces().get(2), [1, 2, 5]);
    assert_eq!(
        findings(&s),
        [
            Finding::ZeroLengthEdges { edge: [1, 2], count: 1, fatal: true },
            Finding::ZeroAreaFaces { face: 2, count: 1 },
            Finding::CoincidentVertices { first: [1, 2], count: 1 },
        ]
    );
    let mut quads = strip(2);
    quads.positions_mut()[1] = quads.positions()[2];
    let found = findings(&quads);
    assert_eq!(
        found,
        [
            Finding::ZeroLengthEdges { edge: [1, 2], count: 1, fatal: false },
            Finding::CoincidentVertices { first: [1, 2], count: 1 },
        ]
    );
    assert!(found.iter().all(|f| f.severity() == Severity::Note));
    disc(&quads);
}

#[test]
fn faces_without_area_are_named_and_thin_ones_are_not() {
    let collinear = surface(vec![[0., 1., 2.], [1., 2., 4.], [3., 4., 8.]], [[0, 1, 2]]);
    assert_eq!(findings(&collinear), [Finding::ZeroAreaFaces { face: 0, count: 1 }]);
    // not collinear in doubles, by one rounding of 0.1 + 0.2
    let nearly = surface(vec![[0., 0., 0.], [0.1, 0.1, 0.1], [0.3, 0.1 + 0.2, 0.3]], [[0, 1, 2]]);
    assert_eq!(findings(&nearly), [Finding::ZeroAreaFaces { face: 0, count: 1 }]);
    // a quad folded onto its diagonal: corners apart, diagonals parallel
    let folded = surface(vec![[0., 0., 0.], [1., 0., 0.], [3., 0., 0.], [2., 0., 0.]], [[0, 1, 2, 3]]);
    assert_eq!(findings(&folded), [Finding::ZeroAreaFaces { face: 0, count: 1 }]);
    for height in [1e-3, 1e-9, 1e-13] {
        let thin = surface(vec![[0., 0., 0.], [1., 0., 0.], [0.5, height, 0.]], [[0, 1, 2]]);
        assert_eq!(findings(&thin), [], "{height}");
    }
    // size is no defect until squares of areas leave the range of doubles, and then it is said to be size
    let scaled = |scale: f64| surface(vec![[0., 0., 0.], [scale, 0., 0.], [0., scale, 0.]], [[0, 1, 2]]);
    for scale in [1e-60, 1e60] {
        assert_eq!(findings(&scaled(scale)), [], "{scale}");
    }
    for scale in [1e-300, 1e-80, 1e80, 1e300] {
        assert_eq!(findings(&scaled(scale)), [Finding::OutOfRange { extent: scale }], "{scale}");
    }
}

#[test]
fn an_edge_of_three_faces_is_no_disc_though_the_euler_number_is_one() {
    let fan = surface(scattered(5), [[2, 4, 0], [2, 4, 1], [2, 4, 3]]);
    let diagnosis = Diagnosis::new(&fan);
    assert_eq!(diagnosis.findings, [Finding::NonManifoldEdges { edge: [2, 4], faces: vec![0, 1, 2], count: 1 }]);
    let [part] = diagnosis.topology.components.as_slice() else { panic!("one component") };
    assert_eq!((part.euler(), part.manifold, part.genus(), part.is_disc()), (1, false, None, false));
    assert!(OrientedMesh::new(&fan, &diagnosis).is_err());
}

#[test]
fn a_vertex_of_two_fans_is_named() {
    // two holes of a square that touch at a corner
    let pinched = filtered(&quad_grid(4, 4, Sides::Free), |f| f != 5 && f != 10);
    let diagnosis = Diagnosis::new(&pinched);
    // with the vertex split the two holes are one
    assert_eq!(
        diagnosis.findings,
        [
            Finding::NonManifoldVertices { vertex: 12, fans: 2, count: 1 },
            Finding::NotADisc { boundary_loops: vec![16, 8], genus: 0 }
        ]
    );
    assert_eq!(diagnosis.topology.components[0].boundary_loops, [16, 8]);

    let bow_tie = surface(scattered(5), [[0, 1, 2], [2, 3, 4]]);
    assert_eq!(
        findings(&bow_tie),
        [
            Finding::NonManifoldVertices { vertex: 2, fans: 2, count: 1 },
            Finding::Components { count: 2, faces: vec![1, 1] }
        ]
    );
}

#[test]
fn two_spheres_in_one_vertex_are_two_components_and_one_pinched_vertex() {
    let two = union(&octahedron(), &octahedron());
    let s = surface(
        two.positions().to_vec(),
        two.faces().iter().map(|f| [f[0], f[1], f[2]].map(|v| if v == 7 { 0 } else { v })),
    );
    let diagnosis = Diagnosis::new(&s);
    assert_eq!(
        diagnosis.findings,
        [
            Finding::NonManifoldVertices { vertex: 0, fans: 2, count: 1 },
            Finding::Components { count: 2, faces: vec![8, 8] },
            Finding::Unreferenced { vertex: 7, count: 1 },
        ]
    );
    assert!(diagnosis.topology.components.iter().all(|c| c.euler() == 2 && !c.manifold && c.boundary_loops.is_empty()));
}

#[test]
fn a_moebius_band_is_not_orientable_and_nothing_is_flipped() {
    for s in [quad_grid(5, 2, Sides::Moebius), triangulated(&quad_grid(5, 2, Sides::Moebius))] {
        let diagnosis = Diagnosis::new(&s);
        let [Finding::NonOrientable { component: 0, edge }] = diagnosis.findings[..] else {
            panic!("{:?}", diagnosis.findings)
        };
        assert!(diagnosis.topology.edges.ends.contains(&edge));
        assert!(!diagnosis.topology.orientation.flip.contains(&true));
        let part = &diagnosis.topology.components[0];
        // one boundary loop and χ = 0: one crosscap
        assert_eq!((part.euler(), part.boundary_loops.as_slice(), part.genus()), (0, &[10usize][..], Some(1)));
    }
}

#[test]
fn the_smaller_patch_is_turned_over() {
    let s = quad_grid(6, 4, Sides::Free);
    for turned in [vec![3], vec![4, 7, 8, 23], (2..24).collect(), (0..24).collect(), (0..24).step_by(2).collect()] {
        let turned: Vec<usize> = turned;
        let repaired: Vec<usize> =
            if turned.len() <= 12 { turned.clone() } else { (0..24).filter(|f| !turned.contains(f)).collect() };
        let diagnosis = Diagnosis::new(&flipped(&s, turned.iter().copied()));
        // with exactly half turned, face 0 decides: it stays as it is
        let repaired: Vec<usize> =
            if turned.len() == 12 { (0..24).filter(|f| !turned.contains(f)).collect() } else { repaired };
        let found: Vec<Finding> = repaired
            .first()
            .map(|&face| Finding::Reoriented { face: face as u32, count: repaired.len() })
            .into_iter()
            .collect();
        assert_eq!(diagnosis.findings, found, "{turned:?}");
        assert!(found.iter().all(|f| f.severity() == Severity::Repaired));
        let got = OrientedMesh::new(&flipped(&s, turned.iter().copied()), &diagnosis).expect("a disc");
        let upside_down = turned.len() >= 12;
        let expected = if upside_down { flipped(&s, 0..24) } else { s.clone() };
        assert_eq!(&got.faces, expected.faces());
        let mut boundary = disc(&s).boundary;
        if upside_down {
            boundary[1..].reverse();
        }
        assert_eq!(got.boundary, boundary);
    }
}

#[test]
fn normals_turn_over_with_their_faces() {
    let normals = vec![[0., 0., 1.], [0., 0., -1.], [0., 0., 1.]];
    let s = flipped(&strip(3), [1]).with_face_normals(normals).expect("one for each face");
    assert_eq!(disc(&s).face_normals, Some(vec![[0., 0., 1.]; 3]));
}

#[test]
fn closed_and_holed_surfaces_are_told_from_discs_by_loops_and_genus() {
    let torus = quad_grid(5, 4, Sides::Torus);
    let double = connected_sum(&torus, 0, &torus, 7);
    let cases: [(&str, Surface, &[Finding]); 7] = [
        ("cube", cube(), &[Finding::Closed { genus: 0 }]),
        ("octahedron", octahedron(), &[Finding::Closed { genus: 0 }]),
        ("torus", torus.clone(), &[Finding::Closed { genus: 1 }]),
        ("double torus", double, &[Finding::Closed { genus: 2 }, Finding::Unreferenced { vertex: 21, count: 4 }]),
        ("annulus", quad_grid(5, 2, Sides::Cylinder), &[Finding::NotADisc { boundary_loops: vec![5, 5], genus: 0 }]),
        (
            "holed square",
            filtered(&quad_grid(4, 4, Sides::Free), |f| f != 5),
            &[Finding::NotADisc { boundary_loops: vec![16, 4], genus: 0 }],
        ),
        // one component, one loop: not a disc
        ("punctured torus", filtered(&torus, |f| f != 9), &[Finding::NotADisc { boundary_loops: vec![4], genus: 1 }]),
    ];
    for (name, s, expected) in cases {
        let mut found = findings(&s);
        if let Some(Finding::Unreferenced { vertex, .. }) = found.last_mut() {
            *vertex = 21; // whichever rim vertex comes first
        }
        assert_eq!(found, expected, "{name}");
        assert!(OrientedMesh::new(&s, &Diagnosis::new(&s)).is_err(), "{name}");
    }
}

#[test]
fn components_are_told_apart_even_where_their_totals_look_like_one_surface() {
    let torus = quad_grid(5, 4, Sides::Torus);
    // a sphere and a double torus: closed, χ = 2 − 2, the numbers of one torus
    let like_a_torus = union(&cube(), &connected_sum(&torus, 0, &torus, 0));
    let diagnosis = Diagnosis::new(&like_a_torus);
    let parts = &diagnosis.topology.components;
    assert_eq!(parts.iter().map(|c| c.euler()).sum::<i64>(), 0);
    assert_eq!(diagnosis.findings[0], Finding::Components { count: 2, faces: vec![38, 6] });
    assert_eq!(parts.iter().map(|c| (c.genus(), c.first_face)).collect::<Vec<_>>(), [(Some(0), 0), (Some(2), 6)]);
    // two discs and a torus with two holes: χ = 1 + 1 − 2 as an annulus, but four loops
    let holed = filtered(&torus, |f| f != 0 && f != 12);
    let parts = Diagnosis::new(&union(&union(&strip(2), &holed), &strip(3))).topology.components;
    let numbers: Vec<_> = parts.iter().map(|c| (c.euler(), c.genus(), c.boundary_loops.as_slice())).collect();
    assert_eq!(numbers, [(1, Some(0), &[6][..]), (-2, Some(1), &[4, 4]), (1, Some(0), &[8])]);
}

#[test]
fn unreferenced_and_coincident_vertices_are_noted_and_harmless() {
    let plain = strip(3);
    let mut positions = plain.positions().to_vec();
    positions.insert(2, [7.0; 3]);
    positions.push([f64::from(1), 0.0, 0.0]);
    let s = surface(positions, plain.faces().renumbered(&[0, 1, 3, 4, 5, 6, 7, 8]).iter());
    let diagnosis = Diagnosis::new(&s);
    // vertex 9 lies where vertex 1 does, but nobody uses it
    assert_eq!(diagnosis.findings, [Finding::Unreferenced { vertex: 2, count: 2 }]);
    let disc = OrientedMesh::new(&s, &diagnosis).expect("a disc");
    assert_eq!(disc.source_vertex, [0, 1, 3, 4, 5, 6, 7, 8]);
    assert_eq!(disc.positions, strip(3).positions());
    assert_eq!(&disc.faces, strip(3).faces());

    // a ring slit open: two vertices twice
    let mut slit = strip(4);
    let places = slit.positions_mut();
    (places[4], places[9]) = (places[0], places[5]);
    // -0 and 0 are the same place
    places[9][2] = -0.0;
    assert_eq!(findings(&slit), [Finding::CoincidentVertices { first: [0, 4], count: 2 }]);
}

#[test]
fn every_finding_says_what_and_where() {
    use Finding::*;
    use Severity::*;
    let cases = [
        (NoFaces, Fatal, "no face"),
        (NotFinite { vertex: 17, count: 2 }, Fatal, "vertex 17"),
        (Polygons { arities: vec![(3, 8), (5, 1)], first: 17 }, Fatal, "1 with 5 corners"),
        (RepeatedVertex { face: 17, vertex: 4, count: 1 }, Fatal, "face 17 has vertex 4"),
        (DuplicateFaces { first: [3, 17], count: 12 }, Fatal, "faces 3 and 17"),
        (ZeroLengthEdges { edge: [3, 17], count: 1, fatal: true }, Fatal, "vertices 3 and 17"),
        (ZeroLengthEdges { edge: [3, 17], count: 1, fatal: false }, Note, "vertices 3 and 17"),
        (ZeroAreaFaces { face: 17, count: 1 }, Fatal, "face 17"),
        (NonManifoldEdges { edge: [3, 17], faces: (0..8).collect(), count: 2 }, Fatal, "3–17 has 8 faces"),
        (NonManifoldVertices { vertex: 17, fans: 3, count: 1 }, Fatal, "vertex 17 has 3 fans"),
        (NonOrientable { component: 0, edge: [3, 17] }, Fatal, "not orientable"),
        (Reoriented { face: 17, count: 5 }, Repaired, "face 17"),
        (Components { count: 3, faces: vec![9, 8, 7] }, Fatal, "9, 8, 7"),
        (Closed { genus: 0 }, Fatal, "genus 0"),
        (Closed { genus: 1 }, Fatal, "genus 1"),
        (Closed { genus: 2 }, Fatal, "genus 2"),
        (NotADisc { boundary_loops: vec![9, 8], genus: 0 }, Fatal, "2 boundary loops, of 9, 8"),
        (NotADisc { boundary_loops: vec![9], genus: 1 }, Fatal, "1 boundary loop, of 9"),
        (NotADisc { boundary_loops: vec![9], genus: 2 }, Fatal, "genus 2"),
        (Unreferenced { vertex: 17, count: 1 }, Note, "vertex 17"),
        (CoincidentVertices { first: [3, 17], count: 1 }, Note, "vertices 3 and 17"),
    ];
    for (finding, severity, message) in cases {
        assert_eq!(finding.severity(), severity, "{finding:?}");
        assert!(finding.to_string().contains(message), "{finding}");
    }
}

#[test]
fn the_error_of_a_surface_that_is_no_disc_lists_every_fatal_finding() {
    // bow-tie of a triangle and one without area, an unused vertex
    let mut s = surface(scattered(6), [[0, 1, 2], [2, 3, 4]]);
    s.positions_mut()[4] = s.positions()[3];
    let diagnosis = Diagnosis::new(&s);
    let error = OrientedMesh::new(&s, &diagnosis).expect_err("no disc");
    assert_eq!(error.findings, diagnosis.fatal().cloned().collect::<Vec<_>>());
    let text = error.to_string();
    assert_eq!(text.lines().count(), error.findings.len());
    for finding in &error.findings {
        assert!(text.contains(&finding.to_string()), "{text}");
    }
    assert!(!text.contains("no face: vertex 5"), "{text}");
}

#[test]
fn fatal_findings_come_first() {
    let two = flipped(&union(&strip(5), &strip(4)), [2]);
    let s = surface([two.positions(), &[[5.0; 3]]].concat(), two.faces().iter());
    let severities: Vec<Severity> = findings(&s).iter().map(Finding::severity).collect();
    assert_eq!(severities, [Severity::Fatal, Severity::Repaired, Severity::Note]);
}
