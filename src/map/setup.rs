//! The problem that every method is given.

use num_complex::Complex64;

use super::normalisation::Normalisation;
use super::{Boundary, Domain, Map, MapError, MapOptions, Start, Valid};
use crate::distortion::{Image, face_maps};
use crate::energy::Expression;

/// The mean of σ1/σ2 above which a circle map is nothing to keep though it folds no face: on coarse meshes with ragged boundaries H is
/// least where some faces are drawn out to needles. Of 200 discs cut out of public meshes 74 had plain maps that fold nothing; 58 of these
/// were above libigl's harmonic map, by factors up to 500. 45 of the 58 are above this mean, the others by a factor of 1.25 at most.
const LARGEST_DISTORTION: f64 = 2.0;

/// One problem: a surface, what is minimised on it, and what makes the map unique.
pub(super) struct Setup<'a> {
    /// The request.
    pub options: &'a MapOptions,
    /// The surface with its quad graph.
    pub domain: &'a Domain,
    /// The energy.
    pub expression: Expression,
    /// Circle maps: the boundary points that are held.
    pub normalisation: Normalisation,
}

impl Setup<'_> {
    /// Whether the energy draws the boundary to the unit circle.
    pub fn is_circle(&self) -> bool {
        is_circle(self.options, &self.expression)
    }

    /// Fails where the options contradict each other, or leave the map undetermined.
    pub fn check(&self) -> Result<(), MapError> {
        let Setup { options, expression, .. } = self;
        let tolerance = options.tolerance;
        match () {
            () if options.is_ordered() && !expression.has("C") => {
                Err(MapError::NoCircle { energy: expression.to_string() })
            }
            () if !expression.has("H") && !expression.has("L") && !expression.is_flip_free() => {
                Err(MapError::Undetermined { energy: expression.to_string() })
            }
            () if !(tolerance > 0.0 && tolerance < 1.0) => Err(MapError::Tolerance { tolerance }),
            () => Ok(()),
        }
    }

    /// Whether the free map is the start of a minimisation: where lengths or areas count and nothing else says where the boundary is.
    pub fn starts_from_free_map(&self) -> bool {
        let Setup { options, expression, .. } = self;
        options.start == Start::Auto
            && !options.boundary.is_fixed()
            && options.pins.is_empty()
            && !expression.has("C")
            && match expression.is_flip_free() {
                true => expression.rows().all(|row| row.flip_free && row.metric),
                false => expression.has("A") || expression.has("L"),
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

    /// Whether a bijective map of lower distortion is looked for though `map` is injective.
    pub fn looks_for_less_distortion(&self, map: &Map) -> bool {
        self.options.valid == Valid::BestQc
            || (self.options.boundary.is_circle() && self.mean_distortion(map) > LARGEST_DISTORTION)
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
    expression.has("C") && !options.boundary.is_fixed()
}
