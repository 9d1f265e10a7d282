//! Processor time and peak memory of this process and its children, as the system counts them.

use std::path::Path;

/// Returns user and system seconds of all threads of this process so far; `None` if the system does
/// not report them.
#[cfg(unix)]
pub fn cpu_seconds() -> Option<f64> {
    used_by(nix::sys::resource::UsageWho::RUSAGE_SELF)
}

/// Returns the processor seconds of all children of this process that have ended.
#[cfg(unix)]
pub fn children_cpu_seconds() -> Option<f64> {
    used_by(nix::sys::resource::UsageWho::RUSAGE_CHILDREN)
}

#[cfg(unix)]
fn used_by(who: nix::sys::resource::UsageWho) -> Option<f64> {
    let usage = nix::sys::resource::getrusage(who).ok()?;
    let seconds = [usage.user_time(), usage.system_time()].map(|t| t.tv_sec() as f64 + 1e-6 * t.tv_usec() as f64);
    Some(seconds[0] + seconds[1])
}

/// Returns `None`: this system does not report it.
#[cfg(not(unix))]
pub fn cpu_seconds() -> Option<f64> {
    None
}

/// Returns `None`: this system does not report it.
#[cfg(not(unix))]
pub fn children_cpu_seconds() -> Option<f64> {
    None
}

/// Returns the peak memory of this process in bytes; only Linux reports it.
pub fn peak_bytes() -> Option<u64> {
    peak_in(Path::new("/proc/self/status"))
}

/// Returns the peak memory so far of a running process in bytes.
pub fn peak_bytes_of(process: u32) -> Option<u64> {
    peak_in(Path::new(&format!("/proc/{process}/status")))
}

fn peak_in(status: &Path) -> Option<u64> {
    let text = std::fs::read_to_string(status).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    kibibytes.checked_mul(1024)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn work_and_memory_are_counted() {
        let (before, held) = (cpu_seconds().expect("Linux counts"), peak_bytes().expect("Linux counts"));
        let block = vec![1u8; 64 << 20];
        let mut sum = 0u64;
        // Until it has cost 20 ms, whatever the machine; a clock that stands still ends as a
        // failure.
        for round in 0..100_000u64 {
            sum += block.iter().step_by(4096).map(|&x| u64::from(x) + round).sum::<u64>();
            if cpu_seconds().is_some_and(|now| now > before + 0.02) {
                break;
            }
        }
        assert!(sum > 0 && cpu_seconds().is_some_and(|now| now > before + 0.02));
        // The block was not there when its pages were first counted.
        assert!(peak_bytes().is_some_and(|peak| peak >= 64 << 20 && peak >= held));
        assert_eq!(peak_bytes_of(u32::MAX), None);
    }
}
