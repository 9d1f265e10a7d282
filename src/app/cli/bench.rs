//! `riemap bench`: speed beside other programs.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use anyhow::{Context, Result, bail};
use clap::Args;

use crate::app::bench::{self, ContestOutcome, Entry, Event, Peers, Plan, Record};
use crate::app::compare::libigl::{Environment, Settings};
use crate::app::experiment::data_folders;
use crate::io::can_be_written;

#[derive(Args)]
pub struct Arguments {
    /// Cases, as `riemap list` names them; without any, all of them
    #[arg(value_name = "CASE")]
    cases: Vec<String>,
    /// Approximate numbers of vertices [default: 10000,100000,1000000]
    #[arg(long, value_name = "N,N,…", value_delimiter = ',', value_parser = clap::value_parser!(u64).range(16..=20_000_000))]
    sizes: Vec<u64>,
    /// Runs of each contestant on each mesh; long runs are repeated less often [default: 3]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=99))]
    repeats: Option<u64>,
    /// Check that everything is installed: one run of 1000 vertices, written only if --results is
    /// given
    #[arg(long)]
    quick: bool,
    /// Time limit of a process in seconds
    #[arg(long, value_name = "SECONDS", default_value_t = 120, value_parser = clap::value_parser!(u64).range(1..=86_400))]
    limit: u64,
    /// Python 3 interpreter with the peers [default: $RIEMAP_PYTHON, or an environment created on
    /// first use]
    ///
    /// The peers are the packages libigl, numpy, scipy, scikit-sparse and pymeshlab. The
    /// environment is in the user's cache folder.
    #[arg(long, value_name = "PROGRAM", conflicts_with = "no_peers")]
    python: Option<PathBuf>,
    /// The program of Boundary First Flattening, bff-command-line; it takes part where it is named
    #[arg(long, value_name = "PROGRAM", conflicts_with = "no_peers")]
    bff: Option<PathBuf>,
    /// Compile scikit-sparse with the CHOLMOD of the system into that environment, if it is missing
    #[arg(long, conflicts_with_all = ["no_peers", "python"])]
    build_scikit_sparse: bool,
    /// Measure only riemap
    #[arg(long)]
    no_peers: bool,
    /// Folder whose subfolder bench/ takes the results [default: results]
    #[arg(long, value_name = "FOLDER")]
    results: Option<PathBuf>,
}

/// Time after which a contestant is not run on the same mesh again.
const PATIENCE: Duration = Duration::from_secs(15);

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    let plan = plan(arguments)?;
    // Requests that must fail are refused before hours are spent.
    bench::chosen(&plan.cases)?;
    let folder = folder(arguments);
    folder.as_deref().map_or(Ok(()), can_take)?;
    let peers = peers(arguments)?;
    // A closed output ends the run.
    let mut printed = Ok(());
    let record = bench::run(&plan, peers.as_ref(), &mut |event| {
        if printed.is_ok() {
            printed = print(out, &event);
        }
    })?;
    printed?;
    writeln!(out, "\n{}", bench::bars(&bench::verdicts(&record)))?;
    if let Some(folder) = folder {
        for path in bench::write(&record, &folder)? {
            writeln!(out, "wrote {}", path.display())?;
        }
    }
    fail_where_ours_did(&record)
}

/// Fails if the results cannot be written, as far as this is known without writing.
fn can_take(folder: &Path) -> Result<()> {
    let there = folder.ancestors().find(|path| path.exists()).unwrap_or(Path::new("."));
    if !there.is_dir() && there != Path::new("") {
        bail!("{}: {} is no folder", folder.display(), there.display());
    }
    if folder.exists() {
        bench::FILES.iter().try_for_each(|name| can_be_written(&folder.join(name)))?;
    }
    Ok(())
}

/// Returns the folder of the results.
fn folder(arguments: &Arguments) -> Option<PathBuf> {
    let results = match &arguments.results {
        Some(results) => results.clone(),
        None if arguments.quick => return None,
        None => PathBuf::from("results"),
    };
    Some(results.join("bench"))
}

