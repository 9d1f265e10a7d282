//! One surface to one map: the pipeline from a disc to its image in the plane.

mod bijective;
mod convex;
mod domain;
mod error;
mod flip_free;
mod lengths;
mod linear;
mod nonlinear;
mod options;
pub mod periodic;
mod reduced;
mod texture;
mod torus;

pub use domain::Domain;
pub use error::MapError;
pub use lengths::{LengthsError, LengthsRecord, Prescribed};
pub use options::{Boundary, Hold, MapOptions, Pin, RhoSource, Start, Valid};
pub use texture::TextureCoordinates;

use num_complex::Complex64;

use crate::constraint::{Fixed, Shape};
use crate::distortion::{Distortion, Image, Validity, mesh_boundary};
use crate::geometry::polygon::out_of_order;
use crate::input::Input;
use crate::map::periodic::PeriodicMap;
use crate::solver::{Observer, Phase};
use crate::surface::cut::CutRecord;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Component;
use crate::surface::topology::diagnosis::{Diagnosis, Finding, Severity};

/// How a map was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// By a direct solver.
    Solved,
    /// By iteration; see there.
    Minimised(crate::solver::Status),
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

/// What a map meets exactly, where an energy would only draw it there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Exactly {
    /// The boundary is on the unit circle.
    Circle,
    /// The boundary edges have their rest lengths.
    Lengths,
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
    /// What was solved for exactly, with H the lowest under it; `None`: the energy's minimum.
    pub exactly: Option<Exactly>,
    /// Whether it is in the place of a map that was not one-to-one.
    pub repaired: bool,
    /// Of such a map: how many faces that other one has folded; `None` where it did not converge.
    pub plain_folded: Option<usize>,
    /// The mean of σ1/σ2 of the plain map, where it folds nothing and is not kept because this one has less.
    pub plain_shear: Option<f64>,
}

impl Map {
    /// The map z of a direct solver, H its only energy where `h` is known; nothing else is said of it.
    pub(crate) fn solved(backend: &'static str, z: Vec<Complex64>, fixed: Fixed, h: Option<f64>) -> Map {
        Map {
            z,
            fixed,
            total: h,
            energies: h.map(|h| ("H", h)).into_iter().collect(),
            gradient_norm: None,
            backend,
            outcome: Outcome::Solved,
            iterations: 0,
            residual: None,
            smallest_singular_value: None,
            on_circle: false,
            anchored: false,
            exactly: None,
            repaired: false,
            plain_folded: None,
            plain_shear: None,
        }
    }
}

/// A surface and its map, with everything in between that a report or a figure needs.
#[derive(Clone, Debug)]
pub struct Mapped {
    /// What was found about the surface, none of it fatal.
    pub findings: Vec<Finding>,
    /// Its one component.
    pub component: Component,
    /// What was done to make it a disc.
    pub cut: CutRecord,
    /// The surface as it was mapped, with its quad graph.
    pub domain: Domain,
    /// The map.
    pub map: Map,
    /// Periodic maps: the periods, and how the faces lie beside each other.
    pub torus: Option<PeriodicMap>,
    /// Its distortion.
    pub distortion: Distortion,
    /// Whether it is one-to-one, exactly.
    pub validity: Validity,
}

