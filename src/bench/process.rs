//! One process, watched: what it takes, and an end where it takes too long.

use std::fs::File;
use std::io::{self, Read, Seek};
use std::process::{Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::stopwatch::{children_cpu_seconds, peak_bytes_of};

/// A process that has ended.
#[derive(Debug)]
pub struct Ended {
    /// How; `None`: it was stopped at the time limit.
    pub status: Option<ExitStatus>,
    /// Seconds by the clock, from its start to its end.
    pub wall: f64,
    /// Processor seconds, all threads, user and system; `None` where the system does not say.
    pub cpu: Option<f64>,
    /// The most memory seen, in bytes; a short last rise may be missed.
    pub peak_bytes: Option<u64>,
    /// What it printed.
    pub stdout: String,
    /// What it said on the standard error stream.
    pub stderr: String,
}

/// How often the process is looked at: finely at first, that the wall time of short ones is right.
const LOOK: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(10)];

/// Runs `command` to its end, for `limit` at most. No other child of this process may end meanwhile, or its time would be counted too.
///
/// # Errors
/// The system cannot start or watch it.
pub fn watch(command: &mut Command, limit: Duration) -> io::Result<Ended> {
    let (mut stdout, mut stderr) = (tempfile::tempfile()?, tempfile::tempfile()?);
    command.stdin(Stdio::null()).stdout(stdout.try_clone()?).stderr(stderr.try_clone()?);
    let cpu_before = children_cpu_seconds();
    let begun = Instant::now();
    let mut child = command.spawn()?;
    let mut peak_bytes = None;
    let (status, wall) = loop {
        if let Some(status) = child.try_wait()? {
            break (Some(status), begun.elapsed());
        }
        if begun.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            break (None, begun.elapsed());
        }
        peak_bytes = peak_bytes.max(peak_bytes_of(child.id()));
        sleep(LOOK[usize::from(begun.elapsed() > Duration::from_secs(1))]);
    };
    let cpu = cpu_before.zip(children_cpu_seconds()).map(|(before, after)| after - before);
    let (stdout, stderr) = (text(&mut stdout)?, text(&mut stderr)?);
    Ok(Ended { status, wall: wall.as_secs_f64(), cpu, peak_bytes, stdout, stderr })
}

fn text(file: &mut File) -> io::Result<String> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_process_is_measured_and_heard() {
        let shell = "i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done; echo done; echo wrong >&2; exit 3";
        let ended = watch(Command::new("sh").args(["-c", shell]), Duration::from_secs(60)).expect("sh runs");
        assert_eq!(ended.status.and_then(|s| s.code()), Some(3));
        assert_eq!((ended.stdout.as_str(), ended.stderr.as_str()), ("done\n", "wrong\n"));
        assert!(ended.wall > 0.0 && ended.cpu.is_some_and(|cpu| cpu > 0.0));
    }

    #[test]
    fn a_process_over_the_limit_is_stopped() {
        let ended = watch(Command::new("sleep").arg("60"), Duration::from_millis(50)).expect("sleep runs");
        assert!(ended.status.is_none() && ended.wall > 0.05 && ended.wall < 30.0);
    }
}
