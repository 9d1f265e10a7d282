//! The report of a map: every number that a table or figure uses. Fields may be added, but are
//! never renamed; `schema/report.json` describes them.

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

/// The report of one map, from the surface to the distortion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The surface.
    pub input: InputRecord,
    /// How the surface was made a disc, or closed; `None` if it was mapped as it is.
    pub cut: Option<CutRecord>,
    /// The quad graph of the surface.
    pub quad_graph: QuadGraphRecord,
    /// Energies of the map.
    pub energy: EnergyRecord,
    /// The solver and how it ended.
    pub solver: SolverRecord,
    /// Distortion of the map.
    pub distortion: Distortion,
    /// Periods of a periodic map.
    pub periods: Option<PeriodsRecord>,
    /// Distance to the exact map, if that is known.
    pub error: Option<ErrorRecord>,
    /// Errors of the boundary lengths, if a free map was asked to have given ones.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub boundary_lengths: Option<LengthsRecord>,
}

/// Counts and topology of the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InputRecord {
    /// Path of the file, or name of the generated surface.
    pub path: String,
    /// `quad`, `triangle` or `digital`.
    pub kind: &'static str,
    /// Vertices in the file.
    pub vertices: usize,
    /// Number of faces.
    pub faces: usize,
    /// Number of boundary loops.
    pub boundary_loops: usize,
    /// Euler number: used vertices − edges + faces.
    pub euler: i64,
    /// Genus; `None` if the surface is not orientable or not a manifold.
    pub genus: Option<u64>,
    /// Voxels of a digital surface and their boundary.
    pub digital: Option<DigitalRecord>,
    /// Faces without area that were given a shape, if there are any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surrogates: Option<SurrogatesRecord>,
}

/// Faces without area that were given a shape, and are left out of the distortion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SurrogatesRecord {
    /// Number of these faces.
    pub count: usize,
    /// Shape at rest: `lifted`, a vertex lifted off the longest edge; or `rectangle`.
    pub shape: &'static str,
    /// Height over length of that shape.
    pub height: f64,
    /// The first of these faces, ascending, as the source numbers them.
    pub faces: Vec<u32>,
}

impl SurrogatesRecord {
    /// Number of faces that are listed.
    const NAMED: usize = 10;

    /// Returns the record of a disc; `None` if no face of the source was given a shape.
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
    /// Interior adjacency at edges where four surfels meet.
    pub adjacency: Adjacency,
    /// Component of the boundary that was mapped, from 0.
    pub component: usize,
    /// Number of surfels of every component, largest first.
    pub components: Vec<usize>,
}

impl DigitalRecord {
    /// Returns the record of a digital surface.
    pub fn new(digital: &Digital) -> Self {
        DigitalRecord {
            voxels: digital.solid.len(),
            adjacency: digital.adjacency,
            component: digital.component,
            components: digital.components.clone(),
        }
    }
}

/// Counts of the quad graph.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct QuadGraphRecord {
    /// Number nv of vertices.
    pub vertices: usize,
    /// Number nf of quads.
    pub quads: usize,
    /// Number nb of boundary vertices.
    pub boundary_vertices: usize,
    /// Smallest Re ρ.
    pub min_re_rho: f64,
    /// Number of quads with Re ρ ≤ 0.
    pub negative_rho: usize,
    /// Number of surfels of a digital surface whose normal was tilted.
    pub clamped: usize,
}

/// Energies of the map, each without its coefficient; `None` if it is not a term, or undefined.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[allow(non_snake_case)]
pub struct EnergyRecord {
    /// Sum of coefficient times energy.
    pub total: Option<f64>,
    /// Conformal energy.
    pub H: Option<f64>,
    /// Circle energy.
    pub C: Option<f64>,
    /// Authalic energy.
    pub A: Option<f64>,
    /// Metric energy of all edges.
    pub L: Option<f64>,
    /// Metric energy of the boundary edges, the paper's L'.
    pub Lb: Option<f64>,
    /// MIPS, +∞ where a face is flipped.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub MIPS: Option<f64>,
    /// Symmetric Dirichlet energy, +∞ where a face is flipped.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub SD: Option<f64>,
}

