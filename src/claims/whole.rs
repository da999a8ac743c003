//! The atlas: rows, claims, findings.

use super::claim::Verdict;
use super::code::Code;
use super::decide::{Decided, decide};
use super::effort::Effort;
use super::findings::{Finding, findings};
use super::speed::{nanoseconds, nanoseconds_of_lines};
use super::survey::{Row, survey, survey_lines};
use super::{NOT_AT_HAND, claims};
use mechaudit_atlas::{Algorithm, Profile};
use serde::Serialize;

/// An algorithm that is missing.
#[derive(Clone, Debug, Serialize)]
pub struct Missing {
    /// Its name.
    pub name: String,
    /// The paper, or the library.
    pub source: String,
    /// Why.
    pub why: String,
}

/// All of it.
#[derive(Clone, Debug, Serialize)]
pub struct Atlas {
    /// How much was done.
    pub effort: Effort,
    /// The codes for w.
    pub rows: Vec<Row>,
    /// Those for the Hartmann–Tran profile.
    pub profiles: Vec<Row>,
    /// Holds what is said of them.
    pub claims: Vec<Decided>,
    /// Holds what follows for what is in use.
    pub findings: Vec<Finding>,
    /// Holds what is missing.
    pub not_at_hand: Vec<Missing>,
}

/// The atlas of these codes and profiles. `step` is called when something is done, with a word for
/// it.
pub fn atlas(
    codes: &[Code],
    lines: &[Profile],
    effort: &Effort,
    timed: bool,
    step: &dyn Fn(&str),
) -> Atlas {
    let mut rows = survey(codes, effort, step);
    let of_lines: Vec<Code> = lines.iter().map(|p| Code::line(*p)).collect();
    let mut profiles = survey_lines(&of_lines, effort);
    step("lines");
    let chosen =
        |name: &str| codes.iter().any(|c| c.name == name) || lines.iter().any(|p| p.name == name);
    if timed {
        let algorithm = |row: &Row| codes.iter().find(|c| c.name == row.name)?.algorithm;
        let double = rows.iter_mut().filter(|r| !r.single);
        let (own, algorithms): (Vec<&mut Row>, Vec<Algorithm>) =
            double.filter_map(|r| algorithm(r).map(|a| (r, a))).unzip();
        let of_w = own.into_iter().zip(nanoseconds(&algorithms));
        for (row, ns) in of_w.chain(profiles.iter_mut().zip(nanoseconds_of_lines(lines))) {
            row.nanoseconds = Some(ns);
        }
        step("speed");
    }
    let missing = |name: &str| NOT_AT_HAND.iter().any(|m| m.name == name);
    let everything = mechaudit_atlas::all().iter().all(|a| chosen(a.name));
    let decided: Vec<Decided> = claims()
        .iter()
        .filter(|c| chosen(c.algorithm) || (everything && missing(c.algorithm)))
        .map(|claim| {
            let decided = decide(claim, effort);
            step(claim.algorithm);
            decided
        })
        .collect();
    Atlas {
        effort: *effort,
        findings: findings(&|name| chosen(name)),
        rows,
        profiles,
        claims: decided,
        not_at_hand: match everything {
            true => NOT_AT_HAND
                .iter()
                .map(|m| Missing {
                    name: m.name.into(),
                    source: m.source.into(),
                    why: m.why.into(),
                })
                .collect(),
            false => Vec::new(),
        },
    }
}

impl Atlas {
    /// How many claims have that verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        self.claims.iter().filter(|c| c.verdict == verdict).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::RefCell;

    #[test]
    fn each_step_is_told_when_it_is_done() {
        let told = RefCell::new(Vec::new());
        let code = Code::double(mechaudit_atlas::find("wells-1999-r4").unwrap());
        let effort = Effort { cases: 1, seed: 1 };
        let step = |word: &str| told.borrow_mut().push(word.to_string());
        atlas(&[code], &[], &effort, false, &step);
        let due = ["values", "derivatives", "heights", "seams", "lines"];
        assert_eq!(told.into_inner()[..5], due);
    }

    /// Times are of algorithms in double precision and of profiles, and only where they are asked
    /// for.
    #[test]
    fn what_is_chosen_is_surveyed_timed_and_decided() {
        let algorithm = mechaudit_atlas::find("humlicek-1982").unwrap();
        let profile = *mechaudit_atlas::PROFILES
            .iter()
            .find(|p| p.name == "hapi-pcqsdhc")
            .unwrap();
        let effort = Effort { cases: 1, seed: 1 };
        for timed in [true, false] {
            let told = RefCell::new(Vec::new());
            let step = |word: &str| told.borrow_mut().push(word.to_string());
            let codes = [Code::single(algorithm).unwrap(), Code::double(algorithm)];
            let found = atlas(&codes, &[profile], &effort, timed, &step);
            assert_eq!(found.effort, effort);
            let times = found.rows.iter().map(|r| r.nanoseconds.is_some());
            assert_eq!(times.collect::<Vec<_>>(), [false, timed]);
            let names = found
                .profiles
                .iter()
                .map(|r| (r.name.as_str(), r.nanoseconds.is_some()));
            assert_eq!(names.collect::<Vec<_>>(), [("hapi-pcqsdhc", timed)]);
            let decided: Vec<&str> = found.claims.iter().map(|c| c.algorithm).collect();
            assert_eq!(decided, ["humlicek-1982", "humlicek-1982", "hapi-pcqsdhc"]);
            let told = told.into_inner();
            assert_eq!(told.contains(&"speed".into()), timed);
            assert_eq!(told[told.len() - 3..], decided[..]);
            let findings: Vec<&str> = found.findings.iter().map(|f| f.algorithm).collect();
            assert_eq!(findings, ["humlicek-1982", "hapi-pcqsdhc", "hapi-pcqsdhc"]);
            assert!(found.not_at_hand.is_empty());
            let verdicts = [
                Verdict::Holds,
                Verdict::InPart,
                Verdict::Refuted,
                Verdict::Open,
            ];
            assert_eq!(verdicts.map(|v| found.count(v)).iter().sum::<usize>(), 3);
            for v in verdicts {
                let due = found.claims.iter().filter(|c| c.verdict == v).count();
                assert_eq!(found.count(v), due);
            }
            assert_eq!(found.count(Verdict::NotTestable), 0);
        }
    }
}
