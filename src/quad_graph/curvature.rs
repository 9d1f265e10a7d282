//! Angles around vertices: the curvature of a surface and the turning of its boundary.

use std::f64::consts::{PI, TAU};

use super::QuadGraph;
use crate::geometry::vector::{cross, dot, norm, scale, sub};
use crate::surface::oriented_mesh::OrientedMesh;

/// Returns the angle defect of each vertex of the graph (`nv`): 2π, or π on the boundary, minus the
/// angles of the faces at the vertex; 0 at dual vertices. For a disc the sum is 2π (Gauss–Bonnet).
///
/// The angles of a quad are those between its edges in R³; if it is not flat, their difference from
/// 2π is distributed evenly over its corners. With `normals` (`nf × 3`, unit) the edges are
/// projected to the tangent planes first.
pub fn curvature(disc: &OrientedMesh, graph: &QuadGraph, normals: Option<&[[f64; 3]]>) -> Vec<f64> {
    let mut curvature = vec![0.0; graph.vertices];
    curvature[..graph.primal].fill(TAU);
    for &v in graph.boundary.iter().filter(|&&v| !graph.is_dual(v)) {
        curvature[v as usize] = PI;
    }
    for (f, polygon) in disc.faces.iter().enumerate() {
        let n = polygon.len();
        let given = normals.map(|normals| normals[f]);
        let edge = |k: usize| {
            let d = disc.spoke(f, k % n, (k + 1) % n);
            given.map_or(d, |n| sub(d, scale(dot(d, n), n)))
        };
        // Twice the vector area, which points upward.
        let up = given.unwrap_or_else(|| cross(sub(edge(0), scale(-1.0, edge(1))), sub(edge(1), scale(-1.0, edge(2)))));
        let angle = |k: usize| {
            let (back, ahead) = (scale(-1.0, edge(k + n - 1)), edge(k));
            let area = cross(ahead, back);
            let angle = norm(area).atan2(dot(ahead, back));
            if dot(area, up) < 0.0 { TAU - angle } else { angle }
        };
        let whole = PI * (n as f64 - 2.0);
        let sum: f64 = (0..n).map(angle).sum();
        for k in 0..n {
            curvature[polygon[k] as usize] -= angle(k) + (whole - sum) / n as f64;
        }
    }
    curvature
}
