//! Many maps of one surface by one factorisation.

use super::kept_factor::KeptFactor;
use super::lengths::prescribe;
use super::pipeline::Prepared;
use super::{Boundary, Hold, Interior, MapError, MapOptions, Mapped, Outline, Pin, solve};
use crate::input::Input;
use crate::io::BoundaryLengths;
use crate::solver::{Observer, Silent};
use crate::surface::Surface;
use crate::surface::oriented_mesh::OrientedMesh;

/// A surface that is mapped many times: the factor of its conformal Laplacian is kept from one map to the next.
///
/// ```
/// use riemap::{Flattener, MapOptions, Surface};
///
/// let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.4, 0.5, 0.3]];
/// let faces = vec![vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]];
/// let flattener = Flattener::new(&Surface::new(positions, faces)?, &MapOptions::default())?;
/// let disc = flattener.circle()?;
/// let square = flattener.fixed(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])?;
/// # assert_eq!(square.uv()[2], Some([1.0, 1.0]));
/// # assert!(disc.validity.is_one_to_one());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Flattener {
    prepared: Prepared,
    exact: Option<Vec<[f64; 2]>>,
    options: MapOptions,
    factor: KeptFactor,
}

impl Flattener {
    /// Prepares a surface. `options` say how it becomes a disc, which dual points and solver are taken and so on; their boundary is not
    /// looked at.
    ///
    /// # Errors
    /// A surface that is not a disc and is not made one by the options; faces that give no ρ.
    pub fn new(surface: &Surface, options: &MapOptions) -> Result<Self, MapError> {
        Flattener::of_input(&Input::of("surface".to_owned(), surface.clone()), options)
    }

    /// Prepares an input: see [`map_input`](super::map_input).
    ///
    /// # Errors
    /// As for [`Flattener::new`].
    pub fn of_input(input: &Input, options: &MapOptions) -> Result<Self, MapError> {
        let options = MapOptions { boundary: Boundary::CIRCLE, ..options.clone() };
        let prepared = Prepared::new(input, &options)?;
        let exact = input.exact.clone().filter(|_| prepared.cut.is_empty());
        Ok(Flattener { prepared, exact, options, factor: KeptFactor::default() })
    }

    /// The vertices of the source along the boundary, with the surface on the left; one on a cut comes once for each of its copies.
    pub fn boundary(&self) -> Vec<u32> {
        let disc = &self.prepared.domain.disc;
        disc.boundary.iter().map(|&v| disc.source_vertex[v as usize]).collect()
    }

    /// The map to the unit disc.
    ///
    /// # Errors
    /// As for [`Flattener::map`].
    pub fn circle(&self) -> Result<Mapped, MapError> {
        self.map(Boundary::CIRCLE, &mut Silent)
    }

    /// The free map, whose boundary edges have their lengths at rest, or those given.
    ///
    /// # Errors
    /// As for [`Flattener::map`]; lengths that no polygon has.
    pub fn free(&self, lengths: Option<BoundaryLengths>) -> Result<Mapped, MapError> {
        self.map(Boundary::Free { lengths, overlap: true }, &mut Silent)
    }

    /// The map whose boundary is at given places, one for each vertex of [`Flattener::boundary`], in its order.
    ///
    /// On triangle meshes it obeys (2) exactly and needs no new factorisation; on quad meshes it is that of least H, and does.
    ///
    /// # Errors
    /// Another number of places; a boundary vertex on a cut, which has several images.
    pub fn fixed(&self, places: &[[f64; 2]]) -> Result<Mapped, MapError> {
        let boundary = self.boundary();
        if places.len() != boundary.len() {
            return Err(MapError::PlaceCount { places: places.len(), boundary: boundary.len() });
        }
        let pins = boundary.iter().zip(places).map(|(&vertex, &place)| Pin { vertex, place }).collect();
        let hold = self.prepared.domain.is_of_triangles().then_some(Hold::Primal);
        let fixed = Boundary::Fixed { on: Outline::Places(pins), hold, interior: Interior::Energy };
        self.map(fixed, &mut Silent)
    }

    /// The map with this boundary.
    ///
    /// # Errors
    /// A periodic boundary; options that leave the map undetermined; a solver that does not converge.
    pub fn map(&self, boundary: Boundary, observer: &mut dyn Observer) -> Result<Mapped, MapError> {
        if boundary == Boundary::Periodic {
            return Err(MapError::NotADiscMap);
        }
        let options = MapOptions { boundary, ..self.options.clone() };
        let mut prepared = self.prepared.clone();
        let domain = &mut prepared.domain;
        domain.prescribed = prescribe(&options, &domain.disc, &mut domain.graph)?;
        let map = solve::solve(&options, domain, Some(&self.factor), self.exact.as_deref(), observer)?;
        Ok(prepared.mapped(map, None, observer))
    }

    /// The mesh that is mapped: the surface opened and oriented.
    pub fn mesh(&self) -> &OrientedMesh {
        &self.prepared.domain.disc
    }
}
