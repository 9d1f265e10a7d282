use super::lengths::boundary_errors;
use super::periodic::PeriodicMap;
use super::{Domain, Map};
use crate::distortion::{Distortion, Image, Validity, mesh_boundary};
use crate::geometry::polygon::out_of_order;
use crate::surface::cut::CutRecord;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::Component;
use crate::surface::topology::diagnosis::Finding;

/// A surface and its map, with everything in between that a report or a figure needs.
#[derive(Clone, Debug)]
pub struct Mapped {
    /// Number of vertices of the source, those included that no face uses.
    pub source_vertices: usize,
    /// The findings of the diagnosis, none of them fatal.
    pub findings: Vec<Finding>,
    /// The component that was mapped.
    pub component: Component,
    /// The cuts, fillings and removals that made it a disc.
    pub cut: CutRecord,
    /// The surface as it was mapped, with its quad graph.
    pub domain: Domain,
    /// The map.
    pub map: Map,
    /// The periods and the layout of the faces, for periodic maps.
    pub torus: Option<PeriodicMap>,
    /// The distortion of the map.
    pub distortion: Distortion,
    /// Whether the map is bijective, by exact predicates.
    pub validity: Validity,
}

impl Mapped {
    /// The image of every vertex of the source (`nv × 2`); `None` for vertices that no mapped face uses.
    ///
    /// A vertex on a cut has several images, one for each of its copies, and here is the first;
    /// [`Mapped::texture_coordinates`] has them all.
    pub fn uv(&self) -> Vec<Option<[f64; 2]>> {
        let mut uv = vec![None; self.source_vertices];
        let copies = self.domain.disc.source_vertex.iter().zip(&self.map.z);
        for (&v, z) in copies.rev().filter(|(v, _)| **v != OrientedMesh::NEW) {
            uv[v as usize] = Some([z.re, z.im]);
        }
        uv
    }

    /// Returns the same surface with another map, without periods, measured anew.
    #[must_use]
    pub fn with(self, map: Map) -> Self {
        let is_free = self.distortion.length.is_some_and(|length| length.boundary_max.is_some());
        let (distortion, validity) = measure(&self.domain, &map, None, is_free);
        Mapped { map, torus: None, distortion, validity, ..self }
    }

    /// The images of the corners of faces and quads.
    pub fn image(&self) -> Image<'_> {
        image(&self.map, self.torus.as_ref())
    }
}

/// Measures the distortion of a map, and tests whether it is bijective; if the boundary is free, measures its lengths too.
pub(super) fn measure(
    domain: &Domain,
    map: &Map,
    torus: Option<&PeriodicMap>,
    is_free: bool,
) -> (Distortion, Validity) {
    let image = image(map, torus);
    let mut distortion = Distortion::new(&domain.disc, &domain.graph, domain.planes.as_ref(), &image);
    if map.on_circle {
        distortion.boundary_out_of_order = Some(out_of_order(&mesh_boundary(&domain.graph, &map.z)));
    }
    if let Some(length) = distortion.length.as_mut().filter(|_| is_free) {
        length.boundary_max = Some(boundary_errors(&domain.disc, &domain.graph, &map.z).max);
    }
    (distortion, Validity::new(&domain.disc, |c| image.corner(&domain.disc, c)))
}

/// The images of corners under a map.
fn image<'a>(map: &'a Map, torus: Option<&'a PeriodicMap>) -> Image<'a> {
    Image { z: &map.z, cover: torus.map(|torus| (&torus.periods, torus.omega())) }
}
