use super::linked::Linked;
use super::{Adjacency, Digital, DigitalError, Solid};
use crate::surface::Surface;

/// Returns one connected component of the boundary of `solid` as a quad mesh.
///
/// The boundary consists of the unit squares (surfels) between an inner and an outer voxel, with
/// corners counter-clockwise seen from outside, joined at their edges according to `adjacency`.
/// `component` is the rank by number of surfels: 0 is the largest; components of equal size are in
/// scan order of their first surfels.
///
/// The result is a closed oriented manifold. Surfels are in scan order of their inner voxels, those
/// of one voxel in the order −x, +x, −y, +y, −z, +z. Vertices are *pointels*, corners of voxels,
/// numbered in the order in which the surfels meet them; a pointel at which the surface touches
/// itself becomes one vertex for each fan of surfels around it. If two edges have the same two
/// ends, the faces carry [twins](crate::surface::Faces::twins). The time is linear, with 64 voxels
/// at once where nothing changes.
///
/// ```
/// use riemap::surface::digital::{Adjacency, Solid, boundary};
///
/// let mut cubes = Solid::empty([2, 2, 1], [0.0; 3]);
/// cubes.insert([0, 0, 0]);
/// cubes.insert([1, 1, 0]);
/// // The cubes share only an edge: they are two surfaces or one.
/// let (surface, apart) = boundary(cubes.clone(), Adjacency::Six, 0)?;
/// assert_eq!((apart.components, surface.positions().len()), (vec![6, 6], 8));
/// let (surface, joined) = boundary(cubes, Adjacency::Eighteen, 0)?;
/// assert_eq!((joined.components, surface.positions().len()), (vec![12], 14));
/// # Ok::<(), riemap::surface::digital::DigitalError>(())
/// ```
///
/// # Errors
/// [`DigitalError`] if no voxel is inside, no component has that rank, or there are too many
/// surfels.
pub fn boundary(solid: Solid, adjacency: Adjacency, component: usize) -> Result<(Surface, Digital), DigitalError> {
    part(solid, adjacency, component, |_| true)
}

/// Returns the surfels of [`boundary`] for which `wanted` is true.
pub(crate) fn part(
    solid: Solid,
    adjacency: Adjacency,
    component: usize,
    wanted: impl Fn(&super::Surfel) -> bool,
) -> Result<(Surface, Digital), DigitalError> {
    let linked = Linked::new(&solid, adjacency)?;
    let (label, components) = linked.components();
    if component >= components.len() {
        return Err(DigitalError::NoSuchComponent { component, sizes: components });
    }
    let keep: Vec<bool> =
        label.iter().zip(&linked.surfels).map(|(&l, surfel)| l as usize == component && wanted(surfel)).collect();
    let linked = if keep.iter().all(|&k| k) { linked } else { linked.keep(|f| keep[f]) };
    let (surface, surfels) = linked.mesh(&solid);
    Ok((surface, Digital { solid, surfels, adjacency, components, component, exact_normals: None }))
}
