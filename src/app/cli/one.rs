//! `riemap run-one`: one run of an experiment in its own process, as `run` and `reproduce` start it
//! for runs with a time limit.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::Result;
use clap::Args;

use crate::app::experiment::{Config, Run, Scratch, make_one};

use super::experiments::{Options, load};

/// The name of the command.
const NAME: &str = "run-one";

#[derive(Args)]
pub struct Arguments {
    /// The experiment: a TOML file
    #[arg(value_name = "CONFIG.toml")]
    config: PathBuf,
    /// Position of the run among those of the config, from 0
    #[arg(long)]
    position: usize,
    #[command(flatten)]
    options: Options,
    /// Folder of the results
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    results: PathBuf,
    /// Name of the program that calls, under which the record is kept until all runs have ended
    #[arg(long, value_name = "NAME")]
    program: String,
}

pub fn run(arguments: &Arguments) -> Result<()> {
    for config in load(std::slice::from_ref(&arguments.config), &arguments.options)? {
        make_one(&Scratch::new(&arguments.results, &arguments.program), &config, arguments.position)?;
    }
    Ok(())
}

/// Returns the command that makes one run.
pub fn command(program: &Path, config: &Config, run: &Run, options: &Options, scratch: &Scratch) -> Command {
    let mut command = Command::new(program);
    command.args([
        NAME,
        &config.path,
        "--full",
        "--position",
        &run.position.to_string(),
        "--program",
        scratch.program(),
    ]);
    command.arg("--results").arg(scratch.results());
    for set in &options.set {
        command.args(["--set", set]);
    }
    command
}
