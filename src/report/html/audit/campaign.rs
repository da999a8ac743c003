//! The parts of a campaign's page that audits do not have.

use crate::audit::{Method, MethodReport, rounded_up};
use crate::campaign::{HuntTally, PartSum, Plan, ProofTally};
use crate::report::html::page::class;
use crate::report::words::Tone;
use crate::report::words::numbers::percent;
use maud::{Markup, html};

/// Cases of all parts.
pub fn totals(reports: &[&MethodReport]) -> String {
    let sum = |of: fn(&MethodReport) -> u64| reports.iter().map(|r| of(r)).sum::<u64>();
    let passed = sum(|r| r.passed + r.recorded);
    format!("{passed} of {} cases pass", sum(|r| r.cases))
}

/// The hunts, part by part, and the worst inputs that they found.
pub fn hunts(plan: &Plan, found: &[PartSum]) -> Markup {
    let parts = plan.parts.iter().zip(found);
    let hunts: Vec<(String, &HuntTally, &dyn Method)> = parts
        .filter_map(|(part, found)| match found {
            PartSum::Hunts(hunts, method) => Some((part.label(), hunts, &**method)),
            PartSum::Report(_) | PartSum::Proof(_) => None,
        })
        .collect();
    html! {
        @if !hunts.is_empty() {
            section { "\n"
                h2 #hunts { "Hunts" } "\n"
                div.scroll tabindex="0" { table { "\n"
                    thead { tr {
                        th.left { "part" } th { "hunts" } th { "evaluations" } th { "failures" }
                        th.left { "output" } th { "of budget" } th.left { "" } th.left { "found" }
                        th.left { "again" }
                    } } "\n"
                    tbody { "\n"
                        @for (label, hunts, method) in &hunts { (lines(label, hunts, *method)) }
                    } "\n"
                } } "\n"
            } "\n"
        }
    }
}

/// The proofs, part by part: what is proved by each formula so far.
pub fn proofs(plan: &Plan, found: &[PartSum]) -> Markup {
    let parts = plan.parts.iter().zip(found);
    let proofs: Vec<(String, &ProofTally)> = parts
        .filter_map(|(part, found)| match found {
            PartSum::Proof(proof) => Some((part.label(), proof)),
            _ => None,
        })
        .collect();
    let bound = |x: f64| match x.is_finite() {
        true => rounded_up(x).to_string(),
        false => "–".into(),
    };
    html! {
        @if !proofs.is_empty() {
            section { "\n"
                h2 #proofs { "Proofs" } "\n"
                p { "Bounds of the norm in units of 2⁻⁵², of components in units in the last place; rounded up." } "\n"
                div.scroll tabindex="0" { table { "\n"
                    thead { tr {
                        th.left { "part" } th.left { "formula" } th { "boxes" } th.left { "measure" } th { "bound" } th { "open" }
                    } } "\n"
                    tbody { "\n"
                        @for (label, proof) in &proofs {
                            @for (name, f) in proof.formulas() {
                                @for (measure, attained) in proof.measures().zip(&f.bounds) {
                                    tr {
                                        td.left { (label) } td.left { (name) } td { (f.boxes) }
                                        td.left { (measure) } td { (bound(attained.bound())) } td {}
                                    } "\n"
                                }
                            }
                            @for measure in proof.measures() {
                                tr {
                                    td.left { (label) } td.left { b { "all" } } td { (proof.boxes()) }
                                    td.left { (measure) } td { b { (bound(proof.bound(measure))) } } td {}
                                } "\n"
                            }
                            tr {
                                td.left { (label) } td.left { b { "all" } } td { (proof.boxes()) } td {} td {}
                                td { span.(class(if proof.open == 0 { Tone::Good } else { Tone::Bad })) { (proof.open) } }
                            } "\n"
                        }
                    } "\n"
                } } "\n"
            } "\n"
        }
    }
}

