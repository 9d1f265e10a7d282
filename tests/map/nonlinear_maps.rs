//! Nonlinear maps through the whole pipeline: energies reached, iterations, constraints, gauge, order, refusals.

use crate::common::*;
use num_complex::Complex64;
use riemap::constraint::float_white_back;
use riemap::energy::conformal::Weight;
use riemap::input::Input;
use riemap::map::{
    Boundary, Ending, FlatOptions, MapError, MapOptions, Mapped, OptionsError, Pin, PinnedPoints, Valid, map_input,
};
use riemap::solver::{LINEAR_SOLVERS, MINIMISERS, Silent, Status, linear_solver};
use riemap::surface::Surface;

/// The unit circle, boundary points kept in order.
fn in_order() -> Boundary {
    Boundary::Circle { pinned: PinnedPoints::Three, ordered: true }
}

fn options(energy: &str, weight: Weight) -> MapOptions {
    let energy = (!energy.is_empty()).then(|| energy.parse().unwrap());
    let boundary = if energy.as_ref().is_none_or(|e: &riemap::energy::Expression| e.is_on_circle()) {
        Boundary::CIRCLE
    } else {
        Boundary::FREE
    };
    // The plain maps, folds and all.
    MapOptions { boundary, energy, weight, valid: Valid::Off, ..MapOptions::default() }
}

fn input(surface: Surface) -> Input {
    Input::of("test".to_owned(), surface)
}

