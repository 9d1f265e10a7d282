//! Maps that must not overlap.

use std::f64::consts::TAU;

use riemap::input::Input;
use riemap::map::{Boundary, FlatOptions, MapOptions, ValidName, map_input};
use riemap::surface::Surface;

use super::shapes::*;
use crate::common::*;

/// A flat ring of `turns` turns, slit open and lifted like a ramp: flattened without stretch it lies on itself.
fn ramp(turns: f64, n: u32) -> Surface {
    let mut s = quad_grid(n, 3, Sides::Free);
    for (v, p) in s.positions_mut().iter_mut().enumerate() {
        let (i, j) = (v as u32 % (n + 1), v as u32 / (n + 1));
        let (angle, radius) = (turns * TAU * f64::from(i) / f64::from(n), 1.5 - f64::from(j) / 6.0);
        *p = [radius * angle.cos(), radius * angle.sin(), 0.05 * angle];
    }
    s
}

#[test]
fn free_maps_that_overlap_are_replaced_by_maps_that_do_not_where_that_is_asked_for() {
    let free = |s: &Surface, overlap| {
        let boundary = Boundary::Free { lengths: None, overlap };
        mapped(s.clone(), &MapOptions { boundary, ..MapOptions::default() }, "free")
    };
    let shapes = [
        ("ramp of quads", ramp(1.3, 60)),
        ("ramp of triangles", triangulated(&ramp(1.3, 60))),
        ("ramp, two turns", triangulated(&ramp(2.0, 90))),
        ("spikes", spikes(16, 20.0)),
    ];
    let mut kept = 0;
    for (what, s) in &shapes {
        let (may, must_not) = (free(s, true), free(s, false));
        shows(what, &must_not);
        assert!(must_not.validity.is_one_to_one(), "{what}: {:?}", must_not.validity);
        // What is one-to-one already stays.
        let same = may.map.z == must_not.map.z;
        assert_eq!(same, may.validity.is_one_to_one(), "{what}");
        assert_eq!(must_not.map.provenance.is_repaired(), !same || may.map.provenance.is_repaired(), "{what}");
        kept += usize::from(same);
    }
    assert!(kept < shapes.len() - 1, "shapes that do not overlap: {kept}");
}

#[test]
fn circle_maps_that_must_not_overlap_are_the_default_ones() {
    let s = rough(12, &mut Random(5));
    let circle = |valid| {
        let options = MapOptions::try_from(FlatOptions { valid, ..FlatOptions::default() }).unwrap();
        mapped(s.clone(), &options, "rough").map.z
    };
    assert_eq!(circle(ValidName::Auto), circle(ValidName::OneToOne));
}

#[test]
fn a_free_map_that_is_stopped_on_its_way_past_itself_does_not_overlap() {
    let s = triangulated(&ramp(1.3, 40));
    for n in [0, 1, 5, 10, 20, 40, 60, 80, 120] {
        let boundary = Boundary::Free { lengths: None, overlap: false };
        let options = MapOptions { boundary, ..MapOptions::default() };
        let stopped = map_input(&Input::of("ramp".to_owned(), s.clone()), &options, &mut Stopper(n)).unwrap();
        assert!(stopped.validity.is_one_to_one(), "stopped after {n}");
    }
}
