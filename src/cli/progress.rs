//! A bar on stderr for whatever takes more than a second; nothing where stderr is no terminal.

use crate::cli::process::interrupt;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io::IsTerminal;
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
        if self.start.elapsed() < Duration::from_secs(1) || interrupt::is_requested() {
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
        self.shown.store(now, Ordering::Relaxed);
        self.show(phase, done, total);
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

/// Does work of which nobody knows how far it is, and shows how long it takes.
pub fn waiting<T>(what: &'static str, work: impl FnOnce() -> T) -> T {
    // Nobody would see the thread that moves it.
    if !std::io::stderr().is_terminal() {
        return work();
    }
    let style = ProgressStyle::with_template("{msg} {spinner} {elapsed}");
    let bar = ProgressBar::hidden();
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_spinner()));
    bar.set_message(what);
    bar.set_draw_target(ProgressDrawTarget::stderr());
    bar.enable_steady_tick(Duration::from_secs(1));
    let done = work();
    bar.finish_and_clear();
    done
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One that began long enough ago to have a bar.
    fn slow() -> Progress {
        let mut slow = Progress::new();
        slow.start -= Duration::from_secs(2);
        slow
    }

    /// Returns the message, position and length of the bar.
    fn bar(progress: &Progress) -> Option<(String, u64, Option<u64>)> {
        let slot = progress.bar.lock().unwrap();
        let bar = slot.as_ref()?;
        Some((bar.message(), bar.position(), bar.length()))
    }

    #[test]
    fn what_is_quick_has_no_bar() {
        let quick = Progress::new();
        quick.show("first", 1, 3);
        quick.tick("first", 3);
        assert_eq!(bar(&quick), None);
        let slow = slow();
        slow.show("first", 1, 3);
        assert_eq!(bar(&slow), Some(("first".into(), 1, Some(3))));
        slow.show("second", 5, 9);
        assert_eq!(bar(&slow), Some(("second".into(), 5, Some(9))));
        slow.clear();
        assert_eq!(bar(&slow), None);
    }

    /// Ticks are counted one by one; those that follow soon on one that was shown are not.
    #[test]
    fn ticks_are_shown_now_and_then() {
        let position = |p: &Progress| bar(p).map(|b| b.1);
        let progress = slow();
        progress.tick("rows", 9);
        assert_eq!(position(&progress), Some(1));
        let last = progress.shown.load(Ordering::Relaxed);
        progress.shown.store(last + 1_000_000, Ordering::Relaxed);
        progress.tick("rows", 9);
        assert_eq!(position(&progress), Some(1));
        progress.shown.store(last - PAUSE, Ordering::Relaxed);
        progress.tick("rows", 9);
        assert_eq!(position(&progress), Some(3));
        let next = progress.shown.load(Ordering::Relaxed);
        assert!((last..last + 60_000).contains(&next));
        progress.restart();
        progress.shown.store(0, Ordering::Relaxed);
        progress.tick("rows", 9);
        assert_eq!(position(&progress), Some(1));
    }

    /// Nothing more is shown once it is over; the time between two that are shown is that of the
    /// last.
    #[test]
    fn a_pause_is_as_long_as_it_says() {
        let position = |p: &Progress| bar(p).map(|b| b.1);
        let progress = slow();
        let now = progress.start.elapsed().as_millis() as u64;
        // Almost a pause ago, and longer ago.
        progress.shown.store(now + 60_000, Ordering::Relaxed);
        progress.reach("rows", 4, 9);
        assert_eq!(position(&progress), None);
        progress.shown.store(now - PAUSE, Ordering::Relaxed);
        progress.reach("rows", 5, 9);
        assert_eq!(position(&progress), Some(5));
        assert!(progress.shown.load(Ordering::Relaxed) >= now);
    }

    #[test]
    fn a_bar_is_taken_away_with_its_progress() {
        let progress = slow();
        progress.show("rows", 1, 9);
        let bar = progress.bar.lock().unwrap().clone().unwrap();
        assert!(!bar.is_finished());
        drop(progress);
        assert!(bar.is_finished());
    }
}
