//! The arguments of `riemap map`.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Result, bail};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};

use crate::constraint::Shape;
use crate::energy::conformal::Weight;
use crate::energy::{Expression, Standard};
use crate::io::{read_boundary_lengths, read_positions};
use crate::map::periodic::Tiling;
use crate::map::{Boundary, BoundaryName, FlatOptions, Hold, MapError, MapOptions, Pin, RhoSource, Start, ValidName};
use crate::quad_graph::RestSource;
use crate::quad_graph::dual::{BoundaryDual, DUAL_POINTS};
use crate::solver::convex::EDGE_WEIGHTS;
use crate::solver::solver_names;
use crate::surface::normals::NormalSpec;

use crate::app::cli::by_name;
use crate::app::cli::source::Source;

#[derive(Args)]
pub struct Arguments {
    #[command(flatten)]
    pub(super) source: Source,
    /// Write the mesh with the map as texture coordinates (.obj, .ply), or a model with a
    /// checkerboard (.glb)
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(super) output: Option<PathBuf>,
    /// Behaviour of the boundary: circle, free, fixed, periodic [default: circle]
    ///
    /// circle: the boundary slides on the unit circle (energy H + C). free: the boundary edges of the
    /// mesh have exactly their lengths (H = 0). fixed: the boundary is pinned on --shape or at
    /// --positions (H). periodic: a closed surface of genus 1 is mapped with two periods (H).
    #[arg(long, value_parser = by_name::<BoundaryName>, help_heading = "Boundary and constraints")]
    pub(super) boundary: Option<BoundaryName>,
    /// Cut the surface open to a disc
    ///
    /// A closed surface, or one with handles or several boundary loops, is cut along short lines.
    /// The output then has texture coordinates per corner.
    #[arg(long, help_heading = "Surface")]
    pub(super) cut: bool,
    /// Fill the holes of the surface for the map
    ///
    /// All boundary loops but the longest are filled, with --boundary periodic all of them. The
    /// faces that fill them are not written.
    #[arg(long, help_heading = "Surface")]
    pub(super) fill_holes: bool,
    /// Leave out face F, counted from 0; repeatable
    #[arg(long, value_name = "F", help_heading = "Surface")]
    pub(super) remove_face: Vec<u32>,
    /// Give faces without area a shape of relative HEIGHT, so that they can be mapped [default
    /// HEIGHT: 0.01]
    ///
    /// Such faces are refused otherwise. Each is mapped as if its third vertex were lifted off its
    /// longest edge to HEIGHT times the length of that edge; a quad, as a rectangle of these sides.
    /// The output keeps their positions.
    #[arg(long, value_name = "HEIGHT", num_args = 0..=1, require_equals = true, default_missing_value = "0.01", value_parser = height, help_heading = "Surface")]
    pub(super) surrogate: Option<f64>,
    /// Energy, instead of that of --boundary, such as "H + 0.5 L + A"
    ///
    /// The terms are H, C, A, L, Lb (the paper's L'), MIPS and SD, each with an optional
    /// coefficient; see `riemap help energies`.
    #[arg(long, value_name = "E", value_parser = Expression::from_str, help_heading = "Energy")]
    pub(super) energy: Option<Expression>,
    /// Shape on which a fixed boundary is pinned by arc length: circle, square [default: circle]
    #[arg(long, value_parser = by_name::<Shape>, conflicts_with = "positions", help_heading = "Boundary and constraints")]
    pub(super) shape: Option<Shape>,
    /// Pin the vertices listed in FILE, instead of --shape
    ///
    /// Each line of the file is `vertex x y`, with vertices counted from 0.
    #[arg(long, value_name = "FILE", help_heading = "Boundary and constraints")]
    pub(super) positions: Option<PathBuf>,
    /// Lengths that the boundary edges of a free map are to have
    ///
    /// The file has one number per line in the order of the boundary (see `riemap info MESH
    /// --boundary`), or lines `v w number`. After a first line `factors`, the numbers are multiples
    /// of the lengths on the surface.
    #[arg(long, value_name = "FILE", help_heading = "Boundary and constraints")]
    pub(super) boundary_lengths: Option<PathBuf>,
    /// Pin vertex V, counted from 0, at (X, Y); repeatable
    ///
    /// Pins are added to a fixed boundary; on a circle they replace the points of --fix.
    #[arg(long, value_name = "V=X,Y", value_parser = pin, allow_hyphen_values = true, help_heading = "Boundary and constraints")]
    pub(super) pin: Vec<Pin>,
    /// Boundary vertices that a fixed boundary pins: whole, primal [default: whole; with
    /// circumcentres primal]
    ///
    /// whole: all boundary vertices of the quad graph; the equations are solved in least squares.
    /// primal: the boundary vertices of the mesh and one dual vertex; the system is square and
    /// solved exactly.
    #[arg(long, value_name = "WHICH", value_parser = by_name::<Hold>, help_heading = "Boundary and constraints")]
    pub(super) hold: Option<Hold>,
    /// Weights of a convex combination map, with --boundary fixed
    ///
    /// Every interior vertex is then the mean of its neighbours by these weights, instead of
    /// minimising H. `riemap list` describes them.
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(EDGE_WEIGHTS.iter().map(|w| w.name)), help_heading = "Boundary and constraints")]
    pub(super) weights: Option<String>,
    /// Map that replaces one with flipped faces: auto, best-qc, one-to-one, off [default: auto]
    ///
    /// auto: a circle or free map with flipped faces is replaced by one without, and no other is.
    /// best-qc: the map of lower mean σ1/σ2 is taken. one-to-one: free maps must not overlap either.
    /// off: the conformal map is kept, as it is beside --energy and --pin.
    #[arg(long, value_parser = by_name::<ValidName>, help_heading = "Solver")]
    pub(super) valid: Option<ValidName>,
    /// Number of boundary points that a circle map pins: 3, or 2 as in the paper [default: 3]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(2..=3), help_heading = "Boundary and constraints")]
    pub(super) fix: Option<u8>,
    /// Keep the boundary points of a circle map in order
    #[arg(long, help_heading = "Boundary and constraints")]
    pub(super) keep_order: bool,
    /// Map from which a minimisation starts: auto, circle
    ///
    /// auto: the free map if the energy has lengths or areas, otherwise the circle. circle: the
    /// boundary on a circle by arc length, as in the paper.
    #[arg(long, default_value = "auto", value_parser = by_name::<Start>, help_heading = "Solver")]
    pub(super) start: Start,
    /// Weights of the energies: integral, unit
    ///
    /// integral: energies converge under refinement of the mesh. unit: the weights of the paper.
    #[arg(long, default_value = "integral", value_parser = by_name::<Weight>, help_heading = "Energy")]
    pub(super) weight: Weight,
    /// Dual point of the faces of a triangle mesh
    #[arg(long, default_value = "barycentre", value_parser = PossibleValuesParser::new(DUAL_POINTS.iter().map(|d| d.name())), help_heading = "Quad graph")]
    pub(super) dual: String,
    /// Dual vertex of boundary edges: midpoint, foot (of the perpendicular from the dual point)
    #[arg(long, default_value = "midpoint", value_parser = by_name::<BoundaryDual>, help_heading = "Quad graph")]
    pub(super) boundary_dual: BoundaryDual,
    /// Estimator of the normals from which ρ of quads is computed [default: digital surfaces auto;
    /// meshes none]
    ///
    /// Parameters follow the name, as in "hat?radius=4"; `riemap list` describes the estimators.
    #[arg(long, value_name = "NAME", value_parser = NormalSpec::from_str, conflicts_with = "rho", help_heading = "Quad graph")]
    pub(super) normals: Option<NormalSpec>,
    /// Lengths and areas at rest beside --normals: projected (on the tangent planes), unit (those
    /// of the surfels)
    #[arg(long, default_value = "projected", value_parser = by_name::<RestSource>, help_heading = "Quad graph")]
    pub(super) rest: RestSource,
    /// Source of ρ of quads: auto, positions, normals
    ///
    /// positions: the diagonals in space. normals: the diagonals projected along the normals of the
    /// file. auto: positions for meshes, estimated normals for digital surfaces.
    #[arg(long, default_value = "auto", value_parser = by_name::<RhoSource>, help_heading = "Quad graph")]
    pub(super) rho: RhoSource,
    /// Solver; `riemap list` describes them
    #[arg(long, hide_possible_values = true, default_value = "auto", value_parser = PossibleValuesParser::new(solver_names()), help_heading = "Solver")]
    pub(super) solver: String,
    /// Stop an iteration when the gradient is at most T times that of the start [default: 1e-10]
    #[arg(long, value_name = "T", value_parser = tolerance, help_heading = "Solver")]
    pub(super) tolerance: Option<f64>,
    /// Stop an iteration after N steps [default: the solver's own number]
    ///
    /// The map reached by then is written, a warning says that it has not converged, and the exit
    /// code is 3.
    #[arg(long, value_name = "N", help_heading = "Solver")]
    pub(super) max_iterations: Option<usize>,
    /// Write the energy, its terms, the gradient, the step and the time of every iteration as CSV
    #[arg(long, value_name = "FILE.csv", help_heading = "Output")]
    pub(super) trace: Option<PathBuf>,
    /// Texture coordinates of a periodic map: conformal, whole
    ///
    /// conformal: those of the map, with the periods 1 and τ. whole: sheared slightly (by 5 % at
    /// most), so that both periods are whole numbers and a texture that repeats has no seam.
    #[arg(long, default_value = "conformal", value_parser = by_name::<Tiling>, help_heading = "Output")]
    pub(super) tiling: Tiling,
    /// Write the linear system (2) as a complex matrix in Matrix Market format
    #[arg(long, value_name = "FILE.mtx", help_heading = "Output")]
    pub(super) system: Option<PathBuf>,
    /// Write energies, times and distortion as JSON; `riemap help report` lists the fields
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(super) report: Option<PathBuf>,
    /// Draw the map, coloured by quasi-conformal distortion (.png, .svg)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(super) picture: Option<PathBuf>,
    /// Draw the surface, shaded, with the checkerboard of the map
    #[arg(long, value_name = "FILE.png", help_heading = "Output")]
    pub(super) texture: Option<PathBuf>,
    /// Outputs of a map that a signal stops: keep (existing files stay, nothing is written), write
    /// (the best map so far)
    #[arg(
        long,
        value_name = "WHICH",
        default_value = "keep",
        value_enum,
        hide_possible_values = true,
        help_heading = "Solver"
    )]
    pub(super) on_interrupt: OnInterrupt,
    /// Print only warnings and errors
    #[arg(short, long, help_heading = "Output")]
    pub(super) quiet: bool,
}

