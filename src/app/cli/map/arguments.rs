use std::path::{Path, PathBuf};
use std::str::FromStr;

use anyhow::{Result, bail};
use clap::builder::PossibleValuesParser;
use clap::{Args, ValueEnum};

use crate::constraint::Shape;
use crate::energy::Expression;
use crate::energy::conformal::Weight;
use crate::io::{is_glb, read_boundary_lengths, read_positions};
use crate::map::periodic::Tiling;
use crate::map::{
    Boundary, BoundaryName, FlatOptions, Hold, MapError, MapOptions, Mapped, Pin, RhoSource, Start, ValidName,
};
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
    /// Write the mesh with the map as texture coordinates (.obj, .ply; .glb: to be looked at, with a checkerboard on it)
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(super) output: Option<PathBuf>,
    /// What the boundary does. circle: H + C; free: H + L', its lengths kept; fixed: H, boundary held on --shape;
    /// periodic: H, closed surfaces of genus 1, two periods [default: circle]
    #[arg(long, value_parser = by_name::<BoundaryName>, help_heading = "Boundary and constraints")]
    pub(super) boundary: Option<BoundaryName>,
    /// Cut a surface that is no disc open along short lines; the output then has texture coordinates per corner
    #[arg(long, help_heading = "Surface")]
    pub(super) cut: bool,
    /// Fill holes for the map: all but the longest, with --boundary periodic all; what is put in is not written
    #[arg(long, help_heading = "Surface")]
    pub(super) fill_holes: bool,
    /// Leave a face out (from 0); repeatable
    #[arg(long, value_name = "F", help_heading = "Surface")]
    pub(super) remove_face: Vec<u32>,
    /// Map faces without area too, which are refused otherwise: each as if its third vertex were
    /// lifted off its longest edge to HEIGHT times the edge's length (quads: as a rectangle of
    /// these sides)
    ///
    /// The output keeps them as they are [default HEIGHT: 0.01]
    #[arg(long, value_name = "HEIGHT", num_args = 0..=1, require_equals = true, default_missing_value = "0.01", value_parser = height, help_heading = "Surface")]
    pub(super) surrogate: Option<f64>,
    /// Energy, in place of the one of --boundary: terms H C A L Lb (L' is Lb) MIPS SD with coefficients, as in "H + 0.5 L + A"
    #[arg(long, value_name = "E", value_parser = Expression::from_str, help_heading = "Energy")]
    pub(super) energy: Option<Expression>,
    /// What a fixed boundary is laid on, by arc length: circle, square [default: circle]
    #[arg(long, value_parser = by_name::<Shape>, conflicts_with = "positions", help_heading = "Boundary and constraints")]
    pub(super) shape: Option<Shape>,
    /// Hold vertices at the places of a file of lines `vertex x y` (vertices from 0), in place of --shape
    #[arg(long, value_name = "FILE", help_heading = "Boundary and constraints")]
    pub(super) positions: Option<PathBuf>,
    /// Free maps: the lengths that the boundary edges are to have, one number a line in the order of the boundary (`riemap info
    /// --boundary`), or lines `v w number`; after a first line `factors` multiples of those on the surface
    #[arg(long, value_name = "FILE", help_heading = "Boundary and constraints")]
    pub(super) boundary_lengths: Option<PathBuf>,
    /// Hold a vertex (from 0) at a place; repeatable. Beside a fixed boundary; in place of --fix for the circle
    #[arg(long, value_name = "V=X,Y", value_parser = pin, allow_hyphen_values = true, help_heading = "Boundary and constraints")]
    pub(super) pin: Vec<Pin>,
    /// Boundary vertices held: whole (least squares), or primal (those of the mesh and one dual vertex: a square system)
    /// [default: whole; with circumcentres primal]
    #[arg(long, value_name = "WHICH", value_parser = by_name::<Hold>, help_heading = "Boundary and constraints")]
    pub(super) hold: Option<Hold>,
    /// With --boundary fixed: every inner vertex the mean of its neighbours by these weights, in place of H's minimum; see
    /// `riemap list`
    #[arg(long, value_name = "NAME", value_parser = PossibleValuesParser::new(EDGE_WEIGHTS.iter().map(|w| w.name)), help_heading = "Boundary and constraints")]
    pub(super) weights: Option<String>,
    /// A circle or free map that folds is replaced by a valid one of little shear (auto; also a
    /// circle map of σ1/σ2 above 2 in the mean), or any where the other has less shear (best-qc)
    ///
    /// Free maps may overlap, unless they must not (one-to-one). off keeps the plain map, as an
    /// --energy or pins of one's own do
    #[arg(long, value_parser = by_name::<ValidName>, help_heading = "Solver")]
    pub(super) valid: Option<ValidName>,
    /// How many boundary points a circle map holds: 3, or 2 as in the paper [default: 3]
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(2..=3), help_heading = "Boundary and constraints")]
    pub(super) fix: Option<u8>,
    /// Circle maps: keep the boundary points in order
    #[arg(long, help_heading = "Boundary and constraints")]
    pub(super) keep_order: bool,
    /// What a minimisation begins with: auto (with lengths or areas in the energy the free map, else the circle), circle
    /// (the boundary on a circle by arc length, as in the paper)
    #[arg(long, default_value = "auto", value_parser = by_name::<Start>, help_heading = "Solver")]
    pub(super) start: Start,
    /// Weights of the energies: integral (converge under refinement), unit (the paper's)
    #[arg(long, default_value = "integral", value_parser = by_name::<Weight>, help_heading = "Energy")]
    pub(super) weight: Weight,
    /// Dual point of triangle meshes
    #[arg(long, default_value = "barycentre", value_parser = PossibleValuesParser::new(DUAL_POINTS.iter().map(|d| d.name())), help_heading = "Quad graph")]
    pub(super) dual: String,
    /// Dual vertex of boundary edges: midpoint, foot (of the perpendicular from the dual point)
    #[arg(long, default_value = "midpoint", value_parser = by_name::<BoundaryDual>, help_heading = "Quad graph")]
    pub(super) boundary_dual: BoundaryDual,
    /// Quad meshes and digital surfaces: take ρ from normals estimated by NAME, with parameters as in "hat?radius=4"; see
    /// `riemap list` [default: digital surfaces auto; meshes none]
    #[arg(long, value_name = "NAME", value_parser = NormalSpec::from_str, conflicts_with = "rho", help_heading = "Quad graph")]
    pub(super) normals: Option<NormalSpec>,
    /// With normals: rest lengths and areas projected on the tangent planes, or those of the surfels (unit)
    #[arg(long, default_value = "projected", value_parser = by_name::<RestSource>, help_heading = "Quad graph")]
    pub(super) rest: RestSource,
    /// What ρ of quad meshes comes from: positions, normals (those of the file, as they are), auto (positions; of digital
    /// surfaces normals that are estimated)
    #[arg(long, default_value = "auto", value_parser = by_name::<RhoSource>, help_heading = "Quad graph")]
    pub(super) rho: RhoSource,
    /// Backend; see `riemap list`
    #[arg(long, default_value = "auto", value_parser = PossibleValuesParser::new(solver_names()), help_heading = "Solver")]
    pub(super) solver: String,
    /// Nonlinear maps: converged when the energy's gradient is at most T times that of the start [default: 1e-10]
    #[arg(long, value_name = "T", value_parser = tolerance, help_heading = "Solver")]
    pub(super) tolerance: Option<f64>,
    /// Nonlinear maps: stop after N iterations and write what is reached [default: the solver's own number]
    #[arg(long, value_name = "N", help_heading = "Solver")]
    pub(super) max_iterations: Option<usize>,
    /// Write energy, its terms, gradient, step and seconds of every iteration as CSV
    #[arg(long, value_name = "FILE.csv", help_heading = "Output")]
    pub(super) trace: Option<PathBuf>,
    /// Periodic maps: what --output has. conformal: the map, periods 1 and τ; whole: sheared a little (5 % at most) so that
    /// both periods are whole numbers and a repeating texture has no seam
    #[arg(long, default_value = "conformal", value_parser = by_name::<Tiling>, help_heading = "Output")]
    pub(super) tiling: Tiling,
    /// Write system (2) as a complex matrix in Matrix Market format
    #[arg(long, value_name = "FILE.mtx", help_heading = "Output")]
    pub(super) system: Option<PathBuf>,
    /// Write all figures of the run as JSON
    #[arg(long, value_name = "FILE.json", help_heading = "Output")]
    pub(super) report: Option<PathBuf>,
    /// Draw the map, coloured by quasi-conformal error (.png, .svg)
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(super) picture: Option<PathBuf>,
    /// Draw the surface, shaded, with the checkerboard that the map lays on it
    #[arg(long, value_name = "FILE.png", help_heading = "Output")]
    pub(super) texture: Option<PathBuf>,
    /// What an interrupted map leaves behind: keep (files that exist stay as they are, nothing is written), write (the
    /// best map so far is written)
    #[arg(long, value_name = "WHICH", default_value = "keep", value_enum, help_heading = "Solver")]
    pub(super) on_interrupt: OnInterrupt,
    /// Print warnings and errors alone
    #[arg(short, long, help_heading = "Output")]
    pub(super) quiet: bool,
}

