//! Work that Ctrl-C ends.

use pyo3::prelude::*;
use std::panic::resume_unwind;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

/// How often pending signals are looked at.
const POLL: Duration = Duration::from_millis(20);

/// Returns what `work` gives on a thread of its own. After Ctrl-C the work is left to itself.
pub fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
) -> PyResult<T> {
    let (sender, mut receiver) = channel();
    let worker = thread::spawn(move || {
        let _ = sender.send(work());
    });
    let mut worker = Some(worker);
    loop {
        let (back, found) = py.detach(move || {
            let found = receiver.recv_timeout(POLL);
            (receiver, found)
        });
        receiver = back;
        match found {
            Ok(value) => return Ok(value),
            Err(RecvTimeoutError::Timeout) => py.check_signals()?,
            Err(RecvTimeoutError::Disconnected) => match worker.take().map(|w| w.join()) {
                Some(Err(panic)) => resume_unwind(panic),
                _ => unreachable!("a thread that ends without a panic has sent its value"),
            },
        }
    }
}