/// Maps `input` to the plane: diagnosis, quad graph, constraints, solution, distortion.
///
/// # Errors
/// Whatever of these fails first.
pub fn run(input: &Input, options: &MapOptions, watch: &mut dyn Observer) -> Result<Mapped, MapError> {
    watch.phase(Phase::Assemble);
    let diagnosis = options.forgiving(input.diagnosis())?;
    let is_periodic = options.boundary == Boundary::Periodic;
    let (mut disc, cut) = if is_periodic {
        options.check_periodic()?;
        OrientedMesh::closed(&input.surface, &diagnosis, options.fill_holes)?
    } else {
        OrientedMesh::open(&input.surface, &diagnosis, &options.opening())?
    };
    options.shape_flat_faces(&mut disc);
    let planes = domain::planes(input, &diagnosis, &disc, options)?;
    let Diagnosis { topology, mut findings } = diagnosis;
    // What was fatal is mended: the cut's record says how.
    findings.retain(|finding| finding.severity() != Severity::Fatal);
    // A disc has one component.
    let component = topology.components[0].clone();
    drop(topology);
    let domain = Domain::with_planes(disc, planes, options)?;
    let (map, torus) = if is_periodic {
        let (map, torus) = options.periodic(&domain, watch)?;
        (map, Some(torus))
    } else {
        // The exact map is that of the whole surface.
        let exact = input.exact.as_deref().filter(|_| cut.is_empty());
        (options.map(&domain, exact, watch)?, None)
    };
    watch.phase(Phase::Measure);
    let (distortion, validity) = measure(&domain, &map, torus.as_ref());
    Ok(Mapped { findings, component, cut, domain, map, torus, distortion, validity })
}

fn measure(domain: &Domain, map: &Map, torus: Option<&PeriodicMap>) -> (Distortion, Validity) {
    let image = image(map, torus);
    let mut distortion = Distortion::new(&domain.disc, &domain.graph, domain.planes.as_ref(), &image);
    if map.on_circle {
        distortion.boundary_out_of_order = Some(out_of_order(&mesh_boundary(&domain.graph, &map.z)));
    }
    (distortion, Validity::new(&domain.disc, |c| image.corner(&domain.disc, c)))
}

/// Where a map puts corners.
fn image<'a>(map: &'a Map, torus: Option<&'a PeriodicMap>) -> Image<'a> {
    Image { z: &map.z, cover: torus.map(|torus| (&torus.periods, torus.omega())) }
}

impl Mapped {
    /// Another map of the same surface, without periods, in the place of this one, and measured.
    #[must_use]
    pub fn with(self, map: Map) -> Self {
        let (distortion, validity) = measure(&self.domain, &map, None);
        Mapped { map, torus: None, distortion, validity, ..self }
    }

    /// Where the map puts the corners of faces and quads.
    pub fn image(&self) -> Image<'_> {
        image(&self.map, self.torus.as_ref())
    }
}

impl MapOptions {
    /// The map of a domain. `exact` are exact conformal coordinates (one per vertex of the source): a
    /// circle map then has its three points where these say.
    ///
    /// # Errors
    /// Options that contradict each other; constraints that do not suffice; a solver that fails or does not converge.
    pub fn map(&self, domain: &Domain, exact: Option<&[[f64; 2]]>, watch: &mut dyn Observer) -> Result<Map, MapError> {
        let expression = self.expression();
        if let Some(name) = &self.weights {
            return self.convex(name, domain, watch);
        }
        if self.keep_order && !expression.has("C") {
            return Err(MapError::NoCircle { energy: expression.to_string() });
        }
        if !expression.has("H") && !expression.has("L") && !flip_free::is_flip_free(&expression) {
            return Err(MapError::Undetermined { energy: expression.to_string() });
        }
        let h_alone = expression.rows().all(|row| row.name == "H") && expression.has("H");
        match (h_alone, self.boundary) {
            (true, Boundary::Fixed) => self.solve(&domain.graph, self.fixed(&domain.disc, &domain.graph)?, watch),
            (true, _) => Err(MapError::FreeBoundary),
            (false, _) => {
                let plain = nonlinear::minimise(self, &expression, domain, exact, watch);
                match self.promises_valid() {
                    true => bijective::kept_or_replaced(self, domain, exact, plain, watch),
                    false => plain,
                }
            }
        }
    }

    /// Whether a fixed boundary is on the unit circle.
    fn fixed_on_circle(&self) -> bool {
        self.positions.is_none() && self.shape == Shape::Circle
    }
}
