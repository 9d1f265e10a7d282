use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{self, Builder};
use std::time::Duration;

/// Interval of [`PoolEvent::Pulse`].
const PULSE: Duration = Duration::from_millis(200);
/// Stack size of a worker in bytes, as a main thread has; other threads have 2 MiB by default.
const STACK: usize = 8 << 20;

/// An event that [`pool`] reports to its caller.
pub(super) enum PoolEvent<T> {
    /// An item has begun: its index.
    Begun(usize),
    /// An item has ended: its index and result.
    Ended(usize, T),
    /// Nothing ended within the last [`PULSE`]; also sent once at the end.
    Pulse,
}

/// Runs `work` on items 0 … `count` − 1, begun in this order, on `threads` threads, and calls
/// `on_event` on the calling thread. Begins no further item once `stop` returns true or `on_event`
/// fails.
///
/// # Errors
/// The error of `on_event`, or a thread that the system refuses to start.
pub(super) fn pool<T: Send, E: From<io::Error>>(
    count: usize,
    threads: usize,
    stop: &(dyn Fn() -> bool + Sync),
    work: &(dyn Fn(usize) -> T + Sync),
    on_event: &mut dyn FnMut(PoolEvent<T>) -> Result<(), E>,
) -> Result<(), E> {
    let next = AtomicUsize::new(0);
    let (sender, receiver) = channel();
    thread::scope(|scope| {
        // Dropped on every way out, so that the workers notice that nobody receives.
        let receiver = receiver;
        for _ in 0..threads.min(count) {
            let (next, sender) = (&next, sender.clone());
            let worker = move || {
                while !stop() {
                    let item = next.fetch_add(1, Ordering::Relaxed);
                    if item >= count || sender.send(PoolEvent::Begun(item)).is_err() {
                        return;
                    }
                    if sender.send(PoolEvent::Ended(item, work(item))).is_err() {
                        return;
                    }
                }
            };
            Builder::new().stack_size(STACK).spawn_scoped(scope, worker)?;
        }
        drop(sender);
        loop {
            match receiver.recv_timeout(PULSE) {
                Ok(event) => on_event(event)?,
                Err(RecvTimeoutError::Timeout) => on_event(PoolEvent::Pulse)?,
                // A last pulse, so that the caller sees the state after the last item.
                Err(RecvTimeoutError::Disconnected) => return on_event(PoolEvent::Pulse),
            }
        }
    })
}
