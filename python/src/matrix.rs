//! Sparse matrices.

use numpy::{Complex64, IntoPyArray, PyArray1};
use pyo3::prelude::*;
use riemap::laplacian::Colouring;
use riemap::map::Domain;
use riemap::problem::linear;
use riemap::quad_graph::QuadGraph;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::{Boundary, MapError, MapOptions};

use crate::error::{Class, of_map, raise};
use crate::input::Input;
use crate::options::map_options;

/// Values, row indices, column offsets and shape of a matrix stored by columns.
type Csc<'py> = (Bound<'py, PyArray1<Complex64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, (usize, usize));

/// Values, rows and columns of entries, those at one place to be added, and the shape.
type Entries<'py> =
    (Bound<'py, PyArray1<Complex64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, (usize, usize));

/// System (2) of an input: one row per quad of the quad graph, one column per vertex of it.
#[pyfunction]
pub fn system<'py>(py: Python<'py>, input: &Input, options: &str) -> PyResult<Csc<'py>> {
    let options = map_options(py, options)?;
    let made = py.detach(|| quad_graph(&input.inner, &options).map(|graph| linear::system(&graph)));
    let matrix = made.map_err(|error| of_map(py, &error))?;
    let shape = (matrix.nrows(), matrix.ncols());
    let (offsets, rows, values) = matrix.disassemble();
    Ok((values.into_pyarray(py), signed(rows).into_pyarray(py), signed(offsets).into_pyarray(py), shape))
}

/// The conformal Laplacian of an input, entry by entry: every quad adds ρ at (i, i) and (j, j), −ρ at (i, j) and (j, i), where i
/// and j are the ends of its black diagonal.
#[pyfunction]
pub fn laplacian<'py>(py: Python<'py>, input: &Input, options: &str) -> PyResult<Entries<'py>> {
    let options = map_options(py, options)?;
    let graph = py.detach(|| quad_graph(&input.inner, &options)).map_err(|error| of_map(py, &error))?;
    let colouring = Colouring::new(&graph)
        .map_err(|error| raise(py, Class::Mesh, &error.to_string(), "not-two-coloured", &[], &[]))?;
    let (mut values, mut rows, mut columns) = (Vec::new(), Vec::new(), Vec::new());
    for quad in colouring.quads(&graph) {
        let [i, j] = quad.black.map(i64::from);
        for (row, column, value) in [(i, i, quad.rho), (j, j, quad.rho), (i, j, -quad.rho), (j, i, -quad.rho)] {
            rows.push(row);
            columns.push(column);
            values.push(value);
        }
    }
    let shape = (graph.primal, graph.primal);
    Ok((values.into_pyarray(py), rows.into_pyarray(py), columns.into_pyarray(py), shape))
}

/// The quad graph of an input, ρ from its positions.
fn quad_graph(input: &riemap::Input, options: &MapOptions) -> Result<QuadGraph, MapError> {
    let diagnosis = input.diagnosis();
    let (mesh, _) = match options.boundary {
        Boundary::Periodic => OrientedMesh::closed(&input.surface, &diagnosis, options.fill_holes)?,
        _ => OrientedMesh::open(&input.surface, &diagnosis, &options.opening())?,
    };
    Ok(Domain::of_positions(mesh, options)?.graph)
}

fn signed(indices: Vec<usize>) -> Vec<i64> {
    indices.into_iter().map(|index| index as i64).collect()
}
