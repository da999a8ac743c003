//! Several codes for the same method, judged at the same cases, side by side.

use super::answer::SolverAnswer;
use super::case::{Case, Cases};
use super::case_report::CaseReport;
use super::method::Method;
use super::referee::Judge;
use super::report::{CandidateReport, MethodReport, RegionReport};
use super::settings::Settings;
use super::tally::Tally;
use rayon::prelude::*;
use serde::Serialize;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

/// The time that an answer takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Speed {
    /// Nanoseconds for an answer, all its values together.
    pub ns_per_answer: f64,
    /// Milliseconds from the start of a program to its end with one answer; none for calls.
    pub start_up_ms: Option<f64>,
    /// Answers that were timed.
    pub answers: u64,
}

/// A code with what was found about it.
#[derive(Clone, Debug, Serialize)]
pub struct Compared {
    /// Its name, distinct from the others.
    pub name: String,
    /// The time that its answers take, if measured.
    pub speed: Option<Speed>,
    /// The findings.
    pub report: MethodReport,
}

/// A code in one region.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Standing {
    /// Cases.
    pub cases: u64,
    /// Cases that did not pass.
    pub failed: u64,
    /// Cases of the wrong kind, or left open by the reference.
    pub wrong: u64,
    /// Largest share of a budget.
    pub of_budget: f64,
    /// Largest error of any output in ulps.
    pub worst_ulps: f64,
    /// Largest root mean square of any output in ulps.
    pub rms_ulps: f64,
    /// Share of the budget divided by that of the best, where both are positive.
    pub ratio: Option<f64>,
    /// True if it is the best here, or one of several: the fewest answers of the wrong kind, and of
    /// those the smallest share of the budget.
    pub best: bool,
}

/// All codes in one region.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Contest {
    /// The region; `all` for all of them.
    pub region: &'static str,
    /// The codes in their order.
    pub standings: Vec<Standing>,
}

/// Several codes side by side.
#[derive(Clone, Debug, Serialize)]
pub struct Comparison {
    /// The method.
    pub method: &'static str,
    /// The codes.
    pub candidates: Vec<Compared>,
    /// Region by region, all together last.
    pub regions: Vec<Contest>,
}

impl Comparison {
    /// Of reports at the same cases. Names that are not distinct are numbered.
    pub fn new(method: &'static str, reports: Vec<(MethodReport, Option<Speed>)>) -> Comparison {
        let mut candidates: Vec<Compared> = Vec::new();
        for (report, speed) in reports {
            let given = report.candidate.as_ref();
            let given = given.map_or("ours".to_string(), |c| c.name.clone());
            let taken = |name: &str| candidates.iter().any(|c: &Compared| c.name == name);
            let numbered = (1..).map(|k| match k {
                1 => given.clone(),
                k => format!("{given} ({k})"),
            });
            let name = numbered.into_iter().find(|n| !taken(n)).unwrap_or_default();
            candidates.push(Compared {
                name,
                speed,
                report,
            });
        }
        let mut places: Vec<&'static str> = Vec::new();
        for c in &candidates {
            for region in c.report.regions.iter().map(|r| r.name) {
                if !places.contains(&region) {
                    places.push(region);
                }
            }
        }
        let of = |place: &'static str| Contest {
            region: place,
            standings: standings(
                candidates
                    .iter()
                    .map(|c| c.report.regions.iter().find(|r| r.name == place)),
            ),
        };
        let mut regions: Vec<Contest> = places.into_iter().map(of).collect();
        regions.push(Contest {
            region: "all",
            standings: standings(candidates.iter().map(|c| Some(&c.report.total))),
        });
        Comparison {
            method,
            candidates,
            regions,
        }
    }

    /// Returns true if every code passes, and there is one.
    pub fn passed(&self) -> bool {
        !self.candidates.is_empty() && self.candidates.iter().all(|c| c.report.passed())
    }

    /// Returns true if the run was ended before all cases were judged.
    pub fn interrupted(&self) -> bool {
        self.candidates.iter().any(|c| c.report.interrupted)
    }
}