fn plan(arguments: &Arguments) -> Result<Plan> {
    let sizes: Vec<usize> = match (arguments.sizes.as_slice(), arguments.quick) {
        ([], true) => vec![1_000],
        ([], false) => vec![10_000, 100_000, 1_000_000],
        (sizes, _) => sizes.iter().map(|&n| n as usize).collect(),
    };
    // Contestants run in a folder of their own.
    let absolute = |path: &PathBuf| path.canonicalize().with_context(|| format!("--bff {}", path.display()));
    Ok(Plan {
        cases: arguments.cases.clone(),
        sizes,
        against_peers: !arguments.no_peers,
        bff: arguments.bff.as_ref().map(absolute).transpose()?,
        repeats: arguments.repeats.unwrap_or(if arguments.quick { 1 } else { 3 }) as usize,
        limit: Duration::from_secs(arguments.limit),
        patience: PATIENCE,
        data: data_folders(std::env::var_os("RIEMAP_DATA")),
    })
}

/// Returns the interpreter with the peers. One that the user named must work; our own environment
/// may be missing.
fn peers(arguments: &Arguments) -> Result<Option<Peers>> {
    if arguments.no_peers {
        return Ok(None);
    }
    if let Some(python) = &arguments.python {
        return Ok(Some(Peers::of(python)?));
    }
    let settings = Settings::from_variables();
    let own = Peers::settings(&settings);
    if !Environment::is_ready(&own) {
        eprintln!("riemap: making a Python environment with the peers in {} (once)", own.folder.display());
    }
    let named = settings.interpreter.is_some();
    match Peers::ensure(&settings, arguments.build_scikit_sparse, &mut |problem| {
        eprintln!("riemap: warning: {problem}")
    }) {
        Ok(peers) => Ok(Some(peers)),
        Err(error) if named => Err(error).context("$RIEMAP_PYTHON"),
        Err(error) => {
            eprintln!("riemap: warning: there are no peers: {error}");
            Ok(None)
        }
    }
}

fn print(out: &mut dyn Write, event: &Event) -> Result<()> {
    match event {
        Event::Mesh { case, vertices, faces } => {
            writeln!(out, "\n{case}: {vertices} vertices, {faces} faces")?;
            writeln!(
                out,
                "  {:<18} {:>9} {:>9} {:>9} {:>9} {:>8} {:>8} {:>7} {:>8}",
                "cpu seconds", "solve", "factor", "whole", "wall", "peak MB", "σ₁/σ₂", "flipped", "ours/its"
            )?;
        }
        Event::Entry(entry) => line(out, entry)?,
        Event::PassedOver(reason) => writeln!(out, "\n{reason}")?,
    }
    out.flush()?;
    Ok(())
}

fn line(out: &mut dyn Write, entry: &Entry) -> Result<()> {
    let Entry { contestant, outcome, ratio, .. } = entry;
    let (median, quality) = match outcome {
        ContestOutcome::Done { median, quality } => (median, quality),
        ContestOutcome::Failed { reason } => return Ok(writeln!(out, "  {contestant:<18} failed: {reason}")?),
        ContestOutcome::LeftOut { install, .. } => {
            return Ok(writeln!(out, "  {contestant:<18} {}: {install}", bench::brief(outcome))?);
        }
        ContestOutcome::OverTheLimit { .. } => {
            return Ok(writeln!(out, "  {contestant:<18} {}", bench::brief(outcome))?);
        }
    };
    let seconds = |s: Option<f64>| s.map_or("–".to_owned(), |s| format!("{s:.3}"));
    writeln!(
        out,
        "  {contestant:<18} {:>9} {:>9} {:>9} {:>9.3} {:>8} {:>8} {:>7} {:>8}",
        seconds(median.solve.and_then(|s| s.cpu)),
        seconds(median.factor.and_then(|s| s.cpu)),
        seconds(median.whole.cpu),
        median.whole.wall,
        median.peak_bytes.map_or("–".to_owned(), |bytes| (bytes / 1_000_000).to_string()),
        quality.quasi_conformal.map_or("–".to_owned(), |error| format!("{error:.4}")),
        quality.flipped,
        ratio.map_or(String::new(), |ratio| format!("{ratio:.3}")),
    )?;
    Ok(())
}

/// Fails if a run of riemap failed. A peer that fails is only a line of the table.
fn fail_where_ours_did(record: &Record) -> Result<()> {
    let ours = |entry: &&Entry| bench::contestant(entry.contestant).is_some_and(|contestant| contestant.is_ours());
    for entry in record.entries.iter().filter(ours) {
        if let ContestOutcome::Failed { reason } = &entry.outcome {
            bail!("{} failed on {} at {} vertices: {reason}", entry.contestant, entry.case, entry.vertices);
        }
    }
    Ok(())
}
