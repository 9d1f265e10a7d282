//! Pinned vertices, and the elimination x = Z y + x0 that leaves solvers only the free unknowns y.

mod boundary;
mod elimination;
mod freedoms;
mod gauge;

pub use boundary::{Shape, on_circle, on_circle_apart, on_shape};
pub use elimination::Elimination;
pub use freedoms::Freedoms;
pub use gauge::{float_white_back, hold_gauge, spread_points, turn_back};

use std::collections::BTreeMap;

use num_complex::Complex64;

use crate::quad_graph::QuadGraph;
use crate::surface::oriented_mesh::OrientedMesh;

/// Vertices of the quad graph that are pinned at given positions or to given lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fixed {
    places: BTreeMap<u32, Complex64>,
    lines: BTreeMap<u32, Line>,
}

/// A condition that pins vertices, supplied by the user of the library in
/// [`MapOptions::constraints`](crate::map::MapOptions::constraints).
pub trait Constraint: Send + Sync {
    /// Pins vertices of the quad graph at positions ([`Fixed::hold`]) or to lines ([`Fixed::hold_on_line`]).
    ///
    /// The vertices of the graph begin with those of `mesh`; [`OrientedMesh::copies`] finds the vertices
    /// of the source among them.
    ///
    /// # Errors
    /// The condition has no meaning on this surface.
    fn hold(&self, mesh: &OrientedMesh, graph: &QuadGraph, fixed: &mut Fixed) -> Result<(), ConstraintError>;
}

/// The line `point + t direction`, t real.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point of the line.
    pub point: Complex64,
    /// The direction, of length 1.
    pub direction: Complex64,
}

/// Largest distance of a pinned vertex from 0, such that sums of squares, multiplied by any ρ in
/// use, are finite.
const FARTHEST: f64 = 1e100;

/// The constraints do not make a well-posed problem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConstraintError {
    /// A pinned vertex does not belong to the mapped surface.
    #[error("vertex {vertex} cannot be held: the surface has no such vertex in use (vertices count from 0)")]
    NoSuchVertex {
        /// The requested vertex.
        vertex: u32,
    },
    /// A position is NaN or infinite.
    #[error("vertex {vertex} cannot be held at a place that is NaN or infinite")]
    NotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// A position is so far from 0 that its square could overflow.
    #[error("vertex {vertex} cannot be held at {}, {}: that is farther than {FARTHEST:e} from 0", place.re, place.im)]
    TooFar {
        /// The vertex.
        vertex: u32,
        /// The position.
        place: Complex64,
    },
    /// The boundary has too few mesh vertices for the corners of the shape.
    #[error("the boundary has {vertices} mesh vertices, and the shape needs {needed}")]
    TooFewBoundaryVertices {
        /// Number of mesh vertices on the boundary.
        vertices: usize,
        /// Number of corners of the shape.
        needed: usize,
    },
    /// Two boundary vertices coincide at rest, so arc length gives them the same position.
    #[error("the boundary has no length between vertices {0} and {1}, so arc length gives both the same position")]
    NoArcLength(u32, u32),
    /// There are fewer equations than unknowns.
    #[error(
        "H leaves {freedoms} complex freedoms with {held} vertices held: hold at least {needed} (the whole boundary, or \
         its mesh vertices and one dual vertex)"
    )]
    Underdetermined {
        /// Number of pinned vertices.
        held: usize,
        /// Number of vertices that must be pinned at least, nb / 2 + 1.
        needed: usize,
        /// The difference of the two.
        freedoms: usize,
    },
    /// No vertex of a diagonal class (black or white) is pinned, so the class can be translated
    /// freely.
    #[error(
        "no vertex of the diagonal class of vertex {vertex} is held, and H lets the class move freely: hold one of it"
    )]
    Afloat {
        /// The first vertex of the class.
        vertex: u32,
    },
}

impl Fixed {
    /// Pins `vertex` at `place`; replaces an earlier position.
    pub fn hold(&mut self, vertex: u32, place: Complex64) {
        self.places.insert(vertex, place);
    }

    /// Pins the dual boundary vertices between pinned mesh vertices, on the straight line between
    /// these in the ratio of the rest lengths.
    pub fn hold_dual_boundary(&mut self, graph: &QuadGraph) {
        let n = graph.boundary.len();
        for k in (0..n).filter(|&k| graph.is_dual(graph.boundary[k])) {
            let (before, after) = (graph.boundary[(k + n - 1) % n], graph.boundary[(k + 1) % n]);
            let (l, m) = (graph.boundary_length[(k + n - 1) % n], graph.boundary_length[k]);
            if let (Some(a), Some(b)) = (self.place(before), self.place(after)) {
                self.hold(graph.boundary[k], (a * m + b * l) / (l + m));
            }
        }
    }

    /// Releases all dual vertices but the first one along the boundary, so that (2) is square on
    /// triangle meshes.
    pub fn keep_one_dual(&mut self, graph: &QuadGraph) {
        let mut dual = graph.boundary.iter().filter(|&&v| graph.is_dual(v) && self.holds(v));
        let first = dual.next().copied();
        self.places.retain(|&v, _| !graph.is_dual(v) || Some(v) == first);
    }

    /// Restricts `vertex` to the line through `point` and `through`.
    pub fn hold_on_line(&mut self, vertex: u32, point: Complex64, through: Complex64) {
        let direction = (through - point) / (through - point).norm();
        self.lines.insert(vertex, Line { point, direction });
    }

    /// The line to which `vertex` is restricted, if any.
    pub fn line(&self, vertex: u32) -> Option<Line> {
        self.lines.get(&vertex).copied()
    }

    /// Whether `vertex` is pinned at a position.
    pub fn holds(&self, vertex: u32) -> bool {
        self.places.contains_key(&vertex)
    }

    /// The position at which `vertex` is pinned, if any.
    pub fn place(&self, vertex: u32) -> Option<Complex64> {
        self.places.get(&vertex).copied()
    }

    /// Number of vertices pinned at positions.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether no vertex is pinned at a position.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The pinned vertices with their positions, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, Complex64)> + '_ {
        self.places.iter().map(|(&v, &z)| (v, z))
    }

    /// Checks that H has a unique minimum under these constraints: at least `nb / 2 + 1` complex
    /// values and one vertex of each diagonal class must be pinned.
    ///
    /// # Errors
    /// [`ConstraintError`] if a condition is violated or a pinned vertex is invalid.
    pub fn determine(&self, graph: &QuadGraph) -> Result<(), ConstraintError> {
        for (vertex, place) in self.iter() {
            if vertex as usize >= graph.vertices {
                return Err(ConstraintError::NoSuchVertex { vertex });
            }
            if !place.is_finite() {
                return Err(ConstraintError::NotFinite { vertex });
            }
            if place.norm() > FARTHEST {
                return Err(ConstraintError::TooFar { vertex, place });
            }
        }
        let (held, needed) = (self.len(), graph.boundary.len() / 2 + 1);
        if held < needed {
            return Err(ConstraintError::Underdetermined { held, needed, freedoms: needed - held });
        }
        let (class, classes) = graph.diagonal_classes();
        let mut anchored = vec![false; classes];
        for (v, _) in self.iter() {
            anchored[class[v as usize] as usize] = true;
        }
        match class.iter().position(|&k| !anchored[k as usize]) {
            Some(vertex) => Err(ConstraintError::Afloat { vertex: vertex as u32 }),
            None => Ok(()),
        }
    }
}
