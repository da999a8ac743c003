//! What a campaign found worse than anything recorded, added to a folder of hard cases.

use crate::cli::commands::hunt::hard_folder;
use crate::cli::complain;
use crate::cli::failure::Failure;
use mechaudit::audit::{HardCase, Method, Origin, rounded_up};
use mechaudit::campaign::{Kind, Part, PartSum, Plan};
use std::path::Path;

/// Whether a part judges the method's own solver by its own budgets.
fn is_of_method(part: &Part) -> bool {
    let own = part.limit.is_some() || part.normwise.is_some();
    matches!(part.kind, Kind::Audit | Kind::Hunt) && !own && !part.single && part.outputs.is_none()
}

/// The worst input of each output of a part.
fn worst(plan: &Plan, part: &Part, sum: &PartSum, method: &dyn Method) -> Vec<HardCase> {
    let case = |share: f64, output: &str, reason: String, input: &[f64]| HardCase {
        share: rounded_up(share),
        output: output.into(),
        reason: format!("{reason}; campaign {}", plan.name),
        input: input.to_vec(),
        folder: None,
    };
    let all: Vec<HardCase> = match sum {
        PartSum::Report(report) => {
            let outputs = report.outputs().iter();
            let found = outputs.filter_map(|o| Some((o, o.worst.as_ref()?)));
            found
                .filter(|(_, c)| !matches!(c.origin, Origin::Hard { .. }))
                .map(|(o, c)| {
                    let reason = format!("drawn in {} from seed {}", c.region, part.seed);
                    case(o.max_of_budget, o.name, reason, &c.input)
                })
                .collect()
        }
        PartSum::Hunts(hunts, _) => {
            let mut worst = hunts.worst(method);
            worst.dedup_by_key(|w| w.output);
            let one = |w: &mechaudit::campaign::WorstOf| {
                let reason = format!("{}, seed {}", w.reason, w.seed);
                case(w.share, w.output, reason, &w.input)
            };
            worst.iter().map(one).collect()
        }
        PartSum::Proof(_) => Vec::new(),
    };
    let good = |c: &HardCase| c.share.is_finite() && method.admits(&c.input);
    all.into_iter().filter(good).collect()
}

/// Adds to `METHOD.csv` what takes up more of an output's budget than any line there, by a hundredth or
/// more, as a hunt does.
pub fn record(folder: &Path, plan: &Plan, parts: &[PartSum]) -> Result<(), Failure> {
    for (part, sum) in plan.parts.iter().zip(parts) {
        if !is_of_method(part) {
            continue;
        }
        let method = part.method();
        let found = worst(plan, part, sum, &*method);
        let worse = |known: &[HardCase]| {
            let before = |c: &HardCase| {
                let same = known.iter().filter(|k| k.output == c.output);
                same.map(|k| k.share).fold(0.0, f64::max)
            };
            let new = found.into_iter().filter(|c| c.share > 1.01 * before(c));
            new.collect::<Vec<HardCase>>()
        };
        let added = hard_folder::add(folder, &*method, worse)?;
        for (number, case) in added {
            let (name, output) = (method.name(), case.output);
            complain(&format!(
                "{name}: hard case {number} added, {output} at {} of its budget",
                case.share
            ));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use mechaudit::machine::Source;

    /// What a program, single precision, other budgets or some outputs found is not the method's own.
    #[test]
    fn only_the_methods_own_cases_are_kept() {
        let part = |more: &str| {
            let text = format!("name = \"x\"\n[[part]]\nmethods = [\"faddeeva\"]\n{more}");
            Plan::read(&Source::toml(text))
                .unwrap()
                .parts
                .swap_remove(0)
        };
        assert!(is_of_method(&part("cases = 1")));
        assert!(is_of_method(&part("kind = \"hunt\"\nhunts = 1")));
        for more in [
            "cases = 1\nulps = 1",
            "cases = 1\nnormwise = 3",
            "cases = 1\nsingle = true",
            "cases = 1\noutputs = [\"Re W\"]",
            "kind = \"proof\"",
            "kind = \"candidate\"\ncases = 1\nexec = \"true\"",
        ] {
            assert!(!is_of_method(&part(more)), "{more}");
        }
    }
}
