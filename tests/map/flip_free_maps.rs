//! Maps by energies that are infinite where a face folds, alone and beside others.

use riemap::input::Input;
use riemap::map::{self, Boundary, MapError, MapOptions, Mapped};
use riemap::solver::Silent;

fn mapped(surface: &str, energy: &str, boundary: Boundary) -> Mapped {
    let options = MapOptions { energy: Some(energy.parse().unwrap()), boundary, ..MapOptions::default() };
    let input = Input::open(surface).unwrap();
    map::map_input(&input, &options, &mut Silent).unwrap_or_else(|error| panic!("{surface} {energy}: {error}"))
}

fn energy_of(mapped: &Mapped, name: &str) -> f64 {
    mapped.map.energies.iter().find(|(n, _)| *n == name).unwrap().1
}

#[test]
fn flat_meshes_are_found_again_from_the_circle() {
    for mesh in ["quad", "triangle", "delaunay"] {
        for energy in ["SD", "MIPS", "MIPS + Lb", "SD + L"] {
            let mapped = mapped(&format!("plane?n=10&mesh={mesh}"), energy, Boundary::FREE);
            // A minimum of 0, reached to |∇E| = 1e-10 of the start's.
            assert!(mapped.map.total.unwrap() < 1e-16, "{mesh} {energy}: {:e}", mapped.map.total.unwrap());
            assert!(mapped.validity.is_one_to_one());
            let distortion = mapped.distortion.quasi_conformal.unwrap();
            assert!(distortion.max < 1.0 + 1e-7, "{mesh} {energy}: {}", distortion.max);
            let lengths = mapped.distortion.length.unwrap().max;
            assert!(lengths < 1.0 + 1e-7, "{mesh} {energy}: {lengths}");
        }
    }
}

#[test]
fn every_combination_gives_a_map_without_folds() {
    for surface in
        ["graph:saddle?n=10&amplitude=2&mesh=delaunay", "graph:cos+cos?n=10&mesh=quad", "sphere?n=10&mesh=triangle"]
    {
        for (energy, boundary) in [
            ("H + 0.01 MIPS", Boundary::FIXED),
            ("H + 0.01 MIPS", Boundary::FREE),
            ("H + C + 0.01 MIPS", Boundary::CIRCLE),
            ("MIPS", Boundary::FIXED),
            ("H + Lb + 0.1 SD", Boundary::FREE),
            ("SD", Boundary::FREE),
        ] {
            let mapped = mapped(surface, energy, boundary.clone());
            assert!(mapped.validity.is_locally_one_to_one(), "{surface} {energy} {boundary:?}");
            let total: f64 = mapped.map.total.unwrap();
            assert!(total.is_finite() && total > 0.0);
        }
    }
}

/// MIPS is the lower the more conformal: beside H it must not be higher than under H alone, and the other way round.
#[test]
fn each_energy_is_lowest_under_itself() {
    let surface = "graph:cos+cos?n=13&mesh=delaunay";
    let [h, both, mips] = ["H", "H + MIPS", "MIPS"].map(|energy| mapped(surface, energy, Boundary::FIXED));
    assert!(energy_of(&h, "H") < energy_of(&both, "H"));
    assert!(energy_of(&mips, "MIPS") < energy_of(&both, "MIPS"));
}

/// The unit of H is the image's area, and MIPS is made to follow: the map must not know the unit of the surface.
#[test]
fn the_compromise_of_h_and_mips_does_not_depend_on_the_unit_of_length() {
    let at = |scale: f64| {
        let mut input = Input::open("graph:cos+cos?n=11&mesh=delaunay").unwrap();
        input.surface.positions_mut().iter_mut().for_each(|p| *p = p.map(|x| scale * x));
        let options = MapOptions {
            energy: Some("H + 0.1 MIPS".parse().unwrap()),
            boundary: Boundary::FIXED,
            ..MapOptions::default()
        };
        map::map_input(&input, &options, &mut Silent).unwrap().map.z
    };
    let (a, b) = (at(1.0), at(1000.0));
    // |∇E| at 1e-10 of the start's.
    assert!(crate::common::largest_difference(&a, &b) < 1e-8);
}

#[test]
fn a_start_that_cannot_be_is_an_error() {
    // An inner vertex held where the faces around it must fold.
    let options = MapOptions {
        energy: Some("MIPS".parse().unwrap()),
        boundary: Boundary::FIXED,
        pins: vec![map::Pin { vertex: 12, place: [5.0, 5.0] }],
        ..MapOptions::default()
    };
    let error = map::map_input(&Input::open("plane?n=4&mesh=quad").unwrap(), &options, &mut Silent).unwrap_err();
    assert!(matches!(error, MapError::NoValidStart { .. }), "{error}");
}
