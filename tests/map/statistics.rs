//! Statistics of the quasi-conformal distortion that a report leads with.

use std::collections::HashMap;

use crate::common::*;
use riemap::distortion::{Image, face_maps};
use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, map_input};
use riemap::solver::Silent;

fn mapped(name: &str, boundary: Boundary) -> Mapped {
    let options = MapOptions { boundary, ..MapOptions::default() };
    map_input(&Input::open(name).unwrap(), &options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn medians_percentiles_and_means_without_ears_are_those_of_sorted_faces() {
    let mut ears = 0;
    for name in ["plane?n=3&mesh=quad", "sphere?n=7&mesh=delaunay", "graph:flat?n=12&mesh=triangle&diagonal=same"] {
        for boundary in [Boundary::CIRCLE, Boundary::FREE] {
            let mapped = mapped(name, boundary);
            let disc = &mapped.domain.disc;
            // Edges, and how many faces each has.
            let mut sides: HashMap<[u32; 2], usize> = HashMap::new();
            let edges = |polygon: &[u32]| -> Vec<[u32; 2]> {
                let ahead = polygon.iter().cycle().skip(1);
                polygon.iter().zip(ahead).map(|(&a, &b)| [a.min(b), a.max(b)]).collect()
            };
            disc.faces.iter().flat_map(edges).for_each(|edge| *sides.entry(edge).or_default() += 1);
            let is_ear = |polygon: &[u32]| edges(polygon).iter().filter(|edge| sides[*edge] == 1).count() >= 2;
            let maps = face_maps(disc, &mapped.domain.graph, &Image::of_disc(&mapped.map.z));
            let mut sorted: Vec<f64> = maps.iter().map(|map| map.quasi_conformal()).collect();
            let inner: Vec<f64> =
                disc.faces.iter().zip(&sorted).filter(|(face, _)| !is_ear(face)).map(|(_, error)| *error).collect();
            ears += sorted.len() - inner.len();
            let found = mapped.distortion.quasi_conformal.unwrap();
            let mean = inner.iter().sum::<f64>() / inner.len() as f64;
            assert!((found.without_ears.unwrap() - mean).abs() < 1e-12 * mean, "{name}");
            sorted.sort_by(f64::total_cmp);
            for (percent, value) in [(50, found.median), (90, found.p90), (99, found.p99)] {
                let not_above = sorted.iter().filter(|error| **error <= value).count();
                let below = sorted.iter().filter(|error| **error < value).count();
                assert!(100 * not_above >= percent * sorted.len() && 100 * below < percent * sorted.len(), "{name}");
            }
        }
    }
    // Four corners of the first, of both maps.
    assert!(ears >= 8, "{ears}");
}

#[test]
fn one_triangle_has_no_faces_but_ears() {
    let s = surface(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.1], [1.2, 1.0, 0.0]], [[0, 1, 2]]);
    let options = MapOptions { boundary: Boundary::FREE, ..MapOptions::default() };
    let mapped = map_input(&Input::of("one".to_owned(), s), &options, &mut Silent).unwrap();
    let error = mapped.distortion.quasi_conformal.unwrap();
    assert_eq!((error.without_ears, error.median), (None, error.max));
}
