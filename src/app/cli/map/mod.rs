//! `riemap map`: reads or generates a surface, maps it, and writes the outputs.

mod arguments;
mod idle;
mod output;
mod summary;
mod validity;
mod written;

use std::io::Write;

use anyhow::{Context, Result};

use crate::app::cli::advice::of_finding;
use crate::app::measure::stopwatch::Stopwatch;
use crate::map::periodic::Tiling;
use crate::map::{self, Ending};
use crate::report::Report;
use crate::solver::Status;

use super::progress::Progress;
use super::{Ended, interrupt};
pub use arguments::Arguments;
use arguments::OnInterrupt;
use idle::without_effect;
use output::{draw, refuse_outputs, write_all};
use summary::{print, warn};
use written::WrittenReport;

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    // Outputs that cannot be written are refused before anything is computed.
    refuse_outputs(arguments)?;
    let options = arguments.options()?;

    let watch = if arguments.trace.is_some() { Stopwatch::tracing() } else { Stopwatch::start() };
    let mut progress = Progress::new(watch, arguments.quiet);
    let input = arguments.source.open()?;
    let mapped = match interrupt::requested() {
        true => None,
        false => Some(map::map_input(&input, &options, &mut progress)),
    };
    progress.end();
    let mapped = match mapped {
        Some(Ok(mapped)) if !interrupt::requested() || arguments.on_interrupt == OnInterrupt::Write => mapped,
        Some(Err(error)) if !interrupt::requested() => return Err(error).with_context(|| input.source.clone()),
        _ => return Err(Ended::BySignal(format!("{}; nothing was written", interrupt::name())).into()),
    };
    let record = Report::new(&input, &mapped, progress.watch.cost());

    for finding in &mapped.findings {
        eprintln!("riemap: note: {finding}: {}", of_finding(finding));
    }
    for reason in without_effect(arguments, &options, &mapped) {
        eprintln!("riemap: note: {reason}");
    }
    warn(&options, &mapped);
    let pictures = draw(arguments, &input, &mapped, &record)?;
    write_all(arguments, &input, &mapped, &WrittenReport::new(&record, &options), &pictures, progress.watch.trace())?;
    if !arguments.quiet {
        print(out, &record)?;
        if let (Some(periods), Tiling::Whole) = (&record.periods, arguments.tiling) {
            let [[a, b], [c, d]] = periods.whole.matrix;
            let shear = 100.0 * periods.whole.shear;
            writeln!(out, "texture coordinates with the periods ({a}, {c}) and ({b}, {d}), sheared by {shear:.2} %")?;
        }
        for path in arguments.outputs() {
            writeln!(out, "wrote {}", path.display())?;
        }
    }
    if interrupt::requested() {
        return Err(Ended::BySignal(format!("{}; the best map so far was written", interrupt::name())).into());
    }
    // Without --max-iterations the library returns an error instead of a map that has not
    // converged.
    if mapped.map.ending == Ending::Minimised(Status::MaxIterations) && arguments.max_iterations.is_some() {
        return Err(Ended::AtLimit { iterations: mapped.map.iterations }.into());
    }
    Ok(())
}
