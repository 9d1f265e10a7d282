use serde::Deserialize;

use super::{Boundary, BoundaryName, Hold, Interior, MapOptions, Outline, Pin, PinnedPoints, RhoSource, Start, Valid};
use crate::constraint::Shape;
use crate::energy::Expression;
use crate::energy::conformal::Weight;
use crate::io::BoundaryLengths;
use crate::quad_graph::RestSource;
use crate::quad_graph::dual::BoundaryDual;
use crate::surface::normals::NormalSpec;

/// [`MapOptions`] as flat keys: those of the command line and of the `[map]` table of an experiment. Missing keys have
/// their defaults. `MapOptions::try_from` converts them and refuses keys that contradict each other.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct FlatOptions {
    /// As in [`MapOptions`].
    pub cut: bool,
    /// As in [`MapOptions`].
    pub fill_holes: bool,
    /// As in [`MapOptions`].
    pub remove_faces: Vec<u32>,
    /// As in [`MapOptions`].
    pub surrogate: Option<f64>,
    /// The boundary of the map.
    pub boundary: Option<BoundaryName>,
    /// As in [`MapOptions`].
    pub energy: Option<Expression>,
    /// The shape on which a fixed boundary lies.
    pub shape: Option<Shape>,
    /// The positions of the vertices of a fixed boundary, instead of `shape`.
    pub positions: Option<Vec<Pin>>,
    /// The lengths of the boundary edges of a free map; by default those at rest.
    pub boundary_lengths: Option<BoundaryLengths>,
    /// As in [`MapOptions`].
    pub pins: Vec<Pin>,
    /// Which vertices of a fixed boundary are pinned.
    pub hold: Option<Hold>,
    /// The weights of a convex combination map, with a fixed boundary.
    pub weights: Option<String>,
    /// Which replacement is computed when the conformal map is not injective.
    pub valid: ValidName,
    /// The number of boundary points that a circle map pins, 2 or 3.
    pub fix: Option<usize>,
    /// Whether the boundary points of a circle map are kept in order.
    pub keep_order: bool,
    /// As in [`MapOptions`].
    pub start: Start,
    /// As in [`MapOptions`].
    pub weight: Weight,
    /// As in [`MapOptions`].
    pub dual: Option<String>,
    /// As in [`MapOptions`].
    pub boundary_dual: BoundaryDual,
    /// As in [`MapOptions`].
    pub rho: RhoSource,
    /// As in [`MapOptions`].
    pub normals: Option<NormalSpec>,
    /// As in [`MapOptions`].
    pub rest: RestSource,
    /// As in [`MapOptions`].
    pub solver: Option<String>,
    /// As in [`MapOptions`].
    pub tolerance: Option<f64>,
    /// As in [`MapOptions`].
    pub max_iterations: Option<usize>,
}

/// The names of flat keys for [`Valid`] and for whether free maps may overlap.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ValidName {
    /// [`Valid::Auto`].
    #[default]
    Auto,
    /// [`Valid::BestQc`].
    BestQc,
    /// [`Valid::Auto`]; and no two parts of a free map may overlap.
    OneToOne,
    /// [`Valid::Off`].
    Off,
}

/// Options that contradict each other.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum OptionsError {
    /// The option belongs to another boundary.
    #[error("`{key}` is an option of the {} boundary, and the boundary is {}", of.name(), boundary.name())]
    OtherBoundary {
        /// The option.
        key: &'static str,
        /// The boundary that has it.
        of: BoundaryName,
        /// The requested boundary.
        boundary: BoundaryName,
    },
    /// Two options exclude each other.
    #[error("`{first}` and `{second}` exclude each other")]
    Exclusive {
        /// One of them.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// The number of pinned points is neither 2 nor 3.
    #[error("{fix} fixed boundary points: a circle map has 3 (or 2, as in the paper)")]
    FixedPoints {
        /// The requested number.
        fix: usize,
    },
    /// A vertex has two pins.
    #[error("vertex {vertex} is pinned twice: one place is enough")]
    PinnedTwice {
        /// The vertex.
        vertex: u32,
    },
}

