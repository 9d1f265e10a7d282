//! What Python hears of a map while it is made.

use std::cell::{Cell, RefCell};
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use pyo3::types::PyDict;
use riemap::Observer;
use riemap::report::{Cost, Seconds};
use riemap::solver::{Iteration, Phase};

/// How often Python is asked whether Ctrl-C was pressed.
const INTERVAL: Duration = Duration::from_millis(50);

/// Calls Python's `progress`, looks for signals, and takes the time of every phase.
///
/// A signal, or an exception of `progress`, stops the solver; [`Watch::cost`] then has it.
pub struct Watch {
    progress: Option<Py<PyAny>>,
    phase: Option<Phase>,
    begun: Instant,
    last: Instant,
    seconds: Seconds,
    looked: Cell<Instant>,
    raised: RefCell<Option<PyErr>>,
}

impl Watch {
    /// Starts the clock.
    pub fn new(progress: Option<Py<PyAny>>) -> Self {
        let now = Instant::now();
        Watch {
            progress,
            phase: None,
            begun: now,
            last: now,
            seconds: Seconds::default(),
            looked: Cell::new(now),
            raised: RefCell::new(None),
        }
    }

    /// The time of all phases.
    ///
    /// # Errors
    /// `KeyboardInterrupt`, or the exception of `progress`, that stopped the solver.
    pub fn cost(mut self) -> PyResult<Cost> {
        self.close_phase();
        match self.raised.take() {
            Some(raised) => Err(raised),
            None => {
                let total = self.last.duration_since(self.begun).as_secs_f64();
                Ok(Cost { seconds: Seconds { total, ..self.seconds }, cpu_seconds: None, peak_bytes: None })
            }
        }
    }

    fn close_phase(&mut self) {
        let now = Instant::now();
        let of_phase = match self.phase {
            None => &mut self.seconds.read,
            Some(Phase::Assemble) => &mut self.seconds.assemble,
            Some(Phase::Order) => &mut self.seconds.order,
            Some(Phase::Factor) => &mut self.seconds.factor,
            Some(Phase::Solve) => &mut self.seconds.solve,
            Some(Phase::Measure) => &mut self.seconds.measure,
        };
        *of_phase += now.duration_since(self.last).as_secs_f64();
        self.last = now;
    }

    /// Calls `progress(phase, iteration)`, where there is one and nothing was raised yet.
    fn report(&self, iteration: Option<&Iteration>) {
        let Some(progress) = &self.progress else { return };
        if self.raised.borrow().is_some() {
            return;
        }
        let called = Python::attach(|py| {
            let iteration = iteration.map(|iteration| as_dict(py, iteration)).transpose()?;
            progress.call1(py, (self.phase.map_or("assemble", name), iteration)).map(drop)
        });
        if let Err(error) = called {
            self.raised.replace(Some(error));
        }
    }
}

impl Observer for Watch {
    fn phase(&mut self, phase: Phase) {
        self.close_phase();
        self.phase = Some(phase);
        self.report(None);
    }

    fn iteration(&mut self, iteration: &Iteration) {
        self.report(Some(iteration));
    }

    fn stop_requested(&self) -> bool {
        if self.raised.borrow().is_none() && self.looked.get().elapsed() > INTERVAL {
            self.looked.set(Instant::now());
            // In other threads than the main one this does nothing.
            if let Err(signal) = Python::attach(|py| py.check_signals()) {
                self.raised.replace(Some(signal));
            }
        }
        self.raised.borrow().is_some()
    }
}

fn name(phase: Phase) -> &'static str {
    match phase {
        Phase::Assemble => "assemble",
        Phase::Order => "order",
        Phase::Factor => "factor",
        Phase::Solve => "solve",
        Phase::Measure => "measure",
    }
}

fn as_dict<'py>(py: Python<'py>, iteration: &Iteration) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(py);
    dict.set_item("number", iteration.number)?;
    dict.set_item("energy", iteration.total)?;
    dict.set_item("gradient_norm", iteration.gradient_norm)?;
    dict.set_item("step", iteration.step)?;
    Ok(dict)
}
