use super::exchange::{Array, Numbers, call};
use super::{Environment, LibiglError};
use serde_json::json;

/// Weights ½(cot α + cot β) above −ZERO_WEIGHT are not counted as negative: the cotangents of two
/// angles with the sum π add up to some 1e-16 of either sign.
const ZERO_WEIGHT: f64 = 1e-12;

/// libigl's harmonic map and its times.
#[derive(Clone, Debug)]
pub struct Harmonic {
    /// The map (`nv × 2`).
    pub uv: Vec<[f64; 2]>,
    /// Processor seconds of all threads of `igl.harmonic`: assembly, factorisation and solve.
    pub seconds_cpu: f64,
    /// Wall-clock seconds of the same.
    pub seconds_wall: f64,
    /// Number of edges with two triangles.
    pub interior_edges: usize,
    /// Number of these edges whose weight ½(cot α + cot β) in `igl.cotmatrix` is below −1e-12.
    pub negative_weights: usize,
    /// Version of libigl's Python package.
    pub version: String,
}

/// Σ_j ½(cot α_ij + cot β_ij)(uv_j − uv_i) = 0 at every vertex i except the `fixed` ones, where uv
/// has the given `values`. Calls libigl's `harmonic(V, F, b, bc, 1)`.
///
/// `positions` (`nv × 3`), `triangles` (`nf × 3`), `fixed` (`nb`, in any order, none twice),
/// `values` (`nb × 2`).
///
/// # Errors
/// An index that does not exist, a vertex fixed twice, a number that is not finite, or a vertex
/// without a path of edges to a fixed one (libigl crashes on some of these, and returns zeros for
/// others); a failure of libigl, with its message.
pub fn harmonic(
    environment: &Environment,
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    fixed: &[u32],
    values: &[[f64; 2]],
) -> Result<Harmonic, LibiglError> {
    check(positions, triangles, fixed, values)?;
    let arrays = arrays(positions, triangles, fixed, values);
    let answer = call(environment, "harmonic", &arrays, json!({ "zero_weight": ZERO_WEIGHT }))?;
    let uv = answer.rows("uv", positions.len())?;
    finite("libigl's result at vertex", &uv)?;
    Ok(Harmonic {
        uv,
        seconds_cpu: answer.number("seconds_cpu")?,
        seconds_wall: answer.number("seconds_wall")?,
        interior_edges: answer.count("interior_edges")?,
        negative_weights: answer.count("negative_weights")?,
        version: environment.versions.libigl.clone(),
    })
}

/// Returns the arrays of a call for a map of a mesh with fixed vertices.
pub(super) fn arrays<'a>(
    positions: &'a [[f64; 3]],
    triangles: &'a [[u32; 3]],
    fixed: &'a [u32],
    values: &'a [[f64; 2]],
) -> [Array<'a>; 4] {
    [
        Array { name: "positions", columns: 3, numbers: Numbers::Real(positions.as_flattened()) },
        Array { name: "triangles", columns: 3, numbers: Numbers::Index(triangles.as_flattened()) },
        Array { name: "fixed", columns: 1, numbers: Numbers::Index(fixed) },
        Array { name: "values", columns: 2, numbers: Numbers::Real(values.as_flattened()) },
    ]
}

pub(super) fn check(
    positions: &[[f64; 3]],
    triangles: &[[u32; 3]],
    fixed: &[u32],
    values: &[[f64; 2]],
) -> Result<(), LibiglError> {
    let count = positions.len();
    finite("position of vertex", positions)?;
    finite("value of fixed vertex", values)?;
    if fixed.len() != values.len() {
        return Err(LibiglError::ValueCount { fixed: fixed.len(), values: values.len() });
    }
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&vertex) = corners.iter().find(|&&v| v as usize >= count) {
            return Err(LibiglError::TriangleIndex { triangle, vertex, count });
        }
    }
    let mut is_fixed = vec![false; count];
    for &vertex in fixed {
        let flag = is_fixed.get_mut(vertex as usize).ok_or(LibiglError::FixedIndex { vertex, count })?;
        if std::mem::replace(flag, true) {
            return Err(LibiglError::FixedTwice { vertex });
        }
    }
    match first_undetermined(triangles, is_fixed) {
        Some(vertex) => Err(LibiglError::Undetermined { vertex }),
        None => Ok(()),
    }
}

/// Returns the first vertex of a component that has no `determined` vertex, by union–find with path
/// halving.
fn first_undetermined(triangles: &[[u32; 3]], mut determined: Vec<bool>) -> Option<usize> {
    let mut parent: Vec<usize> = (0..determined.len()).collect();
    fn root(parent: &mut [usize], mut v: usize) -> usize {
        while parent[v] != v {
            parent[v] = parent[parent[v]];
            v = parent[v];
        }
        v
    }
    for &[a, b, c] in triangles {
        for other in [b, c] {
            let (one, other) = (root(&mut parent, a as usize), root(&mut parent, other as usize));
            parent[other] = one;
            determined[one] |= determined[other];
        }
    }
    (0..parent.len()).find(|&v| !determined[root(&mut parent, v)])
}

pub(super) fn finite<const N: usize>(what: &'static str, rows: &[[f64; N]]) -> Result<(), LibiglError> {
    match rows.iter().position(|row| !row.iter().all(|x| x.is_finite())) {
        Some(index) => Err(LibiglError::NotFinite { what, index }),
        None => Ok(()),
    }
}
