//! What the tests of cuts and of holes share: surfaces to open, and what holds of every disc that one becomes.
#![allow(dead_code)] // each test file uses a part

use super::common::*;
use riemap::surface::Surface;
use riemap::surface::cut::{CutError, CutRecord, Opening};
use riemap::surface::edges::Edges;
use riemap::surface::generate::generate;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::Topology;
use riemap::surface::topology::diagnosis::{Diagnosis, Finding};

pub fn generated(name: &str) -> Surface {
    generate(name).unwrap_or_else(|error| panic!("{error}")).surface
}

/// `tori` tori in a row, sewn together along rims of faces.
pub fn sum_of_tori(tori: usize) -> Surface {
    let torus = quad_grid(7, 6, Sides::Torus);
    (1..tori).fold(torus.clone(), |s, _| connected_sum(&s, s.faces().len() / 2, &torus, 10))
}

pub fn open(s: &Surface, opening: &Opening) -> Result<(OrientedMesh, CutRecord), CutError> {
    OrientedMesh::open(s, &Diagnosis::new(s), opening)
}

pub fn cutting() -> Opening {
    Opening { cut: true, ..Opening::default() }
}

pub fn filling() -> Opening {
    Opening { fill_holes: true, ..Opening::default() }
}

pub fn removing(faces: &[u32]) -> Opening {
    Opening { remove_faces: faces.to_vec(), ..Opening::default() }
}

/// The disc that `s` becomes, after everything is checked that holds of all of them.
#[track_caller]
pub fn opened(name: &str, s: &Surface, opening: &Opening) -> (OrientedMesh, CutRecord) {
    let (disc, record) = open(s, opening).unwrap_or_else(|error| panic!("{name}: {error}"));
    let as_surface = disc.to_surface();
    let topology = Topology::new(&as_surface);
    assert_eq!(topology.components.len(), 1, "{name}");
    let part = &topology.components[0];
    assert!(part.is_disc(), "{name}: {part:?}");
    assert_eq!(part.boundary_loops, [disc.boundary.len()], "{name}");
    assert_eq!(part.vertices, disc.positions.len(), "{name}: no vertex is unused");
    assert!(topology.orientation.flip.iter().all(|flip| !flip), "{name}: all faces agree");
    is_the_source_again(name, s, &disc, opening, &record);
    for (k, &v) in disc.boundary.iter().enumerate() {
        let w = disc.boundary[(k + 1) % disc.boundary.len()];
        let c = (0..disc.faces.corners().len()).find(|&c| {
            disc.faces.corners()[c] == v && {
                let range = disc.faces.corner_range(topology.edges.face_of_corner[c] as usize);
                let next = if c + 1 == range.end { range.start } else { c + 1 };
                disc.faces.corners()[next] == w && topology.edges.opposite(c).is_none()
            }
        });
        // a search for every edge takes its time
        assert!(c.is_some(), "{name}: boundary edge {k} has the surface on its left");
        if k == 20 {
            break;
        }
    }
    (disc, record)
}

/// Copies glued together, the faces are those of the source: same corners, same neighbours but across the cut.
#[track_caller]
pub fn is_the_source_again(name: &str, s: &Surface, disc: &OrientedMesh, opening: &Opening, record: &CutRecord) {
    assert!(disc.source_vertex.is_sorted() && disc.source_face.is_sorted(), "{name}");
    let corners = disc.corner_vertices(s);
    let edges = Edges::new(s.faces(), s.positions().len());
    let mut images = std::collections::HashMap::new();
    for (c, &v) in corners.iter().enumerate() {
        let removed = opening.remove_faces.contains(&edges.face_of_corner[c]);
        assert_eq!(v == OrientedMesh::NEW, removed, "{name}");
        if !removed {
            let source = s.faces().corners()[c];
            assert_eq!(disc.source_vertex[v as usize], source, "{name}");
            assert_eq!(disc.positions[v as usize], s.positions()[source as usize], "{name}");
            assert!(disc.copies(source).contains(&v), "{name}");
            images.entry(source).or_insert_with(std::collections::HashSet::new).insert(v);
        }
    }
    // between cuts through a filled hole there may be copies that no face of the source has
    for (&source, images) in images.iter().filter(|_| disc.filled == 0) {
        assert_eq!(disc.copies(source).len(), images.len(), "{name}");
    }
    assert!(disc.filled > 0 || images.values().map(|i| i.len()).sum::<usize>() == disc.positions.len(), "{name}");
    assert!(disc.is_cut() || images.values().all(|i| i.len() == 1), "{name}");
    // inner edges of the source whose two sides have different ends now
    let ends = |c: u32| {
        let range = s.faces().corner_range(edges.face_of_corner[c as usize] as usize);
        let next = if c as usize + 1 == range.end { range.start } else { c as usize + 1 };
        let (a, b) = (corners[c as usize], corners[next]);
        (a.min(b), a.max(b))
    };
    let parted = (0..edges.len()).filter(|&e| match edges.corners(e) {
        &[c, d] => ends(c) != ends(d) && ends(c).0 != OrientedMesh::NEW && ends(d).0 != OrientedMesh::NEW,
        _ => false,
    });
    let parted = parted.count();
    if disc.filled == 0 {
        assert_eq!(parted, record.cut_edges, "{name}");
    } else {
        assert!(parted <= record.cut_edges, "{name}");
    }
}

pub fn file(name: &str) -> Option<Surface> {
    let path = data_folder()?.join(name);
    Some(riemap::io::read(&path).unwrap_or_else(|error| panic!("{error}")).surface)
}

/// The diagnosis of a disc or closed surface, which must be sound but for being closed.
#[track_caller]
pub fn sound(name: &str, disc: &OrientedMesh) -> Diagnosis {
    let diagnosis = Diagnosis::new(&disc.to_surface());
    let wrong: Vec<&Finding> = diagnosis.fatal().filter(|f| !matches!(f, Finding::Closed { .. })).collect();
    assert!(wrong.is_empty(), "{name}: {wrong:?}");
    assert!(diagnosis.topology.orientation.flip.iter().all(|flip| !flip), "{name}");
    diagnosis
}
