//! The problem that every method is given.

use std::sync::Arc;

use num_complex::Complex64;

use super::kept_factor::KeptFactor;
use super::normalisation::Normalisation;
use super::{Boundary, Domain, Map, MapError, MapOptions, Start};
use crate::distortion::{Image, face_maps};
use crate::energy::Expression;
use crate::laplacian::{ConformalLaplacian, LaplacianError};
use crate::solver::Observer;

/// One problem: a surface, what is minimised on it, and what makes the map unique.
pub(super) struct Setup<'a> {
    /// The request.
    pub options: &'a MapOptions,
    /// The surface with its quad graph.
    pub domain: &'a Domain,
    /// Keeps the factor of the conformal Laplacian for other maps of the domain.
    pub factor: Option<&'a KeptFactor>,
    /// The energy.
    pub expression: Expression,
    /// Circle maps: the boundary points that are held.
    pub normalisation: Normalisation,
}

impl Setup<'_> {
    /// The conformal Laplacian of the domain with its factor: the one that is kept, or a new one.
    pub fn laplacian(&self, watch: &mut dyn Observer) -> Result<Arc<ConformalLaplacian>, LaplacianError> {
        match self.factor {
            Some(kept) => kept.get(&self.domain.graph, watch),
            None => KeptFactor::default().get(&self.domain.graph, watch),
        }
    }

    /// Whether the energy draws the boundary to the unit circle.
    pub fn is_circle(&self) -> bool {
        is_circle(self.options, &self.expression)
    }

    /// Fails where the options contradict each other, or leave the map undetermined.
    pub fn check(&self) -> Result<(), MapError> {
        let Setup { options, expression, .. } = self;
        let tolerance = options.tolerance;
        match () {
            () if options.is_ordered() && !expression.is_on_circle() => {
                Err(MapError::NoCircle { energy: expression.to_string() })
            }
            () if !expression.determines_interior() => Err(MapError::Undetermined { energy: expression.to_string() }),
            () if !(tolerance > 0.0 && tolerance < 1.0) => Err(MapError::Tolerance { tolerance }),
            () => Ok(()),
        }
    }

    /// Whether the free map is the start of a minimisation: where lengths or areas count and nothing else says where the boundary is.
    pub fn starts_from_free_map(&self) -> bool {
        let Setup { options, expression, .. } = self;
        options.start == Start::Auto
            && !options.boundary.is_fixed()
            && !options.holds_more()
            && !expression.is_on_circle()
            && match expression.is_flip_free() {
                true => {
                    expression.is_of_triangles() && expression.energies().all(|energy| energy.properties().fixes_scale)
                }
                false => expression.has_inner_lengths_or_areas(),
            }
    }

    /// Whether the exact check accepts the map that puts the vertices of the mesh at `z` as injective as is asked for: free maps may
    /// overlap themselves, unless otherwise said.
    pub fn accepts(&self, z: &[Complex64]) -> bool {
        let validity = self.domain.validity(z);
        match self.options.boundary {
            Boundary::Free { overlap: true, .. } => validity.is_locally_one_to_one(),
            _ => validity.is_one_to_one(),
        }
    }

    /// The mean of σ1/σ2 over the faces.
    pub fn mean_distortion(&self, map: &Map) -> f64 {
        let faces = face_maps(&self.domain.disc, &self.domain.graph, &Image::of_disc(&map.z));
        let (sum, count) = faces
            .iter()
            .filter(|face| face.has_shape())
            .fold((0.0, 0usize), |(sum, count), face| (sum + face.quasi_conformal(), count + 1));
        sum / count.max(1) as f64
    }
}

/// Whether `expression` draws a free boundary to the unit circle.
pub(super) fn is_circle(options: &MapOptions, expression: &Expression) -> bool {
    expression.is_on_circle() && !options.boundary.is_fixed()
}
