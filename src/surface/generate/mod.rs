//! Generated surfaces: closed forms, many with a conformal map that is known exactly.
//!
//! A surface is named by `kind?parameter=value&…`, for example `sphere?n=64&mesh=delaunay&seed=1`. Everything that is
//! known of a kind is one [`Row`] of [`SURFACES`]: its parameters, its domain and its closed form. The meshes (quads,
//! split quads, Delaunay triangles) depend on the domain alone, so a new surface is one closed form and one row.
//!
//! The same name gives the same mesh, bit for bit, wherever sin, cos and exp round alike; the random numbers are
//! the same everywhere.

mod delaunay;
mod digital;
mod disc;
mod error;
mod graph;
mod grid;
mod hard;
mod mesh;
mod name;
mod random;
mod torus;

use std::path::Path;

use super::digital::Digital;
pub use super::parameters::{Arguments, Parameter, Values};
use super::{Faces, Surface};
pub use error::GenerateError;

/// A generated surface, and what is known of its conformal map.
#[derive(Clone, Debug, PartialEq)]
pub struct Generated {
    /// The mesh. Faces are counter-clockwise in the domain, so that the exact map preserves orientation.
    pub surface: Surface,
    /// Exact conformal disc coordinates w (one per vertex, |w| ≤ 1, boundary on |w| = 1, both up to rounding, of
    /// digital surfaces up to O(h), h the side of a voxel over the size of the shape), where they are known.
    pub exact: Option<Vec<[f64; 2]>>,
    /// Exact ratio of periods τ = ω2/ω1 as (re, im), for closed surfaces of genus 1 where it is known.
    pub period: Option<[f64; 2]>,
    /// Digital surfaces: the voxels and the surfels.
    pub digital: Option<Digital>,
    /// Canonical name, every parameter spelled out: generates this surface again.
    pub name: String,
}

/// Position in R³ of a point of the domain.
pub type Immersion = Box<dyn Fn([f64; 2]) -> [f64; 3]>;

/// Faces over their domain, before they are put into R³.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Domain coordinates, `nv × 2`.
    pub points: Vec<[f64; 2]>,
    /// Polygons, counter-clockwise in the domain.
    pub faces: Faces,
}

/// How a kind of surface comes about.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// An immersion of the square [−1, 1]², its conformal map not known. Parameters [`Row::VERTICES`], [`Row::MESH`].
    Square(fn(&Arguments) -> Result<Immersion, GenerateError>),
    /// A conformal immersion of the unit disc |w| ≤ 1. Parameters [`Row::CELLS`], [`Row::MESH`].
    Disc(fn(&Arguments) -> Result<Immersion, GenerateError>),
    /// Anything else, made as a whole; the name is filled in afterwards.
    Whole(fn(&Arguments) -> Result<Generated, GenerateError>),
}

/// A kind of generated surface.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// What stands before the `?`.
    pub name: &'static str,
    /// One line: the closed form.
    pub about: &'static str,
    /// The parameters, in groups, in the order of the canonical name.
    pub parameters: &'static [&'static [Parameter]],
    /// Domain and closed form.
    pub form: Form,
    /// Whether the exact conformal map (or period) is part of the result.
    pub exact: bool,
}

/// Every kind of surface that has a name.
pub static SURFACES: &[Row] = &[
    graph::COSINES,
    graph::SADDLE,
    graph::GAUSS,
    graph::FLAT,
    disc::plane::QUADRATIC,
    disc::plane::POWER,
    disc::plane::EXPONENTIAL,
    disc::cylinder::CYLINDER,
    disc::sphere::SPHERE,
    disc::enneper::ENNEPER,
    disc::catenoid::CATENOID,
    disc::pseudosphere::PSEUDOSPHERE,
    disc::torus_patch::TORUS_PATCH,
    hard::capsule::CAPSULE,
    hard::ramp::RAMP,
    hard::graph::SPIKES,
    hard::graph::ROUGH,
    hard::flat::COMB,
    hard::flat::SPIRAL,
    hard::flat::STAIRCASE,
    torus::TORUS,
    digital::TORUS,
    digital::BALL,
    digital::CAP,
    digital::ELLIPSOID,
    digital::BOX,
];

/// The surface of that name, among [`SURFACES`].
///
/// # Errors
/// Unknown name or parameter, malformed or excessive value: the message lists what is possible.
pub fn generate(source: &str) -> Result<Generated, GenerateError> {
    generate_from(SURFACES, source)
}

/// The surface of that name, among the kinds of `table`.
///
/// # Errors
/// As [`generate`].
pub fn generate_from(table: &[Row], source: &str) -> Result<Generated, GenerateError> {
    let (row, arguments) = name::parse(table, source)?;
    let name = arguments.canonical();
    let generated = match row.form {
        Form::Square(form) => {
            let patch = mesh::square(&arguments)?;
            let surface = place(&patch.points, patch.faces, &form(&arguments)?);
            Generated { surface, exact: None, period: None, digital: None, name: String::new() }
        }
        Form::Disc(form) => {
            let patch = mesh::disc(&arguments)?;
            let surface = place(&patch.points, patch.faces, &form(&arguments)?);
            Generated { surface, exact: Some(patch.points), period: None, digital: None, name: String::new() }
        }
        Form::Whole(make) => make(&arguments)?,
    };
    Ok(Generated { name, ..generated })
}

/// The surface over `points`.
fn place(points: &[[f64; 2]], faces: Faces, immersion: &Immersion) -> Surface {
    Surface { positions: points.iter().map(|&p| immersion(p)).collect(), faces, face_normals: None }
}

/// Whether `source` is meant as the name of a generated surface rather than of a file: no such file exists, and what
/// stands before the `?` has neither a path separator nor a dot (hence no extension).
///
/// True also for misspelt names, so that the error of [`generate`] can list the known ones.
pub fn is_generated_name(source: &str) -> bool {
    let kind = source.split('?').next().unwrap_or_default();
    !kind.is_empty() && !kind.contains(['/', '\\', '.']) && !Path::new(source).is_file()
}
