//! `riemap map`.

mod arguments;
mod output;
mod summary;
mod validity;

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
use arguments::{OnInterrupt, options, without_effect};
use output::{draw, refuse_outputs, write_all};
use summary::{print, warn};

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    // What cannot be written is refused before anything is computed.
    refuse_outputs(arguments)?;
    let options = options(arguments)?;

    let watch = if arguments.trace.is_some() { Stopwatch::tracing() } else { Stopwatch::start() };
    let mut progress = Progress::new(watch, arguments.quiet);
    let input = arguments.source.open()?;
    let mapped = map::map_input(&input, &options, &mut progress);
    progress.clear();
    let mapped = mapped.with_context(|| input.source.clone())?;
    let interrupted = mapped.map.ending == Ending::Minimised(Status::Interrupted);
    if interrupted && arguments.on_interrupt == OnInterrupt::Keep {
        let signal = interrupt::name();
        return Err(Ended::BySignal(format!("{signal}; nothing was written (--on-interrupt write)")).into());
    }
    let record = Report::new(&input, &mapped, progress.watch.cost());

    for finding in &mapped.findings {
        eprintln!("riemap: note: {finding}: {}", of_finding(finding));
    }
    for reason in without_effect(arguments, &options, &mapped) {
        eprintln!("riemap: note: {reason}");
    }
    warn(&options, &mapped);
    let pictures = draw(arguments, &input, &mapped, &record)?;
    write_all(arguments, &input, &mapped, &record, &pictures, progress.watch.trace())?;
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
    match mapped.map.ending {
        Ending::Minimised(Status::Interrupted) => {
            Err(Ended::BySignal(format!("{}; the best map so far was written", interrupt::name())).into())
        }
        // Without a limit of the user's an unconverged map is an error of the library.
        Ending::Minimised(Status::MaxIterations) if arguments.max_iterations.is_some() => {
            Err(Ended::AtLimit { iterations: mapped.map.iterations }.into())
        }
        _ => Ok(()),
    }
}
