//! Generated surfaces in closed form, many with an exactly known conformal map.
//!
//! A surface is named by `kind?parameter=value&…`, for example `sphere?n=64&mesh=delaunay&seed=1`.
//! Each kind is one [`SurfaceKind`] in the table [`SURFACES`]: its parameters, domain and closed
//! form. The meshes (quads, split quads, Delaunay triangles) depend only on the domain, so a new
//! surface is one closed form and one row of the table.
//!
//! The same name gives the same mesh, bit for bit, on machines whose sin, cos and exp round alike;
//! the random numbers are the same on all machines.

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

/// A generated surface and its exact conformal map, if known.
#[derive(Clone, Debug, PartialEq)]
pub struct Generated {
    /// The mesh. Faces are counter-clockwise in the domain, so that the exact map preserves
    /// orientation.
    pub surface: Surface,
    /// Exact conformal disc coordinates w, if known (one per vertex, |w| ≤ 1, |w| = 1 on the
    /// boundary).
    ///
    /// These hold up to rounding, or up to O(h) for digital surfaces, where h is the side of a
    /// voxel over the size of the shape.
    pub exact: Option<Vec<[f64; 2]>>,
    /// Exact ratio of periods τ = ω2/ω1 as (re, im), if known, for closed surfaces of genus 1.
    pub period: Option<[f64; 2]>,
    /// The voxels and surfels of digital surfaces.
    pub digital: Option<Digital>,
    /// Canonical name with every parameter spelled out; it generates the same surface again.
    pub name: String,
}

/// The position in R³ of a point of the domain.
pub type Immersion = Box<dyn Fn([f64; 2]) -> [f64; 3]>;

/// A mesh of the domain, before it is immersed in R³.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    /// Domain coordinates, `nv × 2`.
    pub points: Vec<[f64; 2]>,
    /// Polygons, counter-clockwise in the domain.
    pub faces: Faces,
}

/// The construction of a kind of surface.
#[derive(Clone, Copy, Debug)]
pub enum Form {
    /// An immersion of the square [−1, 1]² whose conformal map is not known exactly; parameters
    /// [`SurfaceKind::VERTICES`], [`SurfaceKind::MESH`].
    Square(fn(&Arguments) -> Result<Immersion, GenerateError>),
    /// A conformal immersion of the unit disc |w| ≤ 1; parameters [`SurfaceKind::CELLS`],
    /// [`SurfaceKind::MESH`].
    Disc(fn(&Arguments) -> Result<Immersion, GenerateError>),
    /// A function that makes the whole surface; the name is filled in afterwards.
    Whole(fn(&Arguments) -> Result<Generated, GenerateError>),
}

/// A kind of generated surface.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceKind {
    /// The part of the name before the `?`.
    pub name: &'static str,
    /// The closed form, in one line.
    pub about: &'static str,
    /// The parameters, in groups, in the order of the canonical name.
    pub parameters: &'static [&'static [Parameter]],
    /// The construction: domain and closed form.
    pub form: Form,
    /// Whether the exact conformal map (or period) is part of the result.
    pub exact: bool,
}

/// The table of all kinds of surfaces.
pub static SURFACES: &[SurfaceKind] = &[
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

/// Generates the surface named `source`, of a kind in [`SURFACES`].
///
/// # Errors
/// An unknown name or parameter, a malformed or excessive value; the message lists what is
/// possible.
pub fn generate(source: &str) -> Result<Generated, GenerateError> {
    generate_from(SURFACES, source)
}

/// Generates the surface named `source`, of a kind in `table`.
///
/// # Errors
/// As for [`generate`].
pub fn generate_from(table: &[SurfaceKind], source: &str) -> Result<Generated, GenerateError> {
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

/// Immerses the mesh with the domain coordinates `points`.
fn place(points: &[[f64; 2]], faces: Faces, immersion: &Immersion) -> Surface {
    Surface { positions: points.iter().map(|&p| immersion(p)).collect(), faces, face_normals: None }
}

/// Whether `source` is meant as the name of a generated surface rather than of a file.
///
/// This holds if no such file exists and the part before the `?` has neither a path separator nor a
/// dot. Misspelt names qualify too, so that the error of [`generate`] can list the known ones.
pub fn is_generated_name(source: &str) -> bool {
    let kind = source.split('?').next().unwrap_or_default();
    !kind.is_empty() && !kind.contains(['/', '\\', '.']) && !Path::new(source).is_file()
}