/// A line for the worst of each output.
fn lines(label: &str, hunts: &HuntTally, method: &dyn Method) -> Markup {
    let mut worst = hunts.worst(method);
    worst.dedup_by_key(|w| w.output);
    html! {
        @for w in &worst {
            tr {
                td.left { (label) }
                td { (hunts.hunts) } td { (hunts.evaluations) } td { (hunts.failures) }
                td.left { (w.output) }
                td { (percent(w.share)) }
                td.left { @if w.new { span.sign.(class(tone(w.share))) { "new" } } }
                td.left.wrap { (w.reason) ", seed " (w.seed) }
                td.left { code { (w.reproduce(method)) } }
            } "\n"
        }
    }
}

fn tone(share: f64) -> Tone {
    if share > 1.0 { Tone::Bad } else { Tone::Doubt }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::gallery::Gallery;
    use crate::report::text::method::tests::{fabricated, passing};

    #[test]
    fn what_is_new_is_bad_where_it_is_over_budget() {
        for (share, due) in [
            (0.5, Tone::Doubt),
            (1.0, Tone::Doubt),
            (1.001, Tone::Bad),
            (f64::INFINITY, Tone::Bad),
        ] {
            assert_eq!(tone(share), due, "{share}");
        }
    }

    #[test]
    fn recorded_cases_count_as_passed() {
        let mut recorded = passing();
        (recorded.passed, recorded.recorded) = (390, 10);
        let all = [&fabricated(), &recorded];
        assert_eq!(totals(&all), "799 of 800 cases pass");
        assert_eq!(totals(&[]), "0 of 0 cases pass");
    }

    fn plan(kinds: &[&str]) -> Plan {
        let part = |kind: &&str| {
            let hunts = if *kind == "hunt" { "hunts = 3" } else { "" };
            format!("[[part]]\nkind = \"{kind}\"\nmethods = [\"faddeeva\"]\n{hunts}\n")
        };
        let parts: String = kinds.iter().map(part).collect();
        let text = format!("name = \"x\"\n{parts}");
        Plan::read(&crate::machine::Source::toml(text)).unwrap()
    }

    /// Of each output the worst input alone, and each kind of part in a section of its own.
    #[test]
    fn hunts_and_proofs_have_a_section_where_there_are_any() {
        let worst = |share: f64, seed: u64| {
            serde_json::json!({
                "order": !share.to_bits(),
                "input": [0.5f64.to_bits(), 1.0f64.to_bits()],
                "seed": seed,
                "reason": "planted",
            })
        };
        let found = serde_json::json!({
            "hunts": 3,
            "evaluations": 700,
            "failures": 1,
            "first_failures": [],
            "worst": [[0, [worst(1e9, 7), worst(0.5, 8)]], [1, [worst(1e-9, 9)]]],
        });
        let tally: HuntTally = serde_json::from_value(found).unwrap();
        let method = || crate::methods::find("faddeeva").unwrap();
        let sums = || vec![PartSum::Hunts(tally.clone(), method())];
        let proof = || vec![PartSum::Proof(ProofTally::default())];
        let mut all = Gallery::default();
        for (kind, sums) in [("hunt", sums()), ("proof", proof())] {
            let plan = plan(&[kind]);
            all.add(
                format!("hunts of {kind}"),
                hunts(&plan, &sums).into_string(),
            );
            all.add(
                format!("proofs of {kind}"),
                proofs(&plan, &sums).into_string(),
            );
            let page = crate::report::html::audit::campaign(&plan, (1, 4), &sums);
            assert!(page.contains("<title>Campaign x: Under way</title>"));
            let link = format!("<a href=\"#{kind}s\">");
            assert!(page.matches("<a href=\"#").count() > 0 && page.contains(&link));
        }
        let page = crate::report::html::audit::campaign(&plan(&["proof"]), (4, 4), &proof());
        assert!(!page.contains("Under way"));
        all.pin("campaigns");
    }
}
