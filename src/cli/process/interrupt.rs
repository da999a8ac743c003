//! Signals. The first Ctrl-C ends the work with a report of what is done, if the work can be
//! reported; any other ends the program, which takes its temporary files along.

use mechaudit::files::temporary::remove_unfinished;
use std::panic::resume_unwind;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

static STOP: AtomicBool = AtomicBool::new(false);
/// True if the work can end with a report.
static REPORTS: AtomicBool = AtomicBool::new(false);

/// The exit code: 128 and the number of SIGINT, as shells have it.
pub const EXIT_CODE: u8 = 130;
/// The interval between two looks at the request to stop.
pub const POLL: Duration = Duration::from_millis(20);

/// Set once the user has asked to stop; asking for it begins to listen.
pub fn flag() -> &'static AtomicBool {
    REPORTS.store(true, Ordering::Relaxed);
    listen();
    &STOP
}

/// Returns true if the user has asked to stop.
pub fn is_requested() -> bool {
    STOP.load(Ordering::Relaxed)
}

/// Handles Ctrl-C: a report, the first time there can be one; the end otherwise.
fn ctrl_c() {
    let reports = REPORTS.load(Ordering::Relaxed);
    if reports && !STOP.swap(true, Ordering::Relaxed) {
        return;
    }
    remove_unfinished();
    if reports {
        std::process::exit(EXIT_CODE.into());
    }
}

/// Begins to listen. Before, signals end the program, as ever.
pub fn listen() {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(listen_on_a_thread);
}

#[cfg(unix)]
fn listen_on_a_thread() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::{iterator::Signals, low_level::emulate_default_handler};
    let mut listened = vec![SIGINT, SIGTERM];
    listened.extend(Some(SIGHUP).filter(|s| !is_ignored(*s)));
    let Ok(mut signals) = Signals::new(listened) else {
        return;
    };
    thread::spawn(move || {
        for signal in signals.forever() {
            match signal {
                SIGINT => ctrl_c(),
                _ => remove_unfinished(),
            }
            if signal != SIGINT || !is_requested() {
                let _ = emulate_default_handler(signal);
            }
        }
    });
}

/// Returns true if whoever started the program wants a signal ignored, as `nohup` does; where the
/// system does not say, it is left alone.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|l| l.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|m| u64::from_str_radix(m.trim(), 16).ok());
    mask.is_none_or(|m| m & 1 << (signal - 1) != 0)
}

#[cfg(not(unix))]
fn listen_on_a_thread() {
    let _ = ctrlc::set_handler(|| {
        ctrl_c();
        if !is_requested() {
            std::process::exit(EXIT_CODE.into());
        }
    });
}

/// Returns the result of `work`, done on a thread of its own; nothing once the user has asked to
/// stop, and the work is left to itself.
pub fn unless_requested<T: Send + 'static>(work: impl FnOnce() -> T + Send + 'static) -> Option<T> {
    flag();
    if is_requested() {
        return None;
    }
    let (sender, receiver) = channel();
    let worker = thread::spawn(move || {
        let _ = sender.send(work());
    });
    loop {
        match receiver.recv_timeout(POLL) {
            Ok(value) => return Some(value),
            Err(RecvTimeoutError::Timeout) if is_requested() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => resume_unwind(panic),
                Ok(()) => return None,
            },
        }
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    /// Rust ignores SIGPIPE for every program; nobody can ignore SIGKILL.
    #[test]
    fn a_signal_is_ignored_by_the_mask_of_the_process() {
        assert!(is_ignored(13) && !is_ignored(9));
    }

    #[test]
    fn work_gives_its_value_or_its_panic() {
        assert_eq!(unless_requested(|| 5), Some(5));
        let slow = unless_requested(|| {
            thread::sleep(3 * POLL);
            6
        });
        assert_eq!(slow, Some(6));
        let panic = std::panic::catch_unwind(|| unless_requested(|| -> u32 { panic!("planted") }));
        let panic = panic.unwrap_err();
        assert_eq!(panic.downcast_ref::<&str>(), Some(&"planted"));
        assert!(!is_requested());
    }
}
