use super::exchange::call;
use super::harmonic::{arrays, check, finite};
use super::{Environment, LibiglError};
use serde_json::json;

/// libigl's scalable locally injective map and what it took.
#[derive(Clone, Debug)]
pub struct Slim {
    /// The map (`nv × 2`).
    pub uv: Vec<[f64; 2]>,
    /// Processor time of `igl.slim_precompute` and `igl.slim_solve`, all threads together, without the start.
    pub seconds_cpu: f64,
    /// The same by the clock.
    pub seconds_wall: f64,
    /// Whether the harmonic start was folded, so that one with unit weights took its place.
    pub uniform_start: bool,
    /// Version of libigl's Python package.
    pub version: String,
}

/// `iterations` steps towards the least symmetric Dirichlet energy Σ area (σ1² + σ2² + σ1⁻² + σ2⁻²), boundary free: libigl's
/// `slim_precompute`, `slim_solve` (Rabinovich, Poranne, Panozzo, Sorkine-Hornung 2017). The start is what libigl's tutorial takes: harmonic with
/// the `fixed` boundary at `values`, with unit weights where that folds, scaled to the surface's area.
///
/// `positions` (`nv × 3`), `triangles` (`nf × 3`), `fixed` (the boundary, any order, none twice), `values` (`nb × 2`).
///
/// Errors: as those of [`harmonic`](super::harmonic).
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
