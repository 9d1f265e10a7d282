//! What every direct backend promises: to refuse, saying why, or to give the map that all others give.

use crate::common::*;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use riemap::constraint::{Fixed, Shape, on_shape};
use riemap::energy::conformal::{self, Weight};
use riemap::problem::linear::{LinearProblem, system};
use riemap::quad_graph::QuadGraph;
use riemap::solver::{
    LINEAR_SOLVERS, Observer, Phase, Silent, SolveError, Unsuitable, automatic, linear_solver, solve_linear,
};

/// What is held.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Held {
    /// The whole boundary on the circle by arc length.
    Whole,
    /// Its black vertices and one white one: (2) is square.
    Primal,
    /// All but one boundary vertex, and one vertex inside.
    Mixed,
}

fn held(graph: &QuadGraph, held: Held) -> Fixed {
    let whole = on_shape(graph, Shape::Circle).expect("a boundary with length");
    let mut z = vec![Complex64::ZERO; graph.vertices];
    for (v, place) in whole.iter() {
        z[v as usize] = place;
    }
    match held {
        Held::Whole => whole,
        Held::Primal => hold_every_second(graph, &z),
        Held::Mixed => {
            let inside = (0..graph.vertices as u32).find(|&v| !whole.holds(v)).expect("an interior vertex");
            z[inside as usize] = Complex64::new(0.1, -0.2);
            hold(graph.boundary[1..].iter().copied().chain([inside]), &z)
        }
    }
}

fn difference(a: &[Complex64], b: &[Complex64]) -> f64 {
    assert_eq!(a.len(), b.len());
    largest_difference(a, b)
}

#[test]
fn all_backends_that_take_a_problem_give_the_same_map() {
    let (mut solved_by, mut refused_by) = (vec![0; LINEAR_SOLVERS.len()], vec![0; LINEAR_SOLVERS.len()]);
    let (mut negative, mut square) = (0, 0);
    for (name, graph) in graphs() {
        for weight in [Weight::Integral, Weight::Unit] {
            for kind in [Held::Whole, Held::Primal, Held::Mixed] {
                let what = format!("{name}, {weight:?}, {kind:?}");
                let fixed = held(&graph, kind);
                let problem = LinearProblem::new(&graph, weight, &fixed).unwrap_or_else(|e| panic!("{what}: {e}"));
                assert_eq!(problem.is_square(), kind == Held::Primal, "{what}");
                assert_eq!(problem.holds_whole_boundary(), kind == Held::Whole, "{what}");
                let mut found: Vec<(&str, Vec<Complex64>)> = Vec::new();
                for (b, backend) in LINEAR_SOLVERS.iter().enumerate() {
                    match solve_linear(&problem, backend.name(), &mut Silent) {
                        Ok(solution) => {
                            assert_eq!(solution.backend, backend.name());
                            assert!(solution.residual <= 1e-10, "{what}: {} {:e}", solution.backend, solution.residual);
                            for (v, place) in fixed.iter() {
                                assert_eq!(solution.z[v as usize], place, "{what}: {} moved {v}", solution.backend);
                            }
                            found.push((backend.name(), solution.z));
                            solved_by[b] += 1;
                        }
                        Err(SolveError::Unsuitable { backend: by, reason }) => {
                            assert_eq!(by, backend.name());
                            assert_eq!(backend.suits(&problem), Err(reason.clone()), "{what}");
                            assert!(!reason.to_string().is_empty());
                            refused_by[b] += 1;
                        }
                        Err(error) => panic!("{what}: {error}"),
                    }
                }
                let undefined = weight == Weight::Integral && graph.min_re_rho() <= 0.0 && kind != Held::Primal;
                if undefined {
                    assert!(found.is_empty(), "{what}: no weights, yet solved by {}", found[0].0);
                    assert!(solve_linear(&problem, "auto", &mut Silent).is_err());
                    continue;
                }
                assert!(found.len() >= 2, "{what}: {} backend", found.len());
                for (backend, z) in &found[1..] {
                    let d = difference(&found[0].1, z);
                    assert!(d <= 1e-9, "{what}: {} and {backend} differ by {d:e}", found[0].0);
                }
                let auto = solve_linear(&problem, "auto", &mut Silent).unwrap_or_else(|e| panic!("{what}: {e}"));
                assert!(difference(&found[0].1, &auto.z) <= 1e-9, "{what}: auto");
                assert_eq!(auto.backend, automatic(&problem)[0].name(), "{what}: a breakdown on a harmless mesh");
                negative += usize::from(graph.min_re_rho() < 0.0);
                square += usize::from(problem.is_square());
            }
        }
    }
    for (b, backend) in LINEAR_SOLVERS.iter().enumerate() {
        assert!(solved_by[b] > 0, "{} solved nothing", backend.name());
    }
    // the two general ones refuse only what has no weights
    assert!(negative > 0 && square > 0 && refused_by.iter().any(|&k| k > 0));
}

