//! What metric energies begin with, and the gauge that holds them.

use crate::common::{Random, shuffled};
use num_complex::Complex64;
use riemap::energy::conformal::Weight;
use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, Start, Valid, map_input};
use riemap::solver::Silent;
use riemap::surface::Surface;

const GRID_33: &str = "graph:cos+cos?n=33";

/// With integral weights.
fn options(energy: &str, start: Start) -> MapOptions {
    MapOptions { boundary: Boundary::FREE, energy: Some(energy.parse().unwrap()), start, ..MapOptions::default() }
}

#[track_caller]
fn map(name: &str, options: &MapOptions) -> Mapped {
    map_input(&Input::open(name).unwrap(), options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The paper's gauge, a boundary vertex and the next edge, took 52 and 110 iterations: as many as the mesh has columns.
#[test]
fn iterations_do_not_grow_with_the_mesh() {
    for energy in ["H + A + L", "H + L"] {
        for start in [Start::Auto, Start::Circle] {
            let iterations = [33, 101].map(|n| {
                let options = options(energy, start);
                let mapped = map(&format!("graph:cos+cos?n={n}"), &options);
                assert!(mapped.validity.is_one_to_one());
                mapped.map.iterations
            });
            assert!(iterations[0] <= 15 && iterations[1] <= 20, "{energy} {start:?}: {iterations:?}");
        }
    }
}

#[test]
fn both_starts_lead_to_the_same_minimum_and_the_same_place() {
    for energy in ["H + L", "H + A + L"] {
        let [free, circle] = [Start::Auto, Start::Circle].map(|start| {
            let options = MapOptions { tolerance: 1e-9, ..options(energy, start) };
            map(GRID_33, &options).map
        });
        // The energy is right to the square of the gradient, the places to the gradient over the smallest eigenvalue, about 1e-4.
        let [a, b] = [&free, &circle].map(|map| map.total.unwrap());
        assert!((a - b).abs() < 1e-11 * b, "{energy}: {a} {b}");
        // The first boundary edge begins elsewhere, and has the same direction.
        let [first, next] = [0, 1].map(|k| map(GRID_33, &options(energy, Start::Auto)).domain.graph.boundary[k]);
        let edge = |z: &[Complex64]| z[next as usize] - z[first as usize];
        assert!((edge(&free.z) / edge(&circle.z) - 1.0).norm() < 1e-5, "{energy}");
        let apart = |v: usize| (free.z[v] - free.z[first as usize]) - (circle.z[v] - circle.z[first as usize]);
        let largest = (0..free.z.len()).map(|v| apart(v).norm()).fold(0.0, f64::max);
        assert!(largest < 1e-5, "{energy}: {largest:e}");
    }
}

#[test]
fn metric_energies_do_not_depend_on_where_the_gauge_is_held() {
    // The same mesh with its boundary begun elsewhere: vertices renamed.
    let name = "graph:cos+cos?n=9&jitter=0.2&seed=3";
    let surface = Input::open(name).unwrap().surface;
    let names = Random(5).permutation(surface.positions().len());
    let order: Vec<u32> = (0..surface.faces().len() as u32).collect();
    let named = |surface: Surface| Input::of("test".to_owned(), surface);
    let renamed = named(shuffled(&surface, &order, &names));
    for energy in ["H + A", "H + L", "H + A + L", "H + Lb"] {
        let options =
            MapOptions { tolerance: 1e-11, weight: Weight::Unit, valid: Valid::Off, ..options(energy, Start::Auto) };
        let a = map_input(&named(surface.clone()), &options, &mut Silent).unwrap();
        let b = map_input(&renamed, &options, &mut Silent).unwrap();
        assert_ne!(names[a.domain.graph.boundary[0] as usize], b.domain.graph.boundary[0], "another gauge");
        let [ea, eb] = [&a, &b].map(|mapped| mapped.map.total.unwrap());
        assert!((ea - eb).abs() < 1e-9 * ea + 1e-16, "{energy}: {ea:e} {eb:e}");
        // All distances agree, the white offset included: |g| is down to 1e-11.
        let far = surface.positions().len() - 1;
        for v in 0..far {
            let da = (a.map.z[v] - a.map.z[far]).norm();
            let db = (b.map.z[names[v] as usize] - b.map.z[names[far] as usize]).norm();
            assert!((da - db).abs() < 1e-5, "{energy} {v}: {da} {db}");
        }
    }
}
