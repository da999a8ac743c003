//! A bar on stderr for whatever takes more than a second; nothing where stderr is no terminal.

use crate::cli::process::interrupt;
use indicatif::{ProgressBar, ProgressStyle};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Progress through one phase after another.
pub struct Progress {
    start: Instant,
    done: AtomicU64,
    /// Milliseconds from the start to the last tick that was shown.
    shown: AtomicU64,
    bar: Mutex<Option<ProgressBar>>,
}

/// Milliseconds between two ticks that are shown.
const PAUSE: u64 = 100;

impl Progress {
    pub fn new() -> Progress {
        Progress {
            start: Instant::now(),
            done: AtomicU64::new(0),
            shown: AtomicU64::new(0),
            bar: Mutex::new(None),
        }
    }

    /// Shows that `done` of `total` are done.
    pub fn show(&self, phase: &str, done: u64, total: u64) {
        if self.start.elapsed() < Duration::from_secs(1) || interrupt::asked() {
            return;
        }
        let Ok(mut slot) = self.bar.lock() else {
            return;
        };
        let bar = slot.get_or_insert_with(|| {
            let style =
                ProgressStyle::with_template("{msg:32!} {bar:30} {pos}/{len} {per_sec} {eta} left");
            let bar = ProgressBar::new(total);
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            // The rate is that of what comes from here on.
            bar.set_position(done);
            bar.reset_eta();
            bar
        });
        bar.set_message(phase.to_owned());
        bar.set_length(total);
        bar.set_position(done);
    }

    /// One more of `total` is done.
    pub fn tick(&self, phase: &str, total: u64) {
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.reach(phase, done, total);
    }

    /// `done` of `total` are done; shown if enough time has passed.
    pub fn reach(&self, phase: &str, done: u64, total: u64) {
        let now = self.start.elapsed().as_millis() as u64;
        let last = self.shown.load(Ordering::Relaxed);
        if now < last + PAUSE {
            return;
        }
        let order = Ordering::Relaxed;
        if self.shown.compare_exchange(last, now, order, order).is_ok() {
            self.show(phase, done, total);
        }
    }

    /// A new phase begins.
    pub fn restart(&self) {
        self.done.store(0, Ordering::Relaxed);
    }

    /// Removes the bar.
    pub fn clear(&self) {
        if let Ok(mut slot) = self.bar.lock()
            && let Some(bar) = slot.take()
        {
            bar.finish_and_clear();
        }
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        self.clear();
    }
}
