//! New dual points, energies, constraints, solvers and surfaces from outside the crate, through the public interface alone.

mod common;

use std::str::FromStr;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use common::*;
use num_complex::Complex64;
use riemap::constraint::{ConstraintError, Fixed, Shape, on_shape};
use riemap::energy::conformal::{self, Weight};
use riemap::energy::{EnergyError, ExpressionError, Properties, Rest, energy};
use riemap::map::{Own, SolverChoice};
use riemap::problem::linear::LinearProblem;
use riemap::problem::nonlinear::Objective;
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, DualPoint};
use riemap::solver::{
    LinearSolver, MINIMISERS, MinimiseError, Minimiser, Minimum, Observer, Phase, Silent, SolveError, StopRule,
    Unsuitable, solve_linear,
};
use riemap::surface::generate::{Form, Immersion, Parameter, SurfaceKind, generate_from};
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::{Boundary, Constraint, Energy, EnergyKind, Expression, Input, MapError, MapOptions, Pin, map_input};

/// The symmedian point: barycentric weights a², b², c². Inside every triangle.
struct Symmedian;

impl DualPoint for Symmedian {
    fn name(&self) -> &'static str {
        "symmedian"
    }

    fn description(&self) -> &'static str {
        "symmedian point"
    }

    fn weights(&self, lengths: [f64; 3]) -> [f64; 3] {
        lengths.map(|l| l * l)
    }
}

/// The normal equations by Gauss–Seidel with over-relaxation: each vertex in turn at the minimum of H.
struct Relaxation;

impl LinearSolver for Relaxation {
    fn name(&self) -> &'static str {
        "relaxation"
    }

    fn description(&self) -> &'static str {
        "Gauss–Seidel on H"
    }

    fn suits(&self, problem: &LinearProblem) -> Result<(), Unsuitable> {
        problem.weights()?;
        Ok(())
    }

    fn solve(&self, problem: &LinearProblem, watch: &mut dyn Observer) -> Result<Vec<Complex64>, SolveError> {
        let graph = problem.graph;
        let w = problem
            .weights()
            .map_err(|reason| SolveError::Unsuitable { backend: self.name(), reason: reason.into() })?;
        watch.phase(Phase::Solve);
        let incidence = graph.incidence();
        let mut z = problem.elimination.z0.clone();
        for _ in 0..20_000 {
            for &v in &problem.elimination.free {
                let (mut slope, mut curvature) = (Complex64::ZERO, 0.0);
                for &q in incidence.of(v) {
                    let q = q as usize;
                    let coefficients = graph.quads[q].into_iter().zip(conformal::row(graph.rho[q]));
                    for (_, a) in coefficients.filter(|&(u, _)| u == v) {
                        slope += w[q] * a.conj() * conformal::residual(graph, q, &z);
                        curvature += w[q] * a.norm_sqr();
                    }
                }
                z[v as usize] -= 1.6 * slope / curvature;
            }
            let residual = problem
                .residual(&z)
                .map_err(|reason| SolveError::Unsuitable { backend: self.name(), reason: reason.into() })?;
            if residual < 1e-13 {
                return Ok(z);
            }
        }
        Err(SolveError::Singular { backend: self.name(), size: problem.elimination.unknowns() })
    }
}

/// A conformal immersion of the disc that the crate does not have: a patch of a cone around its axis, off the apex.
const CONE: SurfaceKind = SurfaceKind {
    name: "cone",
    about: "part of a cone of revolution, r = e^{u sin α}, φ = v",
    parameters: &[
        SurfaceKind::CELLS,
        &[Parameter::real("angle", 0.5, 0.1, 1.4, "half the opening angle")],
        SurfaceKind::MESH,
    ],
    form: Form::Disc(|arguments| {
        let (sin, cos) = arguments.real("angle")?.sin_cos();
        let immersion: Immersion = Box::new(move |[u, v]| {
            // distance from the apex e^{u sin α}, angle around the axis v: dr² + r² sin² α dv² = r² sin² α (du² + dv²)
            let r = (sin * u).exp();
            [r * sin * v.cos(), r * sin * v.sin(), -r * cos]
        });
        Ok(immersion)
    }),
    exact: true,
};

