//! Solver `reduced`: exactly conformal circle maps, and free maps whose boundary edges have their lengths.

use std::f64::consts::TAU;

use crate::common::*;
use num_complex::Complex64;
use riemap::energy::conformal::{Weight, normal_product, normal_product_scale, weights};
use riemap::input::Input;
use riemap::map::{
    Boundary, Ending, Exactly, MapError, MapOptions, Mapped, Pin, Provenance, RhoSource, Valid, map_input,
};
use riemap::quad_graph::curvature;
use riemap::solver::boundary::{BoundaryError, Reduction};
use riemap::solver::{Silent, Status};

fn circle(solver: &str) -> MapOptions {
    // The plain maps, folds and all.
    MapOptions { solver: solver.into(), valid: Valid::Off, ..MapOptions::default() }
}

fn free(solver: &str) -> MapOptions {
    MapOptions { boundary: Boundary::FREE, ..circle(solver) }
}

#[track_caller]
fn map(name: &str, options: &MapOptions) -> Mapped {
    map_input(&Input::open(name).unwrap(), options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn refusal(name: &str, options: &MapOptions) -> MapError {
    map_input(&Input::open(name).unwrap(), options, &mut Silent).err().unwrap()
}

fn h(mapped: &Mapped) -> f64 {
    mapped.map.energies[0].1
}

/// Largest relative error of the length of a boundary edge of the mesh.
fn length_error(mapped: &Mapped) -> f64 {
    mapped.distortion.length.unwrap().boundary_max.unwrap()
}

#[test]
fn products_are_those_of_the_whole_matrix_with_the_interior_at_rest() {
    for (name, graph) in graphs() {
        if graph.min_re_rho() <= 0.0 {
            continue;
        }
        let w = weights(&graph, Weight::Integral).unwrap();
        let reduction = Reduction::new(&graph, |_| ()).unwrap();
        let mut random = Random(7);
        // Twice: nothing is left over from one product to the next.
        for _ in 0..2 {
            let z: Vec<Complex64> = graph.boundary.iter().map(|_| random.complex()).collect();
            let whole = reduction.extend(&z);
            let product = normal_product(&graph, &w, &whole);
            let scale = normal_product_scale(&graph, &w, &whole).into_iter().fold(0.0, f64::max);
            let m = reduction.m(&z);
            let mut is_boundary = vec![false; graph.vertices];
            for (k, &v) in graph.boundary.iter().enumerate() {
                is_boundary[v as usize] = true;
                // Rounding of a solve whose condition is that of a small Laplacian.
                assert!((product[v as usize] - m[k]).norm() < 1e-12 * scale, "{name} {k}");
            }
            let inside = (0..graph.vertices).filter(|&v| !is_boundary[v]);
            assert!(inside.map(|v| product[v].norm()).fold(0.0, f64::max) < 1e-12 * scale, "{name}");
            // S is real, symmetric, and knows neither colour's constant.
            let y: Vec<Complex64> = z.iter().map(|z| Complex64::new(z.re, 0.0)).collect();
            let (s, sy) = (reduction.s(&z), reduction.s(&y));
            let dot = |a: &[Complex64], b: &[Complex64]| a.iter().zip(b).map(|(a, b)| a.re * b.re).sum::<f64>();
            assert!(sy.iter().all(|s| s.im == 0.0), "{name}");
            assert!((dot(&y, &s) - dot(&z, &sy)).abs() < 1e-12 * scale, "{name}");
            for colour in 0..2 {
                assert!(s.iter().skip(colour).step_by(2).sum::<Complex64>().norm() < 1e-12 * scale, "{name}");
            }
        }
    }
}

#[test]
fn k_is_a_quarter_of_the_central_difference_along_the_boundary() {
    let disc = disc_of("graph:cos+cos?n=5&jitter=0.2");
    let graph = graph_of(&disc, "barycentre");
    let reduction = Reduction::new(&graph, |_| ()).unwrap();
    let w = weights(&graph, Weight::Integral).unwrap();
    let n = graph.boundary.len();
    for k in 0..n {
        // The imaginary part of a column of the whole matrix.
        let mut z = vec![Complex64::ZERO; graph.vertices];
        z[graph.boundary[k] as usize] = Complex64::ONE;
        let column = normal_product(&graph, &w, &z);
        for (v, entry) in column.iter().enumerate() {
            let expected = match graph.boundary.iter().position(|&b| b as usize == v) {
                Some(j) if (j + 1) % n == k => 0.25,
                Some(j) if (k + 1) % n == j => -0.25,
                _ => 0.0,
            };
            assert!((entry.im - expected).abs() < 1e-14, "{k} {v}: {}", entry.im);
        }
    }
    assert_eq!(reduction.len(), n);
}

#[test]
fn where_an_exact_discrete_map_exists_the_circle_map_is_that_of_levenberg_marquardt() {
    for name in ["graph:cos+cos?n=32", "graph:cos+cos?n=33", "sphere?n=32", "enneper?n=16", "enneper?n=32"] {
        let reduced = map(name, &circle("reduced"));
        let soft = map(name, &MapOptions { tolerance: 1e-13, ..circle("levenberg-marquardt") });
        println!("{name}: ε {:?}, soft {:e}", reduced.map.epsilon, soft.map.total.unwrap());
        assert!(h(&reduced) < 1e-24, "{name}: {:e}", h(&reduced));
        let apart = largest_difference(&reduced.map.z, &soft.map.z);
        // The two circles are √(1 ± ε); the soft map keeps to one. Both minima are exact up to that.
        let epsilon = reduced.map.epsilon.unwrap().abs();
        assert!(apart < 4.0 * epsilon + 1e-8, "{name}: {apart:e}, ε {epsilon:e}");
        assert_eq!((reduced.map.exactly, soft.map.exactly), (Some(Exactly::Conformal), None));
    }
}

#[test]
fn the_boundary_of_a_triangle_mesh_is_on_the_circle_to_rounding_and_pins_are_where_they_are_put() {
    let name = "enneper?n=12&mesh=delaunay";
    let disc = disc_of(name);
    let boundary: Vec<u32> = disc.boundary.iter().map(|&v| disc.source_vertex[v as usize]).collect();
    let n = boundary.len();
    for count in [1, 2, 3] {
        let pins: Vec<Pin> = (0..count)
            .map(|i| {
                // Not evenly: the map has something to do.
                let place = Complex64::cis(0.3 + TAU * (i as f64 / count as f64 + 0.02 * f64::from(i as u32 % 2)));
                Pin { vertex: boundary[i * n / count], place: [place.re, place.im] }
            })
            .collect();
        let mapped = map(name, &MapOptions { pins: pins.clone(), ..circle("auto") });
        assert_eq!((mapped.map.provenance, mapped.map.exactly), (Provenance::of("reduced"), Some(Exactly::Conformal)));
        assert!(mapped.map.residual.unwrap() < 1e-12 && h(&mapped) < 1e-24, "{count}: {:e}", h(&mapped));
        let graph = &mapped.domain.graph;
        let epsilon = mapped.map.epsilon.unwrap();
        for &v in &graph.boundary {
            // White points are on the other circle.
            let radius = if graph.is_dual(v) { ((1.0 - epsilon) / (1.0 + epsilon)).sqrt() } else { 1.0 };
            assert!((mapped.map.z[v as usize].norm() - radius).abs() < 1e-12, "{count}");
        }
        for pin in &pins {
            let v = mapped.domain.disc.source_vertex.binary_search(&pin.vertex).unwrap();
            assert!((mapped.map.z[v] - Complex64::new(pin.place[0], pin.place[1])).norm() < 1e-12, "{count}");
        }
        assert_eq!(mapped.distortion.boundary_out_of_order, Some(0), "{count}");
    }
    // More pins than a Möbius map can meet leave no exactly conformal map: the minimisers take them.
    let pins: Vec<Pin> = (0..5)
        .map(|i| {
            let place = Complex64::cis(TAU * i as f64 / 5.0);
            Pin { vertex: boundary[i * n / 5], place: [place.re, place.im] }
        })
        .collect();
    assert_eq!(map(name, &MapOptions { pins, ..circle("auto") }).map.provenance.to_string(), "levenberg-marquardt");
}

#[test]
fn boundary_lengths_are_kept_to_ten_times_the_tolerance_and_h_vanishes_on_smooth_grids() {
    for name in ["graph:cos+cos?n=17", "graph:cos+cos?n=33", "sphere?n=16", "torus-patch?n=16&mesh=quad"] {
        let mapped = map(name, &free("reduced"));
        println!("{name}: {} steps, H {:e}, lengths {:e}", mapped.map.iterations, h(&mapped), length_error(&mapped));
        assert!(length_error(&mapped) < 1.1e-9, "{name}: {:e}", length_error(&mapped));
        // ε is all that H has, and the lengths decide it: it is at most their error.
        assert!(h(&mapped) < 1e-17, "{name}: {:e}", h(&mapped));
        assert_eq!((mapped.distortion.flipped, mapped.map.exactly), (0, Some(Exactly::Lengths)));
        let soft = map(name, &MapOptions { tolerance: 1e-13, ..free("levenberg-marquardt") });
        let size = soft.map.z.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let apart = largest_difference(&mapped.map.z, &soft.map.z);
        println!("apart {apart:e}");
        assert!(apart < 1e-6 * size, "{name}: {apart:e}");
    }
}

#[test]
fn boundary_edges_of_free_maps_have_their_lengths_and_h_vanishes() {
    for (surface, n) in [("graph:cos+cos?n=", 17), ("graph:cos+cos?n=", 33), ("sphere?n=", 16), ("torus-patch?n=", 16)]
    {
        for kind in ["quad", "triangle"] {
            let name = format!("{surface}{n}&mesh={kind}");
            let mapped = map(&name, &free("reduced"));
            println!(
                "{name}: {} steps, H {:e}, lengths {:e}",
                mapped.map.iterations,
                h(&mapped),
                length_error(&mapped)
            );
            assert!(length_error(&mapped) < 1.1e-9, "{name}: {:e}", length_error(&mapped));
            // On these quads the lengths, met to 1e-9, leave H nothing else.
            assert!(h(&mapped) < 1e-17, "{name}: {:e}", h(&mapped));
            assert_eq!((mapped.distortion.flipped, mapped.map.exactly), (0, Some(Exactly::Lengths)));
        }
    }
}

#[test]
fn cones_and_fans_are_flattened_at_their_true_size() {
    let Some(folder) = data_folder() else { return };
    for (file, mean) in [("flatten/cone64.obj", 1.41508), ("flatten/fan1000.obj", 1.01981)] {
        let path = folder.join(file);
        if !path.exists() {
            continue;
        }
        let mapped = map(path.to_str().unwrap(), &free("auto"));
        assert!(length_error(&mapped) < 1.1e-9, "{file}: {:e}", length_error(&mapped));
        let error = mapped.distortion.quasi_conformal.unwrap().mean;
        // The numbers of a prototype that keeps the lengths by multipliers.
        assert!(error < mean, "{file}: {error}");
        assert_eq!(mapped.distortion.flipped, 0, "{file}");
    }
}

#[test]
fn free_maps_of_public_discs_have_the_lengths_of_their_boundary() {
    let Some(folder) = data_folder() else { return };
    let discs =
        ["bff-face.obj", "camelhead.off", "cat_head.obj", "maze.obj", "three_peaks.off"].map(|f| format!("tri/{f}"));
    for file in discs.into_iter().chain(["quad/inspired_mesh_quads_Smooth.off", "flatten/panel.obj"].map(str::to_owned))
    {
        let path = folder.join(&file);
        if !path.exists() {
            continue;
        }
        let mapped = map(path.to_str().unwrap(), &free("auto"));
        println!(
            "{file}: {} steps, {:?}, lengths {:e}",
            mapped.map.iterations,
            mapped.map.ending,
            length_error(&mapped)
        );
        assert_eq!(mapped.map.ending, Ending::Minimised(Status::Converged), "{file}");
        assert_eq!(mapped.map.exactly, Some(Exactly::Lengths), "{file}");
        assert!(length_error(&mapped) < 1.1e-9, "{file}: {:e}", length_error(&mapped));
    }
}

#[test]
fn on_irregular_meshes_free_maps_are_as_conformal_as_levenberg_marquardts() {
    for name in ["sphere?n=12&mesh=delaunay", "enneper?n=12&mesh=triangle", "graph:cos+cos?n=15&jitter=0.3&seed=2"] {
        let (reduced, soft) = (map(name, &free("auto")), map(name, &free("levenberg-marquardt")));
        assert_eq!(reduced.map.provenance.to_string(), "reduced", "{name}");
        assert!(length_error(&reduced) < 1.1e-9, "{name}");
        let error = |mapped: &Mapped| mapped.distortion.quasi_conformal.as_ref().unwrap().mean;
        println!("{name}: {} and {}", error(&reduced), error(&soft));
        assert!((error(&reduced) - error(&soft)).abs() < 1e-3, "{name}");
        assert_eq!(reduced.distortion.flipped, 0, "{name}");
    }
}

#[test]
fn flat_meshes_are_laid_down_as_they_are() {
    for shape in ["mesh=quad&jitter=0.3", "mesh=triangle&jitter=0.3", "mesh=delaunay"] {
        let name = format!("graph:cos+cos?n=12&amplitude=0&{shape}&seed=5");
        let mapped = map(&name, &free("reduced"));
        let (positions, z) = (&mapped.domain.disc.positions, &mapped.map.z);
        let last = positions.len() - 1;
        for v in 0..last {
            let image = (z[v] - z[last]).norm();
            assert!((image - distance(positions[v], positions[last])).abs() < 1e-7, "{name} {v}");
        }
    }
}

#[test]
fn curvature_is_nothing_inside_flat_meshes_and_two_pi_in_all() {
    for name in ["graph:cos+cos?n=9&jitter=0.3", "graph:cos+cos?n=9&mesh=delaunay", "sphere?n=8&mesh=quad"] {
        let disc = disc_of(name);
        let graph = graph_of(&disc, "barycentre");
        let sum: f64 = curvature(&disc, &graph, None).iter().sum();
        assert!((sum - TAU).abs() < 1e-10, "{name}: {sum}");
    }
    let disc = disc_of("graph:cos+cos?n=9&amplitude=0&jitter=0.3");
    let graph = graph_of(&disc, "barycentre");
    let curvature = curvature(&disc, &graph, None);
    let inside = (0..graph.vertices as u32).filter(|v| !graph.boundary.contains(v));
    assert!(inside.map(|v| curvature[v as usize].abs()).fold(0.0, f64::max) < 1e-13);
}

#[test]
fn what_does_not_reduce_is_refused_by_name_and_left_to_others_by_auto() {
    let name = "graph:cos+cos?n=9";
    let boundary = disc_of(name).boundary;
    let inner = Pin { vertex: 40, place: [0.1, 0.0] };
    let outer = |k: usize, angle: f64| Pin { vertex: boundary[k], place: [angle.cos(), angle.sin()] };
    let pins = vec![outer(0, 0.0), outer(10, 2.0), inner];
    let with = |energy: &str| Some(energy.parse().unwrap());
    for options in [
        MapOptions { weight: Weight::Unit, ..circle("reduced") },
        MapOptions { energy: with("H + L"), ..free("reduced") },
        MapOptions { energy: with("H + C + A"), ..circle("reduced") },
        MapOptions { pins, ..circle("reduced") },
        MapOptions { pins: vec![outer(0, 0.0)], ..free("reduced") },
    ] {
        let error = refusal(name, &options);
        assert!(matches!(error, MapError::Reduced(BoundaryError::Unsuitable { .. })), "{error}");
        let mapped = map(name, &MapOptions { solver: "auto".into(), ..options });
        assert_eq!((mapped.map.provenance, mapped.map.exactly), (Provenance::of("levenberg-marquardt"), None));
    }
    // Other coefficients are another problem, unless the backend is asked for.
    let weighted = MapOptions { energy: with("H + 2 C"), ..circle("auto") };
    assert_eq!(map(name, &weighted).map.provenance.to_string(), "levenberg-marquardt");
    let weighted = MapOptions { energy: with("H + 2 C"), ..circle("reduced") };
    assert_eq!(map(name, &weighted).map.z, map(name, &circle("auto")).map.z);
    let obtuse = "graph:cos+cos?n=9&mesh=triangle&jitter=0.4";
    let with_circumcentres = |solver| MapOptions { dual: "circumcentre".to_owned(), ..circle(solver) };
    // Negative ρ are no obstacle, only to the weights of H.
    let round = map(obtuse, &with_circumcentres("auto"));
    assert_eq!(round.map.exactly, Some(Exactly::Conformal));
    let flat = map(obtuse, &MapOptions { boundary: Boundary::FREE, ..with_circumcentres("auto") });
    assert_eq!((flat.map.exactly, length_error(&flat) < 1e-9), (Some(Exactly::Lengths), true));
}

#[test]
fn the_smallest_meshes_are_mapped_or_refused_in_words() {
    for surface in [quad_grid(1, 1, Sides::Free), quad_grid(1, 2, Sides::Free), quad_grid(2, 2, Sides::Free)] {
        for surface in [triangulated(&surface), surface] {
            for options in [circle("auto"), free("auto")] {
                match map_input(&Input::of("small".to_owned(), surface.clone()), &options, &mut Silent) {
                    Ok(mapped) => assert!(mapped.map.z.iter().all(|z| z.is_finite())),
                    Err(error) => println!("{error}"),
                }
            }
        }
    }
}

#[test]
fn digital_surfaces_keep_their_projected_lengths() {
    let name = "digital-cap?R=8";
    let mapped = map(name, &MapOptions { rho: RhoSource::Auto, ..free("auto") });
    println!("{} {:?} H {:e}", mapped.map.provenance, mapped.map.residual, h(&mapped));
    assert_eq!(mapped.map.provenance.to_string(), "reduced");
    assert!(length_error(&mapped) < 1.1e-9);
    let round = map(name, &circle("auto"));
    assert_eq!(round.map.provenance.to_string(), "reduced");
    assert!(round.map.residual.unwrap() <= 1e-10);
}

#[test]
fn hard_boundaries_fall_back_to_levenberg_marquardt_and_say_so() {
    let Some(folder) = data_folder() else { return };
    let path = folder.join("tri/bunny_cut.obj");
    if !path.exists() {
        return;
    }
    let path = path.to_str().unwrap();
    let mapped = map(path, &free("auto"));
    println!("{}: {:?}", mapped.map.provenance, mapped.map.energies);
    if mapped.map.provenance.to_string() != "reduced" {
        let name = mapped.map.provenance.to_string();
        assert_eq!((name.as_str(), mapped.map.exactly), ("levenberg-marquardt (reduced stalled)", None));
        let error = refusal(path, &free("reduced"));
        assert!(matches!(error, MapError::Reduced(BoundaryError::Stalled { .. })), "{error}");
    }
    assert_eq!(mapped.distortion.flipped, 0);
}
