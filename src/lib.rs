//! Riemap computes discrete conformal maps of quad meshes, triangle meshes and digital surfaces, after Cartade,
//! Mercat, Malgouyres, Samir, *Mesh Parameterization with Generalized Discrete Conformal Maps* (J. Math. Imaging
//! Vis. 46, 2013).
//!
//! Every quad carries one complex number ρ, computed from its diagonals. A map z of the vertices is *discrete
//! conformal* if on every quad
//!
//! ```text
//! z3 − z1 = iρ (z2 − z0)                                                     (2)
//! ```
//!
//! A triangle mesh becomes such a *quad graph* by one dual vertex in each face: one quad stands for each edge. The
//! boundary of a set of voxels has squares for quads; ρ is measured on estimated tangent planes.
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
//! [`map()`] takes arrays, [`map_surface`] a checked [`Surface`], and [`map_input`] an [`Input`]: a mesh file, a
//! volume or a generated surface. [`Flattener`] maps one surface many times by one factorisation. All of them return
//! [`Mapped`]: the image of every vertex, its distortion, and whether the map is bijective, by exact predicates.
//!
//! [`MapOptions`] say what is wanted. Its most important choice is the [`Boundary`]: on the unit circle (the
//! default), free with its own lengths, fixed, or none on a closed surface of genus 1, which is mapped with two
//! periods. An [`Expression`] such as `H + 0.5 L` is minimised instead of the energy for which the boundary stands.
//! A conformal map that flips a face is replaced by a bijective one, unless [`Valid::Off`] is asked for.
//!
//! Energies, constraints and solvers of one's own are handed to a map at run time: see [`EnergyKind`],
//! [`Constraint`], [`SolverChoice`](map::SolverChoice) and `examples/own_energy.rs`.
//!
//! # Where to find what
//!
//! Data flows one way, and no module imports one that comes later:
//!
//! ```text
//! surface → quad graph → conformal Laplacian → energies, constraints → problem → solver → map → report → figure → app
//! ```
//!
//! | module | contents |
//! |---|---|
//! | [`surface`] | positions and polygons; the [diagnosis](surface::topology::diagnosis) of a surface; how it is [cut](surface::cut) to a disc; [`digital`](surface::digital) surfaces; estimated [`normals`](surface::normals); [generated](surface::generate) surfaces |
//! | [`io`], [`input`] | mesh files and volumes; surfaces by file or name |
//! | [`quad_graph`] | quads, ρ, boundary; rest lengths and areas; dual points |
//! | [`laplacian`] | the conformal Laplacian, one complex symmetric matrix on half of the vertices: it has all maps that obey (2) |
//! | [`energy`] | H, C, A, L, L', MIPS, SD with all derivatives. A new energy is one file and one row of [`ENERGIES`] |
//! | [`constraint`] | pinned vertices, shapes of the boundary, gauges; the elimination x = Z y + x0 |
//! | [`problem`] | the linear problem and the nonlinear one |
//! | [`solver`] | [direct](solver::linear) solvers, [minimisers](solver::minimise), and Newton's method on the [boundary](solver::boundary) values, which computes circle maps and free maps |
//! | [`map`](mod@map) | `solve.rs` says which method is tried when; `bijective/` replaces a map that flips faces; [`periodic`](map::periodic) maps |
//! | [`distortion`], [`report`], `figure` | how good a map is, its record, its picture (feature `figure`) |
//! | `app` | the command line, experiments, comparisons with libigl, benchmarks (feature `cli`) |
//!
//! Without its default features the library needs neither a command line nor a plotting library.
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
//! In print H lacks the i before ρ, the first term of A a conjugate, and the cotangents a factor ½; here they are
//! corrected.

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
pub use input::Input;
pub use map::{Boundary, Flattener, MapError, MapOptions, Mapped, Pin, Valid, map, map_input, map_surface};
pub use quad_graph::dual::{DUAL_POINTS, DualPoint};
pub use report::Report;
pub use solver::{LINEAR_SOLVERS, LinearSolver, MINIMISERS, Minimiser, Observer, Silent};
pub use surface::{Surface, SurfaceError};