#[test]
fn a_new_dual_point_needs_its_weights_alone() {
    let flat = disc_of("graph:flat?n=8&mesh=delaunay&points=random&seed=6");
    let graph = QuadGraph::from_triangles(&flat, &Symmedian, BoundaryDual::Midpoint).expect("a disc");
    assert!(graph.min_re_rho() > 0.0, "inside every triangle");
    // linear precision: the planar mesh comes back from its boundary
    let z = planar_places(&flat, &Symmedian, BoundaryDual::Midpoint);
    let problem = LinearProblem::new(&graph, Weight::Integral, &hold_boundary(&graph, &z)).expect("whole boundary");
    let solution = solve_linear(&problem, "auto", &mut Silent).expect("solvable");
    assert!(largest_difference(&z, &solution.z) < 1e-11);
}

#[test]
fn a_new_backend_sees_all_it_needs_and_agrees_with_the_others() {
    let quads = disc_of("sphere?n=8&jitter=0.2");
    let triangles = disc_of("enneper?n=5&mesh=triangle");
    let graphs = [
        QuadGraph::from_quads(&quads, None).expect("a disc"),
        QuadGraph::from_triangles(&triangles, &Symmedian, BoundaryDual::Midpoint).expect("a disc"),
    ];
    for graph in &graphs {
        for weight in [Weight::Integral, Weight::Unit] {
            let fixed = on_shape(graph, Shape::Circle).expect("a boundary");
            let problem = LinearProblem::new(graph, weight, &fixed).expect("whole boundary");
            let own: &dyn LinearSolver = &Relaxation;
            assert_eq!(own.suits(&problem), Ok(()));
            let z = own.solve(&problem, &mut Silent).unwrap_or_else(|error| panic!("{error}"));
            let other = solve_linear(&problem, "qr", &mut Silent).expect("solvable").z;
            let d = largest_difference(&z, &other);
            assert!(d < 1e-9, "{weight:?}: {d:e}");
        }
    }
}

#[test]
fn a_new_surface_is_mapped_like_the_others() {
    let errors = [8, 16].map(|n| {
        let cone = generate_from(&[CONE], &format!("cone?n={n}&angle=0.7")).expect("a row");
        let exact: Vec<Complex64> = cone.exact.expect("conformal").iter().map(|w| Complex64::new(w[0], w[1])).collect();
        let graph = QuadGraph::from_quads(&disc(&cone.surface), None).expect("a disc");
        let problem = LinearProblem::new(&graph, Weight::Integral, &hold_boundary(&graph, &exact)).expect("whole");
        largest_difference(&exact, &solve_linear(&problem, "auto", &mut Silent).expect("solvable").z)
    });
    // order two: a quarter, nearly
    assert!(errors[0] < 0.01 && errors[1] < errors[0] / 3.0, "{errors:?}");
}

/// An energy of the table by another name, as a user's own.
struct Renamed(&'static str);

impl EnergyKind for Renamed {
    fn name(&self) -> &'static str {
        "own"
    }

    fn about(&self) -> &'static str {
        "an energy of the table"
    }

    fn properties(&self) -> Properties {
        energy(self.0).expect("of the table").properties()
    }

    fn make(&self, rest: Rest) -> Result<Box<dyn Energy>, EnergyError> {
        energy(self.0).expect("of the table").make(rest)
    }
}

#[test]
fn an_own_energy_is_minimised_as_one_of_the_table_is() {
    let input = Input::open("graph:cos+cos?n=8&mesh=triangle").expect("a surface");
    for name in ["A", "L"] {
        let map = |energy: Expression| {
            let options = MapOptions { boundary: Boundary::FREE, energy: Some(energy), ..MapOptions::default() };
            map_input(&input, &options, &mut Silent).unwrap_or_else(|error| panic!("{error}")).map
        };
        let listed = map(format!("H + 0.5 {name}").parse().expect("an expression"));
        let conformal: Expression = "H".parse().expect("an expression");
        let own = map(conformal.plus(0.5, Arc::new(Renamed(name))).expect("a term"));
        assert_eq!(listed.z, own.z, "{name}");
        assert_eq!(listed.total, own.total, "{name}");
    }
    let twice = Expression::from_str("H").expect("an expression").plus(1.0, Arc::new(Renamed("A")));
    let twice = twice.and_then(|sum| sum.plus(2.0, Arc::new(Renamed("L"))));
    assert_eq!(twice, Err(ExpressionError::Twice { name: "own" }));
}

