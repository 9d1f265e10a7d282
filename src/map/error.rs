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

/// A map cannot be computed as requested.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MapError {
    /// The arrays do not describe a surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The options contradict each other.
    #[error(transparent)]
    Options(#[from] OptionsError),
    /// The surface is not a disc, and the opening that was asked for does not make it one.
    #[error("the surface cannot be mapped: {0}")]
    NoDisc(#[from] CutError),
    /// Another number of places than of boundary vertices.
    #[error("{places} places are given for the {boundary} vertices of the boundary; give one for each, in order")]
    PlaceCount {
        /// Number of places.
        places: usize,
        /// Number of boundary vertices.
        boundary: usize,
    },
    /// A periodic map of a surface that was opened to a disc.
    #[error("the surface was opened to a disc, and a periodic map is one of a closed surface")]
    NotADiscMap,
    /// ρ from normals was requested, and some face has none.
    #[error("face {face} has no usable normal, and ρ from normals needs one for every face")]
    NoNormal {
        /// The first such face.
        face: usize,
    },
    /// ρ from normals was asked for on triangles.
    #[error("a triangle mesh has its own tangent planes: normals are for quad meshes and digital surfaces")]
    NormalsOfTriangles,
    /// The normals cannot be estimated.
    #[error(transparent)]
    Normals(#[from] NormalError),
    /// The height of surrogate faces is out of range.
    #[error("the height of surrogate faces is {height}; it must be positive, and at most 1")]
    SurrogateHeight {
        /// The requested height.
        height: f64,
    },
    /// A face needs a surrogate although normals are given.
    #[error("face {face} has no area, and its surrogate no place beside normals")]
    SurrogateNormals {
        /// The first such face, as an index of the source.
        face: u32,
    },
    /// No dual point has this name.
    #[error("unknown dual point `{name}`; known: {known}")]
    UnknownDual {
        /// The requested name.
        name: String,
        /// The known names.
        known: String,
    },
    /// No minimiser has this name.
    #[error("`{name}` does not solve nonlinear problems; those that do: auto, {known}")]
    NotAMinimiser {
        /// The requested name.
        name: String,
        /// The known names.
        known: String,
    },
    /// The energy is H alone, and the boundary is not pinned.
    #[error("H alone leaves the boundary free to take any shape: it must be fixed, or C, L or Lb be in the energy")]
    FreeBoundary,
    /// A periodic map cannot be computed.
    #[error(transparent)]
    Periodic(#[from] PeriodicError),
    /// An energy other than H was requested for a periodic map.
    #[error("periodic maps minimise H, and `{energy}` was asked for")]
    PeriodicEnergy {
        /// The energy.
        energy: String,
    },
    /// Vertices are pinned in a periodic map.
    #[error("periodic maps hold no vertices, and some are pinned")]
    PeriodicPins,
    /// A solver was requested that does not compute periodic maps.
    #[error("periodic maps have a solver of their own, and `{name}` was asked for")]
    PeriodicSolver {
        /// The requested name.
        name: String,
    },
    /// Faces are to be removed from, or a cut is to be made in, a surface that must be closed.
    #[error("periodic maps are of closed surfaces: nothing can be cut or removed")]
    PeriodicOpening,
    /// The energy does not determine the interior of the map.
    #[error("`{energy}` leaves the inside of the map undetermined: add H, or L")]
    Undetermined {
        /// The energy.
        energy: String,
    },
    /// The tolerance is out of range.
    #[error("the tolerance is {tolerance}; it must be positive and below 1")]
    Tolerance {
        /// The requested tolerance.
        tolerance: f64,
    },
    /// The order of the pinned vertices on the boundary would flip faces.
    #[error(
        "the pins do not follow each other counter-clockwise along the boundary: vertex {vertex} is out of order; turn \
         the pins or the faces over"
    )]
    PinsOutOfOrder {
        /// The first such vertex of the source.
        vertex: u32,
    },
    /// A boundary vertex of a circle map is pinned off the circle.
    #[error(
        "boundary vertex {vertex} is pinned at distance {radius} from 0: a circle map has its boundary at distance 1"
    )]
    PinOffCircle {
        /// The vertex, as an index of the source.
        vertex: u32,
        /// Its distance from 0.
        radius: f64,
    },
    /// An inner vertex of a circle map is pinned on or outside the circle.
    #[error(
        "vertex {vertex} is not on the boundary and is pinned at distance {radius} from 0: inside a circle map it must be \
         less than 1"
    )]
    PinOutside {
        /// The vertex, as an index of the source.
        vertex: u32,
        /// Its distance from 0.
        radius: f64,
    },
    /// The order of the boundary is to be kept, but it is not on a circle.
    #[error("the order is kept along a circle: the energy {energy} has no C")]
    NoCircle {
        /// The energy.
        energy: String,
    },
    /// A pinned vertex belongs to no face.
    #[error("vertex {vertex} cannot be held: no face of the surface uses it (vertices count from 0)")]
    NotInUse {
        /// The vertex, as an index of the source.
        vertex: u32,
    },
    /// A pinned vertex lies on the cut.
    #[error("vertex {vertex} cannot be held: the surface is cut there, and it has {copies} images")]
    OnTheCut {
        /// The vertex, as an index of the source.
        vertex: u32,
        /// Number of its copies.
        copies: usize,
    },
    /// Convex combination weights are combined with an option that they exclude.
    #[error("the weights {name} make a map without an energy and by a solver of its own, and {clash} was asked for")]
    WeightsOfNothing {
        /// Name of the weights.
        name: String,
        /// The other option.
        clash: Clash,
    },
    /// No map without flipped faces was found as a start.
    #[error(
        "no map without folds was found to start from: of the last one {folded} faces are folded (the first: {first:?}) and the shortest edge is \
         {smallest:.0e} of its extent, where doubles tell places apart by 1e-16 of it: a boundary that is held must be so on a convex curve, \
         and what is far from a short boundary is mapped too small; a longer boundary, or a map in parts, helps"
    )]
    NoValidStart {
        /// Number of flipped faces in the last attempt.
        folded: usize,
        /// The first of them, as an index of the source.
        first: Option<u32>,
        /// Its shortest edge relative to its extent.
        smallest: f64,
    },
    /// Some quads are not convex in any map.
    #[error(
        "no map makes the quads at vertex {vertex} convex, which is not on the boundary and has two of them alone, nor those at {} more",
        count - 1
    )]
    NoConvexQuads {
        /// The first such vertex, as an index of the source.
        vertex: u32,
        /// Number of such vertices.
        count: usize,
    },
    /// The prescribed boundary lengths are impossible.
    #[error(transparent)]
    Lengths(#[from] LengthsError),
    /// A convex combination map cannot be computed.
    #[error(transparent)]
    Convex(#[from] ConvexError),
    /// ρ is not defined.
    #[error(transparent)]
    QuadGraph(#[from] QuadGraphError),
    /// Integral weights are undefined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// The energy is not defined on the surface.
    #[error(transparent)]
    Energy(#[from] EnergyError),
    /// The constraints are contradictory or insufficient.
    #[error(transparent)]
    Constraint(#[from] ConstraintError),
    /// The linear problem was not solved.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The nonlinear problem was not solved.
    #[error(transparent)]
    Minimise(#[from] MinimiseError),
    /// The problem on the boundary was not solved.
    #[error(transparent)]
    Reduced(#[from] BoundaryError),
    /// A minimisation reached its largest number of iterations, or the limit of rounding, before
    /// the tolerance.
    #[error(
        "{solver} did not converge: {status} after {iterations} iterations, with the gradient at {reduction:.1e} of \
         that of the start ({tolerance:.1e} was asked for)"
    )]
    NotConverged {
        /// Name of the solver.
        solver: &'static str,
        /// The final status.
        status: &'static str,
        /// Number of iterations.
        iterations: usize,
        /// |∇E| relative to the start.
        reduction: f64,
        /// The requested tolerance.
        tolerance: f64,
    },
}

/// An option that convex combination weights exclude.
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
    /// Whether undefined integral weights (Re ρ ≤ 0) are the cause, whichever solver reported it.
    pub fn is_of_integral_weights(&self) -> bool {
        match self {
            MapError::NonPositiveRho(_) | MapError::Reduced(BoundaryError::NonPositiveRho(_)) => true,
            MapError::Energy(EnergyError::NonPositiveRho(_)) => true,
            MapError::Solve(SolveError::Unsuitable { reason, .. }) => matches!(reason, Unsuitable::NonPositiveRho(_)),
            _ => false,
        }
    }
}
