use super::shared::*;
use crate::common::*;
use num_complex::Complex64;
use riemap::energy::conformal::Weight;
use riemap::energy::{Circle, Energy, Order};
use riemap::energy::{ENERGIES, EnergyKind, EnergyRow};
use riemap::quad_graph::dual::{BoundaryDual, DUAL_POINTS};
use riemap::quad_graph::metric::RestMetric;

/// Of energies that are finite everywhere.
fn values(case: &Case, weight: Weight, z: &[Complex64]) -> Vec<(&'static EnergyRow, f64)> {
    let held = vec![false; case.graph.vertices];
    let folds = ENERGIES.iter().filter(|row| !row.properties().flip_free);
    let made = folds.filter_map(|row| Some((row, row.make(case.rest(weight, &held)).ok()?)));
    made.map(|(row, energy)| (row, energy.value(z))).collect()
}

#[test]
fn flat_meshes_have_no_energy_where_they_lie_and_none_of_h_under_similarities() {
    for name in ["plane?n=5", "plane?n=6&c=0.4"] {
        for case in Case::all(name) {
            let z = match case.disc.faces.arity() {
                Some(4) => case.disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect(),
                _ => {
                    let dual = DUAL_POINTS.iter().find(|d| case.name.contains(d.name())).unwrap();
                    let foot = case.name.contains("Foot");
                    let boundary = if foot { BoundaryDual::Foot } else { BoundaryDual::Midpoint };
                    planar_places(&case.disc, *dual, boundary)
                }
            };
            for weight in WEIGHTS {
                for (row, value) in values(&case, weight, &z) {
                    // A compares with areas folded along the edge: |h| + |h'|, which is |h + h'| only where both
                    // circumcentres are on their own sides.
                    let inside = (0..case.graph.quads.len())
                        .all(|q| (case.metric.folded_area[q] - case.graph.area(q)).abs() < 1e-14);
                    if row.name() == "C" || (row.name() == "A" && !inside) {
                        assert!(row.name() == "C" || case.name.contains("circumcentre"), "{}", case.name);
                        continue;
                    }
                    // Sums of a few hundred squares of roundings, relative to weights of at most 1/l⁴ ≈ 1e6.
                    assert!(value < 1e-22, "{} {weight:?} {}: {value:e}", row.name(), case.name);
                }
                let turned: Vec<_> =
                    z.iter().map(|z| z * Complex64::new(-3.0, 7.0) + Complex64::new(40.0, -9.0)).collect();
                let h = values(&case, weight, &turned).into_iter().find(|(row, _)| row.name() == "H");
                if let Some((_, h)) = h {
                    assert!(h < 1e-22, "{weight:?} {}: {h:e}", case.name);
                }
            }
        }
    }
}

#[test]
fn energies_see_no_rigid_motion_and_circles_no_rotation() {
    let mut random = Random(6);
    for case in Case::all("catenoid?n=4") {
        for weight in WEIGHTS {
            let z = case.state(&mut random);
            let turn = Complex64::cis(1.0 + random.real());
            let shift = random.complex();
            let moved = |shift: Complex64| z.iter().map(|z| turn * z + shift).collect::<Vec<_>>();
            for ((row, here), (_, there)) in
                values(&case, weight, &z).into_iter().zip(values(&case, weight, &moved(shift)))
            {
                // Rounding of places of size 1 to 2, through fourth powers and weights.
                let same = (here - there).abs() <= 1e-12 * here;
                assert_eq!(same, row.name() != "C", "{} {weight:?} {}: {here} {there}", row.name(), case.name);
            }
            let (_, c) = values(&case, weight, &moved(Complex64::ZERO))[1];
            assert!((c - values(&case, weight, &z)[1].1).abs() <= 1e-12 * c);
        }
    }
}

/// Black vertices under a z + b z̄ and white ones under a z − b z̄, on squares: neither H nor A sees it where b is a real
/// multiple of a and |a|² + |b|² = 1. Only lengths of edges, L, tell such maps from the identity.
#[test]
fn h_and_a_do_not_see_black_and_white_vertices_sheared_against_each_other() {
    let mut grid = quad_grid(6, 5, Sides::Free);
    for (v, p) in grid.positions_mut().iter_mut().enumerate() {
        *p = [(v % 7) as f64, (v / 7) as f64, 0.0];
    }
    let disc = disc(&grid);
    let graph = graph_of(&disc, "");
    let metric = RestMetric::of_quads(&disc, &graph, None);
    let (class, classes) = graph.diagonal_classes();
    assert_eq!(classes, 2);
    let at: Vec<Complex64> = disc.positions.iter().map(|p| Complex64::new(p[0], p[1])).collect();
    let case = Case { name: "squares".to_owned(), disc, graph, metric };
    for weight in WEIGHTS {
        for t in [0.1f64, 1.0, -3.0] {
            let a = 1.0 / (1.0 + t * t).sqrt();
            let sheared = at.iter().zip(&class).map(|(z, &c)| {
                let b = if c == class[0] { t * a } else { -t * a };
                a * z + b * z.conj()
            });
            for (row, value) in values(&case, weight, &sheared.collect::<Vec<_>>()) {
                match row.name() {
                    // Roundings of places of size 20, squared.
                    "H" | "A" => assert!(value < 1e-24, "{} {weight:?} {t}: {value:e}", row.name()),
                    "L" => assert!(value > 1e-2, "{weight:?} {t}: {value:e}"),
                    _ => {}
                }
            }
        }
    }
}

#[test]
fn the_circle_energy_vanishes_on_the_unit_circle_alone() {
    let mut random = Random(7);
    for case in Case::all("sphere?n=4") {
        for weight in WEIGHTS {
            let mut z = case.state(&mut random);
            let held = vec![false; case.graph.vertices];
            let c = Circle::new(case.rest(weight, &held));
            assert!(c.value(&z) > 1e-3);
            for &v in &case.graph.boundary {
                z[v as usize] = Complex64::cis(z[v as usize].arg());
            }
            assert!(c.value(&z) < 1e-28);
            // Integral weights sum to 2π: all at radius 2 give (4 − 1)² · 2π.
            let doubled: Vec<_> = z.iter().map(|z| 2.0 * z).collect();
            let total = if weight == Weight::Unit { case.graph.boundary.len() as f64 } else { std::f64::consts::TAU };
            assert!((c.value(&doubled) - 9.0 * total).abs() < 1e-11);
            // Held vertices do not count.
            let all = vec![true; case.graph.vertices];
            assert_eq!(Circle::new(case.rest(weight, &all)).value(&doubled), 0.0);
        }
    }
}

#[test]
fn a_boundary_out_of_order_is_not_admitted_by_the_barrier() {
    let case = Case::quads("plane?n=4&mesh=quad");
    let mut z = case.state(&mut Random(8));
    let order = Order::new(&case.graph);
    assert!(order.value(&z).is_finite());
    let [a, b] = [case.graph.boundary[3] as usize, case.graph.boundary[4] as usize];
    z.swap(a, b);
    assert_eq!(order.value(&z), f64::INFINITY);
    z[a] = Complex64::new(f64::NAN, 0.0);
    assert_eq!(order.value(&z), f64::INFINITY);
}

#[test]
fn names_of_energies_are_those_of_their_rows() {
    let case = Case::quads("plane?n=4&mesh=quad");
    let held = vec![false; case.graph.vertices];
    for row in ENERGIES {
        assert_eq!(row.make(case.rest(Weight::Unit, &held)).unwrap().name(), row.name());
    }
}
