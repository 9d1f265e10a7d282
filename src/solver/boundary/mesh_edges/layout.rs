//! The boundary laid out edge by edge.

use num_complex::Complex64;

use crate::laplacian::ConformalLaplacian;
use crate::quad_graph::QuadGraph;

/// The black boundary edges of a surface, each laid out in the plane with the white vertex between its ends, the surface's own
/// angle kept there: on triangle meshes the boundary edges themselves.
#[derive(Clone, Debug)]
pub struct Layout {
    /// l_k, the distance from b_k to b_{k+1} (n).
    pub length: Vec<f64>,
    /// κ_k: w_k lies at `b_k + κ_k (b_{k+1} − b_k)` (n). A triangle mesh's midpoints have ½.
    pub kappa: Vec<Complex64>,
    /// How the polygon of black vertices turns at b_k on the surface, the angle π less that of the faces (n).
    pub turning: Vec<f64>,
}

impl Layout {
    /// The layout for a graph, its boundary lengths as they are there. `curvature` is as in
    /// [`MeshEdgeProblem`](super::MeshEdgeProblem::curvature).
    pub fn new(graph: &QuadGraph, laplacian: &ConformalLaplacian, curvature: &[f64]) -> Self {
        let n = laplacian.len();
        let (black, white) = (laplacian.black_boundary(), laplacian.white_boundary());
        let halves = |k: usize| {
            let [here, between] = [laplacian.black_index()[k], laplacian.white_index()[k]];
            [here, between].map(|k| graph.boundary_length[k as usize])
        };
        let turn_at_white: Vec<f64> = white.iter().map(|&v| curvature[v as usize]).collect();
        // b_{k+1} − b_k where the edge from b_k to w_k has direction 1.
        let chord: Vec<Complex64> = (0..n)
            .map(|k| {
                let [before, after] = halves(k);
                before + after * Complex64::cis(turn_at_white[k])
            })
            .collect();
        let mut turning = vec![0.0; n];
        for range in laplacian.loops() {
            for k in range.clone() {
                let last = if k == range.start { range.end - 1 } else { k - 1 };
                turning[k] = curvature[black[k] as usize] + turn_at_white[last] - chord[last].arg() + chord[k].arg();
            }
        }
        Layout {
            length: chord.iter().map(|c| c.norm()).collect(),
            kappa: (0..n).map(|k| halves(k)[0] / chord[k]).collect(),
            turning,
        }
    }
}
