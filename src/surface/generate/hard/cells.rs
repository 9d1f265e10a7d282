use crate::surface::generate::random::Random;
use crate::surface::generate::{Arguments, GenerateError, Generated, Parameter, grid, mesh};
use crate::surface::{Faces, Surface};

/// Upper bound on the number of squares, to bound memory.
const MOST_SQUARES: u64 = 4_000_000;

/// Parameters of flat regions made of squares.
pub(super) const PARAMETERS: &[Parameter] = &[
    Parameter::whole("n", 2, 1, 1000, "squares along a unit"),
    Parameter::choice("mesh", &["quad", "triangle"], "squares, split squares"),
    mesh::DIAGONAL,
    mesh::SEED,
];

/// Returns the flat region made of unit squares, given by their distinct lower left corners; each
/// is divided into `n × n` squares of side 1/n.
///
/// # Errors
/// More squares than [`MOST_SQUARES`].
pub(super) fn region(arguments: &Arguments, units: &[[i32; 2]]) -> Result<Generated, GenerateError> {
    let n = arguments.whole("n")?;
    if units.len() as u64 * n * n > MOST_SQUARES {
        let circumstance = format!(" with {} units", units.len());
        let most = (MOST_SQUARES / units.len() as u64).isqrt();
        return Err(arguments.out_of_range("n", circumstance, format!("at most {most}")));
    }
    let n = n as i32;
    let triangles = arguments.choice("mesh")? == "triangle";
    let diagonal = mesh::diagonal(arguments)?;
    let mut random = Random::new(arguments.whole("seed")?);
    let mut squares: Vec<[i32; 2]> = Vec::with_capacity(units.len() * (n * n) as usize);
    for &[x, y] in units {
        squares.extend((0..n).flat_map(|j| (0..n).map(move |i| [n * x + i, n * y + j])));
    }
    // SurfaceKind by row, so that neighbours are also close in memory.
    squares.sort_unstable_by_key(|&[x, y]| (y, x));
    let corners = |[x, y]: [i32; 2]| [(y, x), (y, x + 1), (y + 1, x + 1), (y + 1, x)];
    let mut vertices: Vec<(i32, i32)> = squares.iter().flat_map(|&square| corners(square)).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let place = |&(y, x): &(i32, i32)| [f64::from(x) / f64::from(n), f64::from(y) / f64::from(n), 0.0];
    let positions = vertices.iter().map(place).collect();
    let mut faces = Faces::with_capacity(2 * squares.len(), 6 * squares.len());
    for &square in &squares {
        let quad = corners(square).map(|corner| vertices.partition_point(|&v| v < corner) as u32);
        if triangles {
            let [i, j] = square.map(|x| x.rem_euclid(2) as usize);
            grid::push_split(&mut faces, quad, grid::split_along_first(diagonal, i, j, &mut random));
        } else {
            faces.push(&quad);
        }
    }
    let surface = Surface { positions, faces, face_normals: None };
    Ok(Generated { surface, exact: None, period: None, digital: None, name: String::new() })
}
