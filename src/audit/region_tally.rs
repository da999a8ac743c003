//! The findings in one region so far. Counts, bins, exact sums and firsts of a fixed order:
//! merging is associative and commutative, bit for bit.

use super::by_integer::ByInteger;
use super::case::Case;
use super::case_report::Judged;
use super::judge::{ComponentJudgement, Verdict};
use super::kept::Kept;
use super::kind::{Kind, Kinds};
use super::ranking::First;
use super::report::{Octave, OutputStatistics, Point, RegionReport};
use super::settings::Settings;
use super::spread::{SpreadTally, octave};
use std::cmp::Ordering;
use std::collections::BTreeMap;

/// Cases kept of those with the largest shares of a budget.
pub(super) const WORST: usize = 10;
/// Cases kept of each wrong kind.
pub(super) const EXAMPLES: usize = 3;

/// The part of the cases that a tally keeps.
#[derive(Clone, Copy, Debug)]
pub(super) struct Keep {
    /// Failing cases of a region.
    pub(super) failures: usize,
    /// Nothing gathered yet of errors.
    pub(super) spread: fn() -> SpreadTally,
}

impl Keep {
    /// For a report at the end of a run.
    pub(super) const WHOLE: Keep = Keep {
        failures: 500,
        spread: SpreadTally::default,
    };
    /// For tallies in files, of which there are very many.
    pub(super) const LEAN: Keep = Keep {
        failures: 20,
        spread: SpreadTally::coarse,
    };
}

/// The larger number first, then the earlier case.
fn larger(a: (f64, &Case), b: (f64, &Case)) -> Ordering {
    b.0.total_cmp(&a.0).then_with(|| a.1.order(b.1))
}

/// A number with the case that it belongs to.
pub(super) type Largest = First<(f64, Case)>;

fn offer(largest: &mut Largest, x: f64, case: &Case) {
    largest.offer(|k| larger((k.0, &k.1), (x, case)), || (x, case.clone()));
}

fn by_number(a: &(f64, Case), b: &(f64, Case)) -> Ordering {
    larger((a.0, &a.1), (b.0, &b.1))
}

/// The exponent of octave number 0, were it not zero's.
const BELOW: i32 = -1023;

/// The number of an octave of `f64`.
pub(super) fn number_of(octave: Option<i32>) -> u32 {
    octave.map_or(0, |k| (k - BELOW) as u32)
}

/// The octave of that number.
pub(super) fn octave_of(number: u32) -> Option<i32> {
    (number > 0).then(|| number as i32 + BELOW)
}

/// The findings for one output.
#[derive(Clone, Debug)]
pub(super) struct OutputTally {
    pub(super) values: u64,
    pub(super) kinds: Kinds,
    pub(super) ulps: SpreadTally,
    pub(super) conditioned: SpreadTally,
    pub(super) max_condition: f64,
    pub(super) worst: Largest,
    /// By the number of the octave.
    pub(super) octaves: ByInteger<Largest>,
}

impl OutputTally {
    fn new(keep: Keep) -> OutputTally {
        OutputTally {
            values: 0,
            kinds: Kinds::default(),
            ulps: (keep.spread)(),
            conditioned: (keep.spread)(),
            max_condition: 0.0,
            worst: First::new(1),
            octaves: ByInteger::default(),
        }
    }

    fn add(&mut self, case: &Case, c: &ComponentJudgement) {
        self.values += 1;
        if let Some(kind) = c.kind {
            self.kinds[kind] += 1;
        }
        if c.condition.is_finite() {
            self.max_condition = self.max_condition.max(c.condition);
        }
        if !matches!(c.verdict, Verdict::Pass | Verdict::Over) {
            return;
        }
        self.ulps.add(c.ulps);
        self.conditioned.add(c.conditioned);
        offer(&mut self.worst, c.of_budget, case);
        if c.ulps.is_finite() {
            let ulps = self.ulps.counted(c.ulps);
            let number = number_of(octave(ulps));
            offer(
                self.octaves.or_insert_with(number, || First::new(1)),
                ulps,
                case,
            );
        }
    }

