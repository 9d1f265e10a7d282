//! The contract of iterative backends, for every row of the table.

use std::f64::consts::TAU;

use crate::common::*;
use nalgebra::DMatrix;
use num_complex::Complex64;
use riemap::constraint::{Fixed, Freedoms, hold_gauge, on_circle, spread_points};
use riemap::energy::conformal::{Dirichlet, Weight};
use riemap::energy::{Circle, Conformal, Curvature, Expression, Rest, jacobian};
use riemap::problem::linear::LinearProblem;
use riemap::problem::nonlinear::Objective;
use riemap::quad_graph::metric::RestMetric;
use riemap::solver::minimise::{LevenbergMarquardt, smallest_singular_value};
use riemap::solver::{
    Iteration, MINIMISERS, MinimiseError, Minimiser, Minimum, Observer, Phase, Silent, Status, StopRule, minimiser,
    solve_linear,
};

/// An objective and the start of §4 of the design.
struct Case {
    objective: Objective,
    start: Vec<f64>,
}

/// `energy` on a generated quad mesh; circles with `fix` points held.
fn case(surface: &str, terms: &str, weight: Weight, fix: usize) -> Case {
    let disc = disc_of(surface);
    let graph = graph_of(&disc, "");
    let metric = RestMetric::of_quads(&disc, &graph, None);
    let expression: Expression = terms.parse().unwrap();
    let circle = expression.is_on_circle();
    let points = spread_points(&graph, fix);
    let arc = on_circle(&graph, 1.0, &[(0, 0.0)]).unwrap();
    let anchors: Vec<_> =
        points.iter().map(|&k| (k, arc.place(graph.boundary[k]).unwrap().arg().rem_euclid(TAU))).collect();
    let radius = if circle { 1.0 } else { graph.perimeter() / TAU };
    let whole = on_circle(&graph, radius, if circle { &anchors } else { &[(0, 0.0)] }).unwrap();
    let linear = LinearProblem::new(&graph, weight, &whole).unwrap();
    let z = solve_linear(&linear, "auto", &mut Silent).unwrap().z;
    let mut fixed = Fixed::default();
    if circle {
        for &(k, angle) in &anchors {
            fixed.hold(graph.boundary[k], Complex64::cis(angle));
        }
    } else {
        hold_gauge(&mut fixed, &expression, &graph, &z);
    }
    let held: Vec<bool> = (0..graph.vertices as u32).map(|v| fixed.holds(v)).collect();
    let rest = Rest { graph: &graph, metric: &metric, weight, held: &held };
    let terms = expression.terms().iter().map(|t| (t.coefficient, t.energy.make(rest).unwrap()));
    let objective = Objective {
        terms: terms.collect(),
        freedoms: Freedoms::new(graph.vertices, &fixed),
        norm: Dirichlet::new(&graph, weight),
    };
    let start = objective.freedoms.restrict(&z);
    Case { objective, start }
}

/// Remembers what it hears, and asks for a stop once it has heard of iteration `stop_at`.
#[derive(Default)]
struct Recorder {
    heard: Vec<Iteration>,
    terms: bool,
    stop_at: Option<usize>,
    phases: Vec<Phase>,
}

impl Observer for Recorder {
    fn phase(&mut self, phase: Phase) {
        self.phases.push(phase);
    }

    fn iteration(&mut self, iteration: &Iteration) {
        self.heard.push(iteration.clone());
    }

    fn wants_terms(&self) -> bool {
        self.terms
    }

    fn stop_requested(&self) -> bool {
        self.stop_at.is_some_and(|n| self.heard.last().is_some_and(|i| i.number >= n))
    }
}

fn rule(tolerance: f64) -> StopRule {
    StopRule { tolerance, ..StopRule::default() }
}

fn minimise(backend: &dyn Minimiser, case: &Case, rule: StopRule, watch: &mut dyn Observer) -> Minimum {
    let minimum = backend.minimise(&case.objective, case.start.clone(), rule, watch);
    minimum.unwrap_or_else(|error| panic!("{}: {error}", backend.name()))
}

fn largest(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, |m, d| if d <= m { m } else { d })
}