impl FlatOptions {
    /// The boundary with its options.
    fn boundary(&self) -> Result<Boundary, OptionsError> {
        let boundary = self.boundary.unwrap_or_default();
        let given = [
            ("shape", self.shape.is_some(), BoundaryName::Fixed),
            ("positions", self.positions.is_some(), BoundaryName::Fixed),
            ("hold", self.hold.is_some(), BoundaryName::Fixed),
            ("weights", self.weights.is_some(), BoundaryName::Fixed),
            ("boundary-lengths", self.boundary_lengths.is_some() && !self.keeps_lengths(), BoundaryName::Free),
            ("fix", self.fix.is_some(), BoundaryName::Circle),
            ("keep-order", self.keep_order, BoundaryName::Circle),
        ];
        if let Some((key, _, of)) = given.into_iter().find(|(_, given, of)| *given && *of != boundary) {
            return Err(OptionsError::OtherBoundary { key, of, boundary });
        }
        if self.shape.is_some() && self.positions.is_some() {
            return Err(OptionsError::Exclusive { first: "shape", second: "positions" });
        }
        let pinned = match self.fix {
            None => PinnedPoints::default(),
            Some(2) => PinnedPoints::Two,
            Some(3) => PinnedPoints::Three,
            Some(fix) => return Err(OptionsError::FixedPoints { fix }),
        };
        let free =
            || Boundary::Free { lengths: self.boundary_lengths.clone(), overlap: self.valid != ValidName::OneToOne };
        Ok(match boundary {
            BoundaryName::Circle if self.boundary_lengths.is_some() => free(),
            BoundaryName::Circle => Boundary::Circle { pinned, ordered: self.keep_order },
            BoundaryName::Free => free(),
            BoundaryName::Fixed => Boundary::Fixed {
                on: match &self.positions {
                    Some(places) => Outline::Places(places.clone()),
                    None => Outline::Shape(self.shape.unwrap_or_default()),
                },
                hold: self.hold,
                interior: self.weights.clone().map_or(Interior::Energy, Interior::Weights),
            },
            BoundaryName::Periodic => Boundary::Periodic,
        })
    }

    /// Whether no boundary is given and the energy keeps its lengths.
    fn keeps_lengths(&self) -> bool {
        self.boundary.is_none() && self.energy.as_ref().is_some_and(|energy| energy.keeps_boundary_lengths())
    }
}

impl TryFrom<FlatOptions> for MapOptions {
    type Error = OptionsError;

    fn try_from(flat: FlatOptions) -> Result<Self, OptionsError> {
        let mut pinned: Vec<u32> = flat.pins.iter().map(|pin| pin.vertex).collect();
        pinned.sort_unstable();
        if let Some(twice) = pinned.windows(2).find(|pair| pair[0] == pair[1]) {
            return Err(OptionsError::PinnedTwice { vertex: twice[0] });
        }
        let boundary = flat.boundary()?;
        let defaults = MapOptions::default();
        Ok(MapOptions {
            cut: flat.cut,
            fill_holes: flat.fill_holes,
            remove_faces: flat.remove_faces,
            surrogate: flat.surrogate,
            boundary,
            energy: flat.energy,
            pins: flat.pins,
            constraints: defaults.constraints,
            valid: match flat.valid {
                ValidName::Auto | ValidName::OneToOne => Valid::Auto,
                ValidName::BestQc => Valid::BestQc,
                ValidName::Off => Valid::Off,
            },
            start: flat.start,
            weight: flat.weight,
            dual: flat.dual.unwrap_or(defaults.dual),
            boundary_dual: flat.boundary_dual,
            rho: flat.rho,
            normals: flat.normals,
            rest: flat.rest,
            solver: flat.solver.map_or(defaults.solver, Into::into),
            tolerance: flat.tolerance.unwrap_or(defaults.tolerance),
            max_iterations: flat.max_iterations,
        })
    }
}
