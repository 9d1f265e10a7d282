//! The smallest discs, under every choice there is.

use std::f64::consts::TAU;

use crate::common::surface;
use riemap::input::Input;
use riemap::map::{Boundary, MapError, MapOptions, PinnedPoints, Valid, map_input};
use riemap::solver::Silent;
use riemap::surface::Surface;

/// A closed fan of triangles around vertex 0, or an open one.
fn fan(n: u32, closed: bool, height: f64) -> Surface {
    let rim = if closed { n } else { n + 1 };
    let turn = if closed { TAU } else { 0.7 * TAU };
    let mut positions = vec![[0.1, 0.05, height]];
    positions.extend((0..rim).map(|k| {
        let angle = turn * f64::from(k) / f64::from(n);
        [angle.cos(), 0.8 * angle.sin(), 0.1 * f64::from(k % 2)]
    }));
    surface(positions, (0..n).map(|k| [0, 1 + k, 1 + (k + 1) % rim]))
}

/// A strip of triangles, or of quads.
fn strip(n: u32, quads: bool) -> Surface {
    let column = |k: u32| [[f64::from(k), 0.0, 0.1 * f64::from(k * k)], [f64::from(k) + 0.3, 0.9, 0.0]];
    let quad = |k: u32| [2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1];
    let split = |q: [u32; 4]| [vec![q[0], q[1], q[2]], vec![q[0], q[2], q[3]]];
    let faces: Vec<Vec<u32>> =
        if quads { (0..n).map(|k| quad(k).to_vec()).collect() } else { (0..n).flat_map(|k| split(quad(k))).collect() };
    surface((0..=n).flat_map(column).collect(), faces)
}

fn tiny() -> Vec<(&'static str, Surface)> {
    let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.2, 1.0, 0.0], [0.0, 0.7, 0.0]];
    let needle = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 1e-9, 0.0]];
    // Two quads that lie around a vertex of the boundary, one with a right angle there and one with an obtuse one.
    let bent =
        vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.2], [0.0, 1.0, 0.0], [-1.0, 0.5, 0.3], [-1.0, 0.0, 0.0]];
    vec![
        ("one triangle", surface(corners[..3].to_vec(), [[0, 1, 2]])),
        ("one needle", surface(needle, [[0, 1, 2]])),
        ("two triangles", surface(corners.clone(), [[0, 1, 2], [0, 2, 3]])),
        ("three triangles round a vertex", fan(3, true, 0.4)),
        ("three triangles round the tip of a needle", fan(3, true, 300.0)),
        ("seven triangles round a vertex", fan(7, true, 0.0)),
        ("an open fan of five", fan(5, false, 0.2)),
        ("a strip of eight triangles", strip(4, false)),
        ("one quad", surface(corners, [[0, 1, 2, 3]])),
        ("two quads", strip(2, true)),
        ("two quads, bent", surface(bent, [[0, 1, 2, 3], [0, 3, 4, 5]])),
        ("a strip of five quads", strip(5, true)),
    ]
}

/// Circle and free maps are valid unless that is not asked for; whatever else is asked for is mapped, or refused for what Re ρ is with
/// circumcentres.
#[test]
fn the_smallest_discs_are_mapped_under_every_choice() {
    let (mut mapped, mut refused) = (0, 0);
    for (name, s) in tiny() {
        let two = Boundary::Circle { pinned: PinnedPoints::Two, ordered: false };
        for boundary in [two, Boundary::CIRCLE, Boundary::FREE, Boundary::FIXED] {
            for dual in ["barycentre", "circumcentre", "incentre"] {
                for valid in [Valid::Auto, Valid::BestQc, Valid::Off] {
                    let what = format!("{name}: {boundary:?}, {dual}, {valid:?}");
                    let options = MapOptions {
                        boundary: boundary.clone(),
                        dual: dual.to_owned(),
                        valid,
                        ..MapOptions::default()
                    };
                    let made = match map_input(&Input::of(name.to_owned(), s.clone()), &options, &mut Silent) {
                        Ok(made) => made,
                        Err(error) => {
                            println!("{what}: {error}");
                            let undefined = dual == "circumcentre" && error.is_of_integral_weights();
                            // Nothing takes the place of a plain map that is not found.
                            let plain = valid == Valid::Off && !boundary.is_fixed();
                            assert!(undefined || plain, "{what}: {error}");
                            refused += 1;
                            continue;
                        }
                    };
                    mapped += 1;
                    assert!(made.map.z.iter().all(|z| z.is_finite()), "{what}");
                    let is_valid = match boundary {
                        Boundary::Circle { .. } => made.validity.is_one_to_one(),
                        Boundary::Free { .. } => made.validity.is_locally_one_to_one(),
                        _ => true,
                    };
                    println!("{what}: {} {} {is_valid}", made.map.provenance, made.map.ending.name());
                    assert!(is_valid || valid == Valid::Off, "{what}: {:?}", made.validity);
                }
            }
        }
    }
    assert!(mapped > 330 && refused < 100, "{mapped} mapped, {refused} refused");
}

/// Two quads that share two edges: under every map one of them has an angle of π at least where these meet.
#[test]
fn quads_that_cannot_be_convex_are_refused_by_name() {
    let positions = vec![
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [2.0, 0.5, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [1.2, 0.5, 0.0],
        [-1.0, 0.5, 0.0],
    ];
    // Vertex 5 lies between (1, 2, 3, 5) and (1, 5, 3, 0).
    let s = surface(positions, [[1, 2, 3, 5], [1, 5, 3, 0], [0, 3, 4, 6]]);
    for boundary in [Boundary::CIRCLE, Boundary::FREE] {
        let of = |valid| {
            let options = MapOptions { boundary: boundary.clone(), valid, ..MapOptions::default() };
            map_input(&Input::of("doublet".to_owned(), s.clone()), &options, &mut Silent)
        };
        let error = of(Valid::Auto).unwrap_err();
        assert!(matches!(error, MapError::NoConvexQuads { vertex: 5, count: 1 }), "{boundary:?}: {error}");
        assert!(of(Valid::Off).is_ok());
    }
}
