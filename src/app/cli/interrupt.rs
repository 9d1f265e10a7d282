//! Signals that end the program: the first asks the command to stop, the second ends the program at
//! once.

use std::sync::Arc;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

#[cfg(unix)]
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
#[cfg(not(unix))]
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

#[cfg(unix)]
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, SIGHUP];
#[cfg(not(unix))]
const SIGNALS: [i32; 2] = [SIGINT, SIGTERM];

/// The signal that was received; 0 while there has been none.
static RECEIVED: OnceLock<Arc<AtomicUsize>> = OnceLock::new();

/// Listens for Ctrl-C, termination and hang-up from now on. Further calls change nothing.
pub fn listen() {
    RECEIVED.get_or_init(|| {
        let received = Arc::new(AtomicUsize::new(0));
        for signal in SIGNALS {
            // Where a system refuses a handler, the signal ends the program as it does without one.
            // The shutdown is registered before the flag that arms it: the first signal therefore
            // only sets the flag.
            let armed = Arc::new(AtomicBool::new(false));
            let _ = flag::register_conditional_shutdown(signal, exit_code(signal).into(), Arc::clone(&armed));
            let _ = flag::register(signal, armed);
            // Signals are small positive numbers.
            let _ = flag::register_usize(signal, Arc::clone(&received), signal as usize);
        }
        received
    });
}

/// Whether a signal has asked the program to stop.
pub fn requested() -> bool {
    signal().is_some()
}

/// The exit code of a program that a signal has ended: 128 + its number (130, 143, 129).
pub fn exit_code_of_signal() -> u8 {
    exit_code(signal().unwrap_or(SIGINT))
}

/// `interrupted`, `terminated` or `hung up`, by the signal received.
pub fn name() -> &'static str {
    match signal() {
        Some(SIGTERM) => "terminated",
        #[cfg(unix)]
        Some(SIGHUP) => "hung up",
        _ => "interrupted",
    }
}

fn signal() -> Option<i32> {
    let received = RECEIVED.get()?.load(Ordering::SeqCst);
    i32::try_from(received).ok().filter(|&signal| signal != 0)
}

fn exit_code(signal: i32) -> u8 {
    u8::try_from(128 + signal).unwrap_or(1)
}
