use super::{Facets, NormalError};
use crate::surface::digital::boundary;
use crate::surface::edges::Edges;

/// What `estimate` finds on the whole closed digital surface, where `facets` are a part of it or it cut open: else the surface
/// would end for the averages where the part does.
pub(super) fn on_whole(
    facets: &Facets,
    estimate: impl Fn(&Facets) -> Result<Vec<[f64; 3]>, NormalError>,
) -> Result<Vec<[f64; 3]>, NormalError> {
    let Some(part) = facets.digital.filter(|_| !facets.closed) else { return estimate(facets) };
    // Voxels that were changed since may have no such component; then the part is all there is.
    let Ok((surface, digital)) = boundary(part.solid.clone(), part.adjacency, part.component) else {
        return estimate(facets);
    };
    // Both in scan order.
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
