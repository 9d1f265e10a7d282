//! The options of a map.

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

/// A vertex of the source pinned at a position.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Pin {
    /// Vertex index in the source, from 0.
    pub vertex: u32,
    /// Its position in the plane.
    pub place: [f64; 2],
}

/// The data from which ρ of a quad mesh is computed, if no estimator of normals is named.
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

/// The map from which a minimisation starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Start {
    /// The free map, if the energy depends on lengths or areas and not on the circle, and if that map is found; else
    /// `Circle`.
    #[default]
    Auto,
    /// The paper's (§3.3): the boundary on a circle by arc length, the interior from H.
    Circle,
}

/// Which replacement is computed when the conformal map is not injective.
///
/// Circle and free maps are replaced, unless an energy or pins are given, and convex combination maps in which rounding
/// flipped a face. All other maps are checked and kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Valid {
    /// The same map with its flipped faces unflipped in place, if that is possible; else a bijective map of low
    /// quasi-conformal distortion: the minimum of MIPS, all faces counting alike, or of MIPS + γ'L' with a free boundary.
    #[default]
    Auto,
    /// That bijective map. It also replaces an injective conformal map of higher mean σ1/σ2: on coarse and obtuse meshes. On fine ones
    /// the conformal map is nearer to the exact one.
    BestQc,
    /// None.
    Off,
}

/// The options of a map: how the surface becomes a disc, its boundary, the energy, and the solver. [`FlatOptions`] reads
/// them from flat keys.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "FlatOptions")]
pub struct MapOptions {
    /// Whether a surface that is not a disc is cut open along a short graph.
    pub cut: bool,
    /// Whether holes are filled for the solve: all boundary loops but the longest; for periodic maps all.
    pub fill_holes: bool,
    /// Faces of the source that are removed.
    pub remove_faces: Vec<u32>,
    /// The height over length of the shapes given to faces without area; `None` refuses such faces. See [`Surrogates`].
    pub surrogate: Option<f64>,
    /// The boundary of the map.
    pub boundary: Boundary,
    /// The energy; by default the one that `boundary` stands for.
    pub energy: Option<Expression>,
    /// Pinned vertices. They are added to a fixed boundary or override it; they replace the normalisation points of a
    /// circle map and the gauge of a metric energy.
    pub pins: Vec<Pin>,
    /// Constraints of one's own; they hold vertices as `pins` do.
    pub constraints: Vec<Own<dyn Constraint>>,
    /// Which replacement is computed when the conformal map is not injective.
    pub valid: Valid,
    /// The map from which a minimisation starts.
    pub start: Start,
    /// The weights of the energies.
    pub weight: Weight,
    /// The dual point of triangle meshes.
    pub dual: String,
    /// The dual vertex of boundary edges.
    pub boundary_dual: BoundaryDual,
    /// The data from which ρ of quad meshes is computed.
    pub rho: RhoSource,
    /// The estimator of normals from which ρ of quad meshes and digital surfaces is computed, instead of `rho`.
    pub normals: Option<NormalSpec>,
    /// The rest lengths and areas, if ρ is computed from normals.
    pub rest: RestSource,
    /// The solver.
    pub solver: SolverChoice,
    /// Convergence of nonlinear maps: |∇E| is at most this times its value at the start.
    pub tolerance: f64,
    /// The largest number of iterations; by default that of the solver.
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
    /// The options that make the surface a disc.
    pub fn opening(&self) -> Opening {
        Opening { cut: self.cut, remove_faces: self.remove_faces.clone(), fill_holes: self.fill_holes }
    }

    /// Removes the findings about faces without area from a diagnosis, if such faces are given a shape.
    ///
    /// # Errors
    /// The height is not in (0, 1].
    pub(super) fn forgiving(&self, diagnosis: Diagnosis) -> Result<Diagnosis, MapError> {
        match self.surrogate {
            None => Ok(diagnosis),
            Some(height) if height > 0.0 && height <= 1.0 => Ok(diagnosis.with_surrogates(height)),
            Some(height) => Err(MapError::SurrogateHeight { height }),
        }
    }

    /// Gives faces without area a shape, if that is asked for.
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

    /// Whether a conformal map that is not injective is replaced by one that is.
    pub fn promises_valid(&self) -> bool {
        self.valid != Valid::Off
            && self.energy.is_none()
            && !self.holds_more()
            && matches!(self.boundary, Boundary::Circle { .. } | Boundary::Free { lengths: None, .. })
    }

    /// The number of boundary points that a circle map pins.
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

    /// The prescribed lengths of the boundary edges of a free map.
    pub fn boundary_lengths(&self) -> Option<&BoundaryLengths> {
        match &self.boundary {
            Boundary::Free { lengths, .. } => lengths.as_ref(),
            _ => None,
        }
    }

    /// The name of the weights of a convex combination map.
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

    /// Returns the vertices of `graph` that a fixed boundary and the pins hold, and their positions. Any other boundary is
    /// treated as fixed on the unit circle.
    ///
    /// # Errors
    /// A vertex is not in use; the boundary has too few vertices for the shape.
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

/// Pins vertices of the source at their positions.
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
