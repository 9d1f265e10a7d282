//! Clocks: where the time of a run goes, and its iterations.

use std::time::Instant;

use crate::backend::{Iteration, Observer, Phase};
use crate::report::Seconds;

/// Attributes wall-clock time to the phases of a run.
pub struct Stopwatch {
    begun: Instant,
    last: Instant,
    phase: Option<Phase>,
    seconds: Seconds,
    trace: Option<Vec<Traced>>,
    terms: bool,
}

/// An iteration and when it ended.
#[derive(Clone, Debug)]
pub struct Traced {
    /// What the solver said.
    pub iteration: Iteration,
    /// Seconds since the run began.
    pub seconds: f64,
}

impl Stopwatch {
    /// Begins with reading.
    pub fn start() -> Self {
        let now = Instant::now();
        Stopwatch { begun: now, last: now, phase: None, seconds: Seconds::default(), trace: None, terms: false }
    }

    /// The same, keeping every iteration with its energies.
    pub fn tracing() -> Self {
        Stopwatch { terms: true, ..Self::counting() }
    }

    /// The same, keeping every iteration with its total energy alone, which costs no time.
    pub fn counting() -> Self {
        Stopwatch { trace: Some(Vec::new()), ..Self::start() }
    }

    /// The iterations so far, where they are kept.
    pub fn trace(&self) -> &[Traced] {
        self.trace.as_deref().unwrap_or(&[])
    }

    /// The seconds of all phases so far.
    pub fn seconds(&mut self) -> Seconds {
        self.close_phase();
        Seconds { total: self.begun.elapsed().as_secs_f64(), ..self.seconds }
    }

    fn close_phase(&mut self) {
        let passed = self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        *match self.phase {
            None => &mut self.seconds.read,
            Some(Phase::Assemble) => &mut self.seconds.assemble,
            Some(Phase::Factor) => &mut self.seconds.factor,
            Some(Phase::Solve) => &mut self.seconds.solve,
            Some(Phase::Measure) => &mut self.seconds.measure,
        } += passed;
    }
}

impl Observer for Stopwatch {
    fn phase(&mut self, phase: Phase) {
        self.close_phase();
        self.phase = Some(phase);
    }

    fn iteration(&mut self, iteration: &Iteration) {
        let seconds = self.begun.elapsed().as_secs_f64();
        if let Some(trace) = &mut self.trace {
            trace.push(Traced { iteration: iteration.clone(), seconds });
        }
    }

    fn wants_terms(&self) -> bool {
        self.terms
    }
}
