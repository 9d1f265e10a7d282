//! Faces that give no ρ are named as the source numbers them.

use crate::common::*;
use num_complex::Complex64;
use riemap::quad_graph::dual::{BoundaryDual, DUAL_POINTS, dual_point};
use riemap::quad_graph::metric::RestMetric;
use riemap::quad_graph::{QuadGraph, QuadGraphError, RestSource, TangentPlanes};
use riemap::surface::oriented_mesh::OrientedMesh;

/// Two triangles or one quad, behind an unused vertex, so that the disc's numbers are not the source's.
fn shifted(faces: &[&[u32]], positions: &[[f64; 3]]) -> OrientedMesh {
    let mut all = vec![[9.0; 3]];
    all.extend(positions);
    disc(&surface(all, faces.iter().map(|f| f.iter().map(|v| v + 1).collect::<Vec<_>>())))
}

const SQUARE: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];

#[test]
fn degenerate_faces_are_named_with_the_vertices_of_the_source() {
    let mut quad = shifted(&[&[0, 1, 2, 3]], &SQUARE);
    quad.positions[3] = quad.positions[1];
    assert_eq!(
        QuadGraph::from_quads(&quad, None),
        Err(QuadGraphError::DegenerateQuad { face: 0, vertices: [1, 2, 3, 4] })
    );
    let mut triangles = shifted(&[&[0, 1, 2], &[0, 2, 3]], &SQUARE);
    triangles.positions[3] = [2., 2., 0.];
    for dual in DUAL_POINTS {
        let found = QuadGraph::from_triangles(&triangles, *dual, BoundaryDual::Midpoint);
        // a face on one line: circumcentres break down, the others may still have a point there
        match found {
            Err(error) => {
                assert_eq!(error, QuadGraphError::DegenerateTriangle { face: 1, vertices: [1, 3, 4] });
                assert!(error.to_string().contains("face 1") && error.to_string().contains("[1, 3, 4]"));
            }
            Ok(graph) => assert!(dual.name() != "circumcentre" && graph.rho.iter().all(|rho| rho.is_finite())),
        }
    }
    for far in [f64::NAN, f64::INFINITY, 1e200] {
        triangles.positions[3] = [far, 0., 0.];
        for dual in DUAL_POINTS {
            let found = QuadGraph::from_triangles(&triangles, *dual, BoundaryDual::Midpoint);
            assert!(
                matches!(found, Err(QuadGraphError::DegenerateTriangle { face: 1, vertices: [1, 3, 4] })),
                "{far} {}: {found:?}",
                dual.name()
            );
        }
    }
}

#[test]
fn a_foot_beside_its_edge_is_named_with_the_vertices_of_the_source() {
    // the barycentre of the second triangle projects beyond the end of its edge 3–0
    let disc = shifted(&[&[0, 1, 2], &[0, 2, 3]], &[[0., 0., 0.], [9., 0., 0.], [9., 1., 0.], [0., 1., 0.]]);
    let barycentre = dual_point("barycentre").expect("in the table");
    assert!(QuadGraph::from_triangles(&disc, barycentre, BoundaryDual::Foot).is_ok());
    let disc = shifted(&[&[0, 1, 2], &[0, 2, 3]], &[[0., 0., 0.], [9., 0., 0.], [9., 1., 0.], [-3., 1., 0.]]);
    let found = QuadGraph::from_triangles(&disc, barycentre, BoundaryDual::Foot);
    assert_eq!(found, Err(QuadGraphError::FootOutsideEdge { face: 1, edge: [4, 1] }));
    assert!(QuadGraph::from_triangles(&disc, barycentre, BoundaryDual::Midpoint).is_ok());
}

#[test]
fn rho_is_measured_on_given_tangent_planes() {
    let quad = shifted(&[&[0, 1, 2, 3]], &SQUARE);
    let seen =
        |normal| QuadGraph::from_quads(&quad, Some(&TangentPlanes::exactly(vec![normal], RestSource::Projected)));
    let tilted = seen([0.6, 0.0, 0.8]).expect("seen from above");
    assert!((tilted.rho[0] - Complex64::new(1.6, -0.36) / (2.0 - 0.36)).norm() <= 1e-15);
    for normal in [[1., 0., 0.], [0., 0., -1.], [f64::NAN; 3]] {
        let found = seen(normal);
        assert!(matches!(found, Err(QuadGraphError::NormalOffFace { face: 0, .. })), "{found:?}");
    }
}

