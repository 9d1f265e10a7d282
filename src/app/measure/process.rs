//! Runs one process, measures its time and memory, and stops it at a time limit or on request.

use std::fs::File;
use std::io::{self, Read, Seek};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::app::measure::stopwatch::{children_cpu_seconds, peak_bytes_of};

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// The process exited.
    Itself(ExitStatus),
    /// It was stopped at the time limit.
    OverTime,
    /// It was stopped on request.
    Stopped,
}

/// Conditions that stop a process.
pub struct Bounds<'a> {
    /// Limit of the wall-clock time.
    pub limit: Duration,
    /// Whether a stop has been requested.
    pub stop: &'a dyn Fn() -> bool,
    /// Whether the programs that it calls are stopped with it. It then has a process group of its
    /// own, which Ctrl-C on a terminal does not reach.
    pub with_its_own: bool,
}

/// A process that has ended.
#[derive(Debug)]
pub struct Ended {
    /// Why it ended.
    pub end: End,
    /// Wall-clock seconds from its start to its end.
    pub wall: f64,
    /// User and system seconds of all threads; `None` if the system does not report them. Other
    /// children of this process that end meanwhile are included.
    pub cpu: Option<f64>,
    /// Peak memory in bytes, as sampled; a short last rise may be missed.
    pub peak_bytes: Option<u64>,
    /// Its standard output.
    pub stdout: String,
    /// Its standard error stream.
    pub stderr: String,
}

/// Intervals between two looks at the process, in its first second and later: short ones need an
/// accurate wall time.
const LOOK: [Duration; 2] = [Duration::from_millis(1), Duration::from_millis(10)];

/// Runs `command` until it exits or `bounds` stop it.
///
/// # Errors
/// The system cannot start or observe the process.
pub fn watch(command: &mut Command, bounds: &Bounds) -> io::Result<Ended> {
    let (mut stdout, mut stderr) = (tempfile::tempfile()?, tempfile::tempfile()?);
    command.stdin(Stdio::null()).stdout(stdout.try_clone()?).stderr(stderr.try_clone()?);
    if bounds.with_its_own {
        own_group(command);
    }
    let cpu_before = children_cpu_seconds();
    let begun = Instant::now();
    let mut child = command.spawn()?;
    let mut peak_bytes = None;
    let (end, wall) = loop {
        if let Some(status) = child.try_wait()? {
            break (End::Itself(status), begun.elapsed());
        }
        let early = match () {
            () if (bounds.stop)() => Some(End::Stopped),
            () if begun.elapsed() > bounds.limit => Some(End::OverTime),
            () => None,
        };
        if let Some(early) = early {
            if bounds.with_its_own {
                kill_group(&mut child)?
            } else {
                child.kill()?
            }
            child.wait()?;
            break (early, begun.elapsed());
        }
        peak_bytes = peak_bytes.max(peak_bytes_of(child.id()));
        sleep(LOOK[usize::from(begun.elapsed() > Duration::from_secs(1))]);
    };
    let cpu = cpu_before.zip(children_cpu_seconds()).map(|(before, after)| after - before);
    let (stdout, stderr) = (text(&mut stdout)?, text(&mut stderr)?);
    Ok(Ended { end, wall: wall.as_secs_f64(), cpu, peak_bytes, stdout, stderr })
}

fn text(file: &mut File) -> io::Result<String> {
    let mut bytes = Vec::new();
    file.rewind()?;
    file.read_to_end(&mut bytes)?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

#[cfg(unix)]
fn own_group(command: &mut Command) {
    std::os::unix::process::CommandExt::process_group(command, 0);
}

#[cfg(not(unix))]
fn own_group(_: &mut Command) {}

#[cfg(unix)]
fn kill_group(child: &mut Child) -> io::Result<()> {
    use nix::sys::signal::{Signal, killpg};
    use nix::unistd::Pid;
    let group = i32::try_from(child.id()).map_err(io::Error::other)?;
    Ok(killpg(Pid::from_raw(group), Signal::SIGKILL)?)
}

#[cfg(not(unix))]
fn kill_group(child: &mut Child) -> io::Result<()> {
    child.kill()
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn within(milliseconds: u64) -> Bounds<'static> {
        Bounds { limit: Duration::from_millis(milliseconds), stop: &|| false, with_its_own: false }
    }

    #[test]
    fn a_process_is_measured_and_heard() {
        let shell = "i=0; while [ $i -lt 20000 ]; do i=$((i+1)); done; echo done; echo wrong >&2; exit 3";
        let ended = watch(Command::new("sh").args(["-c", shell]), &within(60_000)).expect("sh runs");
        assert!(matches!(ended.end, End::Itself(status) if status.code() == Some(3)));
        assert_eq!((ended.stdout.as_str(), ended.stderr.as_str()), ("done\n", "wrong\n"));
        assert!(ended.wall > 0.0 && ended.cpu.is_some_and(|cpu| cpu > 0.0));
    }

    #[test]
    fn a_process_over_the_limit_is_stopped() {
        let ended = watch(Command::new("sleep").arg("60"), &within(50)).expect("sleep runs");
        assert!(matches!(ended.end, End::OverTime) && ended.wall > 0.05 && ended.wall < 30.0);
    }
}
