use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{self, Builder};
use std::time::Duration;

/// How often the caller is told that time passes.
const PULSE: Duration = Duration::from_millis(200);
/// Stack of a worker: as a main thread has; other threads have 2 MiB by default.
const STACK: usize = 8 << 20;

/// What the caller of [`pool`] is told.
pub(super) enum Told<T> {
    /// An item is begun.
    Begun(usize),
    /// An item has ended.
    Ended(usize, T),
    /// Time passes.
    Pulse,
}

/// Does `work` on items 0 … `count` − 1, begun in this order, on `threads` threads, and tells `hear` of it on this one.
/// No more are begun where `stop` says so or `hear` fails.
///
/// # Errors
/// That of `hear`; a thread that the system refuses.
pub(super) fn pool<T: Send, E: From<io::Error>>(
    count: usize,
    threads: usize,
    stop: &(dyn Fn() -> bool + Sync),
    work: &(dyn Fn(usize) -> T + Sync),
    hear: &mut dyn FnMut(Told<T>) -> Result<(), E>,
) -> Result<(), E> {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = channel();
    thread::scope(|scope| {
        // Dropped on every way out, so that the workers hear that nobody listens.
        let receiver = receiver;
        for _ in 0..threads.min(count) {
            let (next, sender) = (&next, sender.clone());
            let worker = move || {
                while !stop() {
                    let item = next.fetch_add(1, Ordering::Relaxed);
                    if item >= count || sender.send(Told::Begun(item)).is_err() {
                        return;
                    }
                    if sender.send(Told::Ended(item, work(item))).is_err() {
                        return;
                    }
                }
            };
            Builder::new().stack_size(STACK).spawn_scoped(scope, worker)?;
        }
        drop(sender);
        loop {
            match receiver.recv_timeout(PULSE) {
                Ok(told) => hear(told)?,
                Err(RecvTimeoutError::Timeout) => hear(Told::Pulse)?,
                // A last time, for what came up after the last item.
                Err(RecvTimeoutError::Disconnected) => return hear(Told::Pulse),
            }
        }
    })
}