const GRID: &str = "graph:cos+cos?n=17";

#[test]
fn all_reach_the_same_circle_map() {
    for weight in [Weight::Unit, Weight::Integral] {
        let case = case(GRID, "H + C", weight, 3);
        let reference = minimise(&LevenbergMarquardt::AUTO, &case, rule(1e-12), &mut Silent);
        // Three points and an odd number of columns: an approximate solution of (2), not an exact one.
        let (e, iterations) = (reference.value, reference.iterations);
        assert!(e < 1e-7 && iterations <= 20, "{weight:?}: {e:e} after {iterations}");
        for backend in MINIMISERS {
            let minimum = minimise(*backend, &case, rule(1e-9), &mut Silent);
            println!(
                "{weight:?} {}: {:?} after {}, E {:e}, |g| {:e}, apart {:e}",
                backend.name(),
                minimum.status,
                minimum.iterations,
                minimum.value,
                minimum.gradient_norm,
                largest(&minimum.y, &reference.y)
            );
            assert!([Status::Converged, Status::Precision].contains(&minimum.status), "{}", backend.name());
            // The gradient is 1e-9 of its start, about 1; the smallest singular value squared is about 1e-3.
            assert!(largest(&minimum.y, &reference.y) < 1e-6, "{weight:?} {}", backend.name());
            assert!((minimum.value - e).abs() < 1e-6 * e, "{weight:?} {}", backend.name());
            assert!(minimum.iterations <= backend.default_max_iterations());
        }
    }
}

#[test]
fn what_a_minimum_says_of_itself_is_true() {
    let case = case(GRID, "H + C", Weight::Unit, 3);
    let first: f64 = case.objective.gradient(&case.start).iter().map(|g| g * g).sum::<f64>().sqrt();
    for backend in MINIMISERS {
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let minimum = minimise(*backend, &case, rule(tolerance), &mut Silent);
            let gradient: f64 = case.objective.gradient(&minimum.y).iter().map(|g| g * g).sum::<f64>().sqrt();
            assert_eq!(minimum.status, Status::Converged, "{}", backend.name());
            assert_eq!((minimum.gradient_norm, minimum.reference), (gradient, first), "{}", backend.name());
            assert!(minimum.reduction() <= tolerance);
            assert_eq!(minimum.value, case.objective.value(&minimum.y), "{}", backend.name());
        }
        // Another reference means another measure.
        let rule = StopRule { tolerance: 1e-4, reference: Some(1e4 * first), max_iterations: None };
        let minimum = minimise(*backend, &case, rule, &mut Silent);
        assert_eq!((minimum.status, minimum.iterations), (Status::Converged, 0), "{}", backend.name());
        assert_eq!(minimum.y, case.start);
    }
}

#[test]
fn iterations_end_at_the_maximum_with_the_best_state() {
    let case = case(GRID, "H + C", Weight::Integral, 3);
    for backend in MINIMISERS {
        for max_iterations in [0, 1, 3] {
            let rule = StopRule { tolerance: 1e-12, reference: None, max_iterations: Some(max_iterations) };
            let mut recorder = Recorder::default();
            let minimum = minimise(*backend, &case, rule, &mut recorder);
            assert_eq!(
                (minimum.status, minimum.iterations),
                (Status::MaxIterations, max_iterations),
                "{}",
                backend.name()
            );
            let lowest = recorder.heard.iter().map(|i| i.total).fold(f64::INFINITY, f64::min);
            assert_eq!(minimum.value, lowest, "{}", backend.name());
            assert_eq!(recorder.heard.len(), max_iterations + 1);
            assert!(minimum.value <= case.objective.value(&case.start));
        }
    }
}

#[test]
fn a_stop_is_obeyed_at_the_first_chance_with_the_best_state() {
    let case = case(GRID, "H + C", Weight::Integral, 3);
    for backend in MINIMISERS {
        for stop_at in [0, 2] {
            let mut recorder = Recorder { stop_at: Some(stop_at), ..Recorder::default() };
            let minimum = minimise(*backend, &case, rule(1e-12), &mut recorder);
            assert_eq!((minimum.status, minimum.iterations), (Status::Interrupted, stop_at), "{}", backend.name());
            let lowest = recorder.heard.iter().map(|i| i.total).fold(f64::INFINITY, f64::min);
            assert_eq!((minimum.value, case.objective.value(&minimum.y)), (lowest, lowest), "{}", backend.name());
        }
    }
}