#[test]
fn the_map_is_that_of_dense_linear_algebra() {
    for (name, graph) in graphs() {
        for kind in [Held::Whole, Held::Primal] {
            let weight = if graph.min_re_rho() > 0.0 { Weight::Integral } else { Weight::Unit };
            let problem = LinearProblem::new(&graph, weight, &held(&graph, kind)).expect("well posed");
            let (a, b) = problem.reduced_system();
            let root: Vec<f64> = problem.weights().expect("defined").into_iter().map(f64::sqrt).collect();
            let mut dense = DMatrix::<Complex64>::zeros(a.nrows(), a.ncols());
            for (i, j, &value) in a.triplet_iter() {
                dense[(i, j)] += value * root[i];
            }
            let right = DVector::from_iterator(b.len(), b.iter().zip(&root).map(|(b, w)| b * w));
            let qr = dense.qr();
            let y = qr.r().solve_upper_triangular(&(qr.q().adjoint() * right)).expect("full rank");
            let z = problem.elimination.expand(y.as_slice());
            let solution = solve_linear(&problem, "auto", &mut Silent).expect("solvable");
            let d = difference(&z, &solution.z);
            assert!(d <= 1e-9, "{name} {kind:?}: {d:e}");
        }
    }
}

#[test]
fn where_the_system_is_square_h_vanishes() {
    for (name, graph) in graphs() {
        let problem = LinearProblem::new(&graph, Weight::Unit, &held(&graph, Held::Primal)).expect("well posed");
        let z = solve_linear(&problem, "auto", &mut Silent).expect("solvable").z;
        // relative to what H would be with every residual as large as its terms, a few roundings squared
        let size: f64 = graph.rho.iter().map(|rho| (2.0 + 2.0 * rho.norm()).powi(2)).sum();
        let h = conformal::value(&graph, &vec![1.0; graph.quads.len()], &z);
        let largest = z.iter().map(|z| z.norm()).fold(1.0, f64::max);
        assert!(h <= 1e-26 * size * largest * largest, "{name}: {h:e}");
    }
}

#[test]
fn the_normal_product_is_half_the_gradient_of_h() {
    let mut random = Random(11);
    for (name, graph) in graphs() {
        let w: Vec<f64> = graph.rho.iter().map(|_| 1.5 + random.real()).collect();
        let z: Vec<Complex64> = (0..graph.vertices).map(|_| random.complex()).collect();
        let product = conformal::normal_product(&graph, &w, &z);
        let scale = conformal::normal_product_scale(&graph, &w, &z);
        for v in 0..graph.vertices {
            // H is quadratic: central differences of any step are exact but for rounding
            let mut moved = z.clone();
            let mut slope = |step: Complex64| {
                moved[v] = z[v] + step;
                let ahead = conformal::value(&graph, &w, &moved);
                moved[v] = z[v] - step;
                0.5 * (ahead - conformal::value(&graph, &w, &moved))
            };
            let gradient = Complex64::new(slope(Complex64::ONE), slope(Complex64::I));
            let rounding = 1e-15 * conformal::value(&graph, &w, &z) * graph.quads.len() as f64;
            let d = (gradient - 2.0 * product[v]).norm();
            assert!(d <= 1e-12 * scale[v] + rounding, "{name}: vertex {v}, {gradient} {}", 2.0 * product[v]);
            assert!(product[v].norm() <= scale[v] * (1.0 + 1e-12), "{name}: vertex {v}");
        }
    }
}