/// The solver, how it ended, and what it took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SolverRecord {
    /// Name of the solver, and in parentheses how it came to be used.
    pub backend: String,
    /// `solved` by a direct solver; or `converged`, `precision` (rounding ends the descent),
    /// `max-iterations`, `interrupted`.
    pub status: &'static str,
    /// Whether the map is injective, by an exact check of its doubles: every face (of a quad, every
    /// corner) is positively oriented, and the boundary is simple.
    pub valid: bool,
    /// Whether the map is locally injective, by the same check: the faces wind once around every
    /// vertex. The boundary of a free map may still cross itself.
    pub locally_injective: bool,
    /// Whether the map replaces a conformal one.
    pub repaired: bool,
    /// Number of flipped faces of the conformal map that was replaced.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plain_folded: Option<usize>,
    /// Mean σ1/σ2 of a conformal map without flipped faces that was replaced by one of less
    /// distortion.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plain_shear: Option<f64>,
    /// Number of pinned vertices of the quad graph. Of circle maps these are the boundary points
    /// that make the map unique; a map that replaces a conformal one has a single one if double
    /// precision does not suffice for more.
    pub held: usize,
    /// Number of iterations; 0 for direct solvers.
    pub iterations: usize,
    /// Euclidean norm of the gradient of the energy at the unknowns.
    pub gradient_norm: Option<f64>,
    /// Relative residual of direct solvers; error of the conditions that a map meets exactly.
    pub residual: Option<f64>,
    /// Wall-clock seconds.
    pub seconds: Seconds,
    /// Processor seconds of all threads; `None` if the system does not report them.
    pub cpu_seconds: Option<Seconds>,
    /// Peak memory of the process in bytes; `None` if the system does not report it.
    pub peak_bytes: Option<u64>,
    /// Smallest singular value of the Jacobian of a nonlinear problem.
    pub smallest_singular_value: Option<f64>,
    /// Condition that the map meets exactly: equation (2) on every quad (`conformal`); the boundary
    /// on the circle, with H minimal under this condition (`circle`); the boundary edges of the mesh
    /// with their lengths (`lengths`), and equation (2), on quad meshes as far as these permit.
    /// `None` for a minimum of the energy.
    pub exactly: Option<Exactly>,
    /// ε of the two circles `|z|² = 1 ± ε` on which the boundary of an exactly conformal circle map
    /// lies.
    pub epsilon: Option<f64>,
}

/// Time and memory of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cost {
    /// Wall-clock seconds.
    pub seconds: Seconds,
    /// Processor seconds of all threads.
    pub cpu_seconds: Option<Seconds>,
    /// Peak memory in bytes.
    pub peak_bytes: Option<u64>,
}

/// Seconds by phase.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Seconds {
    /// Reading or generating the surface.
    pub read: f64,
    /// Diagnosis, quad graph, matrices.
    pub assemble: f64,
    /// Ordering the unknowns by nested dissection. Minimum degree is part of the factorisation.
    pub order: f64,
    /// Factorisation.
    pub factor: f64,
    /// Solving with the factors.
    pub solve: f64,
    /// Measuring the distortion.
    pub measure: f64,
    /// Sum of all phases; writing the outputs is not counted.
    pub total: f64,
}

impl Seconds {
    /// The seconds from the surface in memory to its map: assembly, order, factor and solution.
    pub fn of_the_map(&self) -> f64 {
        self.assemble + self.order + self.factor + self.solve
    }
}

/// Distance to the exact map.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ErrorRecord {
    /// Largest distance over the vertices.
    pub max: f64,
    /// Root of the mean square.
    pub rms: f64,
}

impl Report {
    /// Returns the report of a map.
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
    /// Returns the energies of a map.
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
    /// Returns the distance between a map and the exact one, `w` at the vertices of the source,
    /// over the vertices that both have.
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
    /// Returns the record of a surface of one component.
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
    /// Returns the record of `graph`.
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
    /// Returns the record of a map.
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
