//! Clocks: the time of each phase of a run, and its iterations.

mod process;

use std::time::Instant;

use crate::report::{Cost, Seconds};
use crate::solver::{Iteration, Observer, Phase};

pub use process::{children_cpu_seconds, cpu_seconds, peak_bytes, peak_bytes_of};

/// Attributes wall-clock and processor time to the phases of a run.
pub struct Stopwatch {
    begun: Reading,
    last: Reading,
    phase: Option<Phase>,
    wall: Seconds,
    cpu: Seconds,
    trace: Option<Vec<Traced>>,
    terms: bool,
}

/// A reading of both clocks.
#[derive(Clone, Copy)]
struct Reading {
    wall: Instant,
    cpu: Option<f64>,
}

impl Reading {
    fn now() -> Self {
        Reading { wall: Instant::now(), cpu: cpu_seconds() }
    }

    /// Returns the processor seconds since `earlier`.
    fn cpu_since(self, earlier: Reading) -> Option<f64> {
        Some(self.cpu? - earlier.cpu?)
    }
}

/// An iteration and when it ended.
#[derive(Clone, Debug)]
pub struct Traced {
    /// The iteration as the solver reported it.
    pub iteration: Iteration,
    /// Seconds since the run began.
    pub seconds: f64,
}

impl Stopwatch {
    /// Starts the clocks; the first phase is reading.
    pub fn start() -> Self {
        let now = Reading::now();
        let (wall, cpu) = (Seconds::default(), Seconds::default());
        Stopwatch { begun: now, last: now, phase: None, wall, cpu, trace: None, terms: false }
    }

    /// Starts the clocks, and keeps every iteration with its energies.
    pub fn tracing() -> Self {
        Stopwatch { terms: true, ..Self::counting() }
    }

    /// Starts the clocks, and keeps every iteration with its total energy only, which takes no
    /// extra time.
    pub fn counting() -> Self {
        Stopwatch { trace: Some(Vec::new()), ..Self::start() }
    }

    /// Returns the iterations so far, if they are kept.
    pub fn trace(&self) -> &[Traced] {
        self.trace.as_deref().unwrap_or(&[])
    }

    /// Returns the wall-clock seconds of all phases so far.
    pub fn seconds(&mut self) -> Seconds {
        self.cost().seconds
    }

    /// Returns the time of all phases so far, and the peak memory.
    pub fn cost(&mut self) -> Cost {
        self.close_phase();
        let total = self.last.wall.duration_since(self.begun.wall).as_secs_f64();
        let cpu = self.last.cpu_since(self.begun).map(|total| Seconds { total, ..self.cpu });
        Cost { seconds: Seconds { total, ..self.wall }, cpu_seconds: cpu, peak_bytes: peak_bytes() }
    }

    fn close_phase(&mut self) {
        let now = Reading::now();
        *phase_of(&mut self.wall, self.phase) += now.wall.duration_since(self.last.wall).as_secs_f64();
        *phase_of(&mut self.cpu, self.phase) += now.cpu_since(self.last).unwrap_or_default();
        self.last = now;
    }
}

/// Returns the sum to which the seconds of a phase belong.
fn phase_of(seconds: &mut Seconds, phase: Option<Phase>) -> &mut f64 {
    match phase {
        None => &mut seconds.read,
        Some(Phase::Assemble) => &mut seconds.assemble,
        Some(Phase::Order) => &mut seconds.order,
        Some(Phase::Factor) => &mut seconds.factor,
        Some(Phase::Solve) => &mut seconds.solve,
        Some(Phase::Measure) => &mut seconds.measure,
    }
}

impl Observer for Stopwatch {
    fn phase(&mut self, phase: Phase) {
        self.close_phase();
        self.phase = Some(phase);
    }

    fn iteration(&mut self, iteration: &Iteration) {
        let seconds = self.begun.wall.elapsed().as_secs_f64();
        if let Some(trace) = &mut self.trace {
            trace.push(Traced { iteration: iteration.clone(), seconds });
        }
    }

    fn wants_terms(&self) -> bool {
        self.terms
    }
}
