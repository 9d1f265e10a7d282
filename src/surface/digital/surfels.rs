use super::linked::Linked;
use super::{Adjacency, Digital, DigitalError, Solid};
use crate::surface::Surface;

/// The boundary of `solid`: the unit squares between an inner and an outer voxel, counter-clockwise seen from outside, joined
/// at their edges as `adjacency` says. Of its connected components the one of rank `component` is taken: 0 is the one with
/// most surfels, of equal ones that which comes first in scan order.
///
/// The result is a closed oriented manifold. Surfels are in scan order of their inner voxels (one voxel's in the order −x,
/// +x, −y, +y, −z, +z). Vertices are *pointels*, corners of voxels, numbered as the surfels first meet them; where the surface
/// touches itself at a pointel it has a vertex for each of the fans of surfels around it. Where two edges have the same two
/// ends the faces state their [twins](crate::surface::Faces::twins). Linear time, 64 voxels at once where nothing changes.
///
/// ```
/// use riemap::surface::digital::{Adjacency, Solid, boundary};
///
/// let mut cubes = Solid::empty([2, 2, 1], [0.0; 3]);
/// cubes.insert([0, 0, 0]);
/// cubes.insert([1, 1, 0]);
/// // They share an edge alone: two cubes apart, or one surface of both.
/// let (surface, apart) = boundary(cubes.clone(), Adjacency::Six, 0)?;
/// assert_eq!((apart.components, surface.positions().len()), (vec![6, 6], 8));
/// let (surface, joined) = boundary(cubes, Adjacency::Eighteen, 0)?;
/// assert_eq!((joined.components, surface.positions().len()), (vec![12], 14));
/// # Ok::<(), riemap::surface::digital::DigitalError>(())
/// ```
///
/// # Errors
/// No voxel inside, no component of that rank, more than 2³⁰ surfels.
pub fn boundary(solid: Solid, adjacency: Adjacency, component: usize) -> Result<(Surface, Digital), DigitalError> {
    part(solid, adjacency, component, |_| true)
}

/// The surfels of [`boundary`] that are `wanted`.
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
