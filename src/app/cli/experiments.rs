//! Experiments as commands name them: the options that commands share, and how files are loaded.

use std::env;
use std::path::PathBuf;

use anyhow::Result;
use clap::Args;

use crate::app::experiment::{Config, DataFile, Settings, Shard, check_figures, data_folders};

/// The options that `run` and `reproduce` share.
#[derive(Args, Clone)]
pub struct Options {
    /// Set a key of every experiment, for example map.dual=incentre; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Make the long runs of [full] too
    #[arg(long)]
    pub full: bool,
    /// Run only every n-th run, beginning with the i-th; results of all shards merge
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
    /// Make every run again; by default, runs that an interrupted command finished are kept
    #[arg(long)]
    pub fresh: bool,
}

/// Reads experiments, all before the first is run.
pub fn load(paths: &[PathBuf], options: &Options) -> Result<Vec<Config>> {
    let data = data_folders(env::var_os("RIEMAP_DATA"));
    let settings = Settings { sets: options.set.clone(), full: options.full, data };
    let configs = paths.iter().map(|path| Config::load_with(path, &settings)).collect::<Result<Vec<_>, _>>()?;
    check_figures(&configs)?;
    Ok(configs)
}

/// The public files that are needed and not there, each once for every config that needs it.
pub fn absent(configs: &[Config]) -> Vec<(&Config, &DataFile)> {
    let mut absent = Vec::new();
    for config in configs {
        for data in config.runs.iter().filter_map(|run| run.data.as_ref()).filter(|data| data.path.is_none()) {
            if !absent.iter().any(|&(c, d): &(&Config, &DataFile)| c.path == config.path && d.name == data.name) {
                absent.push((config, data));
            }
        }
    }
    absent
}
