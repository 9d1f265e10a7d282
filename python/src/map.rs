//! One surface to one map.

use numpy::IntoPyArray;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use riemap::distortion::face_maps;
use riemap::map::Tiling;
use riemap::report::Cost;
use riemap::surface::oriented_mesh::OrientedMesh;
use riemap::{Mapped, Report};

use crate::error::{Class, of_map, raise};
use crate::input::Input;
use crate::options::map_options;
use crate::watch::Watch;

/// Maps an input; `options` are JSON, `progress` is called with the phase and the iteration.
#[pyfunction]
#[pyo3(signature = (input, options, progress=None))]
pub fn map<'py>(
    py: Python<'py>,
    input: &Input,
    options: &str,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let options = map_options(py, options)?;
    let mut watch = Watch::new(progress);
    let mapped = py.detach(|| riemap::map_input(&input.inner, &options, &mut watch));
    result(py, &input.inner, mapped, watch)
}

/// The arrays of a map, or the exception for what kept it from being made.
pub fn result<'py>(
    py: Python<'py>,
    input: &riemap::Input,
    mapped: Result<Mapped, riemap::MapError>,
    watch: Watch,
) -> PyResult<Bound<'py, PyDict>> {
    // An interrupted map is no map, and an error after an interruption is not the reason.
    let cost = watch.cost()?;
    let mapped = mapped.map_err(|error| of_map(py, &error))?;
    arrays(py, input, &mapped, cost)
}

/// The map as flat arrays and a report in JSON.
fn arrays<'py>(py: Python<'py>, input: &riemap::Input, mapped: &Mapped, cost: Cost) -> PyResult<Bound<'py, PyDict>> {
    let disc = &mapped.domain.disc;
    let report = serde_json::to_string(&Report::new(input, mapped, cost))
        .map_err(|error| raise(py, Class::Convergence, &error.to_string(), "report", &[], &[]))?;
    let uv: Vec<[f64; 2]> = mapped.uv().into_iter().map(|pair| pair.unwrap_or([f64::NAN; 2])).collect();
    let texture = mapped.texture_coordinates(&input.surface, Tiling::Conformal);
    let boundary: Vec<u32> = disc.boundary.iter().map(|&v| disc.source_vertex[v as usize]).collect();

    let faces = input.surface.faces().len();
    let (mut sigma1, mut sigma2, mut area) = (vec![f64::NAN; faces], vec![f64::NAN; faces], vec![f64::NAN; faces]);
    let mut flipped = vec![false; faces];
    let maps = face_maps(disc, &mapped.domain.graph, &mapped.image());
    for (map, &face) in maps.iter().zip(&disc.source_face).filter(|(_, face)| **face != OrientedMesh::NEW) {
        let face = face as usize;
        (sigma1[face], sigma2[face], area[face]) = (map.sigma1, map.sigma2, map.area);
        flipped[face] = !map.positive;
    }

    let arrays = PyDict::new(py);
    arrays.set_item("uv", uv.into_flattened().into_pyarray(py))?;
    arrays.set_item("uv_corner", texture.coordinates.into_flattened().into_pyarray(py))?;
    arrays.set_item("corners_uv", texture.corners.map(|corners| corners.into_pyarray(py)))?;
    arrays.set_item("boundary", boundary.into_pyarray(py))?;
    arrays.set_item("sigma1", sigma1.into_pyarray(py))?;
    arrays.set_item("sigma2", sigma2.into_pyarray(py))?;
    arrays.set_item("area", area.into_pyarray(py))?;
    arrays.set_item("flipped", flipped.into_pyarray(py))?;
    arrays.set_item("report", report)?;
    Ok(arrays)
}