    fn merge(&mut self, other: &OutputTally) {
        self.values += other.values;
        self.kinds.merge(&other.kinds);
        self.ulps.merge(&other.ulps);
        self.conditioned.merge(&other.conditioned);
        self.max_condition = self.max_condition.max(other.max_condition);
        self.worst.merge(&other.worst, by_number);
        for (k, largest) in other.octaves.iter() {
            let own = self.octaves.or_insert_with(k, || First::new(1));
            own.merge(largest, by_number);
        }
    }

    fn statistics(&self, name: &'static str) -> OutputStatistics {
        let worst = self.worst.kept().first();
        let histogram = self.ulps.octaves().into_iter().filter_map(|(k, count)| {
            let (_, worst) = self.octaves.get(number_of(k))?.kept().first()?.clone();
            Some(Octave {
                exponent: k,
                count,
                worst,
            })
        });
        OutputStatistics {
            name,
            values: self.values,
            kinds: self.kinds,
            ulps: self.ulps.spread(),
            conditioned: self.conditioned.spread(),
            histogram: histogram.collect(),
            max_of_budget: worst.map_or(f64::NAN, |w| w.0),
            max_condition: self.max_condition,
            worst: worst.map(|w| w.1.clone()),
            parts: None,
        }
    }
}

/// The findings in a region.
#[derive(Clone, Debug)]
pub(super) struct RegionTally {
    pub(super) cases: u64,
    pub(super) passed: u64,
    pub(super) recorded: u64,
    pub(super) over: u64,
    pub(super) undecided: u64,
    pub(super) reference_failed: u64,
    pub(super) kinds: Kinds,
    pub(super) names: Vec<&'static str>,
    pub(super) outputs: Vec<OutputTally>,
    pub(super) normwise: SpreadTally,
    pub(super) share: Largest,
    pub(super) worst: First<(f64, Kept)>,
    pub(super) wrong: BTreeMap<(Verdict, Option<Kind>), First<Kept>>,
    pub(super) failures: First<Kept>,
    pub(super) points: First<(u64, Point)>,
}

