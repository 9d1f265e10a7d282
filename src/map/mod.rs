//! One surface to one map: the pipeline from a disc to its image in the plane.

mod linear;
mod nonlinear;
mod options;

pub use options::{Boundary, Hold, MapOptions, Pin};

use num_complex::Complex64;

use crate::backend::{MinimiseError, Observer, Phase, SolveError};
use crate::constraint::{ConstraintError, Fixed, Shape};
use crate::distortion::{Distortion, mesh_boundary, out_of_order};
use crate::energy::conformal::NonPositiveRho;
use crate::input::Input;
use crate::quad_graph::{QuadGraph, QuadGraphError, RhoSource};
use crate::surface::diagnosis::{Diagnosis, Finding};
use crate::surface::disc::{Disc, NotADisc};
use crate::surface::topology::Component;

/// The request cannot be met.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MapError {
    /// A surface that is no disc, or too badly formed.
    #[error("the surface cannot be mapped (`riemap info` tells more)")]
    NotADisc(#[from] NotADisc),
    /// ρ from normals was asked for, and some face has none.
    #[error("face {face} has no usable normal, and ρ from normals needs one for every face: use --rho positions")]
    NoNormal {
        /// The first such face.
        face: usize,
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
    #[error("H alone leaves the boundary free to take any shape: hold it (--boundary fixed), or add C, L or Lb")]
    FreeBoundary,
    /// An energy that leaves vertices free to be anywhere.
    #[error("`{energy}` leaves the inside of the map undetermined: add H, or L")]
    Undetermined {
        /// The energy.
        energy: String,
    },
    /// A number of fixed points that means nothing.
    #[error("{fix} fixed boundary points: a circle map has 3 (or 2, as in the paper)")]
    FixedPoints {
        /// The number asked for.
        fix: usize,
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
         less than 1 (`riemap info --boundary` lists the boundary)"
    )]
    PinOutside {
        /// The vertex of the source.
        vertex: u32,
        /// Its distance from 0.
        radius: f64,
    },
    /// The order of a boundary that is on no circle.
    #[error("--keep-order is for circle maps: the energy {energy} has no C")]
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
    /// No usable ρ.
    #[error(transparent)]
    QuadGraph(#[from] QuadGraphError),
    /// Integral weights that are undefined.
    #[error(transparent)]
    NonPositiveRho(#[from] NonPositiveRho),
    /// Constraints that contradict or do not suffice.
    #[error(transparent)]
    Constraint(#[from] ConstraintError),
    /// No solution of the linear problem.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// No solution of the nonlinear problem.
    #[error(transparent)]
    Minimise(#[from] MinimiseError),
    /// A minimisation that ran out of iterations, or met rounding too early.
    #[error(
        "{backend} did not converge: {status} after {iterations} iterations, with the gradient at {reduction:.1e} of \
         that of the start ({tolerance:.1e} was asked for); try another --solver, or --max-iterations to get the \
         unfinished map"
    )]
    NotConverged {
        /// Its name.
        backend: &'static str,
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

/// How a map was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// By a direct solver.
    Solved,
    /// By iteration; see there.
    Minimised(crate::backend::Status),
}

impl Outcome {
    /// As in reports.
    pub fn name(self) -> &'static str {
        match self {
            Outcome::Solved => "solved",
            Outcome::Minimised(status) => status.name(),
        }
    }
}

/// A map and what is known of it.
#[derive(Clone, Debug)]
pub struct Map {
    /// The image of every vertex of the quad graph (`nv`).
    pub z: Vec<Complex64>,
    /// The vertices that were held.
    pub fixed: Fixed,
    /// The energy that was minimised; `None` where its weights are undefined (Re ρ ≤ 0).
    pub total: Option<f64>,
    /// Its terms, without their coefficients.
    pub energies: Vec<(&'static str, f64)>,
    /// |∇E| over the free unknowns, Euclidean.
    pub gradient_norm: Option<f64>,
    /// The backend that found it.
    pub backend: &'static str,
    /// How it ended.
    pub outcome: Outcome,
    /// Iterations, of all stages.
    pub iterations: usize,
    /// Direct solvers: the relative residual reached, of (2) where that is square, else of the normal equations.
    pub residual: Option<f64>,
    /// Circle maps: the smallest singular value of the Jacobian of the residuals.
    pub smallest_singular_value: Option<f64>,
    /// Whether the boundary was to be on the unit circle.
    pub on_circle: bool,
    /// Whether the held points are where the exact map of the surface has them.
    pub anchored: bool,
}

/// A surface and its map, with everything in between that a report or a figure needs.
#[derive(Clone, Debug)]
pub struct Mapped {
    /// What was found about the surface, none of it fatal.
    pub findings: Vec<Finding>,
    /// Its one component.
    pub component: Component,
    /// The surface as it was mapped.
    pub disc: Disc,
    /// Its quad graph.
    pub graph: QuadGraph,
    /// The map.
    pub map: Map,
    /// Its distortion.
    pub distortion: Distortion,
}

/// Maps `input` to the plane: diagnosis, quad graph, constraints, solution, distortion.
///
/// # Errors
/// Whatever of these fails first.
pub fn run(input: &Input, options: &MapOptions, watch: &mut dyn Observer) -> Result<Mapped, MapError> {
    watch.phase(Phase::Assemble);
    let diagnosis = Diagnosis::new(&input.surface);
    let disc = Disc::new(&input.surface, &diagnosis)?;
    let Diagnosis { topology, findings } = diagnosis;
    if let (RhoSource::Normals, Some(face)) = (options.rho, input.face_without_normal) {
        return Err(MapError::NoNormal { face });
    }
    // A disc has one component.
    let component = topology.components[0].clone();
    drop(topology);
    let graph = options.quad_graph(&disc)?;
    let exact = input.exact.as_deref();
    let map = options.map(&disc, &graph, exact, watch)?;
    watch.phase(Phase::Measure);
    let mut distortion = Distortion::new(&disc, &graph, &map.z);
    if map.on_circle {
        distortion.boundary_out_of_order = Some(out_of_order(&mesh_boundary(&graph, &map.z)));
    }
    Ok(Mapped { findings, component, disc, graph, map, distortion })
}

impl MapOptions {
    /// The map of a disc with its quad graph. `exact` are exact conformal coordinates (one per vertex of the source): a
    /// circle map then has its three points where these say.
    ///
    /// # Errors
    /// Options that contradict each other; constraints that do not suffice; a solver that fails or does not converge.
    pub fn map(
        &self,
        disc: &Disc,
        graph: &QuadGraph,
        exact: Option<&[[f64; 2]]>,
        watch: &mut dyn Observer,
    ) -> Result<Map, MapError> {
        let expression = self.expression();
        if self.keep_order && !expression.has("C") {
            return Err(MapError::NoCircle { energy: expression.to_string() });
        }
        if !expression.has("H") && !expression.has("L") {
            return Err(MapError::Undetermined { energy: expression.to_string() });
        }
        let h_alone = expression.rows().all(|row| row.name == "H") && expression.has("H");
        match (h_alone, self.boundary) {
            (true, Boundary::Fixed) => self.solve(graph, self.fixed(disc, graph)?, watch),
            (true, _) => Err(MapError::FreeBoundary),
            (false, _) => nonlinear::minimise(self, &expression, disc, graph, exact, watch),
        }
    }

    /// Whether a fixed boundary is on the unit circle.
    fn fixed_on_circle(&self) -> bool {
        self.positions.is_none() && self.shape == Shape::Circle
    }
}
