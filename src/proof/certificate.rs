//! Describes what a proof leaves: the parts on which a bound is proved, and those on which none is.

use crate::cover::Rectangle;
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A part on which nothing is proved.
#[derive(Clone, Copy, Debug)]
pub struct Open<P = Rectangle> {
    /// Where.
    pub at: P,
    /// Why.
    pub why: &'static str,
}

/// All parts.
#[derive(Clone, Debug)]
pub struct Certificate<L, P = Rectangle> {
    /// Holds what is proved; together they cover all inputs that the theorem names unless something
    /// is open.
    pub leaves: Vec<L>,
    /// Holds what is not.
    pub open: Vec<Open<P>>,
}

impl<L, P> Default for Certificate<L, P> {
    fn default() -> Certificate<L, P> {
        Certificate {
            leaves: Vec::new(),
            open: Vec::new(),
        }
    }
}

/// The progress of a proof, and whether it is to end.
#[derive(Debug, Default)]
pub struct Watch {
    /// Parts of the first partition done.
    pub done: AtomicU64,
    /// Parts of the first partition.
    pub of: AtomicU64,
    /// Set from outside: no part is begun any more.
    pub stop: AtomicBool,
    /// Parts looked at since the first partition, those that were halved among them.
    pub looked_at: AtomicU64,
}

/// Parts that a proof looks at before it gives up; the largest theorem rests on 1.4 million.
pub const MOST_PARTS: u64 = 30_000_000;

impl Watch {
    /// Returns whether the proof has given up, after [`MOST_PARTS`].
    pub fn is_spent(&self) -> bool {
        self.looked_at.load(Ordering::Relaxed) > MOST_PARTS
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed) || self.is_spent()
    }

    /// Counts a part that is looked at; returns whether the proof is to end.
    pub(crate) fn ends(&self) -> bool {
        self.looked_at.fetch_add(1, Ordering::Relaxed);
        self.is_stopped()
    }
}

/// The outcome of one look at a part.
pub(crate) enum Step<L, P> {
    /// Bounds are proved on all of it.
    Proved(Vec<L>),
    /// Nothing is, and why.
    Open(&'static str),
    /// It is proved in two parts.
    Cut([P; 2]),
}

impl<L, P> Certificate<L, P> {
    /// Proves what can be proved on a part that is the `depth`th of its halves, as `step` says of a
    /// part, its depth and the number of parts that came before; `None` if it was stopped.
    pub(crate) fn refine(
        &mut self,
        at: P,
        depth: u32,
        watch: &Watch,
        step: &impl Fn(&P, u32, usize) -> Step<L, P>,
    ) -> Option<()> {
        if watch.ends() {
            return None;
        }
        match step(&at, depth, self.leaves.len() + self.open.len()) {
            Step::Proved(leaves) => self.leaves.extend(leaves),
            Step::Open(why) => self.open.push(Open { at, why }),
            Step::Cut(parts) => {
                for part in parts {
                    self.refine(part, depth + 1, watch, step)?;
                }
            }
        }
        Some(())
    }
}

impl<L: Send, P: Send> Certificate<L, P> {
    /// Returns what `prove` finds on each part of the first partition, on all cores; `None` if it
    /// was stopped.
    pub(crate) fn of_all<R: Sync>(
        roots: &[R],
        watch: &Watch,
        prove: impl Fn(&R, &mut Certificate<L, P>) -> Option<()> + Sync,
    ) -> Option<Certificate<L, P>> {
        watch.done.store(0, Ordering::Relaxed);
        watch.of.store(roots.len() as u64, Ordering::Relaxed);
        watch.looked_at.store(0, Ordering::Relaxed);
        let each: Option<Vec<Certificate<L, P>>> = roots
            .par_iter()
            .with_max_len(1)
            .map(|root| {
                let mut found = Certificate::default();
                prove(root, &mut found)?;
                watch.done.fetch_add(1, Ordering::Relaxed);
                Some(found)
            })
            .collect();
        let mut whole = Certificate::default();
        for part in each? {
            whole.leaves.extend(part.leaves);
            whole.open.extend(part.open);
        }
        Some(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Checks what is proved and what is open of every part, how many are done, and nothing where
    /// it was stopped.
    #[test]
    fn all_parts_are_gathered() {
        let at = Rectangle {
            a: [1.0; 2],
            b: [2.0; 2],
        };
        let watch = Watch::default();
        let prove = |root: &u64, found: &mut Certificate<u64>| {
            found.leaves.extend([*root, 100 + root]);
            if root.is_multiple_of(3) {
                let why = "planted";
                found.open.push(Open { at, why });
            }
            (!watch.is_stopped()).then_some(())
        };
        let roots: Vec<u64> = (0..10).collect();
        for _ in 0..2 {
            let whole = Certificate::of_all(&roots, &watch, prove).expect("not stopped");
            let due: Vec<u64> = roots.iter().flat_map(|r| [*r, 100 + r]).collect();
            assert_eq!((whole.leaves, whole.open.len()), (due, 4));
            let counts = [&watch.done, &watch.of].map(|n| n.load(Ordering::Relaxed));
            assert_eq!(counts, [10, 10]);
        }
        watch.looked_at.store(MOST_PARTS - 1, Ordering::Relaxed);
        assert!(!watch.ends() && !watch.is_spent());
        assert!(watch.ends() && watch.is_spent());
        watch.looked_at.store(0, Ordering::Relaxed);
        watch.stop.store(true, Ordering::Relaxed);
        assert!(watch.ends() && !watch.is_spent());
        assert!(Certificate::of_all(&roots, &watch, prove).is_none());
    }
}
