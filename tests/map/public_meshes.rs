//! The diagnosis of public meshes, against a table that was reached independently of this crate. Folder: `$RIEMAP_DATA`,
//! else `../shared/data`, else `data`; without one the test says so and passes.

use crate::common::data_folder;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::diagnosis::{Diagnosis, Finding, Finding::*};

/// What one component is: first face, faces, vertices, edges, boundary loops, genus (of manifold ones).
type Part = (u32, usize, usize, usize, &'static [usize], Option<u64>);

struct Expected {
    file: &'static str,
    vertices: usize,
    parts: &'static [Part],
    findings: Vec<Finding>,
}

fn expected(file: &'static str, vertices: usize, parts: &'static [Part], findings: Vec<Finding>) -> Expected {
    Expected { file, vertices, parts, findings }
}

fn table() -> Vec<Expected> {
    // vertices of a part: those in use; of a pinched one before it is pulled apart
    vec![
        // 11 holes and two bow-ties: V − E + F = −11, which with 11 loops would be a torus
        expected(
            "bad/beetle.off",
            5105,
            &[(0, 9664, 5105, 14780, &[256, 48, 40, 40, 40, 36, 36, 20, 20, 16, 16], Some(0))],
            vec![
                NonManifoldVertices { vertex: 619, fans: 2, count: 2 },
                NotADisc { boundary_loops: vec![256, 48, 40, 40, 40, 36, 36, 20, 20, 16, 16], genus: 0 },
            ],
        ),
        // face 1 = (0, 0, 3): everything else is its consequence. Three edges, and the one from 0 to 0. Vertex 1 lies on
        // vertex 0, but is not in use
        expected(
            "bad/degenerate_edge.obj",
            4,
            &[(0, 2, 3, 4, &[], None)],
            vec![
                RepeatedVertex { face: 1, vertex: 0, count: 1 },
                ZeroAreaFaces { face: 1, count: 1 },
                Unreferenced { vertex: 1, count: 1 },
            ],
        ),
        // three planes in an octahedron, every face twice: no zero area in spite of the name
        expected(
            "bad/degenerated.obj",
            7,
            &[(0, 24, 7, 18, &[], None)],
            vec![
                DuplicateFaces { first: [0, 1], count: 12 },
                NonManifoldEdges { edge: [0, 1], faces: (0..8).collect(), count: 6 },
            ],
        ),
        // one component, χ = 1, no disc
        expected(
            "bad/fan3.obj",
            5,
            &[(0, 3, 5, 7, &[], None)],
            vec![NonManifoldEdges { edge: [2, 4], faces: vec![0, 1, 2], count: 1 }],
        ),
        // two spheres in one vertex
        expected(
            "bad/hourglass_ico.obj",
            23,
            &[(0, 20, 12, 30, &[], Some(0)), (20, 20, 12, 30, &[], Some(0))],
            vec![NonManifoldVertices { vertex: 22, fans: 2, count: 1 }, Components { count: 2, faces: vec![20, 20] }],
        ),
        // after repair six loops; walking the half-edges as they are finds dozens
        expected(
            "bad/inverted_triangles.obj",
            12577,
            &[(0, 24685, 12577, 37266, &[309, 50, 47, 47, 12, 12], Some(0))],
            vec![
                NotADisc { boundary_loops: vec![309, 50, 47, 47, 12, 12], genus: 0 },
                Reoriented { face: ANY, count: 10408 },
            ],
        ),
        // one crosscap
        expected(
            "bad/moebius.obj",
            280,
            &[(0, 224, 280, 504, &[112], Some(1))],
            vec![NonOrientable { component: 0, edge: [ANY, ANY] }],
        ),
        // thin, not degenerate; V − E + F over all 5009 vertices would be 5007; the coincident ones are not in use
        expected(
            "bad/sliver_tet.ply",
            5009,
            &[(0, 4, 4, 6, &[], Some(0))],
            vec![Closed { genus: 0 }, Unreferenced { vertex: 0, count: 5005 }],
        ),
        // topologically a disc
        expected(
            "bad/zero_area_face.obj",
            3,
            &[(0, 1, 3, 3, &[3], Some(0))],
            vec![ZeroAreaFaces { face: 0, count: 1 }],
        ),
        expected(
            "bad/zero_length_edge.obj",
            4,
            &[(0, 2, 4, 5, &[4], Some(0))],
            vec![
                ZeroLengthEdges { edge: [0, 1], count: 1, fatal: true },
                ZeroAreaFaces { face: 1, count: 1 },
                CoincidentVertices { first: [0, 1], count: 1 },
            ],
        ),
        expected(
            "topology/annulus.obj",
            4985,
            &[(0, 9724, 4985, 14709, &[240, 6], Some(0))],
            vec![NotADisc { boundary_loops: vec![240, 6], genus: 0 }],
        ),
        // disc, sphere, annulus, tori with one, two, no holes: the totals, χ = 0 and six loops, hide all of it
        expected(
            "topology/multiComp.obj",
            4081,
            &[
                (0, 651, 340, 990, &[27], Some(0)),
                (651, 760, 382, 1140, &[], Some(0)),
                (1411, 480, 266, 746, &[35, 17], Some(0)),
                (1891, 1943, 996, 2940, &[51], Some(1)),
                (3834, 1804, 945, 2751, &[51, 39], Some(1)),
                (5638, 2304, 1152, 3456, &[], Some(1)),
            ],
            vec![Components { count: 6, faces: vec![2304, 1943, 1804, 760, 651, 480] }],
        ),
        // one loop and connected, yet no disc
        expected(
            "topology/punctured-torus.obj",
            4599,
            &[(0, 9184, 4599, 13784, &[16], Some(1))],
            vec![NotADisc { boundary_loops: vec![16], genus: 1 }],
        ),
        expected("topology/spot.ply", 2930, &[(0, 5856, 2930, 8784, &[], Some(0))], vec![Closed { genus: 0 }]),
        // 36 corners, welded
        expected("topology/stl_box_ascii.stl", 8, &[(0, 12, 8, 18, &[], Some(0))], vec![Closed { genus: 0 }]),
        expected("topology/stl_box_binary.stl", 8, &[(0, 12, 8, 18, &[], Some(0))], vec![Closed { genus: 0 }]),
        // two eyes with interleaved faces and a head, which touch in two places but are not welded
        expected(
            "topology/suzanne.obj",
            507,
            &[(0, 32, 33, 64, &[8], Some(0)), (1, 32, 33, 64, &[8], Some(0)), (64, 436, 441, 877, &[13, 13], Some(0))],
            vec![
                Polygons { arities: vec![(3, 32), (4, 468)], first: ANY },
                Components { count: 3, faces: vec![436, 32, 32] },
                CoincidentVertices { first: [14, 113], count: 2 },
            ],
        ),
        expected("topology/torus.obj", 3840, &[(0, 7680, 3840, 11520, &[], Some(1))], vec![Closed { genus: 1 }]),
        expected("tri/bff-face.obj", 17157, &[(0, 34144, 17157, 51300, &[168], Some(0))], vec![]),
        // cut along a tree: the seam is there twice and must not be welded
        expected(
            "tri/bunny_cut.obj",
            9850,
            &[(0, 18954, 9850, 28803, &[744], Some(0))],
            vec![CoincidentVertices { first: [101, 104], count: 371 }],
        ),
        expected("tri/camelhead.off", 11381, &[(0, 22704, 11381, 34084, &[56], Some(0))], vec![]),
        expected("tri/cat_head.obj", 131, &[(0, 248, 131, 378, &[12], Some(0))], vec![]),
        // half of all vertices are on the boundary
        expected("tri/maze.obj", 6120, &[(0, 9174, 6120, 15293, &[3064], Some(0))], vec![]),
        expected("tri/three_peaks.off", 1907, &[(0, 3671, 1907, 5577, &[141], Some(0))], vec![]),
        expected("quad/fandisk_quads.off", 766, &[(0, 764, 766, 1528, &[], Some(0))], vec![Closed { genus: 0 }]),
        expected("quad/horse_quad.obj", 2400, &[(0, 2398, 2400, 4796, &[], Some(0))], vec![Closed { genus: 0 }]),
        expected("quad/inspired_mesh_quads_Smooth.off", 1963, &[(0, 1838, 1963, 3800, &[248], Some(0))], vec![]),
    ]
}

/// Where the table does not say which: any index will do.
const ANY: u32 = u32::MAX;

/// The findings without the indices that the table leaves open.
fn comparable(mut found: Vec<Finding>, table: &[Finding]) -> Vec<Finding> {
    for (found, table) in found.iter_mut().zip(table) {
        match (found, table) {
            (Reoriented { face, .. }, Reoriented { face: ANY, .. }) => *face = ANY,
            (NonOrientable { edge, .. }, NonOrientable { edge: [ANY, ANY], .. }) => *edge = [ANY, ANY],
            (Polygons { first, .. }, Polygons { first: ANY, .. }) => *first = ANY,
            _ => {}
        }
    }
    found
}

#[test]
fn every_public_mesh_gets_the_diagnosis_that_was_reached_independently() {
    let Some(folder) = data_folder() else {
        println!("skipped: no public meshes in $RIEMAP_DATA, ../shared/data or data");
        return;
    };
    let mut wrong = Vec::new();
    for Expected { file, vertices, parts, findings } in table() {
        let surface = match riemap::io::read(&folder.join(file)) {
            Ok(mesh) => mesh.surface,
            Err(error) => {
                wrong.push(format!("{file}: {error}"));
                continue;
            }
        };
        let diagnosis = Diagnosis::new(&surface);
        if surface.positions().len() != vertices {
            wrong.push(format!("{file}: {} vertices instead of {vertices}", surface.positions().len()));
        }
        let found = comparable(diagnosis.findings.clone(), &findings);
        if found != findings {
            wrong.push(format!("{file}: findings\n    {found:?} instead of\n    {findings:?}"));
        }
        let components = &diagnosis.topology.components;
        if components.len() != parts.len() {
            wrong.push(format!("{file}: {} components instead of {}", components.len(), parts.len()));
        }
        for (c, &(first_face, faces, vertices, edges, loops, genus)) in components.iter().zip(parts) {
            let counts = (c.first_face, c.faces, c.vertices, c.edges, c.genus());
            let loops_agree = c.boundary_loops == loops || (!c.manifold && loops.is_empty());
            if counts != (first_face, faces, vertices, edges, genus) || !loops_agree {
                let counts_expected = (first_face, faces, vertices, edges, genus);
                wrong.push(format!(
                    "{file}: {counts:?} {:?} instead of {counts_expected:?} {loops:?}",
                    c.boundary_loops
                ));
            }
        }
        // a disc and nothing against it: mapped; all else: refused
        let mappable = parts.len() == 1 && parts[0].4.len() == 1 && diagnosis.fatal().next().is_none();
        match OrientedMesh::new(&surface, &diagnosis) {
            Ok(disc) if mappable => {
                if disc.boundary.len() != parts[0].4[0] {
                    wrong.push(format!("{file}: a boundary of {} vertices", disc.boundary.len()));
                }
            }
            Err(_) if !mappable => {}
            _ => wrong.push(format!("{file}: a disc or not?")),
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn no_public_mesh_is_left_out_of_the_table() {
    let Some(folder) = data_folder() else { return };
    for kind in ["bad", "topology", "tri", "quad"] {
        let Ok(entries) = std::fs::read_dir(folder.join(kind)) else { continue };
        for entry in entries.flatten() {
            let name = format!("{kind}/{}", entry.file_name().to_string_lossy());
            let is_mesh = riemap::io::Format::of(&entry.path()).is_some();
            assert!(!is_mesh || table().iter().any(|row| row.file == name), "{name}: no expectation is written down");
        }
    }
}
