//! The findings, gathered case by case, on one machine or on many.

use super::case::{Case, quoted};
use super::case_report::{CaseReport, Judged};
use super::hard::HardCase;
use super::judge::Verdict;
use super::judged::complete;
use super::kept::Kept;
use super::layout::Layout;
use super::method::Method;
use super::region_tally::{Keep, RegionTally, WORST};
use super::report::{LawReport, MethodReport, OutputBudget, Reproduce};
use super::settings::Settings;
use std::cmp::Ordering;

/// Counts judged cases as they come and keeps no more of them than it has to.
#[derive(Clone)]
pub struct Tally {
    settings: Settings,
    keep: Keep,
    outputs: Vec<&'static str>,
    /// In the order of reports.
    regions: Vec<(&'static str, RegionTally)>,
    /// The place of the last one that a case was counted in.
    last: usize,
    /// Those of the domain with their descriptions.
    known: Vec<(&'static str, &'static str)>,
    laws: Vec<LawReport>,
    interrupted: bool,
    hard: Vec<HardCase>,
}

/// The descriptions of regions beside those of the domain.
const NAMED: [(&str, &str); 5] = [
    ("check-points", "named points of the domain"),
    ("hard", "hard cases that hunts have found"),
    ("given", "inputs given by themselves"),
    ("box", "drawn in a box"),
    ("near", "drawn about an input"),
];

impl Tally {
    /// An empty tally.
    pub fn new(method: &dyn Method, settings: &Settings) -> Tally {
        let laws = method.laws().into_iter().map(|law| LawReport {
            name: law.name,
            statement: law.statement,
            cases: 0,
            worst: 0.0,
            worst_case: None,
        });
        let domain = method.domain().regions.into_iter();
        let domain = domain.map(|r| (r.name, r.description));
        Tally {
            settings: settings.clone(),
            keep: Keep::WHOLE,
            outputs: method.outputs().iter().map(|o| o.name).collect(),
            regions: Vec::new(),
            last: 0,
            known: NAMED.into_iter().chain(domain).collect(),
            laws: laws.collect(),
            interrupted: false,
            hard: method.hard(),
        }
    }

    /// Nothing found yet, for tallies that are [stored](Tally::stored): percentiles are rounded up
    /// by less than a hundredth, and of each region's failing cases the first twenty are kept.
    /// Merges with its like only.
    pub fn lean(method: &dyn Method, settings: &Settings) -> Tally {
        Tally {
            keep: Keep::LEAN,
            ..Tally::new(method, settings)
        }
    }

    /// The place of a region in reports: as in the domain, then by name.
    fn place(&self, name: &'static str) -> (usize, &'static str) {
        let known = self.known.iter().position(|r| r.0 == name);
        (known.unwrap_or(usize::MAX), name)
    }

    fn region(&mut self, name: &'static str) -> &mut RegionTally {
        // Cases come region by region.
        let last = self.regions.get(self.last);
        if last.is_none_or(|r| !std::ptr::eq(r.0, name)) {
            let found = self.regions.iter().position(|r| r.0 == name);
            self.last = found.unwrap_or_else(|| {
                let place = self.place(name);
                let at = self.regions.partition_point(|r| self.place(r.0) < place);
                let new = RegionTally::new(&self.outputs, &self.settings, self.keep);
                self.regions.insert(at, (name, new));
                at
            });
        }
        &mut self.regions[self.last].1
    }

    /// One case.
    pub fn add(&mut self, report: &CaseReport) {
        self.count(report);
    }

    /// One case, of which there may be no report yet.
    pub(super) fn count(&mut self, judged: &impl Judged) {
        let recorded = self.is_recorded(judged);
        self.region(judged.case().region).add(judged, recorded);
    }

    /// Returns true if this is a hard case, each output over its budget by no more than is recorded
    /// of it. It is known by its input, which may have come in a file.
    fn is_recorded(&self, judged: &impl Judged) -> bool {
        let (case, judgement) = (judged.case(), judged.judgement());
        if judgement.verdict != Verdict::Over {
            return false;
        }
        // A norm over its budget is no value over its own.
        if judgement.norm_of_budget > 1.0 {
            return false;
        }
        let bits = |x: &f64| x.to_bits();
        let input = || case.input.iter().map(bits);
        let same = |h: &&HardCase| h.input.iter().map(bits).eq(input());
        let known: Vec<&HardCase> = self.hard.iter().filter(same).collect();
        let components = judgement.components.iter();
        let mut over = components.filter(|c| c.verdict != Verdict::Pass);
        over.all(|c| (known.iter()).any(|h| h.output == c.output && h.allows(c.of_budget)))
    }

    /// The residuals of the method's laws at a case, in the laws' order.
    pub fn laws(&mut self, case: &Case, residuals: &[Option<f64>]) {
        for (k, residual) in residuals.iter().enumerate().take(self.laws.len()) {
            let Some(x) = *residual else { continue };
            // A residual that is not a number breaks the law.
            let x = if x.is_nan() { f64::INFINITY } else { x };
            let before = self.laws[k].worst_case.as_ref();
            let earlier = before.is_none_or(|b| {
                let at = self.place(b.region);
                let places = self.place(case.region).cmp(&at);
                places.then_with(|| case.order(b)).is_lt()
            });
            let law = &mut self.laws[k];
            law.cases += 1;
            if x > law.worst || (x == law.worst && x > 0.0 && earlier) {
                law.worst = x;
                law.worst_case = Some(case.clone());
            }
        }
    }

