//! The exact check of maps, and the maps that must pass it.

use std::f64::consts::TAU;

use crate::common::{disc, surface, triangulated};
use num_complex::Complex64;
use riemap::distortion::Validity;
use riemap::surface::Surface;
use riemap::surface::oriented_mesh::OrientedMesh;

/// A fan of `n` triangles around vertex 0, each of 1/n of `turns` turns in the plane; closed where `closed`.
fn fan(n: u32, turns: f64, closed: bool) -> (Surface, Vec<Complex64>) {
    let rim = if closed { n } else { n + 1 };
    let mut positions = vec![[0.0, 0.0, 1.0]];
    // At rest it goes round once, or half-way, whatever the map does.
    let share = if closed { TAU } else { 0.5 * TAU } / f64::from(n);
    positions.extend((0..rim).map(|k| [(share * f64::from(k)).cos(), (share * f64::from(k)).sin(), 0.0]));
    let faces = (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % rim]);
    let mut z = vec![Complex64::ZERO];
    z.extend((0..rim).map(|k| Complex64::cis(turns * TAU * f64::from(k) / f64::from(n))));
    (surface(positions, faces), z)
}

fn check(disc: &OrientedMesh, z: &[Complex64]) -> Validity {
    Validity::new(disc, |c| z[disc.faces.corners()[c] as usize])
}

#[test]
fn a_fan_that_goes_round_once_is_one_to_one_and_one_that_goes_round_twice_is_not() {
    let (once, z) = fan(8, 1.0, true);
    assert!(check(&disc(&once), &z).is_one_to_one());
    // Every triangle is positive, but around the centre they lie twice; so does the boundary, vertex on vertex.
    let (twice, z) = fan(8, 2.0, true);
    let found = check(&disc(&twice), &z);
    assert_eq!((found.folded.as_slice(), found.wound.as_slice()), (&[][..], &[0][..]));
    assert!(found.crossing.is_some() && !found.is_locally_one_to_one());
}

#[test]
fn a_boundary_vertex_may_open_by_less_than_a_turn() {
    for (turns, wound) in [(0.4, false), (0.999, false), (1.001, true), (1.3, true), (2.2, true)] {
        let (open, z) = fan(9, turns, false);
        let found = check(&disc(&open), &z);
        assert_eq!(found.wound, if wound { vec![0] } else { vec![] }, "{turns} turns");
        assert_eq!(found.crossing.is_some(), wound, "{turns} turns");
    }
}

#[test]
fn every_folded_face_is_named() {
    let (hexagon, mut z) = fan(6, 1.0, true);
    // Beyond the side of face 2: that one is turned over, and no other.
    z[0] = Complex64::from_polar(0.9, 2.5 * TAU / 6.0);
    assert_eq!(check(&disc(&hexagon), &z).folded, [2]);
    // On a side: without area.
    let (square, _) = fan(4, 1.0, true);
    let z = [(0.5, 0.5), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)].map(|(x, y)| Complex64::new(x, y));
    assert_eq!(check(&disc(&square), &z).folded, [0]);
}

#[test]
fn a_quad_must_turn_left_at_all_four_corners() {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let quad = disc(&surface(positions, [[0, 1, 2, 3]]));
    let at = |x: f64, y: f64| [(0.0, 0.0), (1.0, 0.0), (x, y), (0.0, 1.0)].map(|(x, y)| Complex64::new(x, y));
    assert!(check(&quad, &at(1.0, 1.0)).is_one_to_one());
    // Positive diagonals, and a straight or hollow corner.
    assert_eq!(check(&quad, &at(0.5, 0.5)).folded, [0]);
    assert_eq!(check(&quad, &at(0.4, 0.4)).folded, [0]);
    assert!(check(&quad, &at(0.5f64.next_up(), 0.5)).is_one_to_one());
}

#[test]
fn parts_far_from_each_other_may_overlap_where_a_map_is_one_to_one_near_every_point() {
    // A strip of squares that is wound one turn and a quarter around a centre outside of it.
    let n = 40u32;
    let positions = (0..=n).flat_map(|k| [[f64::from(k), 0.0, 0.0], [f64::from(k), 1.0, 0.0]]).collect();
    let strip = surface(positions, (0..n).map(|k| [2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1]));
    let angle = |k: u32| -1.25 * TAU * f64::from(k) / f64::from(n);
    let z: Vec<_> = (0..=n).flat_map(|k| [1.0, 2.0].map(|r| Complex64::from_polar(r, angle(k)))).collect();
    for strip in [triangulated(&strip), strip] {
        let found = check(&disc(&strip), &z);
        assert!(found.is_locally_one_to_one() && !found.is_one_to_one(), "{found:?}");
    }
}
