//! What is mapped: arrays, files, voxels.

use std::path::Path;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use riemap::Surface;
use riemap::input::InputOptions;
use riemap::io::{self, Uv};
use riemap::surface::digital::{self, Adjacency, DigitalError, Solid};
use riemap::surface::edges::Edges;
use riemap::surface::normals::{Facets, estimate};

use crate::error::{Class, of_digital, of_input, of_map, of_write, raise};

/// A surface with what its source tells beside it.
#[pyclass(frozen)]
pub struct Input {
    /// As the library takes it.
    pub inner: riemap::Input,
}

/// Positions, corners of all faces, and how many corners each face has.
type Arrays<'py> = (Bound<'py, PyArray1<f64>>, Bound<'py, PyArray1<u32>>, Bound<'py, PyArray1<u32>>);

#[pymethods]
impl Input {
    /// The surface with these positions (n, 3) and faces, given by the vertex of every corner, face after face, and by the
    /// number of corners of every face; with one normal per face (m, 3) where there are some.
    #[staticmethod]
    #[pyo3(signature = (positions, corners, counts, normals=None))]
    fn of_arrays(
        py: Python<'_>,
        positions: PyReadonlyArray2<'_, f64>,
        corners: PyReadonlyArray1<'_, u32>,
        counts: PyReadonlyArray1<'_, u32>,
        normals: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<Self> {
        let mut rest = corners.as_slice()?;
        let polygons = counts.as_slice()?.iter().map(|&count| {
            let (polygon, after) = rest.split_at_checked(count as usize).unwrap_or_default();
            rest = after;
            polygon
        });
        let refused = |error: riemap::SurfaceError| of_map(py, &error.into());
        let mut surface = Surface::from_polygons(triples(&positions)?, polygons).map_err(refused)?;
        if let Some(normals) = normals {
            surface = surface.with_face_normals(triples(&normals)?).map_err(refused)?;
        }
        Ok(Input { inner: riemap::Input::of("surface".to_owned(), surface) })
    }

    /// The mesh or volume file, or the generated surface, of that name; `options` as JSON.
    #[staticmethod]
    fn open(py: Python<'_>, source: &str, options: &str) -> PyResult<Self> {
        let options: InputOptions = serde_json::from_str(options)
            .map_err(|error| raise(py, Class::Option, &error.to_string(), "value", &[], &[]))?;
        let opened = py.detach(|| riemap::Input::open_with(source, &options));
        opened.map(|inner| Input { inner }).map_err(|error| of_input(py, &error))
    }

    /// The boundary of a set of voxels, given by an array of booleans with the axes x, y, z.
    #[staticmethod]
    fn of_voxels(py: Python<'_>, inside: PyReadonlyArray3<'_, bool>, joined: bool, component: usize) -> PyResult<Self> {
        let solid = solid(&inside).map_err(|error| of_digital(py, &error))?;
        let adjacency = if joined { Adjacency::Eighteen } else { Adjacency::Six };
        let (surface, voxels) =
            py.detach(|| digital::boundary(solid, adjacency, component)).map_err(|error| of_digital(py, &error))?;
        let inner = riemap::Input::of("volume".to_owned(), surface);
        Ok(Input { inner: riemap::Input { digital: Some(voxels), ..inner } })
    }

    /// Positions, corners and counts of the surface.
    fn arrays<'py>(&self, py: Python<'py>) -> Arrays<'py> {
        let surface = &self.inner.surface;
        let counts: Vec<u32> = surface.faces().iter().map(|polygon| polygon.len() as u32).collect();
        (
            surface.positions().as_flattened().to_vec().into_pyarray(py),
            surface.faces().corners().to_vec().into_pyarray(py),
            counts.into_pyarray(py),
        )
    }

    /// Estimated unit normals, three numbers a face.
    fn normals<'py>(&self, py: Python<'py>, estimator: &str) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let surface = &self.inner.surface;
        let estimated = py.detach(|| {
            let edges = Edges::new(surface.faces(), surface.positions().len());
            estimate(estimator, &Facets::new(surface, &edges, self.inner.digital.as_ref())?)
        });
        let normals = estimated.map_err(|error| of_map(py, &error.into()))?;
        Ok(normals.into_flattened().into_pyarray(py))
    }

    /// Writes the surface, with texture coordinates (k, 2) where there are some: one pair for each vertex, or for each corner
    /// the number of its pair.
    #[pyo3(signature = (path, coordinates=None, corners=None))]
    fn write(
        &self,
        py: Python<'_>,
        path: &str,
        coordinates: Option<PyReadonlyArray2<'_, f64>>,
        corners: Option<PyReadonlyArray1<'_, u32>>,
    ) -> PyResult<()> {
        let pairs =
            coordinates.map(|pairs| Ok::<_, PyErr>(pairs.as_slice()?.as_chunks::<2>().0.to_vec())).transpose()?;
        let corners = corners.map(|corners| Ok::<_, PyErr>(corners.as_slice()?.to_vec())).transpose()?;
        let uv = pairs.as_deref().map(|coordinates| match &corners {
            None => Uv::PerVertex(coordinates),
            Some(corners) => Uv::PerCorner { coordinates, corners },
        });
        io::write(Path::new(path), &self.inner.surface, self.inner.vertex_text.as_ref(), uv)
            .map_err(|error| of_write(py, &error))
    }
}

/// The rows of an array of three columns.
fn triples(array: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<[f64; 3]>> {
    match array.as_slice()?.as_chunks::<3>() {
        (rows, []) => Ok(rows.to_vec()),
        _ => Err(PyValueError::new_err("an array of three columns is needed")),
    }
}

/// The voxels that are set.
fn solid(inside: &PyReadonlyArray3<'_, bool>) -> Result<Solid, DigitalError> {
    let inside = inside.as_array();
    let (width, height, depth) = inside.dim();
    let size = [width, height, depth];
    let padded = width.next_multiple_of(64) as u128 * height as u128 * depth as u128;
    if padded > u128::from(DigitalError::MOST_VOXELS) || size.iter().any(|&n| n > i32::MAX as usize) {
        return Err(DigitalError::TooLarge { size });
    }
    let mut solid = Solid::empty(size, [0.0; 3]);
    for ((i, j, k), _) in inside.indexed_iter().filter(|(_, inside)| **inside) {
        solid.insert([i as i32, j as i32, k as i32]);
    }
    match solid.is_empty() {
        true => Err(DigitalError::Empty { size }),
        false => Ok(solid),
    }
}
