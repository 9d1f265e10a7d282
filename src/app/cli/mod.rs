//! One file per command.

mod advice;
mod bench;
mod completions;
mod display;
mod experiments;
mod help;
mod index;
mod info;
mod interrupt;
mod list;
mod map;
mod one;
mod progress;
mod reproduce;
mod run;
mod source;
mod verify;

use std::io::Write;
use std::process::ExitCode;

use clap::{Parser, Subcommand};

pub use advice::advice;

/// Discrete conformal maps of quad meshes, triangle meshes and digital surfaces.
#[derive(Parser)]
#[command(version, max_term_width = 110, disable_help_subcommand = true)]
#[command(after_help = "`riemap help` lists topics: formats, energies, solvers, the report, experiment files, …")]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Describe a surface: its kind, counts and topology, its defects, and what to do about them
    Info(info::Arguments),
    /// Map a surface to the plane and write the outputs asked for
    Map(Box<map::Arguments>),
    /// Compare the cotan map with libigl's harmonic map, live
    Verify(verify::Arguments),
    /// Run experiments: one TOML file each, one record per run
    Run(run::Arguments),
    /// Run the experiments of a clone, all or by name, and draw their figures
    Reproduce(reproduce::Arguments),
    /// Measure speed against peers, each run a process of its own
    Bench(bench::Arguments),
    /// Make one run of an experiment, in the process that `run` starts for it
    #[command(hide = true)]
    RunOne(one::Arguments),
    /// List surfaces, normal estimators, energies, constraints, dual points, solvers and benchmark
    /// cases
    List(list::Arguments),
    /// Write the completion script of a shell to the standard output
    Completions(completions::Arguments),
    /// Explain a topic or a command; without either, list the topics
    Help(help::Arguments),
    /// Write the man page to the standard output
    #[command(hide = true)]
    Man,
}

/// Runs the command; `out` takes what it prints.
pub fn run(arguments: Arguments, out: &mut dyn Write) -> anyhow::Result<()> {
    match arguments.command {
        Command::Info(arguments) => info::run(&arguments, out),
        Command::Map(arguments) => map::run(&arguments, out),
        Command::Verify(arguments) => verify::run(&arguments, out),
        Command::Run(arguments) => run::run(&arguments, out),
        Command::Reproduce(arguments) => reproduce::run(&arguments, out),
        Command::Bench(arguments) => bench::run(&arguments, out),
        Command::RunOne(arguments) => one::run(&arguments),
        Command::List(arguments) => list::run(&arguments, out),
        Command::Completions(arguments) => completions::run(&arguments, out),
        Command::Help(arguments) => help::run(&arguments, out),
        Command::Man => completions::man(out),
    }
}

/// A request that was answered in full and does not end with exit code 0.
#[derive(Debug, thiserror::Error)]
pub enum Ended {
    /// A signal stopped the command.
    #[error("{0}")]
    BySignal(String),
    /// The map stopped at the user's own limit of iterations before it converged, and was written.
    #[error("not converged after {iterations} iterations, the limit given by --max-iterations; the map was written")]
    AtLimit {
        /// The iterations made.
        iterations: usize,
    },
}

/// The exit code of a command that failed: 130, 143 or 129 after a signal, 3 for a map written at
/// the user's own limit without convergence, otherwise 1.
pub fn exit_code(error: &anyhow::Error) -> ExitCode {
    match error.downcast_ref::<Ended>() {
        Some(Ended::BySignal(_)) => interrupt::exit_code_of_signal().into(),
        Some(Ended::AtLimit { .. }) => 3.into(),
        None => ExitCode::FAILURE,
    }
}

/// Parses a name of the library's enums as configuration files spell it.
fn by_name<T: serde::de::DeserializeOwned>(name: &str) -> Result<T, String> {
    use serde::de::IntoDeserializer;
    let deserializer: serde::de::value::StrDeserializer<serde::de::value::Error> = name.into_deserializer();
    T::deserialize(deserializer).map_err(|error| error.to_string())
}

/// `1 vertex`, `2 vertices`.
fn plural(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}
