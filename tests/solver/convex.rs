//! Convex combination maps: `--boundary fixed --weights`.

use crate::common::{disc, largest_difference, surface};
use num_complex::Complex64;
use riemap::constraint::Shape;
use riemap::input::Input;
use riemap::map::{
    self, Boundary, FlatOptions, Interior, MapError, MapOptions, Mapped, OptionsError, Outline, Pin, Provenance, Valid,
};
use riemap::solver::Silent;
use riemap::solver::convex::EDGE_WEIGHTS;
use riemap::surface::Surface;

fn options(weights: &str) -> MapOptions {
    on(Outline::Shape(Shape::Circle), weights)
}

fn on(on: Outline, weights: &str) -> MapOptions {
    let boundary = Boundary::Fixed { on, hold: None, interior: Interior::Weights(weights.to_owned()) };
    MapOptions { boundary, ..MapOptions::default() }
}

fn mapped(name: &str, options: &MapOptions) -> Mapped {
    map::map_input(&Input::open(name).unwrap(), options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// What `flat` does under the weights with its boundary held where it lies.
fn of_flat(flat: &Surface, weights: &str) -> (Vec<Complex64>, Mapped) {
    let boundary = disc(flat).boundary;
    let places = boundary.iter().map(|&vertex| {
        let [x, y, _] = flat.positions()[vertex as usize];
        Pin { vertex, place: [x, y] }
    });
    let options = on(Outline::Places(places.collect()), weights);
    let input = Input::of("flat".to_owned(), flat.clone());
    let z = flat.positions().iter().map(|&[x, y, _]| Complex64::new(x, y)).collect();
    (z, map::map_input(&input, &options, &mut Silent).unwrap())
}

#[test]
fn mean_value_and_cotan_weights_leave_flat_meshes_as_they_are() {
    for (name, weights) in [
        ("plane?n=12&mesh=delaunay&points=random&seed=4", "mean-value"),
        ("plane?n=12&mesh=delaunay&points=random&seed=4", "cotan"),
        ("plane?n=9&jitter=0.4&seed=2", "mean-value"),
    ] {
        let flat = Input::open(name).unwrap().surface;
        let (z, mapped) = of_flat(&flat, weights);
        // Rounding, times what a system of a few hundred unknowns adds to it.
        let difference = largest_difference(&z, &mapped.map.z);
        assert!(difference < 1e-13, "{name} {weights}: {difference:e}");
        assert!(mapped.validity.is_one_to_one() && mapped.map.residual.unwrap() < 1e-14);
    }
}

#[test]
fn uniform_weights_do_not_leave_them() {
    let flat = Input::open("plane?n=9&jitter=0.4&seed=2").unwrap().surface;
    let (z, mapped) = of_flat(&flat, "uniform");
    assert!(largest_difference(&z, &mapped.map.z) > 1e-3);
}

#[test]
fn cotan_weights_are_the_map_of_circumcentres() {
    for name in ["sphere?n=16&mesh=delaunay&points=random&seed=3", "graph:saddle?n=12&amplitude=4&mesh=triangle"] {
        let circumcentres =
            MapOptions { boundary: Boundary::FIXED, dual: "circumcentre".to_owned(), ..MapOptions::default() };
        let known = mapped(name, &circumcentres);
        let found = mapped(name, &options("cotan"));
        let primal = found.domain.graph.primal;
        let difference = largest_difference(&found.map.z[..primal], &known.map.z);
        assert!(difference < 1e-11, "{name}: {difference:e}");
    }
}

#[test]
fn positive_weights_give_maps_that_are_one_to_one_whatever_the_shape() {
    let names = ["graph:saddle?n=20&amplitude=30&mesh=triangle", "graph:cos+cos?n=20&amplitude=10&jitter=0.4&seed=1"];
    for row in EDGE_WEIGHTS.iter().filter(|row| row.convex) {
        for name in names {
            let mapped = mapped(name, &options(row.name));
            assert!(mapped.validity.is_one_to_one(), "{name} {}", row.name);
            assert_eq!(mapped.map.provenance, Provenance::of(row.name));
        }
    }
}

/// A finger of rings of `girth` vertices, closed at its tip by a fan: in Tutte's map each is a fraction of the size of the one before.
fn finger(girth: u32, rings: u32) -> Surface {
    let point = |k: u32, i: u32| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(girth);
        [angle.cos(), angle.sin(), f64::from(k)]
    };
    let mut positions: Vec<_> = (0..rings).flat_map(|k| (0..girth).map(move |i| point(k, i))).collect();
    positions.push([0.0, 0.0, f64::from(rings)]);
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for k in 0..rings {
        for i in 0..girth {
            let at = |k: u32, i: u32| if k == rings { girth * rings } else { girth * k + i % girth };
            faces.push([at(k, i), at(k, i + 1), at(k + 1, i)]);
            if k + 1 < rings {
                faces.push([at(k, i + 1), at(k + 1, i + 1), at(k + 1, i)]);
            }
        }
    }
    surface(positions, faces)
}

#[test]
fn what_rounding_spoils_is_drawn_outward() {
    for girth in [3, 4, 7] {
        let finger = Input::of("finger".to_owned(), finger(girth, 400));
        let run =
            |valid: Valid| map::map_input(&finger, &MapOptions { valid, ..options("uniform") }, &mut Silent).unwrap();
        let spoiled = run(Valid::Off);
        assert!(!spoiled.validity.is_one_to_one() && !spoiled.map.provenance.is_repaired(), "{girth}");
        let mended = run(Valid::Auto);
        assert!(
            mended.validity.is_one_to_one()
                && mended.map.provenance.is_repaired()
                && mended.map.provenance.to_string() == "outward",
            "{girth}"
        );
    }
}

#[test]
fn weights_beside_an_energy_or_another_boundary_are_refused() {
    let input = Input::open("plane?n=4").unwrap();
    let refused = |options: MapOptions| map::map_input(&input, &options, &mut Silent).unwrap_err();
    let circle = FlatOptions { weights: Some("uniform".to_owned()), ..FlatOptions::default() };
    let refusal = MapOptions::try_from(circle).unwrap_err();
    assert!(matches!(refusal, OptionsError::OtherBoundary { key: "weights", .. }), "{refusal}");
    let energy = MapOptions { energy: Some("H".parse().unwrap()), ..options("uniform") };
    assert!(matches!(refused(energy), MapError::WeightsOfNothing { .. }));
    assert!(refused(options("frob")).to_string().contains("mean-value"));
    assert!(refused(options("cotan")).to_string().contains("triangles"));
}
