use super::lengths::{Prescribed, prescribe};
use super::{MapError, MapOptions, RhoSource};
use crate::geometry::vector::scale;
use crate::input::Input;
use crate::quad_graph::metric::RestMetric;
use crate::quad_graph::{QuadGraph, TangentPlanes, own_normal};
use crate::surface::Surface;
use crate::surface::edges::Edges;
use crate::surface::normals::{Facets, NormalError, NormalSpec};
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::diagnosis::Diagnosis;

/// A surface made ready to be mapped: in one piece, oriented, with a number ρ for every quad.
#[derive(Clone, Debug)]
pub struct Domain {
    /// The surface as it is mapped.
    pub disc: OrientedMesh,
    /// The tangent planes that ρ was measured on, where it was not on the faces' own.
    pub planes: Option<TangentPlanes>,
    /// Its quad graph.
    pub graph: QuadGraph,
    /// Where boundary lengths were asked for: the graph has them in the place of those at rest.
    pub prescribed: Option<Prescribed>,
}

impl Domain {
    /// The domain of a disc on which nothing is known but its positions.
    ///
    /// # Errors
    /// An unknown dual point; faces that give no ρ.
    pub fn of_positions(disc: OrientedMesh, options: &MapOptions) -> Result<Self, MapError> {
        Domain::with_planes(disc, None, options)
    }

    /// The domain of a disc, ρ of quads measured on `planes` where they are given.
    ///
    /// # Errors
    /// An unknown dual point; faces that give no ρ; boundary lengths that no map has.
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

    /// Its rest lengths and areas.
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
}

/// The tangent planes that ρ of the faces of `disc`, made of `input`, is to be measured on; `None` where the positions say
/// all.
///
/// # Errors
/// Normals of triangles; an estimator that fails, or that needs what the input has not.
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
    // Where the surface is cut it has no neighbours any more: estimated on the whole.
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
    // Those of a file, asked for by --rho, are taken at their word.
    let exactly = options.normals.is_none() && options.rho == RhoSource::Normals;
    Ok(Some(match exactly {
        true => TangentPlanes::exactly(normals, options.rest),
        false => TangentPlanes::guarded(disc, normals, options.rest),
    }))
}

/// The surface with the faces turned over that need it; `None` where none does.
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
