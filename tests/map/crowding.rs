//! Where doubles end: shapes whose conformal maps onto a disc have parts smaller than can be told apart. On both sides of that a map is valid,
//! says how small its parts are, and ends in bounded time.

use std::time::Instant;

use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, map_input};
use riemap::solver::Silent;

fn mapped(name: &str, boundary: Boundary, iterations: usize) -> Mapped {
    let options = MapOptions { boundary: boundary.clone(), max_iterations: Some(iterations), ..MapOptions::default() };
    let begun = Instant::now();
    let mapped =
        map_input(&Input::open(name).unwrap(), &options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"));
    let scale = mapped.distortion.smallest_scale.unwrap();
    println!("{name} {boundary:?}: {} {}, {scale:e}", mapped.map.ending.name(), mapped.map.iterations);
    assert!(begun.elapsed().as_secs() < 60, "{name} {boundary:?}");
    assert!(mapped.map.z.iter().all(|z| z.is_finite()), "{name} {boundary:?}");
    assert!(mapped.validity.is_locally_one_to_one(), "{name} {boundary:?}: {:?}", mapped.validity);
    assert!(boundary.is_free() || mapped.validity.is_one_to_one(), "{name} {boundary:?}");
    assert!(scale > 0.0 && scale <= 1.0, "{name} {boundary:?}: {scale:e}");
    mapped
}

#[test]
fn maps_are_valid_on_both_sides_of_what_doubles_hold() {
    for mesh in ["triangle", "quad"] {
        for boundary in [Boundary::CIRCLE, Boundary::FREE] {
            for shape in [
                "spiral?rounds=1&n=2",
                "spiral?rounds=4&n=1",
                "spiral?rounds=12&n=1",
                "comb?teeth=4&length=6",
                "comb?teeth=3&length=40",
                "comb?teeth=3&length=300&n=1",
                "capsule?length=8&n=20",
                "capsule?length=30&n=20",
                "capsule?length=100&n=20",
            ] {
                mapped(&format!("{shape}&mesh={mesh}"), boundary.clone(), 100);
            }
        }
    }
}

/// A tube of length l and radius 1 is mapped as small as e^−l: exactly so by the plain map as long as that is valid.
#[test]
fn the_smallest_scale_of_a_capsule_is_that_of_its_conformal_map() {
    let scale = |length: f64| {
        let mapped = mapped(&format!("capsule?length={length}&n=40&mesh=quad"), Boundary::CIRCLE, 100);
        assert!(!mapped.map.provenance.is_repaired());
        mapped.distortion.smallest_scale.unwrap()
    };
    // The mesh is coarse: half an edge is up to length/40 of the exponent.
    let decades = (scale(4.0) / scale(8.0)).ln();
    assert!((decades - 4.0).abs() < 0.4, "{decades}");
}

#[test]
fn an_isometry_has_one_scale() {
    for mesh in ["triangle", "quad"] {
        let flat = mapped(&format!("spiral?rounds=2&n=2&mesh={mesh}"), Boundary::FREE, 100);
        let scale = flat.distortion.smallest_scale.unwrap();
        assert!((scale - 1.0).abs() < 1e-9, "{mesh}: {scale}");
    }
}
