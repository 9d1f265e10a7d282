use num_complex::Complex64;
use serde::Deserialize;

use super::MapError;
use crate::backend::StopRule;
use crate::constraint::{Fixed, Shape, on_shape};
use crate::energy::Expression;
use crate::energy::conformal::Weight;
use crate::quad_graph::dual::{BoundaryDual, DUAL_POINTS, DualPoint, dual_point};
use crate::quad_graph::metric::RestMetric;
use crate::quad_graph::{QuadGraph, QuadGraphError, RhoSource};
use crate::surface::disc::Disc;

/// A vertex of the source held at a place.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// Vertex index in the source, from 0.
    pub vertex: u32,
    /// Its place in the plane.
    pub place: [f64; 2],
}

/// What the boundary does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Boundary {
    /// It is drawn to the unit circle: H + C, unless an energy is given.
    #[default]
    Circle,
    /// It keeps its lengths: H + L', unless an energy is given.
    Free,
    /// It is held on a shape: H, unless an energy is given.
    Fixed,
}

/// Which boundary vertices of the quad graph a fixed boundary holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hold {
    /// All of them: H is minimised in least squares.
    Whole,
    /// Those of the mesh, and one dual vertex: (2) is square and solved exactly. The same as `whole` on quad meshes.
    Primal,
}

/// What is asked of a map; the `[map]` table of an experiment.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
pub struct MapOptions {
    /// What the boundary does.
    pub boundary: Boundary,
    /// The energy, in place of the one that `boundary` stands for.
    pub energy: Option<Expression>,
    /// What a fixed boundary is laid on.
    pub shape: Shape,
    /// Places of boundary vertices, in place of `shape`.
    pub positions: Option<Vec<Pin>>,
    /// Vertices held beside a fixed boundary, or elsewhere than it says; in place of `fix` for the circle; in place of
    /// the gauge for metric energies.
    pub pins: Vec<Pin>,
    /// Which boundary vertices are held by a fixed boundary; by default `whole`, with circumcentres `primal`.
    pub hold: Option<Hold>,
    /// How many boundary points a circle map holds: 3, or 2 as in the paper.
    pub fix: usize,
    /// Circle maps: whether the boundary is kept in order.
    pub keep_order: bool,
    /// Weights of the energies.
    pub weight: Weight,
    /// Dual point of triangle meshes.
    pub dual: String,
    /// Dual vertex of boundary edges.
    pub boundary_dual: BoundaryDual,
    /// What ρ of quad meshes comes from.
    pub rho: RhoSource,
    /// Name of the backend, or `auto`.
    pub solver: String,
    /// Nonlinear maps have converged when |∇E| is at most this times its value at the start.
    pub tolerance: f64,
    /// Iterations at most; by default the backend's own number.
    pub max_iterations: Option<usize>,
}

impl Default for MapOptions {
    fn default() -> Self {
        MapOptions {
            boundary: Boundary::default(),
            energy: None,
            shape: Shape::default(),
            positions: None,
            pins: Vec::new(),
            hold: None,
            fix: 3,
            keep_order: false,
            weight: Weight::default(),
            dual: "barycentre".to_owned(),
            boundary_dual: BoundaryDual::default(),
            rho: RhoSource::default(),
            solver: "auto".to_owned(),
            tolerance: StopRule::default().tolerance,
            max_iterations: None,
        }
    }
}

impl MapOptions {
    /// The energy that is minimised.
    pub fn expression(&self) -> Expression {
        self.energy.clone().unwrap_or_else(|| match self.boundary {
            Boundary::Circle => Expression::of(&["H", "C"]),
            Boundary::Free => Expression::of(&["H", "Lb"]),
            Boundary::Fixed => Expression::of(&["H"]),
        })
    }

    fn dual_point(&self) -> Result<&'static dyn DualPoint, MapError> {
        dual_point(&self.dual).ok_or_else(|| MapError::UnknownDual {
            name: self.dual.clone(),
            known: DUAL_POINTS.iter().map(|d| d.name()).collect::<Vec<_>>().join(", "),
        })
    }

    /// The quad graph of `disc`.
    ///
    /// # Errors
    /// An unknown dual point; faces that give no ρ.
    pub fn quad_graph(&self, disc: &Disc) -> Result<QuadGraph, MapError> {
        let dual = self.dual_point()?;
        Ok(match (disc.faces.arity(), self.rho) {
            (Some(3), RhoSource::Normals) => return Err(QuadGraphError::NormalsOfTriangles.into()),
            (Some(3), RhoSource::Positions) => QuadGraph::from_triangles(disc, dual, self.boundary_dual)?,
            _ => QuadGraph::from_quads(disc, self.rho)?,
        })
    }

    /// The rest lengths and areas of `graph`, which is that of `disc`.
    ///
    /// # Errors
    /// An unknown dual point; degenerate faces.
    pub fn rest_metric(&self, disc: &Disc, graph: &QuadGraph) -> Result<RestMetric, MapError> {
        Ok(match disc.faces.arity() {
            Some(3) => RestMetric::of_triangles(disc, graph, self.dual_point()?)?,
            _ => RestMetric::of_quads(disc, graph),
        })
    }

    /// The vertices of `graph` that a fixed boundary and the pins hold, and where.
    ///
    /// # Errors
    /// Vertices that are not in use; a shape that the boundary is too short for.
    pub fn fixed(&self, disc: &Disc, graph: &QuadGraph) -> Result<Fixed, MapError> {
        let mut whole = match &self.positions {
            None => on_shape(graph, self.shape)?,
            Some(positions) => {
                let mut given = Fixed::default();
                hold_pins(&mut given, disc, positions)?;
                given.hold_dual_boundary(graph);
                given
            }
        };
        let orthogonal = graph.primal < graph.vertices && graph.is_orthogonal();
        let default = if orthogonal { Hold::Primal } else { Hold::Whole };
        if self.hold.unwrap_or(default) == Hold::Primal {
            whole.keep_one_dual(graph);
        }
        hold_pins(&mut whole, disc, &self.pins)?;
        Ok(whole)
    }
}

/// Holds vertices of the source at their places.
pub(super) fn hold_pins(fixed: &mut Fixed, disc: &Disc, pins: &[Pin]) -> Result<(), MapError> {
    for pin in pins {
        // Vertices of the disc keep the order of the source.
        let vertex = disc.source_vertex.binary_search(&pin.vertex);
        let vertex = vertex.map_err(|_| MapError::NotInUse { vertex: pin.vertex })?;
        fixed.hold(vertex as u32, Complex64::new(pin.place[0], pin.place[1]));
    }
    Ok(())
}