#[test]
fn observers_hear_every_iteration_once_with_terms_that_add_up() {
    for terms in ["H + C", "H + 0.5 L + 2 A"] {
        let case = case("graph:cos+cos?n=9", terms, Weight::Unit, 3);
        for backend in MINIMISERS {
            let mut recorder = Recorder { terms: true, ..Recorder::default() };
            let rule = StopRule { tolerance: 1e-6, reference: None, max_iterations: Some(200) };
            let minimum = minimise(*backend, &case, rule, &mut recorder);
            assert!(recorder.phases.contains(&Phase::Solve), "{}", backend.name());
            let numbers: Vec<usize> = recorder.heard.iter().map(|i| i.number).collect();
            assert_eq!(numbers, (0..=minimum.iterations).collect::<Vec<_>>(), "{}", backend.name());
            for i in &recorder.heard {
                let coefficients = case.objective.terms.iter().map(|(t, _)| t);
                let sum: f64 = coefficients.zip(&i.terms).map(|(t, (_, e))| t * e).sum();
                assert!((sum - i.total).abs() <= 1e-13 * i.total, "{} {terms}: {i:?}", backend.name());
            }
            assert_eq!(recorder.heard[0].step, 0.0);
            if backend.name() == "levenberg-marquardt" {
                // It takes no step up, but for rounding at the end.
                let falls = recorder.heard.windows(2).all(|w| w[1].total <= w[0].total * (1.0 + 1e-13));
                assert!(falls, "{terms}");
            }
            let mut silent = Recorder::default();
            minimise(*backend, &case, rule, &mut silent);
            assert!(silent.heard.iter().all(|i| i.terms.is_empty()));
        }
    }
}

#[test]
fn two_runs_agree_to_the_bit() {
    for (terms, weight) in [("H + C", Weight::Integral), ("H + L + A", Weight::Unit)] {
        let case = case("graph:cos+cos?n=9", terms, weight, 3);
        let rule = StopRule { tolerance: 1e-8, reference: None, max_iterations: Some(300) };
        for backend in MINIMISERS {
            let [a, b] = [0, 1].map(|_| minimise(*backend, &case, rule, &mut Silent));
            assert_eq!(a, b, "{}", backend.name());
        }
    }
}

#[test]
fn a_start_that_is_not_finite_is_refused() {
    let case = case("graph:cos+cos?n=9", "H + C", Weight::Integral, 3);
    for backend in MINIMISERS {
        for wrong in [f64::NAN, f64::INFINITY, 1e200] {
            let mut start = case.start.clone();
            start[7] = wrong;
            let result = backend.minimise(&case.objective, start, StopRule::default(), &mut Silent);
            assert_eq!(result, Err(MinimiseError::StartNotFinite), "{} {wrong}", backend.name());
        }
    }
}

#[test]
fn a_minimum_is_left_as_it_is() {
    let mut case = case("graph:cos+cos?n=9", "H + C", Weight::Unit, 3);
    case.start = minimise(&LevenbergMarquardt::AUTO, &case, rule(1e-14), &mut Silent).y;
    for backend in MINIMISERS {
        // Its own gradient is no measure; nothing may run away, nor loop for ever.
        let minimum = minimise(*backend, &case, rule(1e-10), &mut Silent);
        assert!(largest(&minimum.y, &case.start) < 1e-9, "{}", backend.name());
        assert_ne!(minimum.status, Status::MaxIterations, "{}", backend.name());
    }
}

