//! Maps of libigl, measured by our code: cases that are known exactly.

use riemap::app::compare::libigl::{Environment, LibiglError, lscm};
use riemap::app::compare::peer::{PeerError, peer};
use riemap::constraint::Shape;
use riemap::input::Input;
use riemap::map::{Boundary, Interior, MapOptions, Mapped, Outline, Valid, map_input};
use riemap::solver::Silent;
use riemap::surface::cut::Opening;

fn map(name: &str, source: &str) -> Mapped {
    map_opened(name, source, Opening::default())
}

fn map_opened(name: &str, source: &str, opening: Opening) -> Mapped {
    let libigl = Environment::ensure().unwrap_or_else(|error| panic!("{error}"));
    let input = Input::open(source).unwrap();
    peer(name).unwrap().map(&input, opening, &libigl, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}")).0
}

#[test]
fn least_squares_conformal_maps_of_plane_meshes_are_similarities() {
    let mapped = map("libigl-lscm", "plane?n=16&mesh=delaunay&seed=2");
    let distortion = &mapped.distortion;
    // A solution of some 500 equations with residual 0; measured 1e-13.
    assert!(distortion.quasi_conformal.unwrap().max < 1.0 + 1e-9);
    assert!(distortion.length.unwrap().max < 1.0 + 1e-9);
    // Dual vertices are where a similarity puts them, too.
    assert!(distortion.rho_residual.unwrap().max < 1e-9);
    assert_eq!((distortion.flipped, distortion.boundary_out_of_order), (0, None));
}

#[test]
fn the_harmonic_map_is_ours_with_circumcentres() {
    let source = "catenoid?n=12&mesh=delaunay&seed=5";
    let theirs = map("libigl-harmonic", source);
    let options = MapOptions { boundary: Boundary::FIXED, dual: "circumcentre".to_owned(), ..MapOptions::default() };
    let ours = map_input(&Input::open(source).unwrap(), &options, &mut Silent).unwrap();
    let primal = ours.domain.graph.primal;
    let farthest = (0..primal).map(|v| (ours.map.z[v] - theirs.map.z[v]).norm()).fold(0.0, f64::max);
    // As in the cotan equivalence.
    assert!(farthest < 1e-9, "{farthest:e}");
    let [a, b] = [&ours, &theirs].map(|mapped| mapped.distortion.quasi_conformal.unwrap());
    assert!((a.mean - b.mean).abs() < 1e-8 && (a.max - b.max).abs() < 1e-6);
    assert_eq!(theirs.distortion.boundary_out_of_order, Some(0));
    assert_eq!(theirs.domain.graph.vertices, theirs.map.z.len());
}

#[test]
fn a_peer_maps_the_same_disc_that_is_cut_out_of_a_closed_surface() {
    let source = "torus?R=2&r=0.8&n=12&mesh=triangle";
    let theirs = map_opened("libigl-harmonic", source, Opening { cut: true, ..Opening::default() });
    let options = MapOptions { boundary: cotan(), cut: true, valid: Valid::Off, ..MapOptions::default() };
    let ours = map_input(&Input::open(source).unwrap(), &options, &mut Silent).unwrap();
    let primal = ours.domain.graph.primal;
    let farthest = (0..primal).map(|v| (ours.map.z[v] - theirs.map.z[v]).norm()).fold(0.0, f64::max);
    // As in the cotan equivalence.
    assert!(farthest < 1e-9, "{farthest:e}");
    assert_eq!(ours.cut, theirs.cut);
}

#[test]
fn what_a_peer_cannot_map_is_refused() {
    let libigl = Environment::ensure().unwrap_or_else(|error| panic!("{error}"));
    let quads = Input::open("sphere?n=8").unwrap();
    let refused = peer("libigl-lscm").unwrap().map(&quads, Opening::default(), &libigl, &mut Silent);
    assert!(matches!(refused, Err(PeerError::NotTriangles { corners: 4 })));
    let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let refused = lscm(&libigl, &triangle, &[[0, 1, 2]], &[0], &[[0.0, 0.0]]);
    assert!(matches!(refused, Err(LibiglError::TooFewFixed { fixed: 1 })));
    assert!(peer("nobody").is_none());
}

#[test]
fn slim_finds_the_isometry_of_a_plane_mesh_and_never_folds() {
    let flat = map("libigl-slim", "staircase?size=4&mesh=triangle");
    // 20 iterations come within a hundredth of it.
    assert!(flat.distortion.quasi_conformal.unwrap().max < 1.01);
    assert!(flat.distortion.length.unwrap().max < 1.01);
    // The harmonic map of this one is folded: the start has unit weights.
    let source = "spikes?n=17&height=5&mesh=triangle";
    assert!(map("libigl-harmonic", source).distortion.flipped > 0);
    let rough = map("libigl-slim", source);
    assert_eq!(rough.distortion.flipped, 0);
    // Nothing is held on the circle.
    assert_eq!(rough.distortion.boundary_out_of_order, None);
}

/// The boundary fixed on the circle, inner vertices at means by cotangent weights: libigl's harmonic map.
fn cotan() -> Boundary {
    let on = Outline::Shape(Shape::Circle);
    Boundary::Fixed { on, hold: None, interior: Interior::Weights("cotan".to_owned()) }
}
