//! The progress of `run` and `reproduce`: a line that is redrawn on a terminal; elsewhere a line
//! for each finished run, and one every ten seconds.

use std::io::{self, IsTerminal, Write, stderr, stdout};
use std::time::{Duration, Instant};

use crate::app::experiment::{Config, Event, Outcome, Record, Run};

use super::{interrupt, plural};

/// Characters of the line that is redrawn. Terminals are rarely narrower, and a line that wraps
/// cannot be erased.
const WIDTH: usize = 79;

/// Shows the progress of a batch and counts its runs.
pub struct Display {
    begun: Instant,
    total: usize,
    /// Runs whose expectations hold.
    pub done: usize,
    pub refuted: usize,
    pub failed: usize,
    /// Runs that were refuted or failed, except for failures that are a result.
    pub unexpected: usize,
    /// Descriptions of the unexpected outcomes, one line each.
    pub complaints: Vec<String>,
    running: Vec<String>,
    /// Runs that an earlier command had finished.
    pub skipped: usize,
    stopping: bool,
    live: bool,
    every_run: bool,
    /// Time of the last line without a terminal.
    last: Instant,
}

/// Time between two lines without a terminal in which no run ends.
const SILENCE: Duration = Duration::from_secs(10);

impl Display {
    /// Creates the display of a batch of `total` runs.
    pub fn new(total: usize) -> Self {
        let live = stderr().is_terminal();
        Display {
            begun: Instant::now(),
            total,
            done: 0,
            refuted: 0,
            failed: 0,
            unexpected: 0,
            complaints: Vec::new(),
            running: Vec::new(),
            skipped: 0,
            stopping: false,
            live,
            every_run: !(live && stdout().is_terminal()),
            last: Instant::now(),
        }
    }

    /// Returns the number of runs that have ended.
    pub fn ended(&self) -> usize {
        self.done + self.refuted + self.failed
    }

    /// Shows an event and updates the counts.
    pub fn show(&mut self, event: &Event, out: &mut dyn Write) -> io::Result<()> {
        self.clear();
        match event {
            Event::Finished { config, run, record } => {
                self.skipped += 1;
                self.count(config, run, record);
            }
            Event::Begun { config, run } => self.running.push(name(config, run)),
            Event::Ended { config, run, record, seconds } => {
                let name = name(config, run);
                self.running.retain(|running| *running != name);
                let outcome = self.count(config, run, record);
                if self.every_run || record.outcome != Outcome::Done {
                    self.last = Instant::now();
                    writeln!(out, "[{}/{}] {name}  {seconds:.2} s  {outcome}", self.ended(), self.total)?;
                }
            }
            Event::Summed { config, summary: Ok(summary) } => {
                let records = plural(summary.records.len(), "record", "records");
                let files = summary.files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>();
                writeln!(out, "{}: {records}; wrote {}", config.name, files.join(" "))?;
            }
            Event::Summed { config, summary: Err(error) } => {
                let causes = with_cause(error);
                writeln!(out, "{}: NOT SUMMED UP: {causes}", config.name)?;
                self.complaints.push(format!("{}: {causes}", config.name));
            }
            Event::Pulse if !self.live && !self.running.is_empty() && self.last.elapsed() > SILENCE => {
                eprintln!("riemap: {}", self.line());
                self.last = Instant::now();
            }
            Event::Pulse => {}
        }
        if interrupt::requested() && !self.stopping {
            self.stopping = true;
            match self.running.len() {
                0 => writeln!(out, "stopping; no run is in progress")?,
                running => {
                    let running = plural(running, "run", "runs");
                    writeln!(out, "stopping when {running} in progress have ended; Ctrl-C again stops at once")?;
                }
            }
        }
        self.draw();
        // A pipe should show it at once, too.
        out.flush()
    }

    /// Counts a record, and returns its outcome in words.
    fn count(&mut self, config: &Config, run: &Run, record: &Record) -> String {
        let (counter, word) = match record.outcome {
            Outcome::Done => (&mut self.done, "done"),
            Outcome::Refuted => (&mut self.refuted, "REFUTED"),
            Outcome::Failed => (&mut self.failed, "FAILED"),
        };
        *counter += 1;
        let Some(error) = &record.error else { return word.to_owned() };
        if !(run.may_fail(config) && record.outcome == Outcome::Failed) {
            self.unexpected += 1;
            self.complaints.push(format!("{}: {}: {error}", name(config, run), word.to_lowercase()));
        }
        format!("{word}: {error}")
    }

    /// Returns the summary, such as `40 runs in 12.3 s: 38 done, 1 refuted, 1 failed`.
    pub fn summary(&self) -> String {
        let runs = plural(self.ended(), "run", "runs");
        let mut text = format!("{runs} in {:.1} s: {} done", self.begun.elapsed().as_secs_f64(), self.done);
        let others =
            [(self.refuted, "refuted"), (self.failed, "failed"), (self.skipped, "finished before (--fresh: again)")];
        for (count, word) in others {
            if count > 0 {
                text.push_str(&format!(", {count} {word}"));
            }
        }
        text
    }

    /// Erases the line on the terminal.
    pub fn clear(&self) {
        if self.live {
            let _ = write!(stderr(), "\r\x1b[2K");
        }
    }

    fn draw(&self) {
        if self.live && !self.running.is_empty() {
            let _ = write!(stderr(), "{}", self.line());
            let _ = stderr().flush();
        }
    }

    /// Returns the counts, the time and the names of the runs in progress, shortened to one line.
    fn line(&self) -> String {
        let seconds = self.begun.elapsed().as_secs();
        let bad = self.unexpected;
        let bad = if bad > 0 { format!(", {bad} not as expected") } else { String::new() };
        let line = format!("{}/{}{bad}, {seconds} s; running: {}", self.ended(), self.total, self.running.join(" · "));
        if line.chars().count() > WIDTH { line.chars().take(WIDTH - 1).chain(['…']).collect() } else { line }
    }
}

/// Returns the name of a run, such as `riemann source=plane,n=8`.
pub fn name(config: &Config, run: &Run) -> String {
    if config.swept.is_empty() { config.name.clone() } else { format!("{} {}", config.name, run.name) }
}

fn with_cause(error: &dyn std::error::Error) -> String {
    match error.source() {
        Some(cause) => format!("{error}: {}", with_cause(cause)),
        None => error.to_string(),
    }
}
