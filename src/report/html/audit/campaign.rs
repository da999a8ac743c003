//! What a campaign has besides audits.

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
                p { "Bounds of the norm in units of 2⁻⁵², of components in units in the last place, rounded up." } "\n"
                div.scroll tabindex="0" { table { "\n"
                    thead { tr {
                        th.left { "part" } th.left { "formula" } th { "boxes" } th { "norm" } th { "Re" } th { "Im" }
                        th { "open" }
                    } } "\n"
                    tbody { "\n"
                        @for (label, proof) in &proofs {
                            @for (name, f) in proof.formulas() {
                                tr {
                                    td.left { (label) } td.left { (name) } td { (f.boxes) }
                                    td { (bound(f.norm.bound())) } td { (bound(f.re.bound())) }
                                    td { (bound(f.im.bound())) } td {}
                                } "\n"
                            }
                            tr {
                                td.left { (label) } td.left { b { "all" } } td { (proof.boxes()) }
                                td { b { (bound(proof.norm())) } }
                                td colspan="2" { b { (bound(proof.component())) } }
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
}
