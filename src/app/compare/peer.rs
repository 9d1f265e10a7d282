//! Maps of other programs in the form of our own, so that the same code measures both.

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
    /// Its name in experiments.
    pub name: &'static str,
    /// Its description, in one line.
    pub description: &'static str,
    /// Whether the boundary is pinned on the unit circle.
    pub on_circle: bool,
    given: Given,
    call: Call,
}

/// A call: from the pinned vertices and their places to the answer.
type Call = fn(&Environment, &Request) -> Result<Answer, LibiglError>;

/// Vertices that are given to a peer with their places on the circle by arc length.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Given {
    /// The boundary, which is pinned.
    Boundary,
    /// The boundary, from which the peer starts.
    Start,
    /// Two pinned vertices, as far from each other along the boundary as possible.
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

/// Number of iterations that the authors of SLIM show to be enough.
const SLIM_ITERATIONS: usize = 20;

/// All peers.
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

/// Returns the peer of that name.
pub fn peer(name: &str) -> Option<&'static Peer> {
    PEERS.iter().find(|peer| peer.name == name)
}

/// A peer's map that could not be made.
#[derive(Debug, thiserror::Error)]
pub enum PeerError {
    /// The surface is not a disc, or has another defect.
    #[error(transparent)]
    Map(#[from] MapError),
    /// libigl failed.
    #[error(transparent)]
    Libigl(#[from] LibiglError),
    /// The faces are not triangles.
    #[error("libigl maps triangles; the faces have {corners} corners: triangulate them")]
    NotTriangles {
        /// Number of corners of each face.
        corners: usize,
    },
}

impl Peer {
    /// Returns the peer's map of `input`, opened to a disc by `opening`, with its distortion and
    /// its processor seconds. Dual vertices, which the peer does not have, are placed at the
    /// barycentres of the faces and the midpoints of the boundary edges of the image.
    ///
    /// # Errors
    /// The surface is not a disc of triangles, or the peer fails.
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
        // What is held is vertices of the mesh: the boundary's dual vertices go to the edges of the
        // image.
        let z = mapped.domain.with_dual_vertices(z, &fixed);
        let map = Map { on_circle: self.on_circle, ..Map::solved(self.name, z, fixed, None) };
        Ok((mapped.with(map), seconds_cpu))
    }
}
