use super::exchange::call;
use super::harmonic::{arrays, check, finite};
use super::{Environment, LibiglError};
use serde_json::json;

/// libigl's least-squares conformal map and what it took.
#[derive(Clone, Debug)]
pub struct Lscm {
    /// The map (`nv × 2`).
    pub uv: Vec<[f64; 2]>,
    /// Processor time of `igl.lscm` alone, all threads together: assembly, factorisation and solve.
    pub seconds_cpu: f64,
    /// The same by the clock.
    pub seconds_wall: f64,
    /// Version of libigl's Python package.
    pub version: String,
}

/// The map uv of least Dirichlet energy − area, boundary free, among those that are `values` at the `fixed` vertices:
/// libigl's `lscm(V, F, b, bc)`. Two fixed vertices take up the similarities and are enough.
///
/// `positions` (`nv × 3`), `triangles` (`nf × 3`), `fixed` (`nb ≥ 2`, any order, none twice), `values` (`nb × 2`).
///
/// Errors: as those of [`harmonic`](super::harmonic), and fewer than two fixed vertices.
pub fn lscm(
    environment: &Environment,
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    fixed: &[u32],
    values: &[[f64; 2]],
) -> Result<Lscm, LibiglError> {
    check(positions, triangles, fixed, values)?;
    if fixed.len() < 2 {
        return Err(LibiglError::TooFewFixed { fixed: fixed.len() });
    }
    let arrays = arrays(positions, triangles, fixed, values);
    let answer = call(environment, "lscm", &arrays, json!({}))?;
    let uv = answer.rows("uv", positions.len())?;
    finite("libigl's result at vertex", &uv)?;
    Ok(Lscm {
        uv,
        seconds_cpu: answer.number("seconds_cpu")?,
        seconds_wall: answer.number("seconds_wall")?,
        version: environment.versions.libigl.clone(),
    })
}
