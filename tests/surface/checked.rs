//! What a surface is made of is checked when it is made.

use riemap::{MapError, MapOptions, Surface, SurfaceError};

const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn an_index_out_of_range_is_refused_with_its_face() {
    let error = Surface::new(CORNERS.to_vec(), vec![vec![0, 1, 2], vec![0, 2, 4]]).unwrap_err();
    assert_eq!(error, SurfaceError::NoSuchVertex { face: 1, vertex: 4, vertices: 4 });
    let error = riemap::map(&CORNERS, &[vec![0, 1, 2], vec![0, 2, u32::MAX]], &MapOptions::default()).unwrap_err();
    assert_eq!(error, MapError::Surface(SurfaceError::NoSuchVertex { face: 1, vertex: u32::MAX, vertices: 4 }));
}

#[test]
fn a_face_has_at_least_three_corners() {
    for polygon in [vec![], vec![0], vec![0, 1]] {
        let corners = polygon.len();
        let error = Surface::new(CORNERS.to_vec(), vec![polygon]).unwrap_err();
        assert_eq!(error, SurfaceError::TooFewCorners { face: 0, corners });
    }
}

#[test]
fn there_is_one_normal_for_each_face() {
    let square = Surface::new(CORNERS.to_vec(), vec![vec![0, 1, 2, 3]]).unwrap();
    let up = vec![[0.0, 0.0, 1.0]];
    assert_eq!(square.clone().with_face_normals(up.clone()).unwrap().face_normals(), Some(&up[..]));
    let error = square.with_face_normals(vec![]).unwrap_err();
    assert_eq!(error, SurfaceError::NormalCount { normals: 0, faces: 1 });
}

#[test]
fn arrays_that_are_no_surface_to_map_are_refused_and_nothing_panics() {
    let options = MapOptions::default();
    // Nothing at all; no faces; a coordinate that is no number; a face twice.
    let nan = [[f64::NAN, 0.0, 0.0], CORNERS[1], CORNERS[2]];
    for (positions, faces) in [
        (&[][..], vec![]),
        (&CORNERS[..], vec![]),
        (&nan[..], vec![vec![0, 1, 2]]),
        (&CORNERS[..], vec![vec![0, 1, 2], vec![0, 1, 2]]),
        (&CORNERS[..], vec![vec![0, 1, 1]]),
    ] {
        assert!(matches!(riemap::map(positions, &faces, &options), Err(MapError::NoDisc(_))), "{faces:?}");
    }
}
