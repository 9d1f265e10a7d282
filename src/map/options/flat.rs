use serde::Deserialize;

use super::{Boundary, BoundaryName, Hold, Interior, MapOptions, Outline, Pin, PinnedPoints, RhoSource, Start, Valid};
use crate::constraint::Shape;
use crate::energy::Expression;
use crate::energy::conformal::Weight;
use crate::io::BoundaryLengths;
use crate::quad_graph::RestSource;
use crate::quad_graph::dual::BoundaryDual;
use crate::surface::normals::NormalSpec;

/// [`MapOptions`] as flat keys: those of the command line and of the `[map]` table of an experiment. What is left out has its default.
/// Converted by `MapOptions::try_from`, which refuses options that contradict each other.
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
    /// What the boundary does.
    pub boundary: Option<BoundaryName>,
    /// As in [`MapOptions`].
    pub energy: Option<Expression>,
    /// Fixed boundaries: the shape that the boundary is on.
    pub shape: Option<Shape>,
    /// Fixed boundaries: places of vertices, instead of `shape`.
    pub positions: Option<Vec<Pin>>,
    /// Free maps: lengths of the boundary edges, instead of those at rest.
    pub boundary_lengths: Option<BoundaryLengths>,
    /// As in [`MapOptions`].
    pub pins: Vec<Pin>,
    /// Fixed boundaries: which boundary vertices are held.
    pub hold: Option<Hold>,
    /// Fixed boundaries: weights by which inner vertices are means of their neighbours.
    pub weights: Option<String>,
    /// Which map replaces a conformal one that is not injective.
    pub valid: ValidName,
    /// Circle maps: number of boundary points that are pinned, 2 or 3.
    pub fix: Option<usize>,
    /// Circle maps: whether the boundary points are kept in order.
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

/// The choices of [`Valid`], and whether free maps may overlap, by the names of flat keys.
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
    /// An option that only another boundary has.
    #[error("`{key}` is an option of the {} boundary, and the boundary is {}", of.name(), boundary.name())]
    OtherBoundary {
        /// The option.
        key: &'static str,
        /// The boundary that has it.
        of: BoundaryName,
        /// The boundary that was asked for.
        boundary: BoundaryName,
    },
    /// Two options that say the same thing differently.
    #[error("`{first}` and `{second}` exclude each other")]
    Exclusive {
        /// One of them.
        first: &'static str,
        /// The other.
        second: &'static str,
    },
    /// A number of pinned points that is neither 2 nor 3.
    #[error("{fix} fixed boundary points: a circle map has 3 (or 2, as in the paper)")]
    FixedPoints {
        /// The number asked for.
        fix: usize,
    },
    /// A vertex with two pins.
    #[error("vertex {vertex} is pinned twice: one place is enough")]
    PinnedTwice {
        /// The vertex.
        vertex: u32,
    },
}

impl FlatOptions {
    /// The boundary, with what is said of it.
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

    /// Whether the energy that is given keeps the lengths of a boundary of which nothing is said.
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
