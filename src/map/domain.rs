use num_complex::Complex64;

use super::lengths::{Prescribed, prescribe};
use super::{MapError, MapOptions, RhoSource};
use crate::constraint::Fixed;
use crate::distortion::{Validity, folded_faces};
use crate::geometry::vector::scale;
use crate::input::Input;
use crate::quad_graph::metric::RestMetric;
use crate::quad_graph::{QuadGraph, TangentPlanes, own_normal};
use crate::surface::Surface;
use crate::surface::edges::Edges;
use crate::surface::normals::{Facets, NormalError, NormalSpec};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::diagnosis::Diagnosis;

/// A surface prepared for mapping: connected, oriented, with a number ρ for every quad.
#[derive(Clone, Debug)]
pub struct Domain {
    /// The surface to be mapped.
    pub disc: OrientedMesh,
    /// The tangent planes on which ρ was measured, if these are not the faces' own.
    pub planes: Option<TangentPlanes>,
    /// Its quad graph.
    pub graph: QuadGraph,
    /// The prescribed boundary lengths, if any; the graph contains them instead of the lengths at
    /// rest.
    pub prescribed: Option<Prescribed>,
}

impl Domain {
    /// Makes the domain of a disc from its positions alone.
    ///
    /// # Errors
    /// An unknown dual point; faces that do not define ρ.
    pub fn of_positions(disc: OrientedMesh, options: &MapOptions) -> Result<Self, MapError> {
        Domain::with_planes(disc, None, options)
    }

    /// Makes the domain of a disc, with ρ of quads measured on `planes` if given.
    ///
    /// # Errors
    /// An unknown dual point; faces that do not define ρ; impossible boundary lengths.
    pub fn with_planes(
        disc: OrientedMesh,
        planes: Option<TangentPlanes>,
        options: &MapOptions,
    ) -> Result<Self, MapError> {
        let dual = options.dual_point()?;
        let mut graph = match disc.faces.arity() {
            Some(3) => QuadGraph::from_triangles(&disc, dual, options.boundary_dual)?,
            _ => QuadGraph::from_quads(&disc, planes.as_ref())?,
        };
        let prescribed = prescribe(options, &disc, &mut graph)?;
        Ok(Domain { disc, planes, graph, prescribed })
    }

    /// Returns the rest lengths and areas.
    ///
    /// # Errors
    /// An unknown dual point; degenerate faces.
    pub fn rest_metric(&self, options: &MapOptions) -> Result<RestMetric, MapError> {
        Ok(match self.disc.faces.arity() {
            Some(3) => RestMetric::of_triangles(&self.disc, &self.graph, options.dual_point()?)?,
            _ => RestMetric::of_quads(&self.disc, &self.graph, self.planes.as_ref()),
        })
    }

    /// Whether the faces are triangles.
    pub fn is_of_triangles(&self) -> bool {
        self.disc.faces.arity() == Some(3)
    }

    /// Whether the map with the mesh vertices at `z` is injective, by exact predicates.
    pub fn is_one_to_one(&self, z: &[Complex64]) -> bool {
        self.validity(z).is_one_to_one()
    }

    /// Returns the faces that are flipped in the map with the mesh vertices at `z`, as indices of
    /// the domain.
    pub(super) fn folded(&self, z: &[Complex64]) -> Vec<u32> {
        folded_faces(&self.disc, |c| z[self.disc.faces.corners()[c] as usize])
    }

    /// Checks the map with the mesh vertices at `z` by exact predicates; further values, such as
    /// those of dual vertices, are ignored.
    pub fn validity(&self, z: &[Complex64]) -> Validity {
        Validity::new(&self.disc, |c| z[self.disc.faces.corners()[c] as usize])
    }

