//! Plain maps with few folds: these are taken out where they are, and the map is left as it is elsewhere.

use crate::common::Stopper;
use num_complex::Complex64;
use riemap::energy::conformal::{self, Weight};
use riemap::energy::{Curvature, Energy, Mips, Rest, Unfolding};
use riemap::input::Input;
use riemap::map::{Boundary, MapOptions, Mapped, Valid, map_input};
use riemap::solver::Silent;

fn mapped(name: &str, options: &MapOptions) -> Mapped {
    map_input(&Input::open(name).unwrap(), options, &mut Silent).unwrap_or_else(|error| panic!("{name}: {error}"))
}

#[test]
fn a_map_with_few_folds_is_the_plain_one_away_from_them() {
    // On the first the exact map is known; the second opens corners of the square to half a turn, which folds the quads there.
    for name in ["plane?n=64&mesh=quad&jitter=0.45&seed=1", "graph:cos+cos?n=81&jitter=0.3&seed=1"] {
        let plain = mapped(name, &MapOptions { valid: Valid::Off, solver: "reduced".into(), ..MapOptions::default() });
        let found = mapped(name, &MapOptions::default());
        assert!(!plain.validity.is_one_to_one(), "{name}: no fold to take out");
        assert!(
            found.map.provenance.is_repaired() && found.map.provenance.to_string().contains("near folds"),
            "{name}: {}",
            found.map.provenance
        );
        assert!(found.validity.is_one_to_one(), "{name}: {:?}", found.validity);
        assert_eq!(found.distortion.boundary_out_of_order, Some(0), "{name}");
        let kept = plain.map.z.iter().zip(&found.map.z).filter(|(a, b)| a == b).count();
        assert!(2 * kept > plain.map.z.len(), "{name}: {kept} of {} are where they were", plain.map.z.len());
        let mean = |mapped: &Mapped| mapped.distortion.quasi_conformal.unwrap().mean;
        println!("{name}: σ1/σ2 {} before, {} after, {kept} kept", mean(&plain), mean(&found));
        // What is said of the map is said of this one: H is no longer at its minimum.
        let h = |mapped: &Mapped| {
            let graph = &mapped.domain.graph;
            conformal::value(graph, &conformal::weights(graph, Weight::Integral).unwrap(), &mapped.map.z)
        };
        assert_eq!(found.map.energies[0], ("H", h(&found)), "{name}");
        assert!(h(&found) > h(&plain), "{name}");
        // Quads whose corners are opened to half a turn are sheared, whatever one does.
        assert!(mean(&found) < 1.03, "{name}: {}", mean(&found));
    }
}

#[test]
fn folds_of_free_maps_are_taken_out_where_they_are() {
    let name = "rough?n=33&height=0.3&seed=1";
    let free = |valid| mapped(name, &MapOptions { boundary: Boundary::FREE, valid, ..MapOptions::default() });
    let (plain, found) = (free(Valid::Off), free(Valid::Auto));
    println!("{} folded, then {}", plain.validity.folded.len(), found.map.provenance);
    assert!(found.validity.is_locally_one_to_one());
}

#[test]
fn a_map_that_is_stopped_while_folds_are_taken_out_is_valid() {
    let name = "graph:cos+cos?n=41&jitter=0.3&seed=1";
    for n in [1, 2, 3, 4, 6, 8, 10, 15, 25] {
        let stopped = map_input(&Input::open(name).unwrap(), &MapOptions::default(), &mut Stopper(n)).unwrap();
        assert!(stopped.validity.is_one_to_one(), "stopped after {n}: {}", stopped.map.provenance);
        let limited = mapped(name, &MapOptions { max_iterations: Some(n), ..MapOptions::default() });
        assert!(limited.validity.is_one_to_one(), "limited to {n}: {}", limited.map.provenance);
        assert!(limited.map.iterations <= n, "{} of {n}", limited.map.iterations);
    }
}

/// A map with and without folds, and the unfolding energy with ε = `share`.
fn with_unfolding(share: f64, check: impl Fn(&Unfolding, &Mips, &[Complex64])) {
    let name = "graph:saddle?n=5&mesh=triangle";
    let options = MapOptions::default();
    let mapped = mapped(name, &options);
    let metric = mapped.domain.rest_metric(&options).unwrap();
    let rest = Rest { graph: &mapped.domain.graph, metric: &metric, weight: Weight::Integral, held: &[] };
    let scale = vec![0.1; metric.triangles.len()];
    let unfolding = Unfolding::new(rest, &scale, share).unwrap();
    let mips = Mips::new(rest).unwrap();
    check(&unfolding, &mips, &mapped.map.z);
    // One vertex beyond the others: folded.
    let mut folded = mapped.map.z;
    folded[12] += Complex64::new(0.9, 0.4);
    check(&unfolding, &mips, &folded);
}

#[test]
fn the_unfolding_energy_has_the_derivatives_that_differences_have() {
    with_unfolding(0.7, |energy, _, z| {
        let h = 1e-6;
        let moved = |v: usize, d: Complex64| {
            let mut z = z.to_vec();
            z[v] += d;
            z
        };
        let gradient = |z: &[Complex64]| {
            let mut g = vec![Complex64::ZERO; z.len()];
            energy.add_gradient(1.0, z, &mut g);
            g
        };
        let g = gradient(z);
        let largest = g.iter().map(|g| g.norm()).fold(0.0, f64::max);
        let stencils = energy.stencils();
        for (v, g) in g.iter().enumerate().take(25) {
            for (i, d) in [Complex64::new(h, 0.0), Complex64::new(0.0, h)].into_iter().enumerate() {
                let slope = (energy.value(&moved(v, d)) - energy.value(&moved(v, -d))) / (2.0 * h);
                // Differences of second order with a step of 1e-6 have about nine digits.
                assert!((slope - [g.re, g.im][i]).abs() < 1e-6 * largest, "vertex {v}");
                let (ahead, behind) = (gradient(&moved(v, d)), gradient(&moved(v, -d)));
                let mut column = vec![[0.0; 2]; z.len()];
                energy.hessian(z, Curvature::Exact, &mut |e, block| {
                    let vertices = stencils.get(e);
                    if let Some(k) = vertices.iter().position(|&w| w as usize == v) {
                        for (l, &w) in vertices.iter().enumerate() {
                            (0..2).for_each(|j| column[w as usize][j] += block[2 * l + j][2 * k + i]);
                        }
                    }
                });
                let size = column.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
                for (w, column) in column.iter().enumerate() {
                    let change = (ahead[w] - behind[w]) / (2.0 * h);
                    let off = (change.re - column[0]).abs().max((change.im - column[1]).abs());
                    assert!(off < 1e-5 * size, "vertices {v}, {w}: {change} and {column:?}");
                }
            }
        }
    });
}

#[test]
fn the_unfolding_energy_is_mips_where_nothing_folds_and_finite_elsewhere() {
    with_unfolding(1e-9, |energy, mips, z| {
        let (unfolding, mips) = (energy.value(z), mips.value(z));
        assert!(unfolding.is_finite());
        if mips.is_finite() {
            // χ differs from J by ε²/4J.
            assert!((unfolding - mips).abs() < 1e-9 * (1.0 + mips), "{unfolding} and {mips}");
        } else {
            assert!(unfolding > 1e3);
        }
    });
}
