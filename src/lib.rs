//! Riemap: discrete conformal maps of quad meshes, triangle meshes and digital surfaces, after Cartade, Mercat,
//! Malgouyres, Samir, *Mesh Parameterization with Generalized Discrete Conformal Maps* (J. Math. Imaging Vis. 46, 2013).
//!
//! Every quad carries one complex number ρ, made of its diagonals, and a map z of the vertices is *discrete conformal* when
//! on every quad
//!
//! ```text
//! z3 − z1 = iρ (z2 − z0)                                                     (2)
//! ```
//!
//! A triangle mesh becomes such a *quad graph* by a dual vertex per face; one quad stands for each edge. The boundary of a set of
//! voxels is one with squares for quads, seen along estimated normals.
//!
//! # The pipeline
//!
//! Data flows one way, and nothing imports what comes after it:
//!
//! ```text
//! surface → quad graph → conformal Laplacian, energies, constraints → problem → solver → map → distortion → report → figure
//! ```
//!
//! | module | contents |
//! |---|---|
//! | [`surface`] | positions and polygons; the [diagnosis](surface::topology::diagnosis) of a surface; [`OrientedMesh`](surface::oriented_mesh::OrientedMesh) and how a surface is [cut](surface::cut) to a disc; [`digital`](surface::digital): voxels and their boundaries; estimated [`normals`](surface::normals); generated surfaces |
//! | [`quad_graph`] | quads, ρ, boundary; rest lengths and areas; dual points |
//! | [`laplacian`] | the conformal Laplacian: one complex symmetric matrix on half of the vertices, whose solutions are the maps with H = 0 |
//! | [`energy`] | H, C, A, L, L', MIPS, SD with all derivatives; `H + 0.5 L` as an expression |
//! | [`constraint`] | pinned vertices, shapes of the boundary, gauges; elimination x = Z y + x0 |
//! | [`problem`] | the linear problem; the nonlinear one |
//! | [`solver`] | direct solvers, minimisers, and Newton's method on the boundary values |
//! | [`map`] | all of it in one call; maps of closed surfaces of genus 1 in [`periodic`](map::periodic) |
//! | [`distortion`], [`report`], `figure` | how good a map is, its record, its picture |
//! | [`io`], [`input`] | mesh files, volumes; surfaces by file or name |
//! | `app` | the command line, experiments, comparisons with libigl, benchmarks (feature `cli`) |
//! | `geometry`, `sparse` | exact predicates, polygons, Möbius maps; patterns and factors of sparse matrices |
//!
//! # One map
//!
//! ```
//! use riemap::{Boundary, MapOptions};
//!
//! // Four triangles around a vertex that is lifted out of the plane.
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.4, 0.5, 0.3]];
//! let faces = [vec![0, 1, 4], vec![1, 2, 4], vec![2, 3, 4], vec![3, 0, 4]];
//!
//! let options = MapOptions { boundary: Boundary::FREE, ..MapOptions::default() };
//! let mapped = riemap::map(&positions, &faces, &options)?;
//! assert!(mapped.validity.is_one_to_one());
//! let uv = mapped.uv(); // one pair for each vertex
//! # assert!(uv.iter().all(Option::is_some));
//! # Ok::<(), riemap::MapError>(())
//! ```
//!
//! [`map_surface`] takes a checked [`Surface`], [`map_input`] an [`Input`]: a file, a volume or a generated surface.
//!
//! # The paper's equations
//!
//! | equation | function |
//! |---|---|
//! | (1) `ρ = (c − ip)/‖d02‖²` | [`quad_graph::rho::extrinsic`], [`quad_graph::rho::with_normal`] |
//! | (2) as a matrix | [`problem::linear::system`]; one row: [`energy::conformal::row`] |
//! | ρ of a surfel, `(2 n3 − i(n1² − n2²))/(2 − (n1 + n2)²)` | [`quad_graph::rho::with_normal`] on [`quad_graph::TangentPlanes`] |
//! | §2.3 ρ of triangle meshes, `½(cot α + cot β)` | [`quad_graph::QuadGraph::from_triangles`], [`quad_graph::dual`] |
//! | H, and ∂H/∂z̄ = Aᴴ W A z | [`energy::conformal::value`], [`energy::conformal::normal_product`] |
//! | C | [`energy::Circle`] |
//! | A | [`energy::Authalic`] |
//! | L, L' | [`energy::Metric`] |
//! | αH + βC + δA + γL + γ'L' | [`energy::Expression`], [`problem::nonlinear::Objective`] |
//! | §3.2 boundary on a circle by arc length | [`constraint::on_circle`] |
//! | §3.3 the vertices that must be pinned | [`constraint::hold_gauge`], [`constraint::spread_points`] |
//!
//! The printed H has no i before ρ, A's first term lost a conjugate, and the cotangents a factor ½; here they are as they
//! must be.

#[cfg(feature = "cli")]
pub mod app;
pub mod constraint;
pub mod distortion;
pub mod energy;
#[cfg(feature = "figure")]
pub mod figure;
pub(crate) mod geometry;
pub mod input;
pub mod io;
pub mod laplacian;
pub mod map;
pub mod problem;
pub mod quad_graph;
pub mod report;
pub mod solver;
#[doc(hidden)]
pub mod sparse;
pub mod surface;

pub use num_complex;

pub use constraint::Constraint;
pub use energy::{ENERGIES, Energy, EnergyKind, Expression};
pub use input::{Input, InputError};
pub use map::{
    Boundary, Flattener, Map, MapError, MapOptions, Mapped, Pin, PinnedPoints, TextureCoordinates, Tiling, Valid, map,
    map_input, map_surface,
};
pub use quad_graph::dual::{DUAL_POINTS, DualPoint};
pub use report::Report;
pub use solver::{LINEAR_SOLVERS, LinearSolver, MINIMISERS, Minimiser, Observer, Silent};
pub use surface::{Surface, SurfaceError};
