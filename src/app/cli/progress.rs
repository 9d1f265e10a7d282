use std::io::{IsTerminal, Write, stderr};
use std::time::{Duration, Instant};

use crate::app::measure::stopwatch::Stopwatch;
use crate::solver::{Iteration, Observer, Phase};

use super::interrupt;

/// A stopwatch that shows the iterations on a terminal, and hears Ctrl-C.
pub struct Progress {
    pub watch: Stopwatch,
    shown: Option<Instant>,
    shows: bool,
}

impl Progress {
    /// Shows nothing where `quiet`, or where the standard error stream is no terminal.
    pub fn new(watch: Stopwatch, quiet: bool) -> Self {
        interrupt::listen();
        Progress { watch, shown: None, shows: !quiet && stderr().is_terminal() }
    }

    /// Removes the line shown last.
    pub fn clear(&mut self) {
        if self.shown.take().is_some() {
            let _ = write!(stderr(), "\r\x1b[2K");
        }
    }
}

impl Observer for Progress {
    fn phase(&mut self, phase: Phase) {
        self.watch.phase(phase);
    }

    fn iteration(&mut self, iteration: &Iteration) {
        self.watch.iteration(iteration);
        let due = self.shown.is_none_or(|last| last.elapsed() > Duration::from_millis(100));
        if self.shows && due {
            let Iteration { number, total, gradient_norm, .. } = iteration;
            let _ = write!(stderr(), "\r\x1b[2Kiteration {number}: E = {total:.9e}, |gradient| = {gradient_norm:.2e}");
            let _ = stderr().flush();
            self.shown = Some(Instant::now());
        }
    }

    fn wants_terms(&self) -> bool {
        self.watch.wants_terms()
    }

    /// The solver then stops with the best map it has.
    fn stop_requested(&self) -> bool {
        interrupt::requested()
    }
}
