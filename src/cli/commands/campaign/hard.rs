//! Adds the findings of a campaign that are worse than anything recorded to a folder of hard cases.

use crate::cli::complain;
use crate::cli::failure::Failure;
use crate::cli::files::hard_folder;
use mechaudit::audit::{HardCase, Method, Origin, rounded_up};
use mechaudit::campaign::{Kind, Part, PartSum, Plan};
use std::path::Path;

/// Returns true if a part judges the method's own solver by its own budgets.
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

/// Adds to `METHOD.csv` what takes up more of an output's budget than any line there, by a
/// hundredth or more, as a hunt does.
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

    /// Findings with a program, single precision, other budgets or some outputs are not the
    /// method's own.
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

    /// The worst that was drawn or hunted of each output, with where it is from.
    #[test]
    fn the_worst_of_each_output_is_kept() {
        use mechaudit::campaign::{Deal, Sum, run};
        let text = "name = \"some\"\n[[part]]\nmethods = [\"slider-crank\"]\nseeds = [3]\nregions = [\"central\"]\ncases = 4\n\
                    [[part]]\nkind = \"hunt\"\nmethods = [\"slider-crank\"]\nseeds = [5]\nhunts = 2\nevaluations = 40";
        let plan = Plan::read(&Source::toml(text)).unwrap();
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap();
        let stop = std::sync::atomic::AtomicBool::new(false);
        let deal = Deal::new(&plan, 1);
        let found = run(
            (&plan, &deal, 0),
            &pool,
            &|_, _, _, _| Ok(None),
            &|_| (),
            &stop,
        );
        let methods = plan.methods();
        let mut sum = Sum::new(&plan, &methods);
        sum.add(found.unwrap().unwrap()).unwrap();
        let parts = sum.finish(true);
        let outputs = methods[0].outputs();
        for (k, reason) in [(0, " from seed 3; campaign some"), (1, "; campaign some")] {
            let kept = worst(&plan, &plan.parts[k], &parts[k], &*methods[k]);
            assert!(!kept.is_empty() && kept.len() <= outputs.len());
            let mut names: Vec<&str> = kept.iter().map(|c| c.output.as_str()).collect();
            for case in &kept {
                assert!(case.reason.ends_with(reason), "{}", case.reason);
                assert!(case.share.is_finite() && methods[k].admits(&case.input));
                let drawn = case.reason.starts_with("drawn in ");
                assert_eq!(drawn, k == 0, "{}", case.reason);
                assert!(k == 0 || case.reason.contains(", seed "), "{}", case.reason);
            }
            names.dedup();
            assert_eq!(names.len(), kept.len(), "one of each output");
        }
        // A share that is no number is none to be met again.
        if let PartSum::Report(report) = &parts[0] {
            for case in worst(&plan, &plan.parts[0], &parts[0], &*methods[0]) {
                let of = report
                    .outputs()
                    .iter()
                    .find(|o| o.name == case.output)
                    .unwrap();
                assert_eq!(case.share, rounded_up(of.max_of_budget));
                assert!(!matches!(
                    of.worst.as_ref().unwrap().origin,
                    Origin::Hard { .. }
                ));
            }
        }
    }
}