#[test]
fn the_solution_is_the_minimum_of_h() {
    let mut random = Random(12);
    for (name, graph) in graphs() {
        let weight = if graph.min_re_rho() > 0.0 { Weight::Integral } else { Weight::Unit };
        let problem = LinearProblem::new(&graph, weight, &held(&graph, Held::Whole)).expect("well posed");
        let w = problem.weights().expect("defined");
        let z = solve_linear(&problem, "auto", &mut Silent).expect("solvable").z;
        let least = conformal::value(&graph, &w, &z);
        assert!(least > 0.0);
        for size in [1e-4, 1.0] {
            for _ in 0..5 {
                let mut moved = z.clone();
                let mut step = vec![Complex64::ZERO; graph.vertices];
                for &v in &problem.elimination.free {
                    step[v as usize] = size * random.complex();
                    moved[v as usize] += step[v as usize];
                }
                let h = conformal::value(&graph, &w, &moved);
                // H(z + s) = H(z) + H(s): the gradient is 0
                let rise = conformal::value(&graph, &w, &step);
                assert!(h > least, "{name}");
                assert!((h - least - rise).abs() <= 1e-11 * h + 1e-9 * rise, "{name}: {h:e} {least:e} {rise:e}");
            }
        }
    }
}

#[test]
fn with_integral_weights_the_imaginary_part_lives_on_the_boundary_and_measures_area() {
    let mut tried = 0;
    for (name, graph) in graphs().into_iter().filter(|(_, graph)| graph.min_re_rho() > 0.0) {
        tried += 1;
        let n = graph.vertices;
        let w = conformal::weights(&graph, Weight::Integral).expect("Re ρ > 0");
        let mut a = DMatrix::<Complex64>::zeros(graph.quads.len(), n);
        for (q, v, &value) in system(&graph).triplet_iter() {
            a[(q, v)] += value;
        }
        let weighted = DMatrix::from_fn(a.nrows(), n, |q, v| a[(q, v)] * w[q]);
        let m = a.adjoint() * weighted;
        // K: ¼ ahead along the boundary, −¼ back, nothing elsewhere
        let mut k = DMatrix::<f64>::zeros(n, n);
        let next = graph.boundary.iter().cycle().skip(1);
        for (&v, &ahead) in graph.boundary.iter().zip(next) {
            k[(v as usize, ahead as usize)] += 0.25;
            k[(ahead as usize, v as usize)] -= 0.25;
        }
        let d = m.map(|x| x.re);
        let scale = d.amax();
        assert!((m.map(|x| x.im) - k).amax() <= 1e-13 * scale, "{name}");
        assert!((&d - d.transpose()).amax() <= 1e-13 * scale);
        // D is positive semi-definite, and its null vectors are the two classes' indicators
        let mut eigenvalues: Vec<f64> = d.clone().symmetric_eigenvalues().iter().copied().collect();
        eigenvalues.sort_by(f64::total_cmp);
        assert!(eigenvalues[0] >= -1e-12 * scale, "{name}: {eigenvalues:?}");
        assert!(eigenvalues[1] <= 1e-12 * scale && eigenvalues[2] > 1e-6 * scale, "{name}: {:?}", &eigenvalues[..3]);
        let (class, _) = graph.diagonal_classes();
        for colour in 0..2 {
            let indicator = DVector::from_fn(n, |v, _| f64::from(u8::from(class[v] == colour)));
            assert!((&d * indicator).amax() <= 1e-12 * scale, "{name}");
        }
        // H = zᴴDz − signed area
        let mut random = Random(tried);
        let z: Vec<Complex64> = (0..n).map(|_| random.complex()).collect();
        let column = DVector::from_column_slice(&z);
        let dirichlet = (column.adjoint() * d.map(Complex64::from) * &column)[(0, 0)].re;
        let next = graph.boundary.iter().cycle().skip(1);
        let area: f64 =
            graph.boundary.iter().zip(next).map(|(&v, &w)| 0.5 * (z[v as usize].conj() * z[w as usize]).im).sum();
        let h = conformal::value(&graph, &w, &z);
        assert!((h - (dirichlet - area)).abs() <= 1e-12 * dirichlet, "{name}: {h} {dirichlet} {area}");
    }
    assert!(tried >= 8);
}

