//! The progress of a map: a line that is redrawn on a terminal, a line every ten seconds elsewhere.

use std::io::{IsTerminal, Write, stderr};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use crate::app::measure::stopwatch::Stopwatch;
use crate::solver::{Iteration, Observer, Phase, Repair};

use super::interrupt;

/// Time between two lines on a terminal, and elsewhere.
const ON_TERMINAL: Duration = Duration::from_millis(100);
const ELSEWHERE: Duration = Duration::from_secs(10);

/// A stopwatch that reports what the solver is doing, and asks it to stop when a signal has been
/// received.
pub struct Progress {
    pub watch: Stopwatch,
    stage: Arc<Mutex<Stage>>,
    reporter: Option<Reporter>,
}

/// What the solver is doing.
#[derive(Clone, Copy, Default)]
struct Stage {
    phase: Option<Phase>,
    repair: Option<Repair>,
    /// Number, energy and norm of the gradient of the last iteration of this phase.
    iteration: Option<(usize, f64, f64)>,
}

/// The thread that writes lines. It also writes during a long factorisation, in which the solver
/// reports nothing.
struct Reporter {
    end: Sender<()>,
    thread: JoinHandle<()>,
}

impl Progress {
    /// Starts to report, beginning with the stage "reading"; a quiet one reports nothing.
    pub fn new(watch: Stopwatch, quiet: bool) -> Self {
        interrupt::listen();
        let is_terminal = stderr().is_terminal();
        let stage = Arc::new(Mutex::new(Stage::default()));
        let reporter = (!quiet).then(|| Reporter::start(Arc::clone(&stage), is_terminal, stderr()));
        Progress { watch, stage, reporter: reporter.flatten() }
    }

    /// Ends the report and removes its line from the terminal.
    pub fn end(&mut self) {
        if let Some(Reporter { end, thread }) = self.reporter.take() {
            drop(end);
            // A thread that panicked has nothing left to remove.
            let _ = thread.join();
        }
    }

    fn update(&self, change: impl FnOnce(&mut Stage)) {
        change(&mut self.stage.lock().unwrap_or_else(PoisonError::into_inner));
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.end();
    }
}

impl Reporter {
    /// Starts the thread; `None` where the system has none to give, and nothing is then reported.
    fn start(stage: Arc<Mutex<Stage>>, is_terminal: bool, mut out: impl Write + Send + 'static) -> Option<Self> {
        let (end, ended) = channel();
        let begun = Instant::now();
        let report = move || {
            let period = if is_terminal { ON_TERMINAL } else { ELSEWHERE };
            while ended.recv_timeout(period) == Err(RecvTimeoutError::Timeout) {
                let line = stage.lock().unwrap_or_else(PoisonError::into_inner).line(begun.elapsed());
                // Progress that cannot be written is no reason to stop.
                let _ = match is_terminal {
                    true => write!(out, "\r\x1b[2K{line}").and_then(|()| out.flush()),
                    false => writeln!(out, "riemap: {line}"),
                };
            }
            if is_terminal {
                let _ = write!(out, "\r\x1b[2K").and_then(|()| out.flush());
            }
        };
        Some(Reporter { end, thread: thread::Builder::new().spawn(report).ok()? })
    }
}

impl Stage {
    /// The stage and the time since the start, as in `repairing 3/8, Newton 2: E = …, |gradient| =
    /// …, 4.2 s`.
    fn line(&self, elapsed: Duration) -> String {
        let phase = match (self.phase, self.iteration) {
            (None, _) => "reading".to_owned(),
            (Some(Phase::Assemble), None) => "assembling".to_owned(),
            (Some(Phase::Order), None) => "ordering".to_owned(),
            (Some(Phase::Factor), None) => "factorising".to_owned(),
            (Some(Phase::Solve), None) => "solving".to_owned(),
            (Some(Phase::Measure), _) => "measuring".to_owned(),
            (Some(_), Some((number, total, gradient))) => {
                format!("iteration {number}: E = {total:.9e}, |gradient| = {gradient:.2e}")
            }
        };
        let repair = match self.repair.filter(|_| self.phase != Some(Phase::Measure)) {
            None => String::new(),
            Some(Repair::Part { number, count }) => format!("repairing {number}/{count}, "),
            Some(Repair::Whole) => "replacing the map, ".to_owned(),
        };
        format!("{repair}{phase}, {:.1} s", elapsed.as_secs_f64())
    }
}

impl Observer for Progress {
    fn phase(&mut self, phase: Phase) {
        self.watch.phase(phase);
        self.update(|stage| *stage = Stage { phase: Some(phase), iteration: None, ..*stage });
    }

    fn repair(&mut self, repair: Repair) {
        self.watch.repair(repair);
        self.update(|stage| *stage = Stage { repair: Some(repair), iteration: None, ..*stage });
    }

    fn iteration(&mut self, iteration: &Iteration) {
        self.watch.iteration(iteration);
        let Iteration { number, total, gradient_norm, .. } = *iteration;
        self.update(|stage| stage.iteration = Some((number, total, gradient_norm)));
    }

    fn wants_terms(&self) -> bool {
        self.watch.wants_terms()
    }

    /// The solver then stops and returns the best map so far.
    fn stop_requested(&self) -> bool {
        interrupt::requested()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file in memory that the test and the thread share.
    #[derive(Clone, Default)]
    struct Shared(Arc<Mutex<Vec<u8>>>);

    impl Write for Shared {
        fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
            self.0.lock().expect("no panic").extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> std::io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn stages_are_named_with_their_time() {
        let after = Duration::from_millis(4200);
        let mut stage = Stage::default();
        assert_eq!(stage.line(after), "reading, 4.2 s");
        for (phase, name) in [
            (Phase::Assemble, "assembling"),
            (Phase::Order, "ordering"),
            (Phase::Factor, "factorising"),
            (Phase::Solve, "solving"),
        ] {
            stage.phase = Some(phase);
            assert_eq!(stage.line(after), format!("{name}, 4.2 s"));
        }
        stage.iteration = Some((2, 0.5, 1e-3));
        assert_eq!(stage.line(after), "iteration 2: E = 5.000000000e-1, |gradient| = 1.00e-3, 4.2 s");
        stage.repair = Some(Repair::Part { number: 3, count: 8 });
        assert!(stage.line(after).starts_with("repairing 3/8, iteration 2: "));
        stage = Stage { phase: Some(Phase::Measure), iteration: None, ..stage };
        assert_eq!(stage.line(after), "measuring, 4.2 s");
    }

    #[test]
    fn a_terminal_shows_the_stage_although_the_solver_reports_nothing_and_is_clear_at_the_end() {
        let (shared, stage) = (Shared::default(), Arc::new(Mutex::new(Stage::default())));
        let reporter = Reporter::start(stage, true, shared.clone());
        let written = |shared: &Shared| String::from_utf8(shared.0.lock().expect("no panic").clone()).expect("text");
        let begun = Instant::now();
        // Half a minute is for a machine that does other things; a line is due after a tenth of a
        // second.
        while !written(&shared).contains("reading, ") && begun.elapsed() < Duration::from_secs(30) {
            thread::sleep(Duration::from_millis(5));
        }
        let mut progress = Progress { watch: Stopwatch::start(), stage: Arc::default(), reporter };
        progress.end();
        assert!(written(&shared).contains("reading, ") && written(&shared).ends_with("\r\x1b[2K"));
    }
}
