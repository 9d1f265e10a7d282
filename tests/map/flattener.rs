//! Many maps of one surface: the same as each by itself, by one factorisation.

use riemap::map::{Boundary, Hold, Interior, MapError, MapOptions, Outline, Pin};
use riemap::solver::{Iteration, Observer, Phase};
use riemap::{Flattener, Input, Silent, map_input};

/// Counts factorisations.
#[derive(Default)]
struct Factorisations(usize);

impl Observer for Factorisations {
    fn phase(&mut self, phase: Phase) {
        self.0 += usize::from(phase == Phase::Factor);
    }

    fn iteration(&mut self, _iteration: &Iteration) {}
}

fn largest_difference(a: &riemap::Mapped, b: &riemap::Mapped) -> f64 {
    a.map.z.iter().zip(&b.map.z).map(|(z, w)| (z - w).norm()).fold(0.0, f64::max)
}

#[test]
fn maps_of_a_flattener_are_those_that_are_made_alone() {
    let input = Input::open("sphere?n=12&mesh=delaunay").unwrap();
    let options = MapOptions::default();
    let flattener = Flattener::of_input(&input, &options).unwrap();
    let alone = |boundary| map_input(&input, &MapOptions { boundary, ..options.clone() }, &mut Silent).unwrap();
    let boundary = flattener.boundary();
    let ellipse: Vec<[f64; 2]> = (0..boundary.len())
        .map(|k| std::f64::consts::TAU * k as f64 / boundary.len() as f64)
        .map(|t| [2.0 * t.cos(), t.sin()])
        .collect();
    let pins = boundary.iter().zip(&ellipse).map(|(&vertex, &place)| Pin { vertex, place }).collect();
    let fixed = Boundary::Fixed { on: Outline::Places(pins), hold: Some(Hold::Primal), interior: Interior::Energy };
    // The same numbers for the circle and the free map, whose methods take the same factor; the places are held to rounding.
    assert_eq!(largest_difference(&flattener.circle().unwrap(), &alone(Boundary::CIRCLE)), 0.0);
    assert_eq!(largest_difference(&flattener.free(None).unwrap(), &alone(Boundary::FREE)), 0.0);
    assert!(largest_difference(&flattener.fixed(&ellipse).unwrap(), &alone(fixed)) < 1e-11);
    let error = flattener.fixed(&ellipse[1..]).unwrap_err();
    assert_eq!(error, MapError::PlaceCount { places: boundary.len() - 1, boundary: boundary.len() });
}

#[test]
fn the_second_circle_map_needs_no_factorisation() {
    let input = Input::open("sphere?n=12&mesh=delaunay").unwrap();
    let flattener = Flattener::of_input(&input, &MapOptions::default()).unwrap();
    let mut count = Factorisations::default();
    flattener.map(Boundary::CIRCLE, &mut count).unwrap();
    assert_eq!(count.0, 1);
    flattener.map(Boundary::CIRCLE, &mut count).unwrap();
    assert_eq!(count.0, 1);
}
