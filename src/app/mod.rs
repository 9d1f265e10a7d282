//! The application on top of the library: the command line, experiments, comparisons with other programs, benchmarks.

pub mod bench;
pub mod cli;
pub mod compare;
pub mod experiment;
pub mod measure;
