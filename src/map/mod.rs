//! One surface to one map: the pipeline from a disc to its image in the plane.

mod bijective;
mod boundary_energy;
mod convex_start;
mod domain;
mod error;
mod gauge;
mod lengths;
mod method;
mod normalisation;
mod options;
pub mod periodic;
mod provenance;
mod result;
mod setup;
mod solve;
mod texture;
mod torus;

pub use domain::Domain;
pub use error::{Clash, MapError};
pub use lengths::{LengthsError, LengthsRecord, Prescribed};
pub use options::{
    Boundary, BoundaryName, FlatOptions, Hold, Interior, MapOptions, OptionsError, Outline, Pin, PinnedPoints,
    RhoSource, Start, Valid, ValidName,
};
pub use provenance::{Provenance, Replaced, Replacement, Setback};
pub use result::{Ending, Exactly, Map};
pub use texture::TextureCoordinates;

use crate::distortion::{Distortion, Image, Validity, mesh_boundary};
use crate::geometry::polygon::out_of_order;
use crate::input::Input;
use crate::map::periodic::PeriodicMap;
use crate::solver::{Observer, Phase};
use crate::surface::cut::CutRecord;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Component;
use crate::surface::topology::diagnosis::{Diagnosis, Finding, Severity};

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
        solve::solve(self, domain, exact, watch)
    }
}
