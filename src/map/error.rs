use super::lengths::LengthsError;
use super::options::OptionsError;
use crate::constraint::ConstraintError;
use crate::energy::EnergyError;
use crate::energy::conformal::NonPositiveRho;
use crate::map::periodic::PeriodicError;
use crate::quad_graph::QuadGraphError;
use crate::solver::boundary::BoundaryError;
use crate::solver::convex::ConvexError;
use crate::solver::{MinimiseError, SolveError, Unsuitable};
use crate::surface::SurfaceError;
use crate::surface::cut::CutError;
use crate::surface::normals::NormalError;

/// The request cannot be met.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MapError {
    /// Arrays that are not a surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// Options that contradict each other.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// A surface that is no disc and does not become one, or is too badly formed.
    #[error("the surface cannot be mapped: {0}")]
    NoDisc(#[from] CutError),
    /// ρ from normals was asked for, and some face has none.
    #[error("face {face} has no usable normal, and ρ from normals needs one for every face")]
    NoNormal {
        /// The first such face.
        face: usize,
    },
    /// ρ from normals was asked for on triangles.
    #[error("a triangle mesh has its own tangent planes: normals are for quad meshes and digital surfaces")]
    NormalsOfTriangles,
    /// No estimate of the normals.
    #[error(transparent)]
    Normals(#[from] NormalError),
    /// A height of faces that is none.
    #[error("the height of surrogate faces is {height}; it must be positive, and at most 1")]
    SurrogateHeight {
        /// The number asked for.
        height: f64,
    },
    /// A shape of its own for a face that is to be seen along a normal.
    #[error("face {face} has no area, and its surrogate no place beside normals")]
    SurrogateNormals {
        /// The first such face, as the source numbers them.
        face: u32,
    },
    /// A name of no dual point.
    #[error("unknown dual point `{name}`; known: {known}")]
    UnknownDual {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// A name of no iterative backend.
    #[error("`{name}` does not solve nonlinear problems; those that do: auto, {known}")]
    NotAMinimiser {
        /// The name asked for.
        name: String,
        /// The names there are.
        known: String,
    },
    /// H alone with a boundary that is not held.
    #[error("H alone leaves the boundary free to take any shape: it must be fixed, or C, L or Lb be in the energy")]
    FreeBoundary,
    /// No periodic map.
    #[error(transparent)]
    Periodic(#[from] PeriodicError),
    /// An energy other than H for periodic maps.
    #[error("periodic maps minimise H, and `{energy}` was asked for")]
    PeriodicEnergy {
        /// The energy.
        energy: String,
    },
    /// A vertex held where nothing is.
    #[error("periodic maps hold no vertices, and some are pinned")]
    PeriodicPins,
    /// A solver that periodic maps do not take.
    #[error("periodic maps have a solver of their own, and `{name}` was asked for")]
    PeriodicSolver {
        /// The name asked for.
        name: String,
    },
    /// Faces removed from, or a cut through, a surface that is to be closed.
    #[error("periodic maps are of closed surfaces: nothing can be cut or removed")]
    PeriodicOpening,
    /// An energy that leaves vertices free to be anywhere.
    #[error("`{energy}` leaves the inside of the map undetermined: add H, or L")]
    Undetermined {
        /// The energy.
        energy: String,
    },
    /// A tolerance that means nothing.
    #[error("the tolerance is {tolerance}; it must be positive and below 1")]
    Tolerance {
        /// The number asked for.
        tolerance: f64,
    },
    /// Pins that would fold the boundary.
    #[error(
        "the pins do not follow each other counter-clockwise along the boundary: vertex {vertex} is out of order; turn \
         the pins or the faces over"
    )]
    PinsOutOfOrder {
        /// The first such vertex of the source.
        vertex: u32,
    },
    /// A boundary vertex of a circle map pinned elsewhere.
    #[error(
        "boundary vertex {vertex} is pinned at distance {radius} from 0: a circle map has its boundary at distance 1"
    )]
    PinOffCircle {
        /// The vertex of the source.
        vertex: u32,
        /// Its distance from 0.
        radius: f64,
    },
    /// An inner vertex of a circle map pinned on the circle or outside.
    #[error(
        "vertex {vertex} is not on the boundary and is pinned at distance {radius} from 0: inside a circle map it must be \
         less than 1"
    )]
    PinOutside {
        /// The vertex of the source.
        vertex: u32,
        /// Its distance from 0.
        radius: f64,
    },
    /// The order of a boundary that is on no circle.
    #[error("the order is kept along a circle: the energy {energy} has no C")]
    NoCircle {
        /// The energy.
        energy: String,
    },
    /// A held vertex that is not in use.
    #[error("vertex {vertex} cannot be held: no face of the surface uses it (vertices count from 0)")]
    NotInUse {
        /// Its index in the source.
        vertex: u32,
    },
    /// A held vertex that the cut passes through.
    #[error("vertex {vertex} cannot be held: the surface is cut there, and it has {copies} images")]
    OnTheCut {
        /// Its index in the source.
        vertex: u32,
        /// What it became.
        copies: usize,
    },
    /// Weights beside what they do not go with.
    #[error("the weights {name} make a map without an energy and by a solver of its own, and {clash} was asked for")]
    WeightsOfNothing {
        /// The weights.
        name: String,
        /// What was asked for beside them.
        clash: Clash,
    },
    /// No map without folds to start from.
    #[error(
        "no map without folds was found to start from: of the last one {folded} faces are folded (the first: {first:?}) and the shortest edge is \
         {smallest:.0e} of its extent, where doubles tell places apart by 1e-16 of it: a boundary that is held must be so on a convex curve, \
         and what is far from a short boundary is mapped too small; a longer boundary, or a map in parts, helps"
    )]
    NoValidStart {
        /// Faces that are folded.
        folded: usize,
        /// The first of them, as the source numbers them.
        first: Option<u32>,
        /// The shortest edge of its image over the extent of that.
        smallest: f64,
    },
    /// Quads that no map makes convex.
    #[error(
        "no map makes the quads at vertex {vertex} convex, which is not on the boundary and has two of them alone, nor those at {} more",
        count - 1
    )]
    NoConvexQuads {
        /// The first such vertex, as the source numbers them.
        vertex: u32,
        /// How many there are.
        count: usize,
    },
    /// Boundary lengths that no map has.
    #[error(transparent)]
    Lengths(#[from] LengthsError),
    /// No convex combination map.
    #[error(transparent)]
    Convex(#[from] ConvexError),
    /// No usable ρ.
    #[error(transparent)]
    QuadGraph(#[from] QuadGraphError),
    /// Integral weights that are undefined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// An energy that the surface does not have.
    #[error(transparent)]
    Energy(#[from] EnergyError),
    /// Constraints that contradict or do not suffice.
    #[error(transparent)]
    Constraint(#[from] ConstraintError),
    /// No solution of the linear problem.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// No solution of the nonlinear problem.
    #[error(transparent)]
    Minimise(#[from] MinimiseError),
    /// No solution of the problem on the boundary.
    #[error(transparent)]
    Reduced(#[from] BoundaryError),
    /// A minimisation that ran out of iterations, or met rounding too early.
    #[error(
        "{solver} did not converge: {status} after {iterations} iterations, with the gradient at {reduction:.1e} of \
         that of the start ({tolerance:.1e} was asked for)"
    )]
    NotConverged {
        /// Its name.
        solver: &'static str,
        /// How it ended.
        status: &'static str,
        /// Iterations made.
        iterations: usize,
        /// |∇E| relative to the start.
        reduction: f64,
        /// What was asked for.
        tolerance: f64,
    },
}

/// A request beside the weights of a convex combination map, which have no use for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clash {
    /// An energy.
    Energy,
    /// A solver by name.
    Solver,
}

impl std::fmt::Display for Clash {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Clash::Energy => "an energy",
            Clash::Solver => "a solver",
        })
    }
}

impl MapError {
    /// Whether nothing stands against the map but integral weights, which are undefined where Re ρ ≤ 0, whichever backend met that.
    pub fn is_of_integral_weights(&self) -> bool {
        match self {
            MapError::NonPositiveRho(_) | MapError::Reduced(BoundaryError::NonPositiveRho(_)) => true,
            MapError::Energy(EnergyError::NonPositiveRho(_)) => true,
            MapError::Solve(SolveError::Unsuitable { reason, .. }) => matches!(reason, Unsuitable::NonPositiveRho(_)),
            _ => false,
        }
    }
}
