//! The record of a run: everything that a table or figure is made from. Field names are fixed; others may be added.

use std::fmt;

use num_complex::Complex64;
use serde::Serialize;

use crate::distortion::{Distortion, Validity};
use crate::input::Input;
use crate::map::periodic::PeriodsRecord;
use crate::map::{Domain, Exactly, LengthsRecord, Map, Mapped, Provenance, Replacement, Setback};
use crate::quad_graph::QuadGraph;
use crate::surface::cut::CutRecord;
use crate::surface::digital::{Adjacency, Digital};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Component;

/// One map, from input to distortion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// What was mapped.
    pub input: InputRecord,
    /// What was done to make it a disc, or closed.
    pub cut: Option<CutRecord>,
    /// Its quad graph.
    pub quad_graph: QuadGraphRecord,
    /// Energies of the map.
    pub energy: EnergyRecord,
    /// How it was found.
    pub solver: SolverRecord,
    /// How good it is.
    pub distortion: Distortion,
    /// Periodic maps: the periods.
    pub periods: Option<PeriodsRecord>,
    /// Against the exact map, where that is known.
    pub error: Option<ErrorRecord>,
    /// Free maps with boundary lengths that were asked for: how well they are met.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub boundary_lengths: Option<LengthsRecord>,
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
    /// Digital surfaces: the voxels and their boundary.
    pub digital: Option<DigitalRecord>,
    /// The faces without area that were mapped by a shape of their own, where there are some.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surrogates: Option<SurrogatesRecord>,
}

/// Faces without area.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurrogatesRecord {
    /// How many. They are left out of what is said of distortion.
    pub count: usize,
    /// What they were at rest: a vertex lifted off the longest edge, or a rectangle.
    pub shape: &'static str,
    /// Height over length of that.
    pub height: f64,
    /// The first of them, ascending, as the source numbers them.
    pub faces: Vec<u32>,
}

impl SurrogatesRecord {
    /// How many faces are named.
    const NAMED: usize = 10;

    /// That of a disc; `None` where no face of the source has a surrogate.
    pub fn new(disc: &OrientedMesh) -> Option<Self> {
        let faces: Vec<u32> = disc.surrogates.faces.iter().map(|&f| disc.source_face[f as usize]).collect();
        let count = faces.iter().filter(|&&f| f != OrientedMesh::NEW).count();
        (count > 0).then(|| SurrogatesRecord {
            count,
            shape: if disc.faces.arity() == Some(3) { "lifted" } else { "rectangle" },
            height: disc.surrogates.height,
            faces: faces[..count.min(Self::NAMED)].to_vec(),
        })
    }
}

/// The voxels of a digital surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DigitalRecord {
    /// Number of voxels.
    pub voxels: usize,
    /// Interior adjacency: what became of edges where four surfels meet.
    pub adjacency: Adjacency,
    /// Which component of the boundary was mapped.
    pub component: usize,
    /// Surfels of every component, largest first.
    pub components: Vec<usize>,
}

impl DigitalRecord {
    /// The record of a digital surface.
    pub fn new(digital: &Digital) -> Self {
        DigitalRecord {
            voxels: digital.solid.len(),
            adjacency: digital.adjacency,
            component: digital.component,
            components: digital.components.clone(),
        }
    }
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
    /// Conformal without folds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub MIPS: Option<f64>,
    /// Isometric without folds.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub SD: Option<f64>,
}

/// The solver.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolverRecord {
    /// Name of the solver, and in parentheses how it came to be used.
    pub backend: String,
    /// `solved`; iterative ones: `converged`, `precision` (rounding keeps the energy from falling further),
    /// `max-iterations`, `interrupted`.
    pub status: &'static str,
    /// One-to-one by the exact check of the doubles that are written: every face positive (quads: all four corners), the
    /// boundary simple.
    pub valid: bool,
    /// The same near every point: every face positive, once around every vertex; the boundary of a free map may overlap.
    pub locally_injective: bool,
    /// Whether a valid map was put in the place of the plain one.
    pub repaired: bool,
    /// Faces that the plain map has folded, where a valid one is in its place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plain_folded: Option<usize>,
    /// The mean of σ1/σ2 of a plain map that folds nothing, where one of less shear is in its place.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plain_shear: Option<f64>,
    /// Vertices of the quad graph that are held at a place: of circle maps the boundary points that make it unique, one where a valid map
    /// is in the place of the plain one and double precision does not suffice for more.
    pub held: usize,
    /// Iterations; 0 for direct solvers.
    pub iterations: usize,
    /// Euclidean norm of the energy's gradient at the free unknowns.
    pub gradient_norm: Option<f64>,
    /// Relative residual of the linear system, of direct solvers.
    pub residual: Option<f64>,
    /// Wall-clock seconds.
    pub seconds: Seconds,
    /// Processor seconds, all threads; `None` where the system does not say.
    pub cpu_seconds: Option<Seconds>,
    /// The most memory that the process has held at once, in bytes; `None` where the system does not say.
    pub peak_bytes: Option<u64>,
    /// Smallest singular value of the Jacobian, of nonlinear problems.
    pub smallest_singular_value: Option<f64>,
    /// `conformal`: (2) holds on every quad; `circle`, `lengths`: the boundary is on the circle, has its lengths, and H is the
    /// lowest under that; none: the energy's minimum.
    pub exactly: Option<Exactly>,
    /// Circle maps that are exactly conformal: ε of the two circles of the boundary, `|z|² = 1 ± ε`.
    pub epsilon: Option<f64>,
}

