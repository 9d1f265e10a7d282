//! One file per command.

mod advice;
mod bench;
mod display;
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

use clap::{Parser, Subcommand};

pub use advice::advice;
pub use interrupt::EXIT_CODE;
pub use run::Interrupted;

/// Discrete conformal maps of quad meshes, triangle meshes and digital surfaces.
#[derive(Parser)]
#[command(version, max_term_width = 110)]
pub struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Tell what a surface is, what is wrong with it, and what to do
    Info(info::Arguments),
    /// Map a surface to the plane and write what is asked for
    Map(Box<map::Arguments>),
    /// Compare the cotan map with libigl's harmonic map, live
    Verify(verify::Arguments),
    /// Run experiments: one TOML file each, one record per run
    Run(run::Arguments),
    /// Run every experiment of the clone, and draw its figures
    Reproduce(reproduce::Arguments),
    /// Measure speed against peers, each run a process of its own
    Bench(bench::Arguments),
    /// Make one run of an experiment, as `run` does where each has a process of its own
    #[command(hide = true)]
    RunOne(one::Arguments),
    /// List surfaces, estimators of normals, energies, constraints, dual points, backends and cases of bench
    List,
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
        Command::List => list::run(out),
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
