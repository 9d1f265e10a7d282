//! `riemap map`.

mod arguments;
mod output;
mod summary;

use std::io::Write;

use anyhow::{Context, Result, bail};

use riemap::backend::Status;
use riemap::figure::Format;
use riemap::input::Input;
use riemap::map::{self, Outcome};
use riemap::report::Report;
use riemap::stopwatch::Stopwatch;

use super::progress::Progress;
pub use arguments::Arguments;
use arguments::{options, without_effect};
use output::{draw, refuse_outputs, write_all};
use summary::{print, warn};

pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<()> {
    // What cannot be written is refused before anything is computed.
    refuse_outputs(arguments)?;
    let picture_format = arguments.picture.as_deref().map(Format::from_path).transpose()?;
    let options = options(arguments)?;

    let watch = if arguments.trace.is_some() { Stopwatch::tracing() } else { Stopwatch::start() };
    let mut progress = Progress::new(watch, arguments.quiet);
    let input = Input::open(&arguments.mesh)?;
    let mapped = map::run(&input, &options, &mut progress);
    progress.clear();
    let mapped = mapped.with_context(|| input.source.clone())?;
    let record = Report::new(&input, &mapped, progress.watch.seconds());

    for finding in &mapped.findings {
        eprintln!("riemap: note: {finding}: {}", finding.advice());
    }
    for reason in without_effect(arguments, &options, mapped.disc.faces.arity() == Some(3)) {
        eprintln!("riemap: note: {reason}");
    }
    warn(&options, &mapped);
    let picture = picture_format.map(|format| draw(&mapped, &record, format)).transpose()?;
    write_all(arguments, &input, &mapped, &record, picture, progress.watch.trace())?;
    if !arguments.quiet {
        print(out, &record)?;
        for path in arguments.outputs() {
            writeln!(out, "wrote {}", path.display())?;
        }
    }
    if mapped.map.outcome == Outcome::Minimised(Status::Interrupted) {
        bail!("interrupted; the best map so far was written");
    }
    Ok(())
}
