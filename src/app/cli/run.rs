//! `riemap run`: experiments by file.

use std::env;
use std::io::Write;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::available_parallelism;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::app::experiment::{Batch, Config, Run, Scratch};

use super::display::Display;
use super::experiments::{Options, absent, load};
use super::index::write_index;
use super::{Ended, interrupt, one, plural};

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

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let configs = load(&arguments.configs, &arguments.options)?;
    if let Some((config, data)) = absent(&configs).first() {
        bail!("{}: {data}", config.path);
    }
    let outcome = run_all(&configs, &arguments.options, &arguments.results, out);
    let written = write_index(configs, &arguments.options, &arguments.results, out);
    outcome.and(written)
}

/// Runs experiments and writes their summaries.
pub fn run_all(configs: &[Config], options: &Options, results: &Path, out: &mut dyn Write) -> Result<()> {
    interrupt::listen();
    let threads = available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let scratch = &Scratch::of_this_program(results)?;
    if options.fresh {
        scratch.forget(configs, options.shard)?;
    }
    let program = env::current_exe().context("the program does not find itself")?;
    let apart = |config: &Config, run: &Run| one::command(&program, config, run, options, scratch);
    let batch = Batch { configs, shard: options.shard, threads, apart: Some(&apart), scratch };
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
        let (signal, ended) = (interrupt::name(), display.ended());
        return Err(Ended::BySignal(format!(
            "{signal}: {ended} of {total} runs are finished; the same command goes on from there, with --fresh from the start"
        ))
        .into());
    }
    if display.unexpected > 0 {
        bail!("{} without the expected result", plural(display.unexpected, "run", "runs"));
    }
    if !display.complaints.is_empty() {
        bail!("{} without tables and plots", plural(display.complaints.len(), "experiment", "experiments"));
    }
    Ok(())
}