fn standings<'a>(reports: impl Iterator<Item = Option<&'a RegionReport>>) -> Vec<Standing> {
    let mut all: Vec<Standing> = reports
        .map(|report| {
            let outputs = report.map_or(&[][..], |r| r.outputs.as_slice());
            let largest = |of: fn(&super::spread::Spread) -> f64| {
                outputs.iter().map(|o| of(&o.ulps)).fold(0.0, f64::max)
            };
            Standing {
                cases: report.map_or(0, |r| r.cases),
                failed: report.map_or(0, RegionReport::failed),
                wrong: report.map_or(0, |r| r.kinds.total() + r.undecided + r.reference_failed),
                of_budget: report.map_or(f64::NAN, |r| r.max_of_budget),
                worst_ulps: largest(|s| s.max),
                rms_ulps: largest(|s| s.rms),
                ratio: None,
                best: false,
            }
        })
        .collect();
    let judged = all.iter().filter(|s| s.cases > 0);
    let best = judged.map(|s| (s.wrong, s.of_budget)).min_by(|a, b| {
        let wrong = a.0.cmp(&b.0);
        wrong.then_with(|| a.1.total_cmp(&b.1))
    });
    if let Some(best) = best {
        for s in all.iter_mut().filter(|s| s.cases > 0) {
            s.best = s.wrong == best.0 && s.of_budget.total_cmp(&best.1).is_eq();
            s.ratio = (best.1 > 0.0 && s.of_budget > 0.0).then(|| s.of_budget / best.1);
        }
    }
    all
}

/// Judges answers of several codes to the same cases on all cores; each tally gets those of its
/// code. A code that gave none to a case has nothing counted.
pub fn judge_together(
    method: &dyn Method,
    settings: &Settings,
    cases: Vec<(Case, Vec<Option<SolverAnswer>>)>,
    tallies: &mut [Tally],
) {
    let judge = Judge::new(method, settings);
    let judged: Vec<Vec<Option<CaseReport>>> = cases
        .into_par_iter()
        .map(|(case, answers)| {
            let mut referee = judge.referee(case);
            let answers = answers.into_iter();
            answers
                .map(|a| a.map(|a| referee.judge(a, false)))
                .collect()
        })
        .collect();
    for reports in &judged {
        for (tally, report) in tallies.iter_mut().zip(reports) {
            report.iter().for_each(|r| tally.add(r));
        }
    }
}

/// Code under comparison: its name, if it is not the method's own, and what it answers.
pub type Contender<'a> = (
    Option<(String, Option<String>)>,
    &'a (dyn Fn(&[f64]) -> SolverAnswer + Sync),
);

/// Cases judged side by side before they are counted.
const CHUNK: usize = 1024;
/// Calls that are timed, and how often; the fastest counts.
const TIMED: usize = 1000;
const ROUNDS: usize = 5;

/// Returns the time of an answer in the fastest of rounds of `answers` each, if there are any.
fn speed(rounds: impl Iterator<Item = Duration>, answers: usize) -> Option<Speed> {
    let fastest = rounds.min().filter(|_| answers > 0)?;
    Some(Speed {
        ns_per_answer: fastest.as_secs_f64() * 1e9 / answers as f64,
        start_up_ms: None,
        answers: answers as u64,
    })
}

/// Compares functions over the method's domain, on all cores, and times them on one.
pub fn compare(method: &dyn Method, contenders: &[Contender], settings: &Settings) -> Comparison {
    let cases = Cases::new(method, settings);
    let answer = |solve: &(dyn Fn(&[f64]) -> SolverAnswer + Sync), input: &[f64]| {
        let caught = catch_unwind(AssertUnwindSafe(|| solve(input)));
        caught.unwrap_or_else(|_| SolverAnswer::Fails("panicked".into()))
    };
    let mut tallies = vec![Tally::new(method, settings); contenders.len()];
    for start in (0..cases.len()).step_by(CHUNK) {
        let end = cases.len().min(start + CHUNK);
        let answered = (start..end).into_par_iter().map(|i| {
            let case = cases.get(i);
            let each = contenders.iter();
            let answers = each.map(|(_, solve)| Some(answer(*solve, &case.input)));
            let answers: Vec<_> = answers.collect();
            (case, answers)
        });
        let answered: Vec<_> = answered.collect();
        judge_together(method, settings, answered, &mut tallies);
    }
    let inputs: Vec<Vec<f64>> = (0..cases.len().min(TIMED))
        .map(|k| cases.get(k * cases.len() / cases.len().min(TIMED)).input)
        .collect();
    let timed = |solve: &(dyn Fn(&[f64]) -> SolverAnswer + Sync)| {
        let round = |_| {
            let start = Instant::now();
            for input in &inputs {
                std::hint::black_box(answer(solve, std::hint::black_box(input)));
            }
            start.elapsed()
        };
        speed((0..ROUNDS).map(round), inputs.len())
    };
    let reports = tallies.into_iter().zip(contenders);
    let reports = reports.map(|(tally, (name, solve))| {
        let mut report = tally.finish(method);
        report.candidate = name.clone().map(|(name, version)| CandidateReport {
            name,
            version,
            command: None,
            answered: report.cases,
            trouble: None,
        });
        (report, timed(*solve))
    });
    Comparison::new(method.name(), reports.collect())
}

#[cfg(test)]
mod tests;
