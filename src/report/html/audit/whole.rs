//! All that is known of a case, for the page's dialog.

use crate::audit::{CaseReport, Layout, Proof, SolverAnswer, hex_float};
use crate::report::words::audit::of_case;
use crate::report::words::numbers::{percent, short, unit};
use serde::Serialize;

/// A case, written out.
#[derive(Serialize)]
pub struct Whole {
    verdict: &'static str,
    tone: &'static str,
    reason: Option<String>,
    /// Name, unit, decimal, hexadecimal.
    input: Vec<[String; 4]>,
    /// Output, due, got, got in hexadecimal, ulps, u (1 + condition), share of the budget,
    /// condition.
    values: Vec<[String; 8]>,
    /// The answer where it is no values.
    answer: Option<String>,
    proof: Option<&'static str>,
    bits: u32,
    branch: Option<String>,
    left_out: usize,
}

impl Whole {
    /// Of a judged case, with at most `most` numbers of its input and of its answer.
    pub fn of(report: &CaseReport, layout: &Layout, most: usize) -> Whole {
        let (verdict, tone) = of_case(report.judgement.verdict);
        let got = match &report.answer {
            Some(SolverAnswer::Values(v)) => &v[..],
            _ => &[],
        };
        let answer = match &report.answer {
            Some(SolverAnswer::Values(_)) => None,
            Some(SolverAnswer::Fails(why)) => Some(why.clone()),
            None | Some(SolverAnswer::Unanswered(_)) => Some("no answer".into()),
            Some(refusal) => Some(format!("refusal: {}", refusal.refusal().unwrap_or(""))),
        };
        let left_out = [report.case.input.len(), got.len()].map(|n| n.saturating_sub(most));
        Whole {
            verdict,
            tone: crate::report::html::page::class(tone),
            reason: report.judgement.why(),
            input: input(report, layout, most),
            values: values(report, got, most),
            answer,
            proof: report.proof.map(|p| match p {
                Proof::Exact => "exact arithmetic",
                Proof::Bounded(why) => why,
            }),
            bits: report.bits,
            branch: report.branch.as_ref().map(|b| {
                let formula = b
                    .branch
                    .as_deref()
                    .map_or(String::new(), |f| format!("{f}; "));
                format!("{formula}{} from the seam {}", short(b.distance), b.seam)
            }),
            left_out: left_out.iter().sum(),
        }
    }
}

fn input(report: &CaseReport, layout: &Layout, most: usize) -> Vec<[String; 4]> {
    let case = &report.case;
    let names = layout.names(&case.input);
    let numbers = case.input.iter().enumerate().take(most);
    let row = |(k, x): (usize, &f64)| {
        let (name, of) = names.get(k).cloned().unwrap_or_default();
        [name, unit(of), format!("{x:?}"), hex_float(*x)]
    };
    numbers.map(row).collect()
}

fn values(report: &CaseReport, got: &[f64], most: usize) -> Vec<[String; 8]> {
    let judged = report.judgement.components.iter().enumerate().take(most);
    let some = |x: f64| match x.is_nan() {
        true => "–".to_string(),
        false => short(x),
    };
    let row = |(k, c): (usize, &crate::audit::ComponentJudgement)| {
        let due = report.reference.get(k).cloned().flatten();
        let value = got.get(k);
        [
            c.output.to_string(),
            due.unwrap_or_else(|| "–".into()),
            value.map_or("–".into(), |v| format!("{v:?}")),
            value.map_or(String::new(), |v| hex_float(*v)),
            some(c.ulps),
            some(c.conditioned),
            percent(c.of_budget),
            some(c.condition),
        ]
    };
    judged.map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::BranchAt;
    use crate::report::gallery::Gallery;
    use crate::report::text::method::tests::fabricated;

    /// Answers of each kind, and numbers beyond the most counted.
    #[test]
    fn cases_are_written_out() {
        let mut all = Gallery::default();
        let mut write = |name: &str, report: &CaseReport, most| {
            let whole = Whole::of(report, &fabricated().layout, most);
            all.add_json(name, serde_json::to_value(&whole).unwrap());
        };
        let mut report = fabricated().failures.remove(0);
        write("values", &report, 9);
        for (name, answer) in [
            ("too many", Some(SolverAnswer::Values(vec![0.5; 4]))),
            ("fails", Some(SolverAnswer::Fails("it broke".into()))),
            ("unanswered", Some(SolverAnswer::Unanswered("late".into()))),
            ("none", None),
            ("refuses", Some(SolverAnswer::Refuses("singular"))),
            ("declines", Some(SolverAnswer::Declines(None))),
        ] {
            report.answer = answer;
            write(name, &report, 1);
        }
        report = fabricated().failures.remove(0);
        report.case.method = "a/study.toml";
        report.judgement.components[0].ulps = f64::NAN;
        report.reference[0] = None;
        report.proof = Some(Proof::Bounded("a bound"));
        for branch in [Some("Taylor"), None] {
            report.branch = Some(BranchAt {
                branch: branch.map(String::from),
                seam: "|z| = 7".into(),
                distance: 0.25,
            });
            write("not certified", &report, 9);
        }
        all.pin("whole-cases");
    }
}