#[track_caller]
fn map(name: &str, options: &MapOptions) -> Mapped {
    map_input(&Input::open(name).unwrap(), options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn refusal(name: &str, options: &MapOptions) -> MapError {
    map_input(&Input::open(name).unwrap(), options, &mut Silent).err().unwrap()
}

fn total(mapped: &Mapped) -> f64 {
    mapped.map.total.unwrap()
}

fn show(what: &str, mapped: &Mapped) {
    let Mapped { map, distortion, .. } = mapped;
    println!(
        "{what}: {} {} after {}, E {:e}, |g| {:?}, sigma {:?}, flipped {}",
        map.provenance,
        map.ending.name(),
        map.iterations,
        total(mapped),
        map.gradient_norm,
        map.smallest_singular_value,
        distortion.flipped
    );
}

const GRID_33: &str = "graph:cos+cos?n=33";

#[test]
fn energies_with_unit_weights_are_those_of_an_independent_minimiser() {
    // Six digits are given.
    for (energy, value, iterations) in
        [("H + L", 0.276504, 100), ("H + A", 0.014594944, 100), ("H + A + L", 0.290419, 100)]
    {
        let mapped = map(GRID_33, &options(energy, Weight::Unit));
        show(energy, &mapped);
        assert!((total(&mapped) / value - 1.0).abs() < 2e-6, "{energy}: {}", total(&mapped));
        assert!(mapped.map.iterations <= iterations, "{energy}: {}", mapped.map.iterations);
        assert_eq!(mapped.distortion.flipped, 0, "{energy}");
        assert_eq!(mapped.map.ending, Ending::Minimised(Status::Converged), "{energy}");
    }
    let circle = map(GRID_33, &options("H + C", Weight::Unit));
    show("H + C", &circle);
    assert!(total(&circle) < 1e-15 && circle.map.iterations <= 20, "{}", total(&circle));
    assert!(circle.map.smallest_singular_value.unwrap() > 1e-3);
    assert!(circle.validity.is_one_to_one() && circle.distortion.boundary_out_of_order == Some(0));
}

#[test]
fn boundary_lengths_are_kept_exactly() {
    for weight in [Weight::Unit, Weight::Integral] {
        let options = MapOptions { tolerance: 1e-16, ..options("", weight) };
        let mapped = map(GRID_33, &MapOptions { boundary: Boundary::FREE, ..options });
        show("H + L'", &mapped);
        assert!(total(&mapped) < 1e-25, "{weight:?}: {}", total(&mapped));
        assert!(mapped.map.iterations <= 100, "{weight:?}: {}", mapped.map.iterations);
        let graph = &mapped.domain.graph;
        for (k, &v) in graph.boundary.iter().enumerate() {
            let next = graph.boundary[(k + 1) % graph.boundary.len()];
            let length = (mapped.map.z[next as usize] - mapped.map.z[v as usize]).norm();
            // L' sums (2 l δ)² and more: δ is 1e-12 or so.
            assert!((length / graph.boundary_length[k] - 1.0).abs() < 1e-11);
        }
    }
}

#[test]
fn energies_with_integral_weights_converge_to_those_of_the_table() {
    // Six digits are given.
    for (energy, values) in [
        ("H + L", [1.83956, 1.85718, 1.86030]),
        ("H + A", [1.34967, 1.38553, 1.39222]),
        ("H + A + L", [2.49107, 2.53035, 2.53759]),
    ] {
        for (n, value) in [17, 33, 49].into_iter().zip(values).filter(|(n, _)| (energy, *n) != ("H + A + L", 17)) {
            let mapped = map(&format!("graph:cos+cos?n={n}"), &options(energy, Weight::Integral));
            show(&format!("integral {energy} {n}"), &mapped);
            assert!((total(&mapped) - value).abs() < 1e-5, "{energy} {n}: {}", total(&mapped));
            assert!(mapped.map.iterations <= 100, "{energy} {n}: {}", mapped.map.iterations);
        }
    }
}

/// There is another minimum, 3.134249, with three quads that are not convex.
#[test]
fn levenberg_marquardt_finds_the_lower_of_two_minima() {
    let mapped = map("graph:cos+cos?n=17", &options("H + A + L", Weight::Integral));
    assert!((total(&mapped) - 2.49107).abs() < 1e-5, "{}", total(&mapped));
}

#[test]
fn first_order_backends_find_the_lower_of_two_minima() {
    for backend in &MINIMISERS[1..] {
        let solver = backend.name().into();
        let options = MapOptions { solver, tolerance: 1e-6, ..options("H + A + L", Weight::Integral) };
        let mapped = map("graph:cos+cos?n=17", &options);
        show("integral H + A + L 17", &mapped);
        assert!((total(&mapped) - 2.49107).abs() < 1e-5, "{}: {}", backend.name(), total(&mapped));
    }
}

#[test]
fn first_order_backends_reach_the_same_energies() {
    // Their tolerance: the energy is right to 1e-6 long before.
    for (energy, tolerance) in [("H + C", 1e-9), ("H + L", 1e-6), ("H + A + L", 1e-6)] {
        let reference = map("graph:cos+cos?n=17", &options(energy, Weight::Unit));
        for backend in &MINIMISERS[1..] {
            let options = MapOptions { solver: backend.name().into(), tolerance, ..options(energy, Weight::Unit) };
            let mapped = map("graph:cos+cos?n=17", &options);
            show(energy, &mapped);
            let apart = (total(&mapped) - total(&reference)).abs();
            assert!(apart < 1e-6 * total(&reference), "{energy} {}: {apart:e}", backend.name());
        }
    }
}

#[test]
fn triangle_meshes_keep_their_boundary_lengths_and_circles_too() {
    for dual in ["barycentre", "incentre"] {
        for mesh in ["triangle", "delaunay"] {
            let name = format!("sphere?n=8&mesh={mesh}");
            let with = |energy| MapOptions { dual: dual.to_owned(), ..options(energy, Weight::Integral) };
            let free = map(&name, &with("H + Lb"));
            show(&format!("{name} {dual} free"), &free);
            // The edges of the mesh have their lengths, and (2) holds; L', over half edges, is not 0 then.
            let lengths = free.distortion.length.and_then(|length| length.boundary_max).unwrap();
            assert!(lengths < 1e-9, "{name} {dual}: {lengths:e}");
            let h = free.map.energies.iter().find(|(name, _)| *name == "H").unwrap().1;
            assert!(h < 1e-20, "{name} {dual}: {h:e}");
            let circle = map(&name, &with("H + C"));
            show(&format!("{name} {dual} circle"), &circle);
            assert!(circle.map.iterations <= 20, "{name} {dual}: {}", circle.map.iterations);
            // (2) holds; dual points are on the circle of 1 − ε, O(h²) inside that of the mesh's vertices.
            assert!(total(&circle) < 2e-3, "{name} {dual}: {}", total(&circle));
            assert!(free.distortion.flipped == 0 && circle.distortion.flipped == 0, "{name} {dual}");
        }
    }
}

#[test]
fn two_fixed_points_are_seen_in_the_singular_value() {
    let name = "graph:cos+cos?n=9";
    for weight in [Weight::Unit, Weight::Integral] {
        let solver = riemap::map::SolverChoice::from("levenberg-marquardt");
        let of = |pinned| {
            let boundary = Boundary::Circle { pinned, ordered: false };
            map(name, &MapOptions { boundary, solver: solver.clone(), ..options("", weight) })
        };
        let (two, three) = (of(PinnedPoints::Two), of(PinnedPoints::Three));
        assert!(two.map.smallest_singular_value.unwrap() < 1e-7);
        assert!(three.map.smallest_singular_value.unwrap() > 1e-2);
        assert_eq!((two.map.fixed.len(), three.map.fixed.len()), (2, 3));
        // Held points are on the circle.
        assert!(three.map.fixed.iter().all(|(_, place)| (place.norm() - 1.0).abs() < 1e-15));
    }
    for fix in [0, 1, 4] {
        let flat = FlatOptions { fix: Some(fix), ..FlatOptions::default() };
        assert_eq!(MapOptions::try_from(flat).unwrap_err(), OptionsError::FixedPoints { fix });
    }
}

/// Boundary vertices of the grid of n × n, counter-clockwise as its surface has them.
fn boundary_of(name: &str) -> Vec<u32> {
    let disc = disc_of(name);
    disc.boundary.iter().map(|&v| disc.source_vertex[v as usize]).collect()
}

#[test]
fn pins_take_the_place_of_the_three_points_and_must_follow_each_other() {
    let name = "graph:cos+cos?n=9";
    let boundary = boundary_of(name);
    let at = |k: usize, angle: f64| {
        let place = Complex64::cis(angle);
        Pin { vertex: boundary[k], place: [place.re, place.im] }
    };
    let pins = vec![at(0, 0.5), at(9, 2.0), at(20, 4.0)];
    let mapped = map(name, &MapOptions { pins: pins.clone(), ..options("", Weight::Integral) });
    for pin in &pins {
        // Their angles are met to the accuracy of Newton's method.
        assert!((mapped.map.z[pin.vertex as usize] - Complex64::new(pin.place[0], pin.place[1])).norm() < 1e-12);
    }
    assert_eq!(mapped.map.fixed.len(), 3);
    let wrong = vec![at(0, 0.5), at(9, 4.0), at(20, 2.0)];
    let error = refusal(name, &MapOptions { pins: wrong, ..options("", Weight::Integral) });
    assert_eq!(error, MapError::PinsOutOfOrder { vertex: boundary[20] });
    let missing = vec![Pin { vertex: 81, place: [1.0, 0.0] }];
    let error = refusal(name, &MapOptions { pins: missing, ..options("", Weight::Integral) });
    assert_eq!(error, MapError::NotInUse { vertex: 81 });
}

#[test]
fn the_white_offset_of_h_and_a_minimises_l() {
    for name in ["graph:cos+cos?n=9", "sphere?n=6&mesh=delaunay"] {
        let options = options("H + A", Weight::Unit);
        let mapped = map(name, &options);
        let metric = mapped.domain.rest_metric(&options).unwrap();
        let l = |z: &[Complex64]| -> f64 {
            let edges = metric.edges.iter().zip(&metric.length);
            edges.map(|(&[a, b], l)| ((z[a as usize] - z[b as usize]).norm_sqr() - l * l).powi(2)).sum()
        };
        let (class, _) = mapped.domain.graph.diagonal_classes();
        let here = l(&mapped.map.z);
        for k in 0..8 {
            let offset = 1e-4 * Complex64::cis(f64::from(k));
            let shifted = mapped.map.z.iter().zip(&class).map(|(z, &c)| if c == class[0] { *z } else { z + offset });
            assert!(l(&shifted.collect::<Vec<_>>()) > here, "{name} {k}");
        }
        // And from anywhere else it is found again.
        let far = Complex64::new(0.3, -0.2);
        let mut z: Vec<_> =
            mapped.map.z.iter().zip(&class).map(|(z, &c)| if c == class[0] { *z } else { z + far }).collect();
        float_white_back(&mapped.domain.graph, &metric, &mut z);
        let apart = |v: usize, w: usize| (z[v] - z[w]) - (mapped.map.z[v] - mapped.map.z[w]);
        assert!((0..z.len()).all(|v| apart(v, 0).norm() < 1e-6), "{name}");
    }
}

/// A grid of n × n cells without those outside a disc: its boundary is a staircase.
fn staircase(n: u32) -> Surface {
    let grid = quad_grid(n, n, Sides::Free);
    let across = n + 1;
    let place = |v: u32| [f64::from(v % across), f64::from(v / across)].map(|x| 2.0 * x / f64::from(n) - 1.0);
    let positions = (0..across * across).map(|v| {
        let [x, y] = place(v);
        [x, y, 0.3 * x * x + 0.2 * x * y]
    });
    let inside = |face: &[u32]| {
        let corners = face.iter().map(|&v| place(v));
        let [x, y] = corners.fold([0.0; 2], |m, [x, y]| [m[0] + 0.25 * x, m[1] + 0.25 * y]);
        x * x + y * y < 1.0
    };
    surface(positions.collect(), grid.faces().iter().filter(|face| inside(face)))
}

#[test]
fn keep_order_leaves_no_boundary_point_out_of_order_on_a_staircase() {
    let input = input(staircase(16));
    let plain = map_input(&input, &options("", Weight::Integral), &mut Silent).unwrap();
    let kept = MapOptions { boundary: in_order(), ..options("", Weight::Integral) };
    let ordered = map_input(&input, &kept, &mut Silent).unwrap();
    show("plain", &plain);
    show("kept", &ordered);
    println!("{:?} {:?}", plain.distortion.boundary_out_of_order, ordered.distortion.boundary_out_of_order);
    assert!(plain.distortion.boundary_out_of_order.unwrap() > 0);
    assert_eq!(ordered.distortion.boundary_out_of_order, Some(0));
    assert!(total(&ordered) >= total(&plain));
    assert_eq!(ordered.map.energies.len(), 2, "the barrier is no part of the energy that is reported");
    let error =
        map_input(&input, &MapOptions { boundary: in_order(), ..options("H + L", Weight::Integral) }, &mut Silent);
    assert!(matches!(error, Err(MapError::NoCircle { .. })));
}

#[test]
fn keep_order_changes_little_where_the_order_is_kept_anyway() {
    let name = "graph:cos+cos?n=9";
    let plain = map(name, &options("", Weight::Integral));
    let kept = map(name, &MapOptions { boundary: in_order(), ..options("", Weight::Integral) });
    // The last coefficient of the barrier is 1e-8, its gradient at most the number of points over their gaps.
    assert!(largest_difference(&plain.map.z, &kept.map.z) < 1e-4);
}

#[test]
fn what_does_not_converge_is_an_error_unless_the_end_was_set() {
    let name = "graph:cos+cos?n=33";
    for solver in ["fletcher-reeves", "auto"] {
        let options = MapOptions { solver: solver.into(), max_iterations: Some(2), ..options("H + L", Weight::Unit) };
        let mapped = map(name, &options);
        assert_eq!((mapped.map.ending, mapped.map.iterations), (Ending::Minimised(Status::MaxIterations), 2));
    }
    // Two stages share the iterations.
    for max_iterations in [1, 5] {
        let options = MapOptions { max_iterations: Some(max_iterations), ..options("H + Lb", Weight::Integral) };
        assert!(map(name, &options).map.iterations <= max_iterations);
    }
    // Out of reach of doubles and of conjugate gradients' default number of iterations alike.
    let never = MapOptions { solver: "cg-exact".into(), tolerance: 1e-300, ..options("H + C", Weight::Unit) };
    match map_input(&Input::open("graph:cos+cos?n=9").unwrap(), &never, &mut Silent) {
        Ok(mapped) => assert_eq!(mapped.map.ending, Ending::Minimised(Status::Precision)),
        Err(error) => assert!(matches!(error, MapError::NotConverged { .. }), "{error}"),
    }
}

#[test]
fn an_interrupted_map_is_the_initial_one_and_says_so() {
    for (energy, boundary) in [("H + C", Boundary::CIRCLE), ("H + C", in_order()), ("H + Lb", Boundary::FREE)] {
        let input = Input::open("graph:cos+cos?n=9").unwrap();
        let options = MapOptions { boundary, ..options(energy, Weight::Integral) };
        let mapped = map_input(&input, &options, &mut Stopper(0)).unwrap();
        assert_eq!((mapped.map.ending, mapped.map.iterations), (Ending::Minimised(Status::Interrupted), 0));
        assert!(mapped.map.z.iter().all(|z| z.is_finite()) && mapped.distortion.flipped == 0);
    }
}

#[test]
fn options_that_make_no_problem_are_refused() {
    let name = "graph:cos+cos?n=9";
    let alone = MapOptions { boundary: Boundary::CIRCLE, ..options("H", Weight::Integral) };
    assert_eq!(refusal(name, &alone), MapError::FreeBoundary);
    assert_eq!(refusal(name, &options("2 H", Weight::Integral)), MapError::FreeBoundary);
    for tolerance in [0.0, -1.0, 1.0, f64::NAN, f64::INFINITY] {
        let error = refusal(name, &MapOptions { tolerance, ..options("", Weight::Integral) });
        assert!(matches!(error, MapError::Tolerance { .. }));
    }
    for backend in LINEAR_SOLVERS {
        let error = refusal(name, &MapOptions { solver: backend.name().into(), ..options("", Weight::Integral) });
        assert!(matches!(error, MapError::NotAMinimiser { ref name, .. } if name == backend.name()), "{error}");
    }
    for backend in MINIMISERS {
        assert!(linear_solver(backend.name()).is_none());
        let fixed = MapOptions { boundary: Boundary::FIXED, ..options("", Weight::Integral) };
        let error = refusal(name, &MapOptions { solver: backend.name().into(), ..fixed });
        assert!(matches!(error, MapError::Solve(_)), "{}: {error}", backend.name());
    }
}

#[test]
fn sums_without_a_scale_or_a_place_are_refused_or_mapped_without_nan() {
    // What no energy of the sum determines must not come out as NaN or collapse in silence.
    for energy in ["C", "A", "L", "Lb", "H + C + A", "C + L", "H + C + Lb", "A + Lb"] {
        match map_input(&Input::open("graph:cos+cos?n=7").unwrap(), &options(energy, Weight::Integral), &mut Silent) {
            Ok(mapped) => {
                show(energy, &mapped);
                assert!(mapped.map.z.iter().all(|z| z.is_finite()), "{energy}");
                assert!(total(&mapped).is_finite(), "{energy}");
            }
            Err(error) => println!("{energy}: {error}"),
        }
    }
}

#[test]
fn a_fixed_boundary_takes_metric_energies_for_the_interior() {
    let name = "graph:cos+cos?n=9";
    let fixed = |energy| MapOptions { boundary: Boundary::FIXED, ..options(energy, Weight::Integral) };
    let (both, h) = (map(name, &fixed("H + L")), map(name, &fixed("H")));
    assert_eq!(h.map.ending, Ending::Solved);
    for &v in &both.domain.graph.boundary {
        assert_eq!(both.map.z[v as usize], h.map.z[v as usize]);
    }
    // Each is lower in its own energy.
    assert!(both.map.energies[0].1 > total(&h));
    assert!(largest_difference(&both.map.z, &h.map.z) > 1e-3);
    // With little L it is nearly the linear map.
    let little = map(name, &fixed("H + 1e-6 L"));
    assert!(largest_difference(&little.map.z, &h.map.z) < 1e-4);
}

#[test]
fn developable_surfaces_are_unrolled() {
    for energy in ["H + Lb", "H + L", "H + A + L"] {
        let energies = [8, 16, 32].map(|n| {
            let mapped = map(&format!("cylinder?n={n}&mesh=quad"), &options(energy, Weight::Integral));
            show(&format!("cylinder {n} {energy}"), &mapped);
            assert_eq!(mapped.distortion.flipped, 0);
            total(&mapped)
        });
        println!("{energy}: order {:.2}", fitted_order(&[8.0, 16.0, 32.0], &energies));
        assert!(energies[2] < 1e-4, "{energy}: {energies:?}");
        if energy != "H + Lb" {
            // Chords are shorter than arcs by O(h²), squared.
            assert!(fitted_order(&[8.0, 16.0, 32.0], &energies) > 3.5, "{energy}: {energies:?}");
        }
    }
}
