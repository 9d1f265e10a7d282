//! What is asked of a map.

mod boundary;
mod flat;
mod own;

pub use boundary::{Boundary, BoundaryName, Hold, Interior, Outline, PinnedPoints};
pub use flat::{FlatOptions, OptionsError, ValidName};
pub use own::{Own, SolverChoice};

use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::MapError;
use crate::constraint::{Constraint, ConstraintError, Fixed, Shape, on_shape};
use crate::energy::conformal::Weight;
use crate::energy::{Expression, Standard};
use crate::io::BoundaryLengths;
use crate::quad_graph::dual::{BoundaryDual, DUAL_POINTS, DualPoint, dual_point};
use crate::quad_graph::{QuadGraph, RestSource};
use crate::solver::StopRule;
use crate::surface::Surrogates;
use crate::surface::cut::Opening;
use crate::surface::normals::NormalSpec;
use crate::surface::oriented_mesh::OrientedMesh;
use crate::surface::topology::diagnosis::Diagnosis;

/// A vertex of the source held at a place.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// Vertex index in the source, from 0.
    pub vertex: u32,
    /// Its place in the plane.
    pub place: [f64; 2],
}

/// What the ρ of a quad mesh is computed from, where no estimator of normals is named.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RhoSource {
    /// The diagonals in R³, equation (1).
    Positions,
    /// The diagonals projected on the plane of each face's normal, as the file gives it.
    Normals,
    /// Positions for meshes, estimated normals for digital surfaces.
    #[default]
    Auto,
}

/// The map that a minimisation begins with.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// With lengths or areas in the energy and no circle: the free map, where it is found; else as `circle`.
    #[default]
    Auto,
    /// The paper's (§3.3): the boundary on a circle by arc length, the interior from H.
    Circle,
}

/// Which map replaces a conformal one that is not injective. It is replaced for circle and free maps by the energy of their boundary and
/// without pins, and for convex combination maps where rounding has flipped a face. All others are checked, and kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Valid {
    /// The same map with its flipped faces unflipped in place where that is possible; else a bijective map of low quasi-conformal
    /// distortion: the lowest MIPS with all faces counting alike, with a free boundary MIPS + γ'L'.
    #[default]
    Auto,
    /// That bijective map. It also replaces an injective conformal map of higher mean σ1/σ2: on coarse and obtuse meshes. On fine ones
    /// the conformal map is nearer to the exact one.
    BestQc,
    /// None.
    Off,
}

/// The request: how the surface becomes a disc, what its boundary does, the energy, and how it is minimised. [`FlatOptions`] reads the
/// same from flat keys.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "FlatOptions")]
pub struct MapOptions {
    /// Whether a surface that is no disc is cut open along a short graph.
    pub cut: bool,
    /// Whether the holes of the surface are filled for the solve: all but the longest, for periodic maps all.
    pub fill_holes: bool,
    /// Faces of the source that are left out.
    pub remove_faces: Vec<u32>,
    /// The height over length of the shapes that faces without area are given; none: they are refused. See [`Surrogates`].
    pub surrogate: Option<f64>,
    /// What the boundary does.
    pub boundary: Boundary,
    /// The energy, instead of the one that `boundary` stands for.
    pub energy: Option<Expression>,
    /// Vertices pinned beside a fixed boundary, or elsewhere than it says; for circle maps instead of the two or three points; for metric
    /// energies instead of the gauge.
    pub pins: Vec<Pin>,
    /// Constraints of one's own; they hold vertices as `pins` do.
    pub constraints: Vec<Own<dyn Constraint>>,
    /// Which map replaces a conformal one that is not injective.
    pub valid: Valid,
    /// The map that a minimisation starts from.
    pub start: Start,
    /// Weights of the energies.
    pub weight: Weight,
    /// Dual point of triangle meshes.
    pub dual: String,
    /// Dual vertex of boundary edges.
    pub boundary_dual: BoundaryDual,
    /// What ρ of quad meshes is computed from.
    pub rho: RhoSource,
    /// The estimator of normals from which ρ of quad meshes and digital surfaces is computed, instead of `rho`.
    pub normals: Option<NormalSpec>,
    /// With normals: which lengths and areas are those at rest.
    pub rest: RestSource,
    /// The solver.
    pub solver: SolverChoice,
    /// Nonlinear maps have converged when |∇E| is at most this times its value at the start.
    pub tolerance: f64,
    /// Largest number of iterations; by default the solver's own.
    pub max_iterations: Option<usize>,
}

impl Default for MapOptions {
    fn default() -> Self {
        MapOptions {
            cut: false,
            fill_holes: false,
            remove_faces: Vec::new(),
            surrogate: None,
            boundary: Boundary::default(),
            energy: None,
            pins: Vec::new(),
            constraints: Vec::new(),
            valid: Valid::default(),
            start: Start::default(),
            weight: Weight::default(),
            dual: "barycentre".to_owned(),
            boundary_dual: BoundaryDual::default(),
            rho: RhoSource::default(),
            normals: None,
            rest: RestSource::default(),
            solver: SolverChoice::Auto,
            tolerance: StopRule::default().tolerance,
            max_iterations: None,
        }
    }
}

impl MapOptions {
    /// How the surface becomes a disc.
    pub fn opening(&self) -> Opening {
        Opening { cut: self.cut, remove_faces: self.remove_faces.clone(), fill_holes: self.fill_holes }
    }

