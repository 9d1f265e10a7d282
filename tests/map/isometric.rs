//! Isometric maps by Newton's method from the free map.

use crate::common::data_folder;
use riemap::input::Input;
use riemap::map::{self, Boundary, Ending, MapOptions, Mapped};
use riemap::solver::{Silent, Status};

fn mapped(surface: &str, solver: &str) -> Mapped {
    let options = MapOptions {
        energy: Some("SD".parse().unwrap()),
        boundary: Boundary::FREE,
        solver: solver.into(),
        ..MapOptions::default()
    };
    let input = Input::open(surface).unwrap();
    map::map_input(&input, &options, &mut Silent).unwrap_or_else(|error| panic!("{surface} {solver}: {error}"))
}

#[track_caller]
fn takes_at_most(steps: usize, surface: &str) -> Mapped {
    let found = mapped(surface, "auto");
    assert_eq!(found.map.provenance.solver, "newton");
    assert_eq!(found.map.ending, Ending::Minimised(Status::Converged));
    assert!(found.map.iterations <= steps, "{surface}: {}", found.map.iterations);
    assert!(found.validity.is_locally_one_to_one(), "{surface}");
    found
}

#[test]
fn newtons_method_takes_at_most_twenty_steps_to_the_minimum_of_the_other_minimisers() {
    for n in [20, 50] {
        for seed in [1, 2, 3] {
            let surface = format!("graph:cos+cos?n={n}&mesh=delaunay&points=random&seed={seed}");
            let found = takes_at_most(20, &surface);
            let other = mapped(&surface, "levenberg-marquardt");
            let [ours, theirs] = [&found, &other].map(|mapped| mapped.map.total.unwrap());
            // |∇E| at 1e-10 of the start's: the energy is right to its square, and to rounding.
            assert!((ours - theirs).abs() <= 1e-9 * theirs, "{surface}: {ours} against {theirs}");
        }
    }
}

/// Five to nine steps, whatever the mesh width.
#[test]
fn the_number_of_steps_does_not_grow_with_the_mesh() {
    for surface in ["sphere", "enneper", "torus-patch", "catenoid"] {
        for n in [10, 20, 40, 80] {
            takes_at_most(10, &format!("{surface}?n={n}&mesh=delaunay"));
        }
    }
}

/// The energy of the start is 18 and 7 times the least, nearly all of it at the tips, where it is like x⁻².
#[test]
fn public_meshes_with_tips_take_at_most_twenty_steps() {
    let Some(folder) = data_folder() else {
        println!("skipped: no public meshes in $RIEMAP_DATA, ../shared/data or data");
        return;
    };
    for name in ["tri/camelhead.off", "tri/three_peaks.off", "tri/bff-face.obj"] {
        takes_at_most(20, folder.join(name).to_str().unwrap());
    }
}
