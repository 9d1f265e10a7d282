use super::{Facets, NormalError};
use crate::surface::digital::boundary;
use crate::surface::edges::Edges;

/// Applies `estimate` to the whole closed digital surface if `facets` are only a part of it, for
/// example because it was cut open.
///
/// Otherwise the averages would be truncated at the boundary of the part.
pub(super) fn on_whole(
    facets: &Facets,
    estimate: impl Fn(&Facets) -> Result<Vec<[f64; 3]>, NormalError>,
) -> Result<Vec<[f64; 3]>, NormalError> {
    let Some(part) = facets.digital.filter(|_| !facets.closed) else { return estimate(facets) };
    // If the voxels were changed since, there may be no such component; then only the part is used.
    let Ok((surface, digital)) = boundary(part.solid.clone(), part.adjacency, part.component) else {
        return estimate(facets);
    };
    // Both lists of surfels are in scan order.
    let mut place = Vec::with_capacity(part.surfels.len());
    for (f, surfel) in digital.surfels.iter().enumerate() {
        if part.surfels.get(place.len()) == Some(surfel) {
            place.push(f);
        }
    }
    if place.len() < part.surfels.len() {
        return estimate(facets);
    }
    let edges = Edges::new(&surface.faces, surface.positions.len());
    let normals = estimate(&Facets::new(&surface, &edges, Some(&digital))?)?;
    Ok(place.into_iter().map(|f| normals[f]).collect())
}
