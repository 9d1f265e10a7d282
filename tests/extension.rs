//! New dual points, backends and surfaces from outside the crate, through the public interface alone.

mod common;

use common::*;
use num_complex::Complex64;
use riemap::constraint::{Shape, on_shape};
use riemap::energy::conformal::{self, Weight};
use riemap::problem::linear::LinearProblem;
use riemap::quad_graph::QuadGraph;
use riemap::quad_graph::dual::{BoundaryDual, DualPoint};
use riemap::solver::{LinearSolver, Observer, Phase, Silent, SolveError, Unsuitable, solve_linear};
use riemap::surface::generate::{Form, Immersion, Parameter, SurfaceKind, generate_from};

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
