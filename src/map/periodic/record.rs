use num_complex::Complex64;
use serde::Serialize;

use super::{NotReducible, PeriodicMap, Texture, reduce, relative_error, whole};
use crate::surface::oriented_mesh::OrientedMesh;

/// What a report says of a periodic map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PeriodsRecord {
    /// ω2/ω1 in the fundamental domain: [Re τ, Im τ].
    pub tau: [f64; 2],
    /// The ratio in the basis of shortest loops.
    pub tau_found: [f64; 2],
    /// [[a, b], [c, d]] with `τ = (a τ_found + b) / (c τ_found + d)`.
    pub basis: [[i64; 2]; 2],
    /// Loops of the mesh with the periods 1 and τ.
    pub loops: [LoopRecord; 2],
    /// The linear map to texture coordinates with whole-number periods, and its shear..
    pub whole: Texture,
    /// The periods of the white values of (2) divided by those of the black ones, [Re, Im]: 1 for a conformal map. `None` for a map by
    /// least squares.
    pub white_to_black: Option<[f64; 2]>,
    /// H of the map divided by the area of its image, Im τ: 0 for a conformal map.
    pub h_per_area: f64,
    /// The exact ratio, reduced, where it is known.
    pub exact: Option<[f64; 2]>,
    /// |τ − exact| / |exact|
    pub error: Option<f64>,
}

/// A loop of the mesh.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LoopRecord {
    /// Its length on the surface.
    pub length: f64,
    /// Its vertices, as the source numbers them; those put into holes left out.
    pub vertices: Vec<u32>,
}

impl PeriodsRecord {
    /// The record of `map`; `exact` is the ratio of the periods of any basis, where it is known.
    ///
    /// # Errors
    /// An exact ratio that is none.
    pub fn new(disc: &OrientedMesh, map: &PeriodicMap, exact: Option<Complex64>) -> Result<Self, NotReducible> {
        let pair = |z: Complex64| [z.re, z.im];
        let loops = map
            .loops
            .each_ref()
            .map(|cycle| LoopRecord { length: cycle.length, vertices: in_source(disc, &cycle.vertices) });
        Ok(PeriodsRecord {
            tau: pair(map.tau),
            tau_found: pair(map.tau_found),
            basis: map.found.matrix,
            loops,
            whole: whole(map.tau),
            white_to_black: map.white_to_black.map(pair),
            h_per_area: map.h / map.tau.im,
            exact: exact.map(reduce).transpose()?.map(|exact| pair(exact.tau)),
            error: exact.map(|exact| relative_error(map.tau, exact)).transpose()?,
        })
    }
}

fn in_source(disc: &OrientedMesh, vertices: &[u32]) -> Vec<u32> {
    vertices.iter().map(|&v| disc.source_vertex[v as usize]).filter(|&v| v != OrientedMesh::NEW).collect()
}
