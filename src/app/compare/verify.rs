//! The cotan equivalence, checked live: with circumcentres and the boundary of the mesh pinned,
//! system (2) puts the vertices of the mesh where libigl's harmonic map puts them.

use num_complex::Complex64;

use crate::app::compare::libigl::{Environment, Harmonic, LibiglError, harmonic};
use crate::geometry::maximum::max_or_nan;
use crate::map::{Boundary, Domain, Map, MapError, MapOptions};
use crate::solver::{Observer, Phase};
use crate::surface::Surface;
use crate::surface::oriented_mesh::{NotADisc, OrientedMesh};
use crate::surface::topology::diagnosis::Diagnosis;

/// Largest difference from libigl that passes, relative to the radius of the disc.
pub const TOLERANCE: f64 = 1e-9;

/// Generated surfaces of 500 to 100 000 vertices with many obtuse triangles; up to a third of the
/// weights are negative.
pub const SURFACES: [&str; 7] = [
    "graph:cos+cos?n=22&mesh=triangle",
    "graph:saddle?n=23&mesh=triangle&diagonal=same&jitter=0.1&amplitude=10",
    "sphere?n=64&mesh=delaunay&points=random&seed=3",
    "graph:cos+cos?n=71&mesh=triangle&diagonal=same&jitter=0.3&amplitude=10",
    "graph:saddle?n=142&mesh=triangle&diagonal=same&jitter=0.1&amplitude=10",
    "graph:cos+cos?n=142&mesh=delaunay&amplitude=10&seed=7",
    "graph:saddle?n=317&mesh=delaunay&amplitude=6&seed=7",
];

/// The comparison of two maps of one mesh.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of interior edges.
    pub interior_edges: usize,
    /// Number of interior edges with ½(cot α + cot β) < 0, as libigl counts them.
    pub negative_weights: usize,
    /// max |z − z'| over the vertices, relative to the radius of the disc.
    pub difference: f64,
    /// libigl's map and its times.
    pub libigl: Harmonic,
    /// Name of the solver of our map.
    pub backend: &'static str,
}

/// A comparison that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum VerifyError {
    /// The surface is not a disc.
    #[error(transparent)]
    NotADisc(#[from] NotADisc),
    /// The faces are not triangles.
    #[error("the equivalence is about triangle meshes; the faces have {corners} corners: triangulate them")]
    NotTriangles {
        /// Number of corners of each face.
        corners: usize,
    },
    /// Our map failed.
    #[error(transparent)]
    Map(#[from] MapError),
    /// libigl failed.
    #[error(transparent)]
    Libigl(#[from] LibiglError),
}

/// A map of a triangle mesh to the disc by system (2) with circumcentres, with the boundary pinned
/// on the unit circle by arc length.
#[derive(Clone, Debug)]
pub struct CotanMap {
    /// The mesh.
    pub disc: OrientedMesh,
    /// The map, which begins with the vertices of the mesh.
    pub map: Map,
}

/// Returns our map.
///
/// # Errors
/// The surface is not a disc of triangles, or the solver fails.
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

/// Computes libigl's map with the same boundary, and returns the difference.
///
/// # Errors
/// Those of libigl.
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
    /// Whether the maps agree to [`TOLERANCE`].
    pub fn is_equal(&self) -> bool {
        self.difference <= TOLERANCE
    }
}