#[test]
fn guarded_planes_are_never_edge_on_and_say_how_many_were_tilted() {
    let quad = shifted(&[&[0, 1, 2, 3]], &SQUARE);
    for normal in [[1., 0., 0.], [0., 0., -1.], [0.0, 0.6, -0.8]] {
        let planes = TangentPlanes::guarded(&quad, vec![normal], RestSource::Projected);
        assert_eq!(planes.tilted, 1);
        let graph = QuadGraph::from_quads(&quad, Some(&planes)).expect("no longer edge-on");
        assert!(graph.rho[0].re > 0.0 && graph.tilted == 1);
        let [x, y, z] = planes.normals[0];
        assert!(((x * x + y * y + z * z) - 1.0).abs() < 1e-15 && z >= TangentPlanes::SMALLEST_COSINE * (1.0 - 1e-15));
        // Tilted in its own vertical plane.
        assert!((x * normal[1] - y * normal[0]).abs() < 1e-15 && x * normal[0] + y * normal[1] >= 0.0);
    }
    let plain = TangentPlanes::guarded(&quad, vec![[0.6, 0.0, 0.8]], RestSource::Projected);
    assert_eq!((plain.normals[0], plain.tilted), ([0.6, 0.0, 0.8], 0));
}

#[test]
fn projected_rest_lengths_fit_rho_and_unit_ones_are_those_of_the_positions() {
    let quad = shifted(&[&[0, 1, 2, 3]], &SQUARE);
    let normal = [0.48, 0.36, 0.8];
    for (rest, x, y, area) in [
        (RestSource::Projected, (1.0 - 0.48f64.powi(2)).sqrt(), (1.0 - 0.36f64.powi(2)).sqrt(), 0.8),
        (RestSource::Unit, 1.0, 1.0, 1.0),
    ] {
        let planes = TangentPlanes::exactly(vec![normal], rest);
        let graph = QuadGraph::from_quads(&quad, Some(&planes)).expect("seen from above");
        // ρ and the projected area are the same whatever is at rest.
        assert!((graph.area(0) - 0.8).abs() < 1e-15);
        let metric = RestMetric::of_quads(&quad, &graph, Some(&planes));
        let near = |a: f64, b: f64| (a - b).abs() < 1e-15;
        let alternate = |lengths: &[f64]| lengths.iter().all(|&l| near(l, x) || near(l, y));
        assert!(alternate(&graph.boundary_length) && alternate(&metric.length), "{rest:?} {graph:?} {metric:?}");
        assert!(near(graph.perimeter(), 2.0 * (x + y)));
        assert!(near(metric.folded_area[0], area) && metric.area.iter().all(|&a| near(a, 0.5 * area)));
    }
}

#[test]
fn faces_of_the_wrong_kind_are_refused() {
    let (quads, triangles) = (disc_of("plane?n=2"), disc_of("plane?n=2&mesh=triangle"));
    let refused = QuadGraph::from_quads(&triangles, None);
    assert_eq!(refused, Err(QuadGraphError::Corners { corners: 3 }));
    let refused = QuadGraph::from_triangles(&quads, DUAL_POINTS[0], BoundaryDual::Midpoint);
    assert_eq!(refused, Err(QuadGraphError::Corners { corners: 4 }));
}

#[test]
fn dual_points_are_found_by_name_and_barycentres_are_the_default() {
    assert_eq!(DUAL_POINTS[0].name(), "barycentre");
    for (k, dual) in DUAL_POINTS.iter().enumerate() {
        assert!(DUAL_POINTS[..k].iter().all(|other| other.name() != dual.name()));
        assert_eq!(dual_point(dual.name()).expect("its own name").name(), dual.name());
        assert!(!dual.description().is_empty());
    }
    assert!(dual_point("orthocentre").is_none());
}
