use num_complex::Complex64;
use serde::{Deserialize, Serialize};

use super::MapError;
use crate::constraint::{Fixed, Shape, on_shape};
use crate::energy::Expression;
use crate::energy::conformal::Weight;
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
    /// There is none: closed surfaces of genus 1 are mapped with two periods, by H.
    Periodic,
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

/// Which boundary vertices of the quad graph a fixed boundary holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Hold {
    /// All of them: H is minimised in least squares.
    Whole,
    /// Those of the mesh, and one dual vertex: (2) is square and solved exactly. The same as `whole` on quad meshes.
    Primal,
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

/// What takes the place of a map that is not one-to-one, or with a free boundary not so near every point: of the plain circle and free
/// maps, without an energy or pins of one's own, and of convex combination maps that rounding has folded. Other maps are checked alone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Valid {
    /// A valid map of little shear: the lowest MIPS with all faces counting alike, with a free boundary MIPS + γ'L'. Also in the place of a
    /// circle map that folds nothing but shears by more than 2 in the mean.
    #[default]
    Auto,
    /// That map in the place of a valid plain one, too, where its mean σ1/σ2 is lower: on coarse and obtuse meshes. On fine ones the
    /// plain map is nearer to the exact one.
    BestQc,
    /// As `auto`; and of free maps no two parts may overlap: where they do a map whose boundary keeps off itself is in their place.
    OneToOne,
    /// Nothing.
    Off,
}

/// What is asked of a map; the `[map]` table of an experiment.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields, rename_all = "kebab-case")]
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
    /// The energy, in place of the one that `boundary` stands for.
    pub energy: Option<Expression>,
    /// What a fixed boundary is laid on.
    pub shape: Shape,
    /// Places of boundary vertices, in place of `shape`.
    pub positions: Option<Vec<Pin>>,
    /// Free maps: lengths of the boundary edges in the place of those at rest.
    pub boundary_lengths: Option<BoundaryLengths>,
    /// Vertices held beside a fixed boundary, or elsewhere than it says; in place of `fix` for the circle; in place of
    /// the gauge for metric energies.
    pub pins: Vec<Pin>,
    /// Which boundary vertices are held by a fixed boundary; by default `whole`, with circumcentres `primal`.
    pub hold: Option<Hold>,
    /// With a fixed boundary: the vertices inside are means of their neighbours by these weights, in place of the minimum of H.
    pub weights: Option<String>,
    /// What takes the place of a map that is not one-to-one.
    pub valid: Valid,
    /// How many boundary points a circle map holds: 3, or 2 as in the paper.
    pub fix: usize,
    /// Circle maps: whether the boundary is kept in order.
    pub keep_order: bool,
    /// What a minimisation begins with.
    pub start: Start,
    /// Weights of the energies.
    pub weight: Weight,
    /// Dual point of triangle meshes.
    pub dual: String,
    /// Dual vertex of boundary edges.
    pub boundary_dual: BoundaryDual,
    /// What ρ of quad meshes comes from.
    pub rho: RhoSource,
    /// The estimator of normals from which ρ of quad meshes and digital surfaces is taken, in place of `rho`.
    pub normals: Option<NormalSpec>,
    /// With normals: what rest lengths and areas are.
    pub rest: RestSource,
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
            cut: false,
            fill_holes: false,
            remove_faces: Vec::new(),
            surrogate: None,
            boundary: Boundary::default(),
            energy: None,
            shape: Shape::default(),
            positions: None,
            boundary_lengths: None,
            pins: Vec::new(),
            hold: None,
            weights: None,
            valid: Valid::default(),
            fix: 3,
            keep_order: false,
            start: Start::default(),
            weight: Weight::default(),
            dual: "barycentre".to_owned(),
            boundary_dual: BoundaryDual::default(),
            rho: RhoSource::default(),
            normals: None,
            rest: RestSource::default(),
            solver: "auto".to_owned(),
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
            Boundary::Circle => Expression::of(&["H", "C"]),
            Boundary::Free => Expression::of(&["H", "Lb"]),
            Boundary::Fixed | Boundary::Periodic => Expression::of(&["H"]),
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
            && self.pins.is_empty()
            && self.boundary_lengths.is_none()
            && matches!(self.boundary, Boundary::Circle | Boundary::Free)
    }

    /// Whether a fixed boundary is on the unit circle.
    pub(super) fn fixed_on_circle(&self) -> bool {
        self.positions.is_none() && self.shape == Shape::Circle
    }

    /// The vertices of `graph` that a fixed boundary and the pins hold, and where.
    ///
    /// # Errors
    /// Vertices that are not in use; a shape that the boundary is too short for.
    pub fn fixed(&self, disc: &OrientedMesh, graph: &QuadGraph) -> Result<Fixed, MapError> {
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
pub(super) fn hold_pins(fixed: &mut Fixed, disc: &OrientedMesh, pins: &[Pin]) -> Result<(), MapError> {
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
