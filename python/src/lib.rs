//! The extension module `riemap._native` behind the Python package `riemap`: the library's functions on NumPy arrays.
//!
//! Arrays are checked and brought into one form by the package, options arrive as JSON and are read by
//! [`FlatOptions`](riemap::map::FlatOptions), as those of experiments are, and reports leave as JSON.

mod error;
mod flattener;
mod input;
mod map;
mod matrix;
mod options;
mod watch;

use pyo3::prelude::*;

/// The module that Python loads.
#[pymodule]
mod _native {
    #[pymodule_export]
    use crate::flattener::Flattener;
    #[pymodule_export]
    use crate::input::Input;
    #[pymodule_export]
    use crate::map::map;
    #[pymodule_export]
    use crate::matrix::{laplacian, system};
}
