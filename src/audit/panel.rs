//! Many cases judged on all cores.

use super::answer::SolverAnswer;
use super::case::Case;
use super::judged::answer_of;
use super::method::{Law, Method};
use super::referee::Judge;
use super::settings::Settings;
use super::tally::Tally;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};

/// Cases that a thread takes at a time; all of them are solved before the first is judged: the
/// solver's code and tables stay in the processor's caches from case to case.
const BLOCK: u64 = 32;
/// Blocks for each thread, so that none waits long for the last one.
const BLOCKS: u64 = 8;

/// Cases of these numbers with the answers to them.
pub type Answered<'a> = dyn Fn(Range<usize>) -> Vec<(Case, SolverAnswer)> + Sync + 'a;

/// Judges cases of a method on the threads of the current pool. Each thread counts in a tally of
/// its own: how cases fall to threads does not show in the sum.
pub struct Panel<'a> {
    method: &'a dyn Method,
    judge: Judge<'a>,
    laws: Vec<Law>,
    /// An empty tally.
    empty: Tally,
    /// The tallies that no thread is counting in.
    tallies: Mutex<Vec<Tally>>,
}

impl<'a> Panel<'a> {
    /// The method that is judged.
    pub fn method(&self) -> &'a dyn Method {
        self.method
    }

    /// Creates a panel for reports.
    pub fn new(method: &'a dyn Method, settings: &'a Settings) -> Panel<'a> {
        Panel::counting_in(Tally::new(method, settings), method, settings)
    }

    /// Creates a panel for tallies that are stored; see [`Tally::lean`].
    pub fn lean(method: &'a dyn Method, settings: &'a Settings) -> Panel<'a> {
        Panel::counting_in(Tally::lean(method, settings), method, settings)
    }

    fn counting_in(empty: Tally, method: &'a dyn Method, settings: &'a Settings) -> Panel<'a> {
        Panel {
            method,
            judge: Judge::new(method, settings),
            laws: method.laws(),
            empty,
            tallies: Mutex::default(),
        }
    }

    /// Counts in a tally that no other thread uses.
    fn counting(&self, count: impl FnOnce(&mut Tally)) {
        // Nobody panics with the lock held.
        let free = || self.tallies.lock().unwrap_or_else(PoisonError::into_inner);
        let taken = free().pop();
        let mut tally = taken.unwrap_or_else(|| self.empty.clone());
        count(&mut tally);
        free().push(tally);
    }

    /// Judges `total` cases in blocks, on all threads.
    fn in_blocks(total: u64, judge: impl Fn(Range<u64>) + Sync) {
        let blocks = BLOCKS * rayon::current_num_threads() as u64;
        let block = (total / blocks).clamp(1, BLOCK);
        let one = |k: u64| judge(k * block..total.min((k + 1) * block));
        (0..total.div_ceil(block)).into_par_iter().for_each(one);
    }

    /// Judges the method's own solver at `total` cases, with its laws, until `stop` is set.
    /// `progress` gets the number of cases judged. Returns true if every case was judged.
    pub fn audit(
        &self,
        total: u64,
        case: &(dyn Fn(u64) -> Case + Sync),
        progress: &(dyn Fn(u64) + Sync),
        stop: &AtomicBool,
    ) -> bool {
        let judged = AtomicU64::new(0);
        let go_on = || !stop.load(Ordering::Relaxed);
        Panel::in_blocks(total, |numbers| {
            let cases = while_going(&go_on, numbers, case);
            let answer = |c: &Case| answer_of(self.method, &c.input);
            let answers = while_going(&go_on, &cases, answer);
            let counted = self.count(&cases, answers, &go_on, progress, true);
            judged.fetch_add(counted, Ordering::Relaxed);
        });
        judged.into_inner() == total
    }

    /// Judges `total` answers from elsewhere as long as `go_on` returns true. Returns true if every
    /// answer was judged and none was missing. Each thread asks for the answers that it judges.
    pub fn judge(
        &self,
        total: usize,
        answered: &Answered,
        go_on: &(dyn Fn() -> bool + Sync),
    ) -> bool {
        let whole = AtomicBool::new(true);
        Panel::in_blocks(total as u64, |numbers| {
            let expected = numbers.end - numbers.start;
            let block = answered(numbers.start as usize..numbers.end as usize);
            let (cases, answers): (Vec<_>, Vec<_>) = block.into_iter().unzip();
            if self.count(&cases, answers, go_on, &|_| {}, false) < expected {
                whole.store(false, Ordering::Relaxed);
            }
        });
        whole.into_inner()
    }

    /// Judges answers to cases and counts them; says how many.
    fn count(
        &self,
        cases: &[Case],
        mut answers: Vec<SolverAnswer>,
        go_on: &(dyn Fn() -> bool + Sync),
        progress: &(dyn Fn(u64) + Sync),
        with_laws: bool,
    ) -> u64 {
        let laws = if with_laws { &self.laws[..] } else { &[] };
        // The code of the judge and of the tally, one after the other: the processor's caches hold
        // either.
        let answered = cases.iter().zip(&mut answers);
        let judged = while_going(go_on, answered, |(case, answer)| {
            let brief = self.judge.judge_briefly(case, answer);
            progress(1);
            brief
        });
        self.counting(|tally| {
            for ((case, answer), brief) in cases.iter().zip(&answers).zip(&judged) {
                if !laws.is_empty() {
                    let of = |law: &Law| (law.residual)(&case.input);
                    let residuals: Vec<Option<f64>> = laws.iter().map(of).collect();
                    tally.laws(case, &residuals);
                }
                tally.count(&(case, answer, brief));
            }
        });
        judged.len() as u64
    }

    /// The findings.
    pub fn into_tally(self) -> Tally {
        let tallies = self.tallies.into_inner();
        let mut tallies = tallies.unwrap_or_else(PoisonError::into_inner).into_iter();
        let mut sum = tallies.next().unwrap_or(self.empty);
        tallies.for_each(|t| sum.merge(t));
        sum
    }
}

/// Makes something of each item until `go_on` returns false, in room for all of them.
fn while_going<T, U>(
    go_on: &(impl Fn() -> bool + ?Sized),
    items: impl IntoIterator<Item = T>,
    make: impl FnMut(T) -> U,
) -> Vec<U> {
    let items = items.into_iter();
    let mut made = Vec::with_capacity(items.size_hint().0);
    made.extend(items.take_while(|_| go_on()).map(make));
    made
}

#[cfg(test)]
mod tests;
