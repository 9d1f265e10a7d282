use super::shared::*;
use crate::common::*;
use riemap::energy::conformal::Weight;
use riemap::map::periodic::{PeriodicError, periodic};
use riemap::quad_graph::{PeriodsError, QuadGraph};
use riemap::solver::Silent;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::surface::topology::homology::HomologyError;

fn refused(disc: &OrientedMesh, graph: &QuadGraph, weight: Weight) -> PeriodicError {
    periodic(disc, graph, weight, &mut Silent).unwrap_err()
}

#[test]
fn surfaces_of_another_genus_or_with_a_boundary_are_refused() {
    let sphere = closed(&cube());
    let graph = graph_of(&sphere, "");
    assert_eq!(refused(&sphere, &graph, Weight::Integral), PeriodicError::Homology(HomologyError::Sphere));

    let torus = quad_grid(6, 6, Sides::Torus);
    let double = closed(&connected_sum(&torus, 3, &torus, 9));
    let graph = graph_of(&double, "");
    let error = refused(&double, &graph, Weight::Integral);
    assert_eq!(error, PeriodicError::Homology(HomologyError::Genus { genus: 2 }));
    assert!(error.to_string().contains("genus 2"), "{error}");

    let disc = disc_of("sphere?n=8");
    let error = refused(&disc, &graph_of(&disc, ""), Weight::Integral);
    assert_eq!(error, PeriodicError::Homology(HomologyError::Boundary { edges: disc.boundary.len() }));
}

#[test]
fn integral_weights_of_obtuse_pairs_are_refused_and_unit_ones_are_not() {
    let disc = torus(12, "&mesh=triangle");
    let graph = graph_of(&disc, "circumcentre");
    let error = refused(&disc, &graph, Weight::Integral).to_string();
    assert!(error.contains("Re ρ") && error.contains("integral weights"), "{error}");
    assert!(map(&disc, &graph, Weight::Unit).tau.im > 1.0);
}

#[test]
fn a_quad_graph_of_another_mesh_is_refused() {
    for (mesh, dual) in [("", ""), ("&mesh=triangle", "barycentre")] {
        let (one, other) = (torus(8, mesh), torus(10, mesh));
        for (disc, graph) in [(&one, graph_of(&other, dual)), (&other, graph_of(&one, dual))] {
            let error = refused(disc, &graph, Weight::Integral);
            assert!(matches!(error, PeriodicError::Periods(PeriodsError::OtherMesh { .. })), "{error}");
        }
    }
}

#[test]
fn faces_that_disagree_or_lie_apart_are_refused_by_the_library() {
    // The pipeline orients and takes one component; a `OrientedMesh` made by hand need not be so.
    let whole = torus(8, "");
    let graph = graph_of(&whole, "");
    let mut turned = whole.clone();
    turned.faces.flip(11);
    let error = refused(&turned, &graph, Weight::Integral);
    assert!(matches!(error, PeriodicError::Homology(HomologyError::Orientation { .. })), "{error}");

    let mut two = whole.clone();
    two.faces = whole
        .faces
        .iter()
        .map(<[u32]>::to_vec)
        .chain(whole.faces.iter().map(|f| f.iter().map(|v| v + 64).collect()))
        .collect();
    two.positions.extend(whole.positions.iter().copied());
    let error = refused(&two, &graph, Weight::Integral);
    assert_eq!(error, PeriodicError::Homology(HomologyError::Disconnected));
}
