//! Meshes of the two domains, square and disc, from the parameters shared by all surfaces over
//! them.

use super::delaunay::{self, PointDistribution};
use super::grid::{self, Diagonal};
use super::random::Random;
use super::{Arguments, GenerateError, Parameter, Patch, SurfaceKind};

/// Bounds the memory: 17 million vertices take 1.5 GB as triangles.
const MAX_N: u64 = 4096;
/// The same bound for Delaunay triangulations, which need three times the memory.
const MAX_N_DELAUNAY: u64 = 2048;

/// Parameter: the rule by which the cells of a grid are split.
pub(super) const DIAGONAL: Parameter =
    Parameter::choice("diagonal", &["alternate", "same", "random"], "how each cell is split into two triangles")
        .only_with("mesh", &["triangle"]);
/// Parameter: the seed of the random numbers.
pub(super) const SEED: Parameter = Parameter::whole("seed", 0, 0, u64::MAX, "of the random numbers");

impl SurfaceKind {
    /// Parameter `n` of [`Form::Square`](super::Form::Square) surfaces: vertices along a side.
    pub const VERTICES: &'static [Parameter] =
        &[Parameter::whole("n", 33, 3, MAX_N, "vertices along each side; delaunay: as many in all, at most 2048")];

    /// Parameter `n` of [`Form::Disc`](super::Form::Disc) surfaces: cells along a side of the grid.
    pub const CELLS: &'static [Parameter] = &[Parameter::whole(
        "n",
        32,
        2,
        MAX_N,
        "cells along each side: (n + 1)² vertices; delaunay: about as many, n at most 2048",
    )];

    /// Parameters of every mesh of a square or a disc.
    pub const MESH: &'static [Parameter] = &[
        Parameter::choice("mesh", &["quad", "triangle", "delaunay"], "grid, split grid, Delaunay triangles"),
        DIAGONAL,
        Parameter::real("jitter", 0.0, 0.0, 0.45, "how far interior grid vertices are moved at random, in cells")
            .only_with("mesh", &["quad", "triangle"]),
        Parameter::choice("points", &["jittered", "random"], "interior points: one a cell, or independent")
            .only_with("mesh", &["delaunay"]),
        SEED,
    ];
}

/// Reads the rule for splitting cells.
pub(super) fn diagonal(arguments: &Arguments) -> Result<Diagonal, GenerateError> {
    Ok(match arguments.choice("diagonal")? {
        "same" => Diagonal::Same,
        "random" => Diagonal::Random,
        _ => Diagonal::Alternate,
    })
}

/// Makes a mesh of the square [−1, 1]² with `n × n` vertices.
pub(super) fn square(arguments: &Arguments) -> Result<Patch, GenerateError> {
    let cells = (arguments.whole("n")? as usize).saturating_sub(1).max(1);
    let mut random = Random::new(arguments.whole("seed")?);
    if arguments.choice("mesh")? == "delaunay" {
        return delaunay::square(cells, points(arguments)?, &mut random);
    }
    grid_mesh(arguments, cells, false, &mut random, |p| p)
}

/// Makes a mesh of the unit disc. Grids have `n × n` cells of [−1, 1]² mapped by w = (s √(1 −
/// t²/2), t √(1 − s²/2)).
pub(super) fn disc(arguments: &Arguments) -> Result<Patch, GenerateError> {
    let cells = (arguments.whole("n")? as usize).max(1);
    let mut random = Random::new(arguments.whole("seed")?);
    if arguments.choice("mesh")? == "delaunay" {
        return delaunay::disc(cells, points(arguments)?, &mut random);
    }
    grid_mesh(arguments, cells, true, &mut random, |[s, t]| {
        [s * (1.0 - 0.5 * t * t).sqrt(), t * (1.0 - 0.5 * s * s).sqrt()]
    })
}

fn grid_mesh(
    arguments: &Arguments,
    cells: usize,
    round: bool,
    random: &mut Random,
    chart: impl Fn([f64; 2]) -> [f64; 2],
) -> Result<Patch, GenerateError> {
    let points = grid::jitter(cells, arguments.real("jitter")?, random, chart);
    let faces = match arguments.choice("mesh")? {
        "triangle" => grid::triangles(cells, diagonal(arguments)?, round, random),
        _ => grid::quads(cells),
    };
    Ok(Patch { points, faces })
}

fn points(arguments: &Arguments) -> Result<PointDistribution, GenerateError> {
    if arguments.whole("n")? > MAX_N_DELAUNAY {
        let range = format!("at most {MAX_N_DELAUNAY}");
        return Err(arguments.out_of_range("n", " with mesh=delaunay".to_string(), range));
    }
    Ok(if arguments.choice("points")? == "random" { PointDistribution::Random } else { PointDistribution::Jittered })
}
