//! Many maps of one surface by one factorisation.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use riemap::Boundary;
use riemap::io::BoundaryLengths;

use crate::error::{Class, of_map, raise};
use crate::input::Input;
use crate::map::result;
use crate::options::map_options;
use crate::watch::Watch;

/// A surface that is mapped many times.
#[pyclass(frozen)]
pub struct Flattener {
    flattener: riemap::Flattener,
    input: Py<Input>,
}

#[pymethods]
impl Flattener {
    /// Prepares an input; `options` are JSON.
    #[new]
    fn new(py: Python<'_>, input: Py<Input>, options: &str) -> PyResult<Self> {
        let options = map_options(py, options)?;
        let surface = &input.get().inner;
        let flattener =
            py.detach(|| riemap::Flattener::of_input(surface, &options)).map_err(|error| of_map(py, &error))?;
        Ok(Flattener { flattener, input })
    }

    /// The vertices along the boundary, with the surface on the left.
    fn boundary<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        self.flattener.boundary().into_pyarray(py)
    }

    /// The map to the unit disc.
    #[pyo3(signature = (progress=None))]
    fn circle<'py>(&self, py: Python<'py>, progress: Option<Py<PyAny>>) -> PyResult<Bound<'py, PyDict>> {
        self.map(py, Boundary::CIRCLE, progress)
    }

    /// The free map; `lengths` are JSON.
    #[pyo3(signature = (lengths=None, progress=None))]
    fn free<'py>(
        &self,
        py: Python<'py>,
        lengths: Option<&str>,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let refused =
            |error: serde_json::Error| raise(py, Class::Option, &format!("lengths: {error}"), "value", &[], &[]);
        let lengths: Option<BoundaryLengths> = lengths.map(serde_json::from_str).transpose().map_err(refused)?;
        self.map(py, Boundary::Free { lengths, overlap: true }, progress)
    }

    /// The map with the boundary at these places, in its order.
    fn fixed<'py>(&self, py: Python<'py>, places: PyReadonlyArray2<'_, f64>) -> PyResult<Bound<'py, PyDict>> {
        let places = places.as_slice()?.as_chunks::<2>().0.to_vec();
        let watch = Watch::new(None);
        let mapped = py.detach(|| self.flattener.fixed(&places));
        result(py, &self.input.get().inner, mapped, watch)
    }
}

impl Flattener {
    fn map<'py>(
        &self,
        py: Python<'py>,
        boundary: Boundary,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let mut watch = Watch::new(progress);
        let mapped = py.detach(|| self.flattener.map(boundary, &mut watch));
        result(py, &self.input.get().inner, mapped, watch)
    }
}