    /// Extends a map of the mesh's vertices to the quad graph: dual vertices are placed at the
    /// barycentres of their faces, those on the boundary where `fixed` pins them, or on their
    /// edges.
    pub(crate) fn with_dual_vertices(&self, mut z: Vec<Complex64>, fixed: &Fixed) -> Vec<Complex64> {
        let graph = &self.graph;
        if graph.primal == graph.vertices {
            return z;
        }
        for polygon in self.disc.faces.iter() {
            let sum: Complex64 = polygon.iter().map(|&v| z[v as usize]).sum();
            z.push(sum / polygon.len() as f64);
        }
        z.resize(graph.vertices, Complex64::ZERO);
        let n = graph.boundary.len();
        for k in (0..n).filter(|&k| graph.is_dual(graph.boundary[k])) {
            let [before, after] = [(k + n - 1) % n, (k + 1) % n];
            let (l, m) = (graph.boundary_length[before], graph.boundary_length[k]);
            let [a, b] = [before, after].map(|k| z[graph.boundary[k] as usize]);
            let on_edge = (a * m + b * l) / (l + m);
            z[graph.boundary[k] as usize] = fixed.place(graph.boundary[k]).unwrap_or(on_edge);
        }
        z
    }

    /// The signed area enclosed by the boundary of an image.
    pub(super) fn image_area(&self, z: &[Complex64]) -> f64 {
        let boundary = &self.graph.boundary;
        let next = boundary.iter().cycle().skip(1);
        let pairs = boundary.iter().zip(next);
        pairs.map(|(&v, &w)| 0.5 * (z[v as usize].conj() * z[w as usize]).im).sum()
    }
}

/// Returns the tangent planes on which ρ of the faces of `disc`, which was made from `input`, is to
/// be measured; `None` if it is computed from positions.
///
/// # Errors
/// Normals of triangles; an estimator that fails or lacks input.
pub(super) fn planes(
    input: &Input,
    diagnosis: &Diagnosis,
    disc: &OrientedMesh,
    options: &MapOptions,
) -> Result<Option<TangentPlanes>, MapError> {
    let spec = match (&options.normals, options.rho) {
        (Some(spec), _) => spec.clone(),
        (None, RhoSource::Auto) if input.digital.is_some() => NormalSpec::default(),
        (None, RhoSource::Normals) => "file".parse().map_err(NormalError::from)?,
        (None, _) => return Ok(None),
    };
    if input.surface.faces.arity() == Some(3) {
        return Err(MapError::NormalsOfTriangles);
    }
    if let Some(&face) = disc.surrogates.faces.first() {
        return Err(MapError::SurrogateNormals { face: disc.source_face[face as usize] });
    }
    if let (true, Some(face)) = (spec.name() == "file", input.face_without_normal) {
        return Err(MapError::NoNormal { face });
    }
    // Normals are estimated before cutting, because faces along the cut lose their neighbours.
    let turned = oriented(&input.surface, diagnosis);
    let facets = match &turned {
        None => Facets::new(&input.surface, &diagnosis.topology.edges, input.digital.as_ref()),
        Some(turned) => {
            let edges = Edges::new(&turned.faces, turned.positions.len());
            Facets::new(turned, &edges, input.digital.as_ref())
        }
    }?;
    let estimated = spec.estimate(&facets)?;
    let of_face = |f: usize| match disc.source_face[f] {
        OrientedMesh::NEW => own_normal(disc, disc.faces.get(f)).unwrap_or_default(),
        source => estimated[source as usize],
    };
    let normals = (0..disc.faces.len()).map(of_face).collect();
    // Normals of a file, requested by `rho`, are used unchanged.
    let exactly = options.normals.is_none() && options.rho == RhoSource::Normals;
    Ok(Some(match exactly {
        true => TangentPlanes::exactly(normals, options.rest),
        false => TangentPlanes::guarded(disc, normals, options.rest),
    }))
}

/// Returns the surface with the faces flipped that need it; `None` if none does.
fn oriented(surface: &Surface, diagnosis: &Diagnosis) -> Option<Surface> {
    let flip = &diagnosis.topology.orientation.flip;
    if !flip.contains(&true) {
        return None;
    }
    let mut turned = surface.clone();
    for f in (0..flip.len()).filter(|&f| flip[f]) {
        turned.faces.flip(f);
        if let Some(normals) = &mut turned.face_normals {
            normals[f] = scale(-1.0, normals[f]);
        }
    }
    Some(turned)
}