/// What happens to the outputs of a map that a signal stops.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum OnInterrupt {
    /// Nothing is written.
    Keep,
    /// The best map so far is written.
    Write,
}

impl Arguments {
    /// The files to be written.
    pub(super) fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.output, &self.system, &self.report, &self.picture, &self.texture, &self.trace]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path)
    }
}

/// Whether one linear solve makes the map.
fn is_linear(options: &MapOptions) -> bool {
    options.boundary == Boundary::Periodic
        || options.boundary.is_fixed() && options.expression().terms.iter().all(|term| term.name == "H")
}

/// Options that were given and change nothing, each with the reason.
pub(super) fn without_effect(arguments: &Arguments, options: &MapOptions, mapped: &Mapped) -> Vec<&'static str> {
    let (triangles, opening) = (mapped.domain.is_of_triangles(), &mapped.cut);
    let circle = options.expression().has("C") && !options.boundary.is_fixed();
    let linear = is_linear(options);
    let idle = [
        (arguments.boundary == Some(BoundaryName::Free) && circle, "--boundary free has no effect: the energy has C"),
        (
            arguments.boundary == Some(BoundaryName::Circle) && !circle,
            "--boundary circle has no effect: the energy has no C",
        ),
        (arguments.fix.is_some() && !circle, "--fix has no effect: this is no circle map"),
        (arguments.fix.is_some() && circle && !options.pins.is_empty(), "--fix has no effect: pins take its place"),
        (arguments.tolerance.is_some() && linear, "--tolerance has no effect: the map is solved directly"),
        (arguments.max_iterations.is_some() && linear, "--max-iterations has no effect: the map is solved directly"),
        (options.dual != "barycentre" && !triangles, "--dual has no effect on a quad mesh"),
        (
            options.boundary_dual != BoundaryDual::default() && !triangles,
            "--boundary-dual has no effect on a quad mesh",
        ),
        (
            options.cut && opening.cut_edges == 0 && opening.vertices_split == 0,
            "--cut has no effect: the surface is a disc",
        ),
        (
            options.surrogate.is_some() && mapped.domain.disc.surrogates.faces.is_empty(),
            "--surrogate has no effect: every face has an area",
        ),
        (options.fill_holes && opening.holes_filled == 0, "--fill-holes has no effect: there is no hole to be filled"),
        (
            options.rest != RestSource::default() && mapped.domain.planes.is_none(),
            "--rest has no effect: ρ is not taken from normals",
        ),
        (
            arguments.tiling != Tiling::default() && mapped.torus.is_none(),
            "--tiling has no effect: the map has no periods",
        ),
        (
            arguments.tiling != Tiling::default() && arguments.output.as_deref().is_some_and(is_glb),
            "--tiling has no effect on .glb: its checkerboard has the periods already",
        ),
    ];
    let of_valid = valid_without_effect(arguments, options, mapped.map.provenance.is_repaired());
    idle.into_iter().chain(of_valid).filter(|(is_idle, _)| *is_idle).map(|(_, reason)| reason).collect()
}