impl RegionTally {
    pub(super) fn new(names: &[&'static str], settings: &Settings, keep: Keep) -> RegionTally {
        RegionTally {
            names: names.to_vec(),
            cases: 0,
            passed: 0,
            recorded: 0,
            over: 0,
            undecided: 0,
            reference_failed: 0,
            kinds: Kinds::default(),
            outputs: vec![OutputTally::new(keep); names.len()],
            normwise: (keep.spread)(),
            share: First::new(1),
            worst: First::new(WORST),
            wrong: BTreeMap::new(),
            failures: First::new(keep.failures),
            points: First::new(settings.points),
        }
    }

    /// One case; `recorded` if it fails as is recorded.
    pub(super) fn add(&mut self, report: &impl Judged, recorded: bool) {
        let (case, judgement) = (report.case(), report.judgement());
        self.cases += 1;
        for (i, c) in judgement.components.iter().enumerate() {
            if let Some(at) = self.output(i, c) {
                self.outputs[at].add(case, c);
            }
        }
        self.sample(report);
        let share = judgement.share();
        if judgement.is_measured() {
            if !judgement.components.is_empty() {
                self.normwise.add(judgement.normwise);
            }
            offer(&mut self.share, share, case);
            self.worst.offer(
                |k| larger((k.0, k.1.case()), (share, case)),
                || (share, Kept::of(report)),
            );
        }
        match judgement.verdict {
            Verdict::Pass => self.passed += 1,
            _ if recorded => self.recorded += 1,
            Verdict::Over => self.over += 1,
            Verdict::Undecided => self.undecided += 1,
            Verdict::OracleError => self.reference_failed += 1,
            Verdict::WrongKind => {
                let kind = judgement.kind.unwrap_or(Kind::Unreadable);
                self.kinds[kind] += 1;
            }
        }
        if judgement.verdict == Verdict::Pass || recorded {
            return;
        }
        let earlier = |kept: &Kept| kept.case().order(case);
        self.failures.offer(earlier, || Kept::of(report));
        if judgement.verdict != Verdict::Over {
            let key = (judgement.verdict, judgement.kind);
            let examples = self.wrong.entry(key);
            let examples = examples.or_insert_with(|| First::new(EXAMPLES));
            examples.offer(earlier, || Kept::of(report));
        }
    }

    /// Which output value `i` belongs to. Of a table some may be missing.
    fn output(&self, i: usize, c: &ComponentJudgement) -> Option<usize> {
        let cyclic = i % self.names.len();
        let named = self.names[cyclic];
        match std::ptr::eq(named, c.output) || named == c.output {
            true => Some(cyclic),
            false => self.names.iter().position(|n| *n == c.output),
        }
    }

    /// The cases with the smallest hashes of their inputs: a sample that does not depend on the
    /// order or on the machine.
    fn sample(&mut self, report: &impl Judged) {
        if self.points.room() == 0 {
            return;
        }
        let (case, judgement) = (report.case(), report.judgement());
        let hash = case.hash();
        let outputs = self.names.len();
        let largest = |o: usize| {
            let all = judgement.components.iter();
            let own = all.filter(|c| c.output == self.names[o] && c.kind.is_none());
            own.map(|c| c.ulps).fold(f64::NAN, f64::max)
        };
        self.points.offer(
            |(h, p)| h.cmp(&hash).then_with(|| p.case.order(case)),
            || {
                let point = Point {
                    case: case.clone(),
                    verdict: judgement.verdict,
                    ulps: (0..outputs).map(largest).collect(),
                    of_budget: judgement.share(),
                };
                (hash, point)
            },
        );
    }

    /// Cases that got no answer and are counted only.
    pub(super) fn unanswered(&mut self, cases: u64) {
        self.cases += cases;
        self.kinds[Kind::Unanswered] += cases;
    }

    pub(super) fn merge(&mut self, other: &RegionTally) {
        self.cases += other.cases;
        self.passed += other.passed;
        self.recorded += other.recorded;
        self.over += other.over;
        self.undecided += other.undecided;
        self.reference_failed += other.reference_failed;
        self.kinds.merge(&other.kinds);
        for (own, more) in self.outputs.iter_mut().zip(&other.outputs) {
            own.merge(more);
        }
        self.normwise.merge(&other.normwise);
        self.share.merge(&other.share, by_number);
        self.worst.merge(&other.worst, |a, b| {
            larger((a.0, a.1.case()), (b.0, b.1.case()))
        });
        let earlier = |a: &Kept, b: &Kept| a.case().order(b.case());
        for (key, examples) in &other.wrong {
            let own = self.wrong.entry(*key);
            own.or_insert_with(|| First::new(EXAMPLES))
                .merge(examples, earlier);
        }
        self.failures.merge(&other.failures, earlier);
        self.points.merge(&other.points, |a, b| {
            a.0.cmp(&b.0).then_with(|| a.1.case.order(&b.1.case))
        });
    }

    /// The cases with the largest shares, the largest first.
    pub(super) fn worst(&self) -> &[(f64, Kept)] {
        self.worst.kept()
    }

    /// The first of each wrong kind.
    pub(super) fn wrong(&self) -> impl Iterator<Item = (&(Verdict, Option<Kind>), &[Kept])> {
        self.wrong.iter().map(|(key, first)| (key, first.kept()))
    }

    /// The first cases that did not pass.
    pub(super) fn failures(&self) -> &[Kept] {
        self.failures.kept()
    }

    /// The sample, in the order of cases.
    pub(super) fn points(&self) -> Vec<Point> {
        let kept = self.points.kept().iter();
        let mut points: Vec<Point> = kept.map(|(_, p)| p.clone()).collect();
        points.sort_by(|a, b| a.case.order(&b.case));
        points
    }

    /// Returns its report; `norm` is true if normwise errors mean something.
    pub(super) fn report(
        &self,
        (name, description): (&'static str, &'static str),
        norm: bool,
    ) -> RegionReport {
        let worst = self.share.kept().first();
        let outputs = self.outputs.iter().zip(&self.names);
        RegionReport {
            name,
            description,
            cases: self.cases,
            passed: self.passed,
            recorded: self.recorded,
            over: self.over,
            undecided: self.undecided,
            reference_failed: self.reference_failed,
            kinds: self.kinds,
            outputs: outputs.map(|(o, name)| o.statistics(name)).collect(),
            normwise: norm.then(|| self.normwise.spread()),
            max_of_budget: worst.map_or(f64::NAN, |w| w.0),
            worst: worst.map(|w| w.1.clone()),
        }
    }
}

#[cfg(test)]
mod tests;
