//! The program `riemap`: runs the command line and turns errors into messages and exit codes.

use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

use clap::Parser;
use riemap::app::cli;

fn main() -> ExitCode {
    let mut out = io::stdout().lock();
    let result = cli::run(cli::Arguments::parse(), &mut out);
    match result.and_then(|()| Ok(out.flush()?)) {
        Ok(()) => ExitCode::SUCCESS,
        // The reader of the output, such as `head`, has read enough.
        Err(error) if is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("riemap: error: {}{}", message(&error), cli::advice(&error));
            cli::exit_code(&error)
        }
    }
}

fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| cause.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == ErrorKind::BrokenPipe))
}

/// Joins an error and its causes, leaving out causes that the text before them contains.
fn message(error: &anyhow::Error) -> String {
    let mut text = String::new();
    for cause in error.chain().map(|cause| cause.to_string()) {
        if !text.contains(&cause) {
            let separator = if text.is_empty() { "" } else { ": " };
            text = text + separator + &cause;
        }
    }
    text
}