/// Parses the height of a surrogate.
fn height(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|h| *h > 0.0 && *h <= 1.0);
    number.ok_or_else(|| "expected a number above 0, at most 1".to_owned())
}

/// What of this concerns valid maps: where none is promised, and what one that is in the place of the plain map does not see.
fn valid_without_effect(arguments: &Arguments, options: &MapOptions, repaired: bool) -> [(bool, &'static str); 8] {
    let given = arguments.valid.is_some_and(|valid| valid != ValidName::Off);
    let one_to_one = arguments.valid == Some(ValidName::OneToOne);
    let repaired = repaired && options.weights().is_none();
    [
        (
            given && options.energy.is_some(),
            "--valid has no effect: the map is the minimum of --energy, and checked alone",
        ),
        (given && !options.pins.is_empty(), "--valid has no effect beside pins: the map is checked alone"),
        (
            given && options.boundary_lengths().is_some(),
            "--valid has no effect beside --boundary-lengths: the map is checked alone",
        ),
        (
            given && options.boundary.is_fixed() && options.weights().is_none(),
            "--valid has no effect on a fixed boundary without --weights: the map is checked alone",
        ),
        (
            given && options.boundary == Boundary::Periodic,
            "--valid has no effect: nothing takes the place of a map with periods, which is checked alone",
        ),
        (
            one_to_one && options.boundary.is_circle() && options.promises_valid(),
            "--valid one-to-one says no more than auto here: circle maps do not overlap",
        ),
        (
            repaired && options.is_ordered(),
            "--keep-order has no effect: the map in the place of the plain one is in order by itself",
        ),
        (
            repaired && options.solver != "auto",
            "--solver has no effect on the map in the place of the plain one: it is Newton's",
        ),
    ]
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

/// What the arguments ask of the library.
pub(super) fn options(arguments: &Arguments) -> Result<MapOptions> {
    let positions = match &arguments.positions {
        None => None,
        Some(path) => {
            let pins = read_positions(path)?.into_iter().map(|(vertex, place)| Pin { vertex, place });
            Some(pins.collect())
        }
    };
    let flat = FlatOptions {
        cut: arguments.cut,
        fill_holes: arguments.fill_holes,
        remove_faces: arguments.remove_face.clone(),
        surrogate: arguments.surrogate,
        boundary: arguments.boundary,
        energy: arguments.energy.clone(),
        fix: arguments.fix.map(usize::from),
        keep_order: arguments.keep_order,
        start: arguments.start,
        tolerance: arguments.tolerance,
        max_iterations: arguments.max_iterations,
        shape: arguments.shape,
        positions,
        boundary_lengths: arguments.boundary_lengths.as_deref().map(read_boundary_lengths).transpose()?,
        pins: arguments.pin.clone(),
        hold: arguments.hold,
        weights: arguments.weights.clone(),
        valid: arguments.valid.unwrap_or_default(),
        weight: arguments.weight,
        dual: Some(arguments.dual.clone()),
        boundary_dual: arguments.boundary_dual,
        rho: arguments.rho,
        normals: arguments.normals.clone(),
        rest: arguments.rest,
        solver: Some(arguments.solver.clone()),
    };
    let options = MapOptions::try_from(flat).map_err(MapError::from)?;
    if arguments.trace.is_some() && is_linear(&options) {
        bail!("--trace is for nonlinear maps, and this one is solved directly: leave it out");
    }
    Ok(options)
}
