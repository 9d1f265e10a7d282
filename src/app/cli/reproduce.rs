//! `riemap reproduce`: the experiments of a clone, by name.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;

use crate::app::experiment::{EXPERIMENTS, has_experiments, remove_stale};

use super::experiments::{Options, absent, load};
use super::index::{experiment_files, name, write_index};
use super::run::run_all;

#[derive(Args)]
pub struct Arguments {
    /// Names of experiments, as in experiments/NAME.toml; without any, all of them
    #[arg(value_name = "NAME")]
    names: Vec<String>,
    #[command(flatten)]
    options: Options,
    /// Folder of the results [default: results]
    #[arg(long, value_name = "FOLDER")]
    results: Option<PathBuf>,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    if !has_experiments() {
        bail!(
            "there is no folder `experiments` here: change into a clone of riemap, which has one, or use `riemap run \
             CONFIG.toml`"
        );
    }
    let experiments = Path::new(EXPERIMENTS);
    let mut paths = experiment_files(experiments)?;
    if !arguments.names.is_empty() {
        let known: Vec<String> = paths.iter().map(|path| name(path)).collect();
        if let Some(unknown) = arguments.names.iter().find(|name| !known.contains(name)) {
            bail!("unknown experiment `{unknown}`; {} has: {}", experiments.display(), known.join(", "));
        }
        paths.retain(|path| arguments.names.contains(&name(path)));
    }
    let results = arguments.results.clone().unwrap_or_else(|| PathBuf::from("results"));
    let configs = load(&paths, &arguments.options)?;
    for (config, data) in absent(&configs) {
        writeln!(out, "{} passed over: {data}", config.name)?;
    }
    // With settings of the command line, the config may have fewer runs than usual.
    if arguments.options.set.is_empty() {
        for config in &configs {
            for run in remove_stale(config, &results)? {
                writeln!(out, "{} {run} removed: {} has no such run", config.name, config.path)?;
            }
        }
    }
    let outcome = run_all(&configs, &arguments.options, &results, out);
    let written = write_index(configs, &arguments.options, &results, out);
    outcome.and(written)
}
