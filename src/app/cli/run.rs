use std::env;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::app::experiment::{Batch, Config, DataFile, Journal, Run, Settings, Shard, data_folders};

use super::display::Display;
use super::index::write_index;
use super::{interrupt, one, plural};

#[derive(Args)]
pub struct Arguments {
    /// Experiments: TOML files
    #[arg(value_name = "CONFIG.toml", required = true)]
    configs: Vec<PathBuf>,
    #[command(flatten)]
    options: Options,
    /// Folder of the results
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    results: PathBuf,
}

/// What `run` and `reproduce` have in common.
#[derive(Args, Clone)]
pub struct Options {
    /// Set a key of all of them, for example map.dual=incentre; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
    /// Make the long runs of [full], too
    #[arg(long)]
    pub full: bool,
    /// Run only every n-th run, beginning with the i-th; results of all shards merge
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    pub shard: Shard,
    /// Make everything again where a former command was interrupted; by default what it finished is kept
    #[arg(long)]
    pub fresh: bool,
}

/// Ctrl-C.
#[derive(Debug, thiserror::Error)]
#[error(
    "interrupted: {ended} of {total} runs are finished; the same command goes on from there, with --fresh from the start"
)]
pub struct Interrupted {
    ended: usize,
    total: usize,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let configs = load(&arguments.configs, &arguments.options)?;
    if let Some((config, data)) = absent(&configs).first() {
        bail!("{}: {data}", config.path);
    }
    let outcome = run_all(&configs, &arguments.options, &arguments.results, out);
    let written = write_index(configs, &arguments.options, &arguments.results, out);
    outcome.and(written)
}

/// Reads experiments, all before the first is run.
pub fn load(paths: &[PathBuf], options: &Options) -> Result<Vec<Config>> {
    let data = data_folders(env::var_os("RIEMAP_DATA"));
    let settings = Settings { sets: options.set.clone(), full: options.full, data };
    Ok(paths.iter().map(|path| Config::load_with(path, &settings)).collect::<Result<_, _>>()?)
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

/// Runs and sums up experiments.
pub fn run_all(configs: &[Config], options: &Options, results: &Path, out: &mut dyn Write) -> Result<()> {
    interrupt::listen();
    let threads = available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let journal = Journal::of_this_program(results)?;
    if options.fresh {
        journal.forget(configs, options.shard)?;
    }
    let program = env::current_exe().context("the program does not find itself")?;
    let apart = |config: &Config, run: &Run| one::command(&program, config, run, options, results);
    let batch = Batch { configs, shard: options.shard, results, threads, apart: Some(&apart), journal: Some(&journal) };
    let total = batch.runs().count();
    let mut display = Display::new(total);
    let (mut shown, unheard) = (Ok(()), AtomicBool::new(false));
    let stop = || interrupt::requested() || unheard.load(Ordering::Relaxed);
    batch.run(&stop, &mut |event| {
        if shown.is_ok() {
            shown = display.show(&event, out);
            unheard.store(shown.is_err(), Ordering::Relaxed);
        }
    })?;
    display.clear();
    shown?;
    for complaint in &display.complaints {
        writeln!(out, "! {complaint}")?;
    }
    writeln!(out, "{}", display.summary())?;
    if interrupt::requested() && display.ended() < total {
        return Err(Interrupted { ended: display.ended(), total }.into());
    }
    if display.unexpected > 0 {
        bail!("{} without the expected result", plural(display.unexpected, "run", "runs"));
    }
    if !display.complaints.is_empty() {
        bail!("{} without tables and plots", plural(display.complaints.len(), "experiment", "experiments"));
    }
    Ok(())
}
