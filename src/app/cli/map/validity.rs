//! The faults of a map that is not injective, in words.

use num_complex::Complex64;

use crate::distortion::{Distortion, Validity};
use crate::surface::Surface;
use crate::surface::oriented_mesh::OrientedMesh;

use crate::app::cli::plural;

/// Number of faces or vertices that a message names.
const NAMED: usize = 5;

/// Describes why a map is not injective, one sentence per reason.
pub(super) fn faults(validity: &Validity, distortion: &Distortion) -> Vec<String> {
    let mut faults = Vec::new();
    let filled = validity.folded.iter().filter(|&&f| f == OrientedMesh::NEW).count();
    let folded = &validity.folded[..validity.folded.len() - filled];
    if !folded.is_empty() {
        let how = match (distortion.flipped, distortion.not_convex.saturating_sub(distortion.flipped)) {
            (_, 0) => "flipped",
            (0, _) => "positive but not convex",
            _ => "flipped, or positive but not convex",
        };
        let faces = plural(folded.len(), "face is", "faces are");
        faults.push(format!("the map is not injective: {faces} {how}: {}", named("face", "faces", folded)));
    }
    if filled > 0 {
        let faces = plural(filled, "face is", "faces are");
        faults.push(format!("{faces} flipped that fill holes, whose rims may therefore overlap"));
    }
    if !validity.wound.is_empty() {
        let vertices = plural(validity.wound.len(), "vertex", "vertices");
        let named = named("vertex", "vertices", &validity.wound);
        faults.push(format!("the map is not injective: the faces wind more than once around {vertices}: {named}"));
    }
    if let Some([a, b]) = validity.crossing {
        let but = if validity.is_locally_one_to_one() { "; the map is locally injective" } else { "" };
        faults.push(format!(
            "the boundary of the map crosses or touches itself, at the boundary edges from vertices {a} and {b}{but}"
        ));
    }
    faults
}

/// Lists the first indices, as in `faces 3, 5, 8 and 20 more`.
fn named(one: &str, many: &str, of: &[u32]) -> String {
    let shown: Vec<String> = of.iter().take(NAMED).map(u32::to_string).collect();
    let more = match of.len().saturating_sub(NAMED) {
        0 => String::new(),
        n => format!(" and {n} more"),
    };
    format!("{} {}{more}", if of.len() == 1 { one } else { many }, shown.join(", "))
}

/// Checks texture coordinates as they are written, one pair for every corner of `surface`: those of
/// periodic maps are moved and rounded.
pub(super) fn of_written(disc: &OrientedMesh, surface: &Surface, pairs: &[[f64; 2]]) -> Validity {
    let mut at = vec![Complex64::ZERO; disc.faces.corners().len()];
    for (&corner, &[x, y]) in disc.corners_of(surface).iter().zip(pairs) {
        if let Some(at) = at.get_mut(corner as usize) {
            *at = Complex64::new(x, y);
        }
    }
    Validity::new(disc, |c| at[c])
}
