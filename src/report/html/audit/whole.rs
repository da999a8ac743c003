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
    use crate::report::text::method::tests::fabricated;
    use serde_json::{Value, json};

    fn written(change: impl Fn(&mut CaseReport), most: usize) -> Value {
        let mut report = fabricated().failures.remove(0);
        change(&mut report);
        serde_json::to_value(Whole::of(&report, &fabricated().layout, most)).unwrap()
    }

    #[test]
    fn a_case_is_written_out() {
        let whole = written(|_| (), 9);
        let due = json!({
            "verdict": "over budget",
            "tone": "t-bad",
            "reason": "phi2 (value 0) is 7.5e-1, expected 7.500000000000008e-1: 1.750 times its budget off",
            "input": [
                ["a", "", "0.1", "0x1.999999999999ap-4"],
                ["b", "m", "-2.0", "-0x1p+1"],
            ],
            "values": [[
                "phi2", "0.75000000000000080491", "0.75", "0x1.8p-1", "7.25", "0.400", "175.0 %", "31.00",
            ]],
            "answer": null,
            "proof": "exact arithmetic",
            "bits": 128,
            "branch": null,
            "left_out": 0,
        });
        assert_eq!(whole, due);
    }

    #[test]
    fn numbers_beyond_the_most_are_counted() {
        let answer = Some(SolverAnswer::Values(vec![0.5; 4]));
        let whole = written(|r| r.answer = answer.clone(), 1);
        assert_eq!(whole["input"].as_array().unwrap().len(), 1);
        assert_eq!(whole["left_out"], 1 + 3);
    }

    #[test]
    fn an_answer_without_values_says_what_it_is() {
        for (answer, due) in [
            (Some(SolverAnswer::Fails("it broke".into())), "it broke"),
            (Some(SolverAnswer::Unanswered("late".into())), "no answer"),
            (None, "no answer"),
            (Some(SolverAnswer::Refuses("singular")), "refusal: singular"),
            (Some(SolverAnswer::Declines(None)), "refusal: "),
        ] {
            let whole = written(|r| r.answer = answer.clone(), 9);
            assert_eq!(whole["answer"], due);
            let values = &whole["values"][0];
            assert_eq!((&values[2], &values[3]), (&json!("–"), &json!("")));
        }
    }

    #[test]
    fn what_is_no_number_is_a_dash_and_a_seam_has_its_distance() {
        let at = |branch: Option<&'static str>| {
            move |r: &mut CaseReport| {
                r.judgement.components[0].ulps = f64::NAN;
                r.reference[0] = None;
                r.proof = Some(Proof::Bounded("a bound"));
                r.branch = Some(BranchAt {
                    branch: branch.map(String::from),
                    seam: "|z| = 7".into(),
                    distance: 0.25,
                });
            }
        };
        let whole = written(at(Some("Taylor")), 9);
        assert_eq!(whole["branch"], "Taylor; 0.250 from the seam |z| = 7");
        assert_eq!(whole["proof"], "a bound");
        let values = &whole["values"][0];
        assert_eq!((&values[1], &values[4]), (&json!("–"), &json!("–")));
        assert_eq!(
            written(at(None), 9)["branch"],
            "0.250 from the seam |z| = 7"
        );
    }

    #[test]
    fn inputs_have_the_names_and_units_of_their_method() {
        let whole = written(|r| r.case.method = "a/study.toml", 9);
        let named: Vec<(&Value, &Value)> = (0..2)
            .map(|k| (&whole["input"][k][0], &whole["input"][k][1]))
            .collect();
        assert_eq!(
            named,
            [(&json!("a"), &json!("")), (&json!("b"), &json!("m"))]
        );
    }
}
