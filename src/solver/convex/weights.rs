//! Weights computed from the shapes of the faces.

use super::{ConvexError, Weighted};
use crate::geometry::vector::{cross, dot, norm};
use crate::surface::edges::Edges;
use crate::surface::oriented_mesh::OrientedMesh;

/// Weight 1 along every edge, in both directions.
pub(super) fn uniform(disc: &OrientedMesh) -> Result<Vec<Weighted>, ConvexError> {
    let edges = Edges::new(&disc.faces, disc.positions.len());
    Ok(edges.ends.iter().flat_map(|&[a, b]| both_ways(a, b, 1.0)).collect())
}

/// Mean-value weights `w_ij = (tan α/2 + tan β/2) / |vi − vj|`, where α and β are the angles at vi
/// on both sides of the edge (Floater 2003). They are defined for all polygons, and `Σ w_ij (v_j −
/// v_i) = 0` on a flat mesh.
pub(super) fn mean_value(disc: &OrientedMesh) -> Result<Vec<Weighted>, ConvexError> {
    let mut weights = Vec::with_capacity(2 * disc.faces.corners().len());
    for (f, polygon) in disc.faces.iter().enumerate() {
        let n = polygon.len();
        for k in 0..n {
            let [vertex, ahead, behind] = [0, 1, n - 1].map(|step| polygon[(k + step) % n]);
            let [to_ahead, to_behind] = [1, n - 1].map(|step| disc.spoke(f, k, (k + step) % n));
            let (product, along, area) =
                (norm(to_ahead) * norm(to_behind), dot(to_ahead, to_behind), norm(cross(to_ahead, to_behind)));
            // tan α/2 = sin α / (1 + cos α) = (1 − cos α) / sin α; the form without cancellation is
            // used.
            let tangent = if along > 0.0 { area / (product + along) } else { (product - along) / area };
            for (neighbour, d) in [(ahead, to_ahead), (behind, to_behind)] {
                let weight = tangent / norm(d);
                if !(weight > 0.0 && weight.is_finite()) {
                    return Err(ConvexError::NoAngle { name: "mean-value", face: disc.source_face[f] });
                }
                weights.push(Weighted { vertex, neighbour, weight });
            }
        }
    }
    Ok(weights)
}

/// Cotangent weights `w_ij = ½ (cot α + cot β)`, where α and β are the angles opposite the edge.
pub(super) fn cotan(disc: &OrientedMesh) -> Result<Vec<Weighted>, ConvexError> {
    let mut weights = Vec::with_capacity(2 * disc.faces.corners().len());
    for (f, polygon) in disc.faces.iter().enumerate() {
        let &[a, b, c] = polygon else { return Err(ConvexError::NotTriangles { corners: polygon.len() }) };
        for (k, [i, j]) in [[b, c], [c, a], [a, b]].into_iter().enumerate() {
            let [u, v] = [1, 2].map(|step| disc.spoke(f, k, (k + step) % 3));
            let weight = 0.5 * dot(u, v) / norm(cross(u, v));
            if !weight.is_finite() {
                return Err(ConvexError::NoAngle { name: "cotan", face: disc.source_face[f] });
            }
            weights.extend(both_ways(i, j, weight));
        }
    }
    Ok(weights)
}

pub(super) fn both_ways(a: u32, b: u32, weight: f64) -> [Weighted; 2] {
    [Weighted { vertex: a, neighbour: b, weight }, Weighted { vertex: b, neighbour: a, weight }]
}
