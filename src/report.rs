//! The record of a run: everything that a table or figure is made from. Field names are fixed; others may be added.

use serde::Serialize;

use crate::distortion::Distortion;
use crate::input::Input;
use crate::map::{Map, Mapped};
use crate::quad_graph::QuadGraph;
use crate::surface::disc::Disc;
use crate::surface::topology::Component;

/// One map, from input to distortion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// What was mapped.
    pub input: InputRecord,
    /// Its quad graph.
    pub quad_graph: QuadGraphRecord,
    /// Energies of the map.
    pub energy: EnergyRecord,
    /// How it was found.
    pub solver: SolverRecord,
    /// How good it is.
    pub distortion: Distortion,
    /// Against the exact map, where that is known.
    pub error: Option<ErrorRecord>,
}

/// The surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InputRecord {
    /// Path, or name of a generated surface.
    pub path: String,
    /// `quad`, `triangle` or `digital`.
    pub kind: &'static str,
    /// Vertices in the file.
    pub vertices: usize,
    /// Faces.
    pub faces: usize,
    /// Boundary loops.
    pub boundary_loops: usize,
    /// Vertices in use − edges + faces.
    pub euler: i64,
    /// Genus.
    pub genus: Option<u64>,
}

/// The quad graph.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct QuadGraphRecord {
    /// nv.
    pub vertices: usize,
    /// nf.
    pub quads: usize,
    /// nb.
    pub boundary_vertices: usize,
    /// Smallest Re ρ.
    pub min_re_rho: f64,
    /// Quads with Re ρ ≤ 0.
    pub negative_rho: usize,
    /// Digital surfaces: surfels whose normal was tilted.
    pub clamped: usize,
}

/// Energies without their coefficients, but for the total. `None`: not a term, or undefined.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case)]
pub struct EnergyRecord {
    /// Σ coefficient × energy.
    pub total: Option<f64>,
    /// Conformal.
    pub H: Option<f64>,
    /// Circle.
    pub C: Option<f64>,
    /// Authalic.
    pub A: Option<f64>,
    /// Metric, all edges.
    pub L: Option<f64>,
    /// Metric, boundary edges.
    pub Lb: Option<f64>,
}

/// The solver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolverRecord {
    /// Name of the backend.
    pub backend: &'static str,
    /// `solved`; iterative ones: `converged`, `precision` (rounding keeps the energy from falling further),
    /// `max-iterations`, `interrupted`.
    pub status: &'static str,
    /// Every face positive (quads: convex), boundary simple.
    pub valid: bool,
    /// Whether a valid map was put in the place of the plain one.
    pub repaired: bool,
    /// Iterations; 0 for direct solvers.
    pub iterations: usize,
    /// Euclidean norm of the energy's gradient at the free unknowns.
    pub gradient_norm: Option<f64>,
    /// Relative residual of the linear system, of direct solvers.
    pub residual: Option<f64>,
    /// Wall-clock seconds.
    pub seconds: Seconds,
    /// Smallest singular value of the Jacobian, of nonlinear problems.
    pub smallest_singular_value: Option<f64>,
}

/// Wall-clock seconds by phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Reading or generating the surface.
    pub read: f64,
    /// Diagnosis, quad graph, matrices.
    pub assemble: f64,
    /// Factorisation.
    pub factor: f64,
    /// Solving with the factors.
    pub solve: f64,
    /// Measuring the distortion.
    pub measure: f64,
    /// All, distortion included, writing not.
    pub total: f64,
}

/// Distance to the exact map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorRecord {
    /// Over vertices.
    pub max: f64,
    /// Root of the mean square.
    pub rms: f64,
}

impl Report {
    /// The record of a map.
    pub fn new(input: &Input, mapped: &Mapped, seconds: Seconds) -> Self {
        let Mapped { component, disc, graph, map, distortion, .. } = mapped;
        let vertices = input.surface.positions.len();
        Report {
            input: InputRecord::new(&input.source, disc.faces.arity(), vertices, component),
            quad_graph: QuadGraphRecord::new(graph),
            energy: EnergyRecord::new(map),
            solver: SolverRecord::new(map, distortion, seconds),
            distortion: distortion.clone(),
            error: input.exact.as_ref().filter(|_| map.anchored).map(|w| ErrorRecord::new(w, disc, map)),
        }
    }
}

impl EnergyRecord {
    /// The energies of a map.
    pub fn new(map: &Map) -> Self {
        let of = |name: &str| map.energies.iter().find(|(n, _)| *n == name).map(|(_, value)| *value);
        EnergyRecord { total: map.total, H: of("H"), C: of("C"), A: of("A"), L: of("L"), Lb: of("Lb") }
    }
}

impl ErrorRecord {
    /// The distance of a map to the exact one, `w` at the vertices of the source, over the vertices of the mesh.
    pub fn new(w: &[[f64; 2]], disc: &Disc, map: &Map) -> Self {
        let distances = disc.source_vertex.iter().zip(&map.z).map(|(&v, z)| {
            let [x, y] = w[v as usize];
            (z.re - x).hypot(z.im - y)
        });
        let (mut max, mut squares) = (0.0f64, 0.0);
        for d in distances {
            max = max.max(d);
            squares += d * d;
        }
        ErrorRecord { max, rms: (squares / disc.source_vertex.len() as f64).sqrt() }
    }
}

impl InputRecord {
    /// The record of a surface of one component.
    pub fn new(path: &str, corners: Option<usize>, vertices: usize, component: &Component) -> Self {
        InputRecord {
            path: path.to_owned(),
            kind: if corners == Some(3) { "triangle" } else { "quad" },
            vertices,
            faces: component.faces,
            boundary_loops: component.boundary_loops.len(),
            euler: component.euler(),
            genus: component.genus(),
        }
    }
}

impl QuadGraphRecord {
    /// The record of `graph`.
    pub fn new(graph: &QuadGraph) -> Self {
        QuadGraphRecord {
            vertices: graph.vertices,
            quads: graph.quads.len(),
            boundary_vertices: graph.boundary.len(),
            min_re_rho: graph.min_re_rho(),
            negative_rho: graph.rho.iter().filter(|rho| rho.re <= 0.0).count(),
            clamped: 0,
        }
    }
}

impl SolverRecord {
    /// The record of a solution.
    pub fn new(map: &Map, distortion: &Distortion, seconds: Seconds) -> Self {
        SolverRecord {
            backend: map.backend,
            status: map.outcome.name(),
            valid: distortion.is_valid(),
            repaired: false,
            iterations: map.iterations,
            gradient_norm: map.gradient_norm,
            residual: map.residual,
            seconds,
            smallest_singular_value: map.smallest_singular_value,
        }
    }
}
