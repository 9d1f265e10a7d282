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
//! | `RIEMAP_PYTHON_ENV` | the folder of the environment, by default `riemap/libigl` in the user's cache folder (`$XDG_CACHE_HOME`, else `~/.cache`) |
//! | `PYTHON` | the interpreter that makes the environment, in place of `python3`, then `python` |
//!
//! The versions are pinned with the hashes of their wheels (`requirements.txt`), which pip checks. An environment belongs to
//! the user and is executed only if nobody else can write to it.

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