/// Outputs of a map that a signal stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum OnInterrupt {
    /// Nothing is written.
    Keep,
    /// The best map so far is written.
    Write,
}

impl Arguments {
    /// Returns the files to be written.
    pub(super) fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.output, &self.system, &self.report, &self.picture, &self.texture, &self.trace]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
    }

    /// Returns the arguments as options of the library, after reading the files that they name.
    pub(super) fn options(&self) -> Result<MapOptions> {
        let positions = match &self.positions {
            None => None,
            Some(path) => {
                let pins = read_positions(path)?.into_iter().map(|(vertex, place)| Pin { vertex, place });
                Some(pins.collect())
            }
        };
        let flat = FlatOptions {
            cut: self.cut,
            fill_holes: self.fill_holes,
            remove_faces: self.remove_face.clone(),
            surrogate: self.surrogate,
            boundary: self.boundary,
            energy: self.energy.clone(),
            fix: self.fix.map(usize::from),
            keep_order: self.keep_order,
            start: self.start,
            tolerance: self.tolerance,
            max_iterations: self.max_iterations,
            shape: self.shape,
            positions,
            boundary_lengths: self.boundary_lengths.as_deref().map(read_boundary_lengths).transpose()?,
            pins: self.pin.clone(),
            hold: self.hold,
            weights: self.weights.clone(),
            valid: self.valid.unwrap_or_default(),
            weight: self.weight,
            dual: Some(self.dual.clone()),
            boundary_dual: self.boundary_dual,
            rho: self.rho,
            normals: self.normals.clone(),
            rest: self.rest,
            solver: Some(self.solver.clone()),
        };
        let options = MapOptions::try_from(flat).map_err(MapError::from)?;
        if self.trace.is_some() && is_linear(&options) {
            bail!("--trace is for nonlinear maps, and this one is solved directly: leave it out");
        }
        Ok(options)
    }
}

/// Whether the map is the solution of one linear system.
pub(super) fn is_linear(options: &MapOptions) -> bool {
    options.boundary == Boundary::Periodic
        || options.boundary.is_fixed() && options.expression().as_standard() == Some(Standard::Conformal)
}

/// Parses the height of a surrogate.
fn height(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|h| *h > 0.0 && *h <= 1.0);
    number.ok_or_else(|| "expected a number above 0, at most 1".to_owned())
}

/// Parses a tolerance.
fn tolerance(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|t| *t > 0.0 && *t < 1.0);
    number.ok_or_else(|| "expected a number between 0 and 1".to_owned())
}

/// Parses `V=X,Y`.
fn pin(text: &str) -> Result<Pin, String> {
    let parse = || {
        let (vertex, place) = text.split_once('=')?;
        let (x, y) = place.split_once(',')?;
        let number = |s: &str| s.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        Some(Pin { vertex: vertex.trim().parse().ok()?, place: [number(x)?, number(y)?] })
    };
    parse().ok_or_else(|| "expected V=X,Y with a vertex index from 0 and two finite numbers".to_owned())
}
