//! From a surface to its map: diagnosis, opening, quad graph, solution, distortion.

use super::mapped::measure;
use super::periodic::PeriodicMap;
use super::{Boundary, Domain, Map, MapError, MapOptions, Mapped, domain, solve};
use crate::input::Input;
use crate::solver::{Observer, Phase, Silent};
use crate::surface::Surface;
use crate::surface::cut::CutRecord;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Component;
use crate::surface::topology::diagnosis::{Diagnosis, Finding, Severity};

/// Maps a mesh given by arrays to the plane.
///
/// `positions` are the vertices in R³ (`nv × 3`), `faces` the polygons as lists of vertex indices, counted from 0:
/// triangles, or quads. [`Mapped::uv`] has the image of every vertex.
///
/// ```
/// use riemap::MapOptions;
///
/// let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.4, 0.5, 0.3]];
/// let faces = [vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]];
/// let mapped = riemap::map(&positions, &faces, &MapOptions::default())?;
/// // The boundary of the default map is on the unit circle.
/// let [x, y] = mapped.uv()[0].expect("a face uses the vertex");
/// assert!((x.hypot(y) - 1.0).abs() < 1e-12);
/// # Ok::<(), riemap::MapError>(())
/// ```
///
/// # Errors
/// Arrays that are not a surface, and everything for which [`map_surface`] fails.
pub fn map(positions: &[[f64; 3]], faces: &[Vec<u32>], options: &MapOptions) -> Result<Mapped, MapError> {
    map_surface(&Surface::from_polygons(positions.to_vec(), faces)?, options)
}

/// Maps a surface to the plane.
///
/// # Errors
/// A surface that is not a disc, is not made one by the options, or is too badly formed; options that leave the map undetermined;
/// a solver that does not converge.
pub fn map_surface(surface: &Surface, options: &MapOptions) -> Result<Mapped, MapError> {
    map_input(&Input::of("surface".to_owned(), surface.clone()), options, &mut Silent)
}

/// Maps an input to the plane, and tells `observer` how far it is.
///
/// An [`Input`] knows more than its surface: voxels, of which normals are estimated, the normals of a file, exact conformal coordinates.
///
/// # Errors
/// As for [`map_surface`].
pub fn map_input(input: &Input, options: &MapOptions, observer: &mut dyn Observer) -> Result<Mapped, MapError> {
    observer.phase(Phase::Assemble);
    let prepared = Prepared::new(input, options)?;
    let domain = &prepared.domain;
    let (map, torus) = if options.boundary == Boundary::Periodic {
        let (map, torus) = options.periodic(domain, observer)?;
        (map, Some(torus))
    } else {
        // The exact map is that of the whole surface.
        let exact = input.exact.as_deref().filter(|_| prepared.cut.is_empty());
        (options.map(domain, exact, observer)?, None)
    };
    Ok(prepared.mapped(map, torus, observer))
}

/// A surface made ready to be mapped, and what was found on the way.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    source_vertices: usize,
    findings: Vec<Finding>,
    component: Component,
    pub cut: CutRecord,
    pub domain: Domain,
    /// Whether the boundary is free.
    is_free: bool,
}

impl Prepared {
    /// Diagnoses and opens the surface, and measures ρ.
    pub fn new(input: &Input, options: &MapOptions) -> Result<Self, MapError> {
        let diagnosis = options.forgiving(input.diagnosis())?;
        let (mut disc, cut) = if options.boundary == Boundary::Periodic {
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
        let source_vertices = input.surface.positions.len();
        let is_free = matches!(options.boundary, Boundary::Free { .. });
        Ok(Prepared { source_vertices, findings, component, cut, domain, is_free })
    }

    /// The surface with its map, measured.
    pub fn mapped(self, map: Map, torus: Option<PeriodicMap>, observer: &mut dyn Observer) -> Mapped {
        observer.phase(Phase::Measure);
        let Prepared { source_vertices, findings, component, cut, domain, is_free } = self;
        let (distortion, validity) = measure(&domain, &map, torus.as_ref(), is_free);
        Mapped { source_vertices, findings, component, cut, domain, map, torus, distortion, validity }
    }
}

impl MapOptions {
    /// The map of a domain. `exact` are exact conformal coordinates, one pair for each vertex of the source: the pinned points of a
    /// circle map are then where these say.
    ///
    /// # Errors
    /// Options that leave the map undetermined; constraints that do not suffice; a solver that fails or does not converge.
    pub fn map(
        &self,
        domain: &Domain,
        exact: Option<&[[f64; 2]]>,
        observer: &mut dyn Observer,
    ) -> Result<Map, MapError> {
        solve::solve(self, domain, None, exact, observer)
    }
}
