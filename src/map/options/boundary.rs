use serde::{Deserialize, Serialize};

use super::Pin;
use crate::constraint::Shape;
use crate::io::BoundaryLengths;

/// The boundary condition of a map.
#[derive(Clone, Debug, PartialEq)]
pub enum Boundary {
    /// The boundary is on the unit circle, or drawn to it: H + C, unless an energy is given.
    Circle {
        /// The number of boundary points that are pinned to make the map unique.
        pinned: PinnedPoints,
        /// Whether the boundary points are kept in order.
        ordered: bool,
    },
    /// The boundary edges keep their lengths, and H = 0; an energy that is given is minimised instead.
    Free {
        /// The lengths of the boundary edges; by default those at rest.
        lengths: Option<BoundaryLengths>,
        /// Whether parts of the map may overlap. If not, a map that overlaps is replaced, as `valid` says.
        overlap: bool,
    },
    /// The boundary is fixed: H, unless an energy is given.
    Fixed {
        /// The curve or the positions at which it is fixed.
        on: Outline,
        /// Which boundary vertices are pinned; by default `Whole`, with circumcentres `Primal`.
        hold: Option<Hold>,
        /// How the interior is computed.
        interior: Interior,
    },
    /// The surface has no boundary: closed surfaces of genus 1 are mapped with two periods, by H.
    Periodic,
}

impl Boundary {
    /// The unit circle with three pinned points; the order of the others is not enforced.
    pub const CIRCLE: Boundary = Boundary::Circle { pinned: PinnedPoints::Three, ordered: false };

    /// The surface's own lengths; parts of the map may overlap.
    pub const FREE: Boundary = Boundary::Free { lengths: None, overlap: true };

    /// Fixed on the unit circle by arc length, the interior from the energy.
    pub const FIXED: Boundary = Boundary::fixed(Outline::Shape(Shape::Circle));

    /// The boundary fixed on an outline, the interior from the energy.
    pub const fn fixed(on: Outline) -> Self {
        Boundary::Fixed { on, hold: None, interior: Interior::Energy }
    }

    /// Whether it is on the unit circle.
    pub fn is_circle(&self) -> bool {
        matches!(self, Boundary::Circle { .. })
    }

    /// Whether it keeps its lengths.
    pub fn is_free(&self) -> bool {
        matches!(self, Boundary::Free { .. })
    }

    /// Whether it is fixed.
    pub fn is_fixed(&self) -> bool {
        matches!(self, Boundary::Fixed { .. })
    }
}

impl Default for Boundary {
    fn default() -> Self {
        Boundary::CIRCLE
    }
}

/// The kinds of [`Boundary`], by the names of flat keys.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum BoundaryName {
    /// [`Boundary::Circle`].
    #[default]
    Circle,
    /// [`Boundary::Free`].
    Free,
    /// [`Boundary::Fixed`].
    Fixed,
    /// [`Boundary::Periodic`].
    Periodic,
}

impl BoundaryName {
    /// The name in options and reports.
    pub fn name(self) -> &'static str {
        match self {
            BoundaryName::Circle => "circle",
            BoundaryName::Free => "free",
            BoundaryName::Fixed => "fixed",
            BoundaryName::Periodic => "periodic",
        }
    }
}

/// The number of boundary points that a circle map pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum PinnedPoints {
    /// Two, as in the paper. The linearised problem is then singular on symmetric surfaces.
    Two,
    /// Three, the number of parameters of the Möbius group of the disc.
    #[default]
    Three,
}

impl PinnedPoints {
    /// The number.
    pub fn count(self) -> usize {
        match self {
            PinnedPoints::Two => 2,
            PinnedPoints::Three => 3,
        }
    }
}

/// The curve or the positions at which a boundary is fixed.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// The boundary lies on a shape, by arc length.
    Shape(Shape),
    /// The vertices are pinned at given positions.
    Places(Vec<Pin>),
}

/// Which boundary vertices of the quad graph are pinned.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hold {
    /// All of them; H is minimised in the sense of least squares.
    Whole,
    /// Those of the mesh and one dual vertex: (2) is square and solved exactly. On quad meshes the same as `Whole`.
    Primal,
}

/// How the interior of a map with a fixed boundary is computed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Interior {
    /// It minimises the energy.
    #[default]
    Energy,
    /// Every vertex is the mean of its neighbours by the weights of this name.
    Weights(String),
}
