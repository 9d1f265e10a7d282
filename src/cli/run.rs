use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::Args;

use riemap::experiment::{self, Config, Outcome, Progress, Shard};

use super::plural;

#[derive(Args)]
pub struct Arguments {
    /// Experiments: TOML files
    #[arg(value_name = "CONFIG.toml", required = true)]
    configs: Vec<PathBuf>,
    /// Set a key of all of them, for example map.dual=incentre; repeatable
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Run only every n-th run, beginning with the i-th; results of all shards merge
    #[arg(long, value_name = "I/N", default_value = "1/1")]
    shard: Shard,
    /// Folder of the results
    #[arg(long, value_name = "FOLDER", default_value = "results")]
    results: PathBuf,
}

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    run_all(&arguments.configs, &arguments.set, arguments.shard, &arguments.results, out)
}

/// Runs and sums up experiments; all are read before the first is run.
pub fn run_all(paths: &[PathBuf], sets: &[String], shard: Shard, results: &Path, out: &mut dyn Write) -> Result<()> {
    let configs: Vec<Config> = paths.iter().map(|path| Config::load(path, sets)).collect::<Result<_, _>>()?;
    let mut failed = 0;
    for config in &configs {
        writeln!(out, "{}: {}", config.path, config.title)?;
        let mut printed = Ok(());
        let records = experiment::run(config, shard, results, |progress| {
            if printed.is_ok() {
                printed = print(progress, out);
            }
        })?;
        printed?;
        failed += records.iter().filter(|record| record.outcome != Outcome::Done).count();
        let summary = experiment::summarise(config, results)?;
        writeln!(out, "  records: {}", results.join(&config.name).display())?;
        for file in &summary.files {
            writeln!(out, "  wrote {}", file.display())?;
        }
    }
    if failed > 0 {
        bail!("{} without the expected result", plural(failed, "run", "runs"));
    }
    Ok(())
}

fn print(progress: Progress, out: &mut dyn Write) -> std::io::Result<()> {
    let Progress { position, total, record, seconds } = progress;
    let (outcome, error) = match record.outcome {
        Outcome::Done => ("done", String::new()),
        Outcome::Refuted => ("REFUTED", format!(": {}", record.error.as_deref().unwrap_or_default())),
        Outcome::Failed => ("FAILED", format!(": {}", record.error.as_deref().unwrap_or_default())),
    };
    writeln!(out, "  {}/{total}  {}  {seconds:.2} s  {outcome}{error}", position + 1, record.run)?;
    // Seen at once, also through a pipe.
    out.flush()
}