    /// Adds what another tally of the same method and settings has gathered. The sum does not
    /// depend on the order in which tallies are added, bit for bit.
    pub fn merge(&mut self, other: Tally) {
        for (name, tally) in other.regions {
            self.region(name).merge(&tally);
        }
        for k in 0..self.laws.len().min(other.laws.len()) {
            let (own, more) = (&self.laws[k], &other.laws[k]);
            let order = more.worst.total_cmp(&own.worst).then_with(|| {
                match (&own.worst_case, &more.worst_case) {
                    (Some(a), Some(b)) => {
                        let places = self.place(a.region).cmp(&self.place(b.region));
                        places.then_with(|| a.order(b))
                    }
                    (a, b) => b.is_some().cmp(&a.is_some()),
                }
            });
            let law = &mut self.laws[k];
            law.cases += other.laws[k].cases;
            if order == Ordering::Greater {
                law.worst = other.laws[k].worst;
                law.worst_case.clone_from(&other.laws[k].worst_case);
            }
        }
        self.interrupted |= other.interrupted;
    }

    /// The run ends before its last case.
    pub fn interrupt(&mut self) {
        self.interrupted = true;
    }

    /// Returns true if [`Tally::interrupt`] has been called.
    pub fn is_interrupted(&self) -> bool {
        self.interrupted
    }

    /// Cases of a region that got no answer: they count, and do not pass.
    pub fn unanswered(&mut self, region: &'static str, cases: u64) {
        if cases > 0 {
            self.region(region).unanswered(cases);
        }
    }

    /// The ten worst: of each region the worst, and if there is room the worst of the rest.
    fn worst(&self) -> Vec<Kept> {
        let all = |skip: usize, take: usize| {
            let of = move |(at, (_, t)): (usize, &'_ (_, RegionTally))| {
                let some = t.worst().iter().skip(skip).take(take).cloned();
                some.map(move |(share, kept)| (share, at, kept))
                    .collect::<Vec<_>>()
            };
            let mut all: Vec<_> = self.regions.iter().enumerate().flat_map(of).collect();
            // Stable: within a region they are in their order.
            all.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
            all
        };
        let chosen = all(0, 1).into_iter().chain(all(1, WORST)).take(WORST);
        chosen.map(|(_, _, kept)| kept).collect()
    }

    /// The report.
    pub fn finish(self, method: &dyn Method) -> MethodReport {
        let settings = &self.settings;
        let outputs = method.outputs();
        let norm_budget = method.norm_budget();
        let norm = norm_budget.is_some() || outputs.iter().all(|o| o.unit == outputs[0].unit);
        let mut all = RegionTally::new(&self.outputs, settings, self.keep);
        let mut regions = Vec::new();
        let (mut wrong, mut failures, mut points) = (Vec::new(), Vec::new(), Vec::new());
        for (name, tally) in &self.regions {
            let described = self.known.iter().find(|r| r.0 == *name);
            let described = described.map_or("", |r| r.1);
            regions.push(tally.report((*name, described), norm));
            wrong.extend(tally.wrong().map(|(key, kept)| (*key, kept.to_vec())));
            failures.extend_from_slice(tally.failures());
            points.extend(tally.points());
            all.merge(tally);
        }
        // Kind by kind; of each as many as of one region, the first regions' first.
        wrong.sort_by_key(|w| w.0);
        let mut examples: Vec<Kept> = Vec::new();
        for group in wrong.chunk_by(|a, b| a.0 == b.0) {
            let first = group.iter().filter_map(|(_, kept)| kept.first());
            let rest = group.iter().flat_map(|(_, kept)| kept.iter().skip(1));
            examples.extend(first.chain(rest).take(3).cloned());
        }
        let judged = |kept: Vec<Kept>| -> Vec<CaseReport> {
            let all = kept.into_iter();
            all.map(|k| k.report(method, settings)).collect()
        };
        let completed = |kept: Vec<Kept>| -> Vec<CaseReport> {
            let all = judged(kept).into_iter();
            all.map(|r| complete(method, r, settings)).collect()
        };
        let total = all.report(("all", "all regions together"), norm);
        let layout = Layout::new(method);
        MethodReport {
            method: method.name(),
            summary: method.summary(),
            source: method.source(),
            remarks: method.remarks(),
            candidate: None,
            settings: settings.clone(),
            format: method.format(),
            inputs: layout.singles(),
            layout,
            budgets: outputs
                .iter()
                .map(|o| OutputBudget {
                    name: o.name,
                    unit: o.unit,
                    budget: o.budget,
                })
                .collect(),
            norm_budget,
            proved: method.proved(),
            cases: total.cases,
            passed: total.passed,
            recorded: total.recorded,
            interrupted: self.interrupted,
            failures_left_out: total.failed() - failures.len() as u64,
            total,
            regions,
            worst: completed(self.worst()),
            wrong: completed(examples),
            laws: self.laws,
            map: None,
            failures: judged(failures),
            points,
            reproduce: Reproduce {
                head: format!("mechaudit audit {} ", quoted(method.name())),
                tail: String::new(),
            },
        }
    }
}

mod stored;
pub use stored::{StoredError, StoredTally};

#[cfg(test)]
mod tests;
