//! What a campaign has besides audits.

use super::overview::number;
use crate::audit::Method;
use crate::audit::MethodReport;
use crate::campaign::{HuntTally, PartSum, Plan};
use crate::report::html::page::class;
use crate::report::words::Tone;
use crate::report::words::numbers::{percent, short};
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
            PartSum::Report(_) => None,
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

/// A line for the worst of each output.
fn lines(label: &str, hunts: &HuntTally, method: &dyn Method) -> Markup {
    let mut worst = hunts.worst(method);
    worst.dedup_by_key(|w| w.output);
    html! {
        @for w in &worst {
            tr {
                td.left { (label) }
                (number(true, hunts.hunts as f64)) td { (hunts.evaluations) } td { (hunts.failures) }
                td.left { (w.output) }
                td { (percent(w.share)) }
                td.left { @if w.new { span.sign.(class(tone(w.share))) { "new" } } }
                td.left.wrap { (w.reason) ", seed " (short(w.seed as f64)) }
                td.left { code { (w.reproduce(method)) } }
            } "\n"
        }
    }
}

fn tone(share: f64) -> Tone {
    if share > 1.0 { Tone::Bad } else { Tone::Doubt }
}
