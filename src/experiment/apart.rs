//! Runs in processes of their own: what one of them takes, breaks or waits for does not touch the others.

use std::io::{self, Read, Seek};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// How often a process is looked at.
const GLANCE: Duration = Duration::from_millis(20);

/// How a process ended.
pub(super) enum End {
    /// By itself, well.
    Well,
    /// By itself, otherwise: its status, and the last that it said on stderr.
    Otherwise(ExitStatus, String),
    /// It was over its time.
    OverTime,
    /// It was to stop.
    Stopped,
}

/// Waits for a process at most `seconds`, and ends it with all that it has called where it is not to go on.
///
/// # Errors
/// It does not start.
pub(super) fn apart(mut command: Command, seconds: f64, stop: &dyn Fn() -> bool) -> io::Result<End> {
    let begun = Instant::now();
    let mut said = tempfile::tempfile()?;
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(said.try_clone()?);
    own_group(&mut command);
    let mut child = command.spawn()?;
    let early = loop {
        if let Some(status) = child.try_wait()? {
            if status.success() {
                return Ok(End::Well);
            }
            let mut text = String::new();
            said.rewind()?;
            // What is no text is no message.
            let _ = said.read_to_string(&mut text);
            return Ok(End::Otherwise(status, text.trim().lines().last().unwrap_or_default().to_owned()));
        }
        match () {
            () if stop() => break End::Stopped,
            () if begun.elapsed().as_secs_f64() > seconds => break End::OverTime,
            () => sleep(GLANCE),
        }
    };
    end(&mut child)?;
    child.wait()?;
    Ok(early)
}

/// A group of its own, so that it can be ended with the programs that it calls.
#[cfg(unix)]
fn own_group(command: &mut Command) {
    std::os::unix::process::CommandExt::process_group(command, 0);
}

#[cfg(not(unix))]
fn own_group(_: &mut Command) {}

#[cfg(unix)]
fn end(child: &mut Child) -> io::Result<()> {
    use nix::sys::signal::{Signal, killpg};
    use nix::unistd::Pid;
    let group = i32::try_from(child.id()).map_err(io::Error::other)?;
    Ok(killpg(Pid::from_raw(group), Signal::SIGKILL)?)
}

#[cfg(not(unix))]
fn end(child: &mut Child) -> io::Result<()> {
    child.kill()
}