#[test]
fn refusals_say_what_stands_against_the_backend() {
    let bary = graph_of(&disc_of("sphere?n=5&mesh=triangle"), "barycentre");
    let circum = graph_of(&disc_of("graph:saddle?n=8&amplitude=4&mesh=triangle"), "circumcentre");
    let suits = |name: &str, graph: &QuadGraph, weight, kind| {
        let problem = LinearProblem::new(graph, weight, &held(graph, kind)).expect("well posed");
        linear_solver(name).expect(name).suits(&problem)
    };
    let free = bary.vertices - bary.boundary.len();
    assert_eq!(
        suits("lu", &bary, Weight::Unit, Held::Whole),
        Err(Unsuitable::NotSquare { equations: bary.quads.len(), unknowns: free })
    );
    for name in ["cholesky-real", "nalgebra-cholesky"] {
        assert_eq!(suits(name, &bary, Weight::Unit, Held::Whole), Err(Unsuitable::UnitWeights));
        let vertex = bary.boundary[3];
        assert_eq!(suits(name, &bary, Weight::Integral, Held::Primal), Err(Unsuitable::FreeBoundary { vertex }));
    }
    let bad: Vec<usize> = (0..circum.rho.len()).filter(|&q| circum.rho[q].re <= 0.0).collect();
    assert!(bad.len() > 10, "{} negative weights", bad.len());
    for name in ["cholesky-real", "nalgebra-cholesky", "cholesky", "qr"] {
        let Err(Unsuitable::NonPositiveRho(found)) = suits(name, &circum, Weight::Integral, Held::Whole) else {
            panic!("{name}")
        };
        let first = bad[0];
        assert_eq!((found.quad, found.count), (first, bad.len()));
        assert_eq!((found.vertices, found.re_rho), (circum.quads[first], circum.rho[first].re));
    }
    let quad = bary.rho.iter().position(|rho| rho.im != 0.0).expect("barycentres");
    assert_eq!(
        suits("cotan", &bary, Weight::Unit, Held::Primal),
        Err(Unsuitable::NotOrthogonal { quad, im_rho: bary.rho[quad].im })
    );
    assert_eq!(suits("cotan", &circum, Weight::Unit, Held::Whole), Err(Unsuitable::NotPrimal));
    assert_eq!(suits("cotan", &circum, Weight::Integral, Held::Primal), Ok(()));
    assert_eq!(suits("lu", &circum, Weight::Integral, Held::Primal), Ok(()));
}

#[test]
fn an_unknown_solver_is_told_the_known_ones() {
    let graph = graph_of(&disc_of("plane?n=3"), "");
    let problem = LinearProblem::new(&graph, Weight::Unit, &held(&graph, Held::Whole)).expect("well posed");
    let error = solve_linear(&problem, "cholesy", &mut Silent).expect_err("misspelt");
    let text = error.to_string();
    assert!(text.contains("`cholesy`") && text.contains("auto"), "{text}");
    assert!(LINEAR_SOLVERS.iter().all(|b| text.contains(b.name())), "{text}");
    assert!(linear_solver("cholesy").is_none());
    for (k, backend) in LINEAR_SOLVERS.iter().enumerate() {
        assert!(LINEAR_SOLVERS[..k].iter().all(|other| other.name() != backend.name()));
        assert!(!backend.description().is_empty() && backend.name() != "auto");
    }
}

#[test]
fn phases_are_announced_in_order() {
    struct Heard(Vec<Phase>);
    impl Observer for Heard {
        fn phase(&mut self, phase: Phase) {
            self.0.push(phase);
        }
    }
    for dual in ["barycentre", "circumcentre"] {
        let graph = graph_of(&disc_of("sphere?n=4&mesh=triangle"), dual);
        for kind in [Held::Whole, Held::Primal] {
            let problem = LinearProblem::new(&graph, Weight::Unit, &held(&graph, kind)).expect("well posed");
            for backend in LINEAR_SOLVERS.iter().filter(|b| b.suits(&problem).is_ok()) {
                let mut heard = Heard(Vec::new());
                backend.solve(&problem, &mut heard).expect("solvable");
                // The order is told by those that make it apart from the factor, between two parts of the assembly.
                heard.0.retain(|phase| *phase != Phase::Order);
                heard.0.dedup();
                assert_eq!(heard.0, [Phase::Assemble, Phase::Factor, Phase::Solve], "{}", backend.name());
            }
        }
    }
}

#[test]
fn a_problem_without_unknowns_is_solved_by_what_is_held() {
    // one quad, all of its vertices on the boundary
    let graph =
        graph_of(&disc(&surface(vec![[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], [[0, 1, 2, 3]])), "");
    let problem = LinearProblem::new(&graph, Weight::Integral, &held(&graph, Held::Whole)).expect("well posed");
    assert_eq!(problem.elimination.unknowns(), 0);
    for backend in ["auto", "cholesky-real", "cholesky", "qr", "nalgebra-cholesky"] {
        let solution = solve_linear(&problem, backend, &mut Silent).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(solution.z, problem.elimination.z0);
    }
}
