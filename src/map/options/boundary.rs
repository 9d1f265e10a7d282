use serde::{Deserialize, Serialize};

use super::Pin;
use crate::constraint::Shape;
use crate::io::BoundaryLengths;

/// What the boundary of a map does.
#[derive(Clone, Debug, PartialEq)]
pub enum Boundary {
    /// It is on the unit circle, or drawn to it: H + C, unless an energy is given.
    Circle {
        /// Number of boundary points that are pinned, so that the map is unique.
        pinned: PinnedPoints,
        /// Whether the boundary points are kept in order.
        ordered: bool,
    },
    /// It keeps its lengths: H + L', unless an energy is given.
    Free {
        /// Lengths of the boundary edges, instead of those at rest.
        lengths: Option<BoundaryLengths>,
        /// Whether parts of the map may overlap each other; where not, a map that does so is replaced, as `valid` says.
        overlap: bool,
    },
    /// It is fixed: H, unless an energy is given.
    Fixed {
        /// Where the boundary is.
        on: Outline,
        /// Which boundary vertices are held; by default `Whole`, with circumcentres `Primal`.
        hold: Option<Hold>,
        /// How the interior is found.
        interior: Interior,
    },
    /// There is none: closed surfaces of genus 1 are mapped with two periods, by H.
    Periodic,
}

impl Boundary {
    /// The unit circle with three points pinned, in no forced order.
    pub const CIRCLE: Boundary = Boundary::Circle { pinned: PinnedPoints::Three, ordered: false };

    /// The surface's own lengths; parts of the map may overlap.
    pub const FREE: Boundary = Boundary::Free { lengths: None, overlap: true };

    /// Fixed on the unit circle by arc length, the interior from the energy.
    pub const FIXED: Boundary = Boundary::fixed(Outline::Shape(Shape::Circle));

    /// Fixed on an outline, the interior from the energy.
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
    /// The name.
    pub fn name(self) -> &'static str {
        match self {
            BoundaryName::Circle => "circle",
            BoundaryName::Free => "free",
            BoundaryName::Fixed => "fixed",
            BoundaryName::Periodic => "periodic",
        }
    }
}

/// Number of boundary points that a circle map pins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub enum PinnedPoints {
    /// As in the paper. The linearised problem is then singular on symmetric surfaces.
    Two,
    /// As many as the disc's Möbius group has parameters.
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

/// Where a fixed boundary is.
#[derive(Clone, Debug, PartialEq)]
pub enum Outline {
    /// On a shape, by arc length.
    Shape(Shape),
    /// Vertices at places of their own.
    Places(Vec<Pin>),
}

/// Which boundary vertices of the quad graph a fixed boundary holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hold {
    /// All of them: H is minimised in least squares.
    Whole,
    /// Those of the mesh, and one dual vertex: (2) is square and solved exactly. The same as `whole` on quad meshes.
    Primal,
}

/// How the interior is found beside a fixed boundary.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Interior {
    /// It minimises the energy.
    #[default]
    Energy,
    /// Every vertex is the mean of its neighbours by the weights of this name.
    Weights(String),
}
