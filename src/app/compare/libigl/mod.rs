//! Calls to libigl, for comparison: its Python package runs in its own environment and exchanges
//! files with this program.
//!
//! [`Environment::ensure`] finds or creates the environment; [`harmonic`], [`lscm`] and [`slim`]
//! run `igl.harmonic`, `igl.lscm` and SLIM in it. Every call is one process, so that measurements
//! do not influence each other. A further function of libigl is one function in `calls.py` and one
//! file here, like `harmonic.rs`.
//!
//! | variable | value |
//! |---|---|
//! | `RIEMAP_PYTHON` | an interpreter that has libigl; no environment is created |
//! | `RIEMAP_PYTHON_ENV` | the folder of the environment, by default `riemap/libigl` in the user's cache folder (`$XDG_CACHE_HOME`, else `~/.cache`) |
//! | `PYTHON` | the interpreter that creates the environment, instead of `python3`, then `python` |
//!
//! The versions are pinned with the hashes of their wheels (`requirements.txt`), which pip checks.
//! An environment belongs to the user and is executed only if nobody else can write to it.

mod environment;
mod error;
mod exchange;
mod harmonic;
mod interpreter;
mod lscm;
mod ownership;
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
