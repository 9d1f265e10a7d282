use super::exchange::call;
use super::harmonic::{arrays, check, finite};
use super::{Environment, LibiglError};
use serde_json::json;

/// libigl's least-squares conformal map and its times.
#[derive(Clone, Debug)]
pub struct Lscm {
    /// The map (`nv × 2`).
    pub uv: Vec<[f64; 2]>,
    /// Processor seconds of all threads of `igl.lscm`: assembly, factorisation and solve.
    pub seconds_cpu: f64,
    /// Wall-clock seconds of the same.
    pub seconds_wall: f64,
    /// Version of libigl's Python package.
    pub version: String,
}

/// Minimises the Dirichlet energy minus the area with a free boundary among the maps that have the
/// given `values` at the `fixed` vertices, by libigl's `lscm(V, F, b, bc)`. Two fixed vertices
/// determine the similarity and suffice.
///
/// `positions` (`nv × 3`), `triangles` (`nf × 3`), `fixed` (`nb ≥ 2`, in any order, none twice),
/// `values` (`nb × 2`).
///
/// # Errors
/// Those of [`harmonic`](super::harmonic), and fewer than two fixed vertices.
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