/// What a run took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// By the clock on the wall.
    pub seconds: Seconds,
    /// Of the processor, all threads.
    pub cpu_seconds: Option<Seconds>,
    /// The most memory held at once, in bytes.
    pub peak_bytes: Option<u64>,
}

/// Seconds by phase.
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
    pub fn new(input: &Input, mapped: &Mapped, cost: Cost) -> Self {
        let Mapped { component, domain, map, distortion, validity, .. } = mapped;
        let Domain { disc, graph, .. } = domain;
        // The exact periods of generated surfaces are periods.
        let exact = input.period.map(|[re, im]| Complex64::new(re, im));
        let periods = mapped.torus.as_ref().and_then(|torus| PeriodsRecord::new(disc, torus, exact).ok());
        Report {
            input: InputRecord { surrogates: SurrogatesRecord::new(disc), ..InputRecord::new(input, component) },
            cut: Some(mapped.cut.clone()).filter(|cut| !cut.is_empty()),
            quad_graph: QuadGraphRecord::new(graph),
            energy: EnergyRecord::new(map),
            solver: SolverRecord::new(map, validity, cost),
            distortion: distortion.clone(),
            periods,
            boundary_lengths: domain
                .prescribed
                .as_ref()
                .map(|prescribed| LengthsRecord::new(prescribed, disc, graph, &map.z)),
            error: input.exact.as_ref().filter(|_| map.anchored).map(|w| ErrorRecord::new(w, disc, map)),
        }
    }
}

impl EnergyRecord {
    /// The energies of a map.
    pub fn new(map: &Map) -> Self {
        let of = |name: &str| map.energies.iter().find(|(n, _)| *n == name).map(|(_, value)| *value);
        EnergyRecord {
            total: map.total,
            H: of("H"),
            C: of("C"),
            A: of("A"),
            L: of("L"),
            Lb: of("Lb"),
            MIPS: of("MIPS"),
            SD: of("SD"),
        }
    }
}

impl ErrorRecord {
    /// The distance of a map to the exact one, `w` at the vertices of the source, over the vertices that both have.
    pub fn new(w: &[[f64; 2]], disc: &OrientedMesh, map: &Map) -> Self {
        let both = disc.source_vertex.iter().zip(&map.z).filter_map(|(&v, z)| Some((w.get(v as usize)?, z)));
        let distances = both.map(|(&[x, y], z)| (z.re - x).hypot(z.im - y));
        let (mut max, mut squares, mut count) = (0.0f64, 0.0, 0usize);
        for d in distances {
            max = max.max(d);
            squares += d * d;
            count += 1;
        }
        ErrorRecord { max, rms: (squares / count as f64).sqrt() }
    }
}

impl InputRecord {
    /// The record of a surface of one component.
    pub fn new(input: &Input, component: &Component) -> Self {
        InputRecord {
            path: input.source.clone(),
            kind: match (&input.digital, input.surface.faces.arity()) {
                (Some(_), _) => "digital",
                (None, Some(3)) => "triangle",
                _ => "quad",
            },
            vertices: input.surface.positions.len(),
            faces: component.faces,
            boundary_loops: component.boundary_loops.len(),
            euler: component.euler(),
            genus: component.genus(),
            digital: input.digital.as_ref().map(DigitalRecord::new),
            surrogates: None,
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
            clamped: graph.tilted,
        }
    }
}

impl SolverRecord {
    /// The record of a solution.
    pub fn new(map: &Map, validity: &Validity, cost: Cost) -> Self {
        SolverRecord {
            backend: map.provenance.to_string(),
            status: map.ending.name(),
            valid: validity.is_one_to_one(),
            locally_injective: validity.is_locally_one_to_one(),
            repaired: map.provenance.is_repaired(),
            plain_folded: map.provenance.flipped(),
            plain_shear: map.provenance.replaced.and_then(|replaced| match replaced.by {
                Replacement::LessDistorted { mean } => Some(mean),
                _ => None,
            }),
            held: map.fixed.len(),
            iterations: map.iterations,
            gradient_norm: map.gradient_norm,
            residual: map.residual,
            seconds: cost.seconds,
            cpu_seconds: cost.cpu_seconds,
            peak_bytes: cost.peak_bytes,
            smallest_singular_value: map.smallest_singular_value,
            exactly: map.exactly,
            epsilon: map.epsilon,
        }
    }
}

impl fmt::Display for Provenance {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let how = match (self.replaced.map(|replaced| replaced.by), self.after) {
            (Some(Replacement::Locally), _) => " (near folds)",
            (Some(Replacement::Wholly | Replacement::LessDistorted { .. }), _) => " (valid)",
            (Some(Replacement::OtherWeights), _) => "",
            (None, Some(Setback::Stalled { .. })) => " (reduced stalled)",
            (None, Some(Setback::OutOfOrder)) => " (reduced out of order)",
            (None, None) => "",
        };
        write!(out, "{}{how}", self.solver)
    }
}