    /// What stands against a surface when faces without area are given a shape as asked.
    ///
    /// # Errors
    /// A height that is none.
    pub(super) fn forgiving(&self, diagnosis: Diagnosis) -> Result<Diagnosis, MapError> {
        match self.surrogate {
            None => Ok(diagnosis),
            Some(height) if height > 0.0 && height <= 1.0 => Ok(diagnosis.with_surrogates(height)),
            Some(height) => Err(MapError::SurrogateHeight { height }),
        }
    }

    /// Gives the faces of a disc that have no area a shape, where that is asked for.
    pub(super) fn shape_flat_faces(&self, disc: &mut OrientedMesh) {
        if let Some(height) = self.surrogate {
            disc.surrogates = Surrogates::new(&disc.positions, &disc.faces, height);
        }
    }

    /// The energy that is minimised.
    pub fn expression(&self) -> Expression {
        self.energy.clone().unwrap_or_else(|| match self.boundary {
            Boundary::Circle { .. } => Expression::standard(Standard::OnCircle),
            Boundary::Free { .. } => Expression::standard(Standard::OfLengths),
            Boundary::Fixed { .. } | Boundary::Periodic => Expression::standard(Standard::Conformal),
        })
    }

    pub(super) fn dual_point(&self) -> Result<&'static dyn DualPoint, MapError> {
        dual_point(&self.dual).ok_or_else(|| MapError::UnknownDual {
            name: self.dual.clone(),
            known: DUAL_POINTS.iter().map(|d| d.name()).collect::<Vec<_>>().join(", "),
        })
    }

    /// Whether a conformal map that is not injective is replaced.
    pub fn promises_valid(&self) -> bool {
        self.valid != Valid::Off
            && self.energy.is_none()
            && !self.holds_more()
            && matches!(self.boundary, Boundary::Circle { .. } | Boundary::Free { lengths: None, .. })
    }

    /// Number of boundary points that a circle map pins.
    pub fn pinned_points(&self) -> PinnedPoints {
        match self.boundary {
            Boundary::Circle { pinned, .. } => pinned,
            _ => PinnedPoints::default(),
        }
    }

    /// Whether the boundary points of a circle map are kept in order.
    pub fn is_ordered(&self) -> bool {
        matches!(self.boundary, Boundary::Circle { ordered: true, .. })
    }

    /// The lengths that the boundary edges of a free map are to have.
    pub fn boundary_lengths(&self) -> Option<&BoundaryLengths> {
        match &self.boundary {
            Boundary::Free { lengths, .. } => lengths.as_ref(),
            _ => None,
        }
    }

    /// The weights by which inner vertices are means of their neighbours.
    pub fn weights(&self) -> Option<&str> {
        match &self.boundary {
            Boundary::Fixed { interior: Interior::Weights(name), .. } => Some(name),
            _ => None,
        }
    }

    /// Whether a fixed boundary is on the unit circle.
    pub(super) fn is_fixed_on_circle(&self) -> bool {
        matches!(self.boundary, Boundary::Fixed { on: Outline::Shape(Shape::Circle), .. })
    }

    /// Whether vertices are held by pins or by constraints of one's own.
    pub fn holds_more(&self) -> bool {
        !self.pins.is_empty() || !self.constraints.is_empty()
    }

    /// Holds the vertices of the pins and of the constraints of one's own.
    ///
    /// # Errors
    /// A pinned vertex that no face uses, or that lies on the cut; whatever a constraint says.
    pub(super) fn hold(&self, fixed: &mut Fixed, disc: &OrientedMesh, graph: &QuadGraph) -> Result<(), MapError> {
        hold_pins(fixed, disc, &self.pins)?;
        for constraint in &self.constraints {
            constraint.hold(disc, graph, fixed)?;
            if let Some((vertex, _)) = fixed.iter().find(|&(v, _)| v as usize >= graph.vertices) {
                return Err(ConstraintError::NoSuchVertex { vertex }.into());
            }
        }
        Ok(())
    }

    /// The vertices of `graph` that a fixed boundary and the pins hold, and where. Another boundary is taken for one that is fixed on the
    /// unit circle.
    ///
    /// # Errors
    /// Vertices that are not in use; a shape that the boundary is too short for.
    pub fn fixed(&self, disc: &OrientedMesh, graph: &QuadGraph) -> Result<Fixed, MapError> {
        let (on, hold) = match &self.boundary {
            Boundary::Fixed { on, hold, .. } => (on, *hold),
            _ => (&Outline::Shape(Shape::Circle), None),
        };
        let mut whole = match on {
            Outline::Shape(shape) => on_shape(graph, *shape)?,
            Outline::Places(places) => {
                let mut given = Fixed::default();
                hold_pins(&mut given, disc, places)?;
                given.hold_dual_boundary(graph);
                given
            }
        };
        let orthogonal = graph.primal < graph.vertices && graph.is_orthogonal();
        let default = if orthogonal { Hold::Primal } else { Hold::Whole };
        if hold.unwrap_or(default) == Hold::Primal {
            whole.keep_one_dual(graph);
        }
        self.hold(&mut whole, disc, graph)?;
        Ok(whole)
    }
}

/// Holds vertices of the source at their places.
fn hold_pins(fixed: &mut Fixed, disc: &OrientedMesh, pins: &[Pin]) -> Result<(), MapError> {
    for pin in pins {
        let copies = disc.copies(pin.vertex);
        let vertex = match copies.len() {
            0 => return Err(MapError::NotInUse { vertex: pin.vertex }),
            1 => copies.start,
            copies => return Err(MapError::OnTheCut { vertex: pin.vertex, copies }),
        };
        fixed.hold(vertex, Complex64::new(pin.place[0], pin.place[1]));
    }
    Ok(())
}
