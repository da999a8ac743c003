//! Ctrl-C: the first ends the work with a report of what is done, the second ends the program.

use std::panic::resume_unwind;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

static STOP: AtomicBool = AtomicBool::new(false);

/// The exit code: 128 and the number of SIGINT, as shells have it.
pub const EXIT_CODE: u8 = 130;
/// How often whoever waits looks whether to go on.
pub const POLL: Duration = Duration::from_millis(20);

/// Set once the user has asked to stop; asking for it begins to listen.
pub fn flag() -> &'static AtomicBool {
    static LISTENING: OnceLock<()> = OnceLock::new();
    LISTENING.get_or_init(|| {
        // Without a handler Ctrl-C ends the program, as ever.
        let _ = ctrlc::set_handler(|| {
            if STOP.swap(true, Ordering::Relaxed) {
                std::process::exit(EXIT_CODE.into());
            }
        });
    });
    &STOP
}

/// Whether the user has asked to stop.
pub fn asked() -> bool {
    STOP.load(Ordering::Relaxed)
}

/// What `work` gives on a thread of its own; nothing once the user has asked to stop, and the work
/// is left to itself.
pub fn unless_asked<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    flag();
    if asked() {
        return None;
    }
    let (sender, receiver) = channel();
    let worker = thread::spawn(move || {
        let _ = sender.send(work());
    });
    loop {
        match receiver.recv_timeout(POLL) {
            Ok(value) => return Some(value),
            Err(RecvTimeoutError::Timeout) if asked() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => resume_unwind(panic),
                Ok(()) => return None,
            },
        }
    }
}