/// Holds the pins of a list, as the options' own do.
struct Held(Vec<(u32, Complex64)>);

impl Constraint for Held {
    fn hold(&self, mesh: &OrientedMesh, _graph: &QuadGraph, fixed: &mut Fixed) -> Result<(), ConstraintError> {
        self.0.iter().for_each(|&(v, place)| fixed.hold(mesh.copies(v).start, place));
        Ok(())
    }
}

#[test]
fn an_own_constraint_holds_what_pins_hold() {
    let input = Input::open("graph:cos+cos?n=8&mesh=triangle").expect("a surface");
    let places = [(0, Complex64::new(0.0, 0.0)), (8, Complex64::new(2.0, 0.5)), (40, Complex64::new(1.0, 1.5))];
    let options = MapOptions {
        energy: Some("H + L".parse().expect("an expression")),
        boundary: Boundary::FREE,
        ..MapOptions::default()
    };
    let map =
        |options: &MapOptions| map_input(&input, options, &mut Silent).unwrap_or_else(|error| panic!("{error}")).map;
    let pins = places.map(|(vertex, z)| Pin { vertex, place: [z.re, z.im] }).to_vec();
    let pinned = map(&MapOptions { pins, ..options.clone() });
    let held = map(&MapOptions { constraints: vec![Own::new(Arc::new(Held(places.to_vec())))], ..options.clone() });
    assert_eq!(pinned.z, held.z);
    // A vertex that does not exist is an error, and no panic.
    let far = Own::<dyn Constraint>::new(Arc::new(Nowhere));
    let error =
        map_input(&input, &MapOptions { constraints: vec![far], ..options }, &mut Silent).expect_err("no such vertex");
    assert_eq!(error, MapError::Constraint(ConstraintError::NoSuchVertex { vertex: u32::MAX - 1 }));
}

/// Holds a vertex that no surface has.
struct Nowhere;

impl Constraint for Nowhere {
    fn hold(&self, _mesh: &OrientedMesh, _graph: &QuadGraph, fixed: &mut Fixed) -> Result<(), ConstraintError> {
        fixed.hold(u32::MAX - 1, Complex64::ZERO);
        Ok(())
    }
}

/// Levenberg–Marquardt, counting how often it is asked.
struct Counting(AtomicUsize);

impl Minimiser for Counting {
    fn name(&self) -> &'static str {
        "counting"
    }

    fn description(&self) -> &'static str {
        "Levenberg–Marquardt, counted"
    }

    fn minimise(
        &self,
        objective: &Objective,
        start: Vec<f64>,
        rule: StopRule,
        watch: &mut dyn Observer,
    ) -> Result<Minimum, MinimiseError> {
        self.0.fetch_add(1, Ordering::Relaxed);
        MINIMISERS[0].minimise(objective, start, rule, watch)
    }
}

#[test]
fn own_solvers_are_handed_to_a_map() {
    let input = Input::open("sphere?n=8&jitter=0.2").expect("a surface");
    let map =
        |options: &MapOptions| map_input(&input, options, &mut Silent).unwrap_or_else(|error| panic!("{error}")).map;

    let fixed = MapOptions { boundary: Boundary::FIXED, ..MapOptions::default() };
    let own = map(&MapOptions { solver: SolverChoice::Linear(Own::new(Arc::new(Relaxation))), ..fixed.clone() });
    assert_eq!(own.provenance.solver, "relaxation");
    assert!(largest_difference(&map(&fixed).z, &own.z) < 1e-9);

    let counting = Arc::new(Counting(AtomicUsize::new(0)));
    let own = Own::<dyn Minimiser>::new(Arc::clone(&counting) as Arc<dyn Minimiser>);
    let metric = MapOptions {
        energy: Some("H + L".parse().expect("an expression")),
        boundary: Boundary::FREE,
        ..MapOptions::default()
    };
    let found = map(&MapOptions { solver: SolverChoice::Minimiser(own), ..metric.clone() });
    assert_eq!((found.provenance.solver, counting.0.load(Ordering::Relaxed)), ("counting", 1));
    assert_eq!(map(&MapOptions { solver: MINIMISERS[0].name().into(), ..metric }).z, found.z);
}
