use super::exchange::call;
use super::harmonic::{arrays, check, finite};
use super::{Environment, LibiglError};
use serde_json::json;

/// libigl's scalable locally injective map and its times.
#[derive(Clone, Debug)]
pub struct Slim {
    /// The map (`nv × 2`).
    pub uv: Vec<[f64; 2]>,
    /// Processor seconds of all threads of `igl.slim_precompute` and `igl.slim_solve`, without the
    /// start.
    pub seconds_cpu: f64,
    /// Wall-clock seconds of the same.
    pub seconds_wall: f64,
    /// Whether the harmonic start had flipped faces, and was replaced by one with unit weights.
    pub uniform_start: bool,
    /// Version of libigl's Python package.
    pub version: String,
}

/// Σ area (σ1² + σ2² + σ1⁻² + σ2⁻²), the symmetric Dirichlet energy, is reduced in `iterations`
/// steps with a free boundary by libigl's `slim_precompute` and `slim_solve` (Rabinovich, Poranne,
/// Panozzo, Sorkine-Hornung 2017). The start is that of libigl's tutorial: the harmonic map with
/// the `fixed` boundary at `values`, with unit weights if faces flip, scaled to the area of the
/// surface.
///
/// `positions` (`nv × 3`), `triangles` (`nf × 3`), `fixed` (the boundary, in any order, none
/// twice), `values` (`nb × 2`).
///
/// # Errors
/// Those of [`harmonic`](super::harmonic).
pub fn slim(
    environment: &Environment,
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    fixed: &[u32],
    values: &[[f64; 2]],
    iterations: usize,
) -> Result<Slim, LibiglError> {
    check(positions, triangles, fixed, values)?;
    let arrays = arrays(positions, triangles, fixed, values);
    let answer = call(environment, "slim", &arrays, json!({ "iterations": iterations }))?;
    let uv = answer.rows("uv", positions.len())?;
    finite("libigl's result at vertex", &uv)?;
    Ok(Slim {
        uv,
        seconds_cpu: answer.number("seconds_cpu")?,
        seconds_wall: answer.number("seconds_wall")?,
        uniform_start: answer.count("uniform_start")? > 0,
        version: environment.versions.libigl.clone(),
    })
}
