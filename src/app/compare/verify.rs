//! The cotan equivalence, checked live: with circumcentres and the mesh's boundary held, the vertices of the mesh are
//! where libigl's harmonic map puts them.

use num_complex::Complex64;

use crate::app::compare::libigl::{Environment, Harmonic, LibiglError, harmonic};
use crate::geometry::maximum::max_or_nan;
use crate::map::{Boundary, Domain, Map, MapError, MapOptions};
use crate::solver::{Observer, Phase};
use crate::surface::Surface;
use crate::surface::oriented_mesh::{NotADisc, OrientedMesh};
use crate::surface::topology::diagnosis::Diagnosis;

/// The largest difference to libigl, relative to the radius of the disc, that passes.
pub const TOLERANCE: f64 = 1e-9;

/// Generated surfaces with many obtuse triangles, 500 to 100 000 vertices; up to a third of the weights negative.
pub const SURFACES: [&str; 7] = [
    "graph:cos+cos?n=22&mesh=triangle",
    "graph:saddle?n=23&mesh=triangle&diagonal=same&jitter=0.1&amplitude=10",
    "sphere?n=64&mesh=delaunay&points=random&seed=3",
    "graph:cos+cos?n=71&mesh=triangle&diagonal=same&jitter=0.3&amplitude=10",
    "graph:saddle?n=142&mesh=triangle&diagonal=same&jitter=0.1&amplitude=10",
    "graph:cos+cos?n=142&mesh=delaunay&amplitude=10&seed=7",
    "graph:saddle?n=317&mesh=delaunay&amplitude=6&seed=7",
];

/// Two maps of one mesh, compared.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Its inner edges.
    pub interior_edges: usize,
    /// Inner edges with ½(cot α + cot β) < 0, as libigl counts them.
    pub negative_weights: usize,
    /// max |z − z'| over the vertices, relative to the radius of the disc.
    pub difference: f64,
    /// What libigl said.
    pub libigl: Harmonic,
    /// The backend that made our map.
    pub backend: &'static str,
}

/// No comparison.
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// Not a disc.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// A quad mesh.
    #[error("the equivalence is about triangle meshes; the faces have {corners} corners: triangulate them")]
    NotTriangles {
        /// Corners of each face.
        corners: usize,
    },
    /// Our side failed.
    #[error(transparent)]
    Map(#[from] MapError),
    /// libigl's side failed.
    #[error(transparent)]
    Libigl(#[from] LibiglError),
}

/// A triangle mesh mapped to the disc by system (2) with circumcentres, boundary on the unit circle by arc length.
#[derive(Clone, Debug)]
pub struct CotanMap {
    /// The mesh.
    pub disc: OrientedMesh,
    /// Its map; the vertices of the mesh come first.
    pub map: Map,
}

/// Our side.
///
/// # Errors
/// A surface that is not a disc of triangles; a solver that fails.
pub fn cotan_map(surface: &Surface, watch: &mut dyn Observer) -> Result<CotanMap, VerifyError> {
    watch.phase(Phase::Assemble);
    let disc = OrientedMesh::new(surface, &Diagnosis::new(surface))?;
    if disc.faces.arity() != Some(3) {
        return Err(VerifyError::NotTriangles { corners: disc.faces.arity().unwrap_or(0) });
    }
    let options = MapOptions { boundary: Boundary::FIXED, dual: "circumcentre".to_owned(), ..MapOptions::default() };
    let Domain { disc, graph, .. } = Domain::of_positions(disc, &options)?;
    let map = options.solve(&graph, options.fixed(&disc, &graph)?, watch)?;
    Ok(CotanMap { disc, map })
}

/// libigl's side, with the boundary where ours has it, and the difference.
///
/// # Errors
/// libigl's.
pub fn compare(ours: &CotanMap, libigl: &Environment) -> Result<Comparison, VerifyError> {
    let CotanMap { disc, map } = ours;
    let values: Vec<[f64; 2]> = disc.boundary.iter().map(|&v| [map.z[v as usize].re, map.z[v as usize].im]).collect();
    let triangles: Vec<[u32; 3]> = disc.faces.iter().filter_map(|t| t.try_into().ok()).collect();
    let theirs = harmonic(libigl, &disc.positions, &triangles, &disc.boundary, &values)?;
    let distance = |(z, w): (&Complex64, &[f64; 2])| (z - Complex64::new(w[0], w[1])).norm();
    Ok(Comparison {
        vertices: disc.positions.len(),
        interior_edges: theirs.interior_edges,
        negative_weights: theirs.negative_weights,
        difference: map.z.iter().zip(&theirs.uv).map(distance).fold(0.0, max_or_nan),
        libigl: theirs,
        backend: map.provenance.solver,
    })
}

impl Comparison {
    /// Whether both maps are the same to [`TOLERANCE`].
    pub fn is_equal(&self) -> bool {
        self.difference <= TOLERANCE
    }
}
