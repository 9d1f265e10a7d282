//! Which vertices are held where, and the elimination x = Z y + x0 that leaves backends the free unknowns y alone.

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

/// Vertices of the quad graph held at given places, or on given lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Fixed {
    places: BTreeMap<u32, Complex64>,
    lines: BTreeMap<u32, Line>,
}

/// `point + t direction`, t real.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    /// A point of the line.
    pub point: Complex64,
    /// Of length 1.
    pub direction: Complex64,
}

/// Largest distance of a held vertex from 0: sums of squares of such places, times any ρ in use, are still finite.
const FARTHEST: f64 = 1e100;

/// The constraints do not make a well-posed problem.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ConstraintError {
    /// A held vertex that is no vertex of the mapped surface.
    #[error("vertex {vertex} cannot be held: the surface has no such vertex in use (vertices count from 0)")]
    NoSuchVertex {
        /// The vertex asked for.
        vertex: u32,
    },
    /// A place that is NaN or infinite.
    #[error("vertex {vertex} cannot be held at a place that is NaN or infinite")]
    NotFinite {
        /// The vertex.
        vertex: u32,
    },
    /// A place whose square leaves the range of doubles.
    #[error("vertex {vertex} cannot be held at {}, {}: that is farther than {FARTHEST:e} from 0", place.re, place.im)]
    TooFar {
        /// The vertex.
        vertex: u32,
        /// The place.
        place: Complex64,
    },
    /// Too few boundary edges for a shape's corners.
    #[error("the boundary has {vertices} mesh vertices, and the shape needs {needed}")]
    TooFewBoundaryVertices {
        /// Mesh vertices on the boundary.
        vertices: usize,
        /// Corners of the shape.
        needed: usize,
    },
    /// Two boundary vertices that are held coincide at rest, so arc length does not tell them apart.
    #[error("the boundary has no length between vertices {0} and {1}, and arc length does not tell them apart")]
    NoArcLength(u32, u32),
    /// Fewer equations than unknowns.
    #[error(
        "H leaves {freedoms} complex freedoms with {held} vertices held: hold at least {needed} (the whole boundary, or \
         its mesh vertices and one dual vertex)"
    )]
    Underdetermined {
        /// Vertices held.
        held: usize,
        /// Vertices that must be held at least, nb / 2 + 1.
        needed: usize,
        /// The difference.
        freedoms: usize,
    },
    /// A class of vertices (design: black or white) of which none is held can be translated freely.
    #[error(
        "no vertex of the diagonal class of vertex {vertex} is held, and H lets the class move freely: hold one of it"
    )]
    Afloat {
        /// The first vertex of the class.
        vertex: u32,
    },
}

impl Fixed {
    /// Holds `vertex` at `place`, in place of what was said of it before.
    pub fn hold(&mut self, vertex: u32, place: Complex64) {
        self.places.insert(vertex, place);
    }

    /// Holds the dual boundary vertices between mesh vertices that are held, on the straight line between these, in the
    /// ratio of the rest lengths.
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

    /// Lets go of all dual vertices but the first one along the boundary, so that (2) is square on a triangle mesh.
    pub fn keep_one_dual(&mut self, graph: &QuadGraph) {
        let mut dual = graph.boundary.iter().filter(|&&v| graph.is_dual(v) && self.holds(v));
        let first = dual.next().copied();
        self.places.retain(|&v, _| !graph.is_dual(v) || Some(v) == first);
    }

    /// Lets `vertex` move on the line from `point` towards `through` alone.
    pub fn hold_on_line(&mut self, vertex: u32, point: Complex64, through: Complex64) {
        let direction = (through - point) / (through - point).norm();
        self.lines.insert(vertex, Line { point, direction });
    }

    /// The line on which `vertex` is held.
    pub fn line(&self, vertex: u32) -> Option<Line> {
        self.lines.get(&vertex).copied()
    }

    /// Whether `vertex` is held.
    pub fn holds(&self, vertex: u32) -> bool {
        self.places.contains_key(&vertex)
    }

    /// Where `vertex` is held.
    pub fn place(&self, vertex: u32) -> Option<Complex64> {
        self.places.get(&vertex).copied()
    }

    /// Number of vertices held.
    pub fn len(&self) -> usize {
        self.places.len()
    }

    /// Whether no vertex is held.
    pub fn is_empty(&self) -> bool {
        self.places.is_empty()
    }

    /// The vertices held with their places, in ascending order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, Complex64)> + '_ {
        self.places.iter().map(|(&v, &z)| (v, z))
    }

    /// Checks that H has one minimum under these constraints: `nb / 2 + 1` complex values at least, and one vertex of
    /// each diagonal class.
    ///
    /// # Errors
    /// What is missing, or a vertex that does not exist.
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
