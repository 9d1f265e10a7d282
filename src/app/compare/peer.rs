//! Maps of other programs, put where a map of ours would be, so that the same code measures both.

pub use crate::geometry::moebius::{Moebius, MoebiusError};

use num_complex::Complex64;

use crate::app::compare::libigl::{Environment, LibiglError, harmonic, lscm, slim};
use crate::constraint::{Fixed, spread_points};
use crate::input::Input;
use crate::map::{Boundary, Domain, Map, MapError, MapOptions, Mapped, map_input};
use crate::solver::Observer;
use crate::surface::cut::Opening;

/// A function of another program.
pub struct Peer {
    /// As experiments name it.
    pub name: &'static str,
    /// One line.
    pub description: &'static str,
    /// Whether the boundary is held on the unit circle.
    pub on_circle: bool,
    given: Given,
    call: Call,
}

/// What is held, and where, to an answer.
type Call = fn(&Environment, &Request) -> Result<Answer, LibiglError>;

/// Of which vertices the peer is told a place: those of the circle by arc length.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Given {
    /// The boundary, which stays there.
    Boundary,
    /// The boundary, to start from.
    Start,
    /// Two, as far from each other along the boundary as can be, which stay there.
    TwoPoints,
}

struct Request<'a> {
    positions: &'a [[f64; 3]],
    triangles: &'a [[u32; 3]],
    held: &'a [u32],
    places: &'a [[f64; 2]],
}

struct Answer {
    uv: Vec<[f64; 2]>,
    seconds_cpu: f64,
}

/// As many as the authors of SLIM show to be enough.
const SLIM_ITERATIONS: usize = 20;

/// Every peer.
pub static PEERS: &[Peer] = &[
    Peer {
        name: "libigl-harmonic",
        description: "cotan Laplacian, boundary on the unit circle by arc length",
        on_circle: true,
        given: Given::Boundary,
        call: |libigl, r| {
            let map = harmonic(libigl, r.positions, r.triangles, r.held, r.places)?;
            Ok(Answer { uv: map.uv, seconds_cpu: map.seconds_cpu })
        },
    },
    Peer {
        name: "libigl-lscm",
        description: "least-squares conformal map, boundary free, two boundary vertices held",
        on_circle: false,
        given: Given::TwoPoints,
        call: |libigl, r| {
            let map = lscm(libigl, r.positions, r.triangles, r.held, r.places)?;
            Ok(Answer { uv: map.uv, seconds_cpu: map.seconds_cpu })
        },
    },
    Peer {
        name: "libigl-slim",
        description: "20 iterations of SLIM on the symmetric Dirichlet energy, boundary free, nothing held, from the harmonic map",
        on_circle: false,
        given: Given::Start,
        call: |libigl, r| {
            let map = slim(libigl, r.positions, r.triangles, r.held, r.places, SLIM_ITERATIONS)?;
            Ok(Answer { uv: map.uv, seconds_cpu: map.seconds_cpu })
        },
    },
];

/// The peer of that name.
pub fn peer(name: &str) -> Option<&'static Peer> {
    PEERS.iter().find(|peer| peer.name == name)
}

/// No map of a peer.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// Not a disc, or another fault of the surface.
    #[error(transparent)]
    Map(#[from] MapError),
    /// libigl's side failed.
    #[error(transparent)]
    Libigl(#[from] LibiglError),
    /// A quad mesh.
    #[error("libigl maps triangles; the faces have {corners} corners: triangulate them")]
    NotTriangles {
        /// Corners of each face.
        corners: usize,
    },
}

impl Peer {
    /// The peer's map of `input`, opened to a disc as `opening` says, measured, and its CPU seconds. Dual vertices, which it knows nothing of, are put at the
    /// barycentres of the image faces and the midpoints of the image's boundary edges.
    ///
    /// # Errors
    /// A surface that is no disc of triangles; a peer that fails.
    pub fn map(
        &self,
        input: &Input,
        opening: Opening,
        libigl: &Environment,
        watch: &mut dyn Observer,
    ) -> Result<(Mapped, f64), PeerError> {
        let corners = input.surface.faces.arity().unwrap_or(0);
        if corners != 3 {
            return Err(PeerError::NotTriangles { corners });
        }
        // Opens the surface and lays its boundary on the circle.
        let Opening { cut, remove_faces, fill_holes } = opening;
        let options = MapOptions { boundary: Boundary::FIXED, cut, remove_faces, fill_holes, ..MapOptions::default() };
        let mapped = map_input(input, &options, watch)?;
        let Domain { disc, graph, .. } = &mapped.domain;
        let held: Vec<u32> = match self.given {
            Given::Boundary | Given::Start => disc.boundary.clone(),
            // Both are vertices of the mesh.
            Given::TwoPoints => spread_points(graph, 2).into_iter().map(|k| graph.boundary[k]).collect(),
        };
        let places: Vec<[f64; 2]> = held.iter().map(|&v| mapped.map.z[v as usize]).map(|z| [z.re, z.im]).collect();
        let triangles: Vec<[u32; 3]> = disc.faces.iter().filter_map(|t| t.try_into().ok()).collect();
        let request = Request { positions: &disc.positions, triangles: &triangles, held: &held, places: &places };
        let Answer { uv, seconds_cpu } = (self.call)(libigl, &request)?;
        let mut fixed = Fixed::default();
        for (&v, &[x, y]) in held.iter().zip(&places).filter(|_| self.given != Given::Start) {
            fixed.hold(v, Complex64::new(x, y));
        }
        let z = uv.iter().map(|&[x, y]| Complex64::new(x, y)).collect();
        // What is held is vertices of the mesh: the boundary's dual vertices go to the edges of the image.
        let z = mapped.domain.with_dual_vertices(z, &fixed);
        let map = Map { on_circle: self.on_circle, ..Map::solved(self.name, z, fixed, None) };
        Ok((mapped.with(map), seconds_cpu))
    }
}
