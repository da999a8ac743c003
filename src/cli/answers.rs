//! Answers of a candidate, read on a thread of their own so that waiting for one can end.

use crate::cli::process::interrupt;
use crate::cli::process::wire::{Line, Lines};
use std::io::BufRead;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::{Duration, Instant};

/// Answers read before they are asked for.
const AHEAD: usize = 4096;

/// A stream of answers.
pub struct Answers(Receiver<std::io::Result<Line>>);

/// What came of waiting for one.
pub enum Next {
    Answer(Line),
    /// There are no more.
    Closed,
    Unreadable(std::io::Error),
    /// Nothing came in time.
    Silent,
    /// The user has asked to stop.
    Interrupted,
}

impl Answers {
    pub fn of(input: impl BufRead + Send + 'static) -> Answers {
        let (sender, receiver) = sync_channel(AHEAD);
        thread::spawn(move || listen(Lines::new(input), &sender));
        Answers(receiver)
    }

    /// The next one, waited for as long as that, or for ever.
    pub fn next(&self, patience: Option<Duration>) -> Next {
        interrupt::flag();
        let start = Instant::now();
        loop {
            if interrupt::asked() {
                return Next::Interrupted;
            }
            let left = patience.map(|p| p.saturating_sub(start.elapsed()));
            let wait = left.map_or(interrupt::POLL, |l| l.min(interrupt::POLL));
            match self.0.recv_timeout(wait) {
                Ok(Ok(line)) => return Next::Answer(line),
                Ok(Err(e)) => return Next::Unreadable(e),
                Err(RecvTimeoutError::Disconnected) => return Next::Closed,
                Err(RecvTimeoutError::Timeout) => {
                    if left.is_some_and(|l| l <= wait) {
                        return Next::Silent;
                    }
                }
            }
        }
    }
}

/// Hands over line by line until there are no more or nobody wants them.
fn listen(mut lines: Lines<impl BufRead>, to: &SyncSender<std::io::Result<Line>>) {
    while let Some(line) = lines.read().transpose() {
        let last = line.is_err();
        if to.send(line).is_err() || last {
            return;
        }
    }
}
