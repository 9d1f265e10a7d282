//! What is held: refusals of too little, and boundaries laid on shapes.

use crate::common::*;
use num_complex::Complex64;
use riemap::constraint::{ConstraintError, Fixed, Shape, on_shape};
use riemap::energy::conformal::Weight;
use riemap::problem::linear::LinearProblem;

#[test]
fn constraints_that_leave_freedoms_are_refused() {
    let graph = graph_of(&disc_of("sphere?n=5&mesh=triangle"), "barycentre");
    let refusal = |fixed: &Fixed| LinearProblem::new(&graph, Weight::Integral, fixed).err();
    let needed = graph.boundary.len() / 2 + 1;
    let zeros = vec![Complex64::ZERO; graph.vertices];
    for held in [0, 1, 2, needed - 1] {
        let fixed = hold(graph.boundary[..held].iter().copied(), &zeros);
        let freedoms = needed - held;
        assert_eq!(refusal(&fixed), Some(ConstraintError::Underdetermined { held, needed, freedoms }));
    }
    assert_eq!(refusal(&hold(graph.boundary[..needed].iter().copied(), &zeros)), None);
    // enough vertices, but all of the mesh itself: the dual ones float
    let primal_only = hold(0..needed as u32, &zeros);
    assert_eq!(refusal(&primal_only), Some(ConstraintError::Afloat { vertex: graph.primal as u32 }));
    let dual_only = hold((graph.primal..graph.primal + needed).map(|v| v as u32), &zeros);
    assert_eq!(refusal(&dual_only), Some(ConstraintError::Afloat { vertex: 0 }));
    let mut beyond = hold_boundary(&graph, &zeros);
    beyond.hold(graph.vertices as u32, Complex64::ZERO);
    assert_eq!(refusal(&beyond), Some(ConstraintError::NoSuchVertex { vertex: graph.vertices as u32 }));
    let mut nowhere = hold_boundary(&graph, &zeros);
    nowhere.hold(graph.boundary[4], Complex64::new(f64::NAN, 0.0));
    assert_eq!(refusal(&nowhere), Some(ConstraintError::NotFinite { vertex: graph.boundary[4] }));
}

#[test]
fn on_the_circle_the_boundary_goes_around_once_by_arc_length() {
    for (name, graph) in graphs() {
        let fixed = on_shape(&graph, Shape::Circle).expect("a boundary with length");
        assert_eq!(fixed.len(), graph.boundary.len());
        let mut arc = 0.0;
        for (&v, &length) in graph.boundary.iter().zip(&graph.boundary_length) {
            let place = fixed.place(v).expect("held");
            let expected = Complex64::cis(std::f64::consts::TAU * arc / graph.perimeter());
            assert!((place - expected).norm() < 1e-12, "{name}");
            arc += length;
        }
    }
}

#[test]
fn on_the_square_corners_are_held_by_mesh_vertices_and_sides_by_arc_length() {
    for (name, graph) in graphs() {
        let fixed = on_shape(&graph, Shape::Square).expect("enough vertices");
        assert_eq!(fixed.len(), graph.boundary.len());
        let z: Vec<Complex64> = graph.boundary.iter().map(|&v| fixed.place(v).expect("held")).collect();
        assert!(z.iter().all(|z| (z.re.abs().max(z.im.abs()) - 1.0).abs() < 1e-14), "{name}");
        let corners: Vec<usize> = (0..z.len()).filter(|&k| z[k].re.abs() == 1.0 && z[k].im.abs() == 1.0).collect();
        assert_eq!(corners.len(), 4, "{name}");
        assert!(corners.iter().all(|&k| (graph.boundary[k] as usize) < graph.primal), "{name}");
        // counter-clockwise, around once: the signed area is that of the square
        let n = z.len();
        let area: f64 = (0..n).map(|k| 0.5 * (z[k].conj() * z[(k + 1) % n]).im).sum();
        assert!((area - 4.0).abs() < 1e-12, "{name}: {area}");
        // on one side lengths are in one proportion to those at rest
        for c in 0..4 {
            let (from, to) = (corners[c], if c < 3 { corners[c + 1] } else { corners[0] + n });
            let rate = |k: usize| (z[(k + 1) % n] - z[k % n]).norm() / graph.boundary_length[k % n];
            assert!((from..to).all(|k| (rate(k) / rate(from) - 1.0).abs() < 1e-10), "{name}");
        }
    }
    // three mesh vertices have no four corners
    let triangle = disc(&surface(scattered(3), [[0, 1, 2]]));
    let refused = on_shape(&graph_of(&triangle, "barycentre"), Shape::Square);
    assert_eq!(refused, Err(ConstraintError::TooFewBoundaryVertices { vertices: 3, needed: 4 }));
}

#[test]
fn a_boundary_without_length_is_refused_by_name() {
    let mut quads = disc_of("plane?n=3");
    let (a, b) = (quads.boundary[1], quads.boundary[2]);
    quads.positions[b as usize] = quads.positions[a as usize];
    let graph = graph_of(&quads, "");
    assert_eq!(on_shape(&graph, Shape::Circle), Err(ConstraintError::NoArcLength(a, b)));
}
