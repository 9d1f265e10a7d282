//! Ctrl-C: the first asks to stop, the second ends the program.

use std::sync::atomic::{AtomicBool, Ordering};

static STOP: AtomicBool = AtomicBool::new(false);

/// What a program ends with that Ctrl-C has ended: 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// Hears Ctrl-C from now on.
pub fn listen() {
    // A handler cannot be set twice, or not at all on some systems: then Ctrl-C ends the program as ever.
    let _ = ctrlc::set_handler(|| {
        if STOP.swap(true, Ordering::SeqCst) {
            std::process::exit(EXIT_CODE.into());
        }
    });
}

/// Whether Ctrl-C has been pressed.
pub fn requested() -> bool {
    STOP.load(Ordering::SeqCst)
}
