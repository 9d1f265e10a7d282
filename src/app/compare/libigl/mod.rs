//! libigl itself, to compare with: its Python package in an environment of its own, called through files.
//!
//! [`Environment::ensure`] finds or makes the environment, once; [`harmonic`], [`lscm`] and [`slim`] run
//! `igl.harmonic`, `igl.lscm` and SLIM in it. Every call is
//! one process: nothing of one measurement is left to the next. A further function of libigl is one function in
//! `calls.py` and one here, like `harmonic.rs`.
//!
//! | variable | what it sets |
//! |---|---|
//! | `RIEMAP_PYTHON` | an interpreter that has libigl already; no environment is made |
//! | `RIEMAP_PYTHON_ENV` | the folder of the environment, in place of `target/riemap-python/libigl` |
//! | `PYTHON` | the interpreter that makes the environment, in place of `python3`, then `python` |
//! | `CARGO_TARGET_DIR` | in place of `target` |
//!
//! The versions are pinned (`requirements.txt`), not hashed: three Python ranges on three platforms are some 200 wheels.

mod environment;
mod error;
mod exchange;
mod harmonic;
mod interpreter;
mod lscm;
mod settings;
mod slim;

pub use environment::{Environment, VERSION};
pub use error::LibiglError;
pub use harmonic::{Harmonic, harmonic};
pub use interpreter::Versions;
pub(crate) use interpreter::command;
pub use lscm::{Lscm, lscm};
pub use settings::Settings;
pub(crate) use settings::program;
pub use slim::{Slim, slim};