#[test]
fn levenberg_marquardt_works_with_either_hessian() {
    for (terms, curvatures) in [
        ("H + C", &[None, Some(Curvature::GaussNewton), Some(Curvature::Exact)][..]),
        ("H + L", &[None, Some(Curvature::GaussNewton), Some(Curvature::Exact)]),
    ] {
        let case = case(GRID, terms, Weight::Unit, 3);
        let energies = curvatures.iter().map(|&curvature| {
            let minimum = minimise(&LevenbergMarquardt { curvature }, &case, rule(1e-9), &mut Silent);
            println!("{terms} {curvature:?}: {:?} {} {:e}", minimum.status, minimum.iterations, minimum.value);
            assert!([Status::Converged, Status::Precision].contains(&minimum.status), "{terms} {curvature:?}");
            minimum.value
        });
        let energies: Vec<f64> = energies.collect();
        for e in &energies {
            // The gradient is down to 1e-9: the energy is right to about its square.
            assert!((e - energies[0]).abs() < 1e-12 + 1e-9 * energies[0], "{terms}: {energies:?}");
        }
    }
}

/// σ of the Jacobian of H + C by a dense decomposition of itself.
fn dense_smallest_singular_value(surface: &str, weight: Weight, objective: &Objective, y: &[f64]) -> f64 {
    let disc = disc_of(surface);
    let graph = graph_of(&disc, "");
    let metric = RestMetric::of_quads(&disc, &graph, None);
    let freedoms = &objective.freedoms;
    let held: Vec<bool> = (0..graph.vertices).map(|v| freedoms.width(v) == 0).collect();
    let rest = Rest { graph: &graph, metric: &metric, weight, held: &held };
    let z = freedoms.expand(y);
    let parts = [jacobian(&Conformal::new(rest).unwrap(), &z), jacobian(&Circle::new(rest), &z)];
    let mut dense = DMatrix::zeros(parts[0].nrows() + parts[1].nrows(), y.len());
    for (part, first) in parts.iter().zip([0, parts[0].nrows()]) {
        for (row, column, value) in part.triplet_iter().filter(|(_, column, _)| !held[column / 2]) {
            dense[(first + row, freedoms.offset[column / 2] as usize + column % 2)] = *value;
        }
    }
    dense.singular_values().min()
}

#[test]
fn two_fixed_points_leave_a_circle_map_free_where_three_do_not() {
    for weight in [Weight::Unit, Weight::Integral] {
        let sigma = |surface: &str, fix: usize| {
            let case = case(surface, "H + C", weight, fix);
            let minimum = minimise(&LevenbergMarquardt::AUTO, &case, rule(1e-12), &mut Silent);
            let estimate = smallest_singular_value(&case.objective, &minimum.y).unwrap();
            let dense = dense_smallest_singular_value(surface, weight, &case.objective, &minimum.y);
            println!("{surface} {weight:?} {fix}: {estimate:e} {dense:e}");
            (estimate, dense)
        };
        for surface in ["graph:cos+cos?n=9", "graph:cos+cos?n=10&jitter=0.2&seed=4"] {
            let (estimate, dense) = sigma(surface, 3);
            // Inverse iteration until the quotient settles to 1e-6.
            assert!((estimate - dense).abs() < 1e-4 * dense, "{surface} {weight:?}: {estimate:e} {dense:e}");
            assert!(estimate > 1e-2, "{surface} {weight:?}: {estimate:e}");
        }
        // A symmetric mesh: 0 to rounding of J, not only of JᵀJ; the largest singular value is about 10.
        let (estimate, dense) = sigma("graph:cos+cos?n=9", 2);
        assert!(estimate < 1e-12 && dense < 1e-12, "{weight:?}: {estimate:e} {dense:e}");
        // Small and not 0: what JᵀJ alone would know to a part in 100.
        let (estimate, dense) = sigma("graph:cos+cos?n=10&jitter=0.000001&seed=4", 2);
        assert!(dense > 1e-10 && dense < 1e-5 && (estimate - dense).abs() < 1e-3 * dense, "{estimate:e} {dense:e}");
    }
}

#[test]
fn names_find_their_minimisers() {
    for backend in MINIMISERS {
        assert_eq!(minimiser(backend.name()).map(|m| m.name()), Some(backend.name()));
        assert!(!backend.description().is_empty());
    }
    assert!(minimiser("cholesky").is_none());
}
