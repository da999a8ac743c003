//! Reports for programs, as `schema/audit.schema.json` describes them.

pub use super::SCHEMA_VERSION;
use super::baseline::Changes;
use crate::audit::{CaseReport, Comparison, Layout, MethodReport, SolverAnswer, hex_float};
use crate::campaign::{Deal, Identity, PartSum, Plan};
use serde_json::{Value, json};

/// The report of an audit of one method or of several.
pub fn document(reports: &[MethodReport], interrupted: bool) -> Value {
    json!({
        "schema_version": SCHEMA_VERSION,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "passed": !interrupted && super::words::audit::all_pass(reports),
        "interrupted": interrupted,
        "methods": reports.iter().map(method).collect::<Vec<Value>>(),
    })
}

/// A case: the judgement with the answer, names and exact values of the inputs, and the command
/// that judges it again.
pub fn case(report: &CaseReport, layout: &Layout, again: &str) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let input = &report.case.input;
    let hex: Vec<String> = input.iter().map(|x| hex_float(*x)).collect();
    let names = layout.names(input).into_iter();
    let got = match &report.answer {
        Some(SolverAnswer::Values(v)) => json!({
            "values": v,
            "hexadecimal": v.iter().map(|x| hex_float(*x)).collect::<Vec<_>>(),
        }),
        Some(SolverAnswer::Fails(why)) => json!({ "fails": why }),
        Some(SolverAnswer::Unanswered(why)) => json!({ "unanswered": why }),
        Some(refusal) => json!({ "refuses": refusal.refusal().unwrap_or("") }),
        None => Value::Null,
    };
    if let Some(object) = value.as_object_mut() {
        object.insert("input_names".into(), names.map(|n| n.0).collect());
        object.insert("input_hexadecimal".into(), json!(hex));
        object.insert("got".into(), got);
        object.insert("share".into(), json!(report.judgement.share()));
        object.insert("reproduce".into(), json!(again));
    }
    value
}

/// A method's report.
pub fn method(report: &MethodReport) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let cases = |all: &[CaseReport]| -> Value {
        let all = all.iter();
        all.map(|f| case(f, &report.layout, &report.reproduce_command(&f.case)))
            .collect()
    };
    value["passed_all"] = json!(report.passed());
    value["worst"] = cases(&report.worst);
    value["wrong"] = cases(&report.wrong);
    value["failures"] = cases(&report.failures);
    value
}

/// Several codes side by side, each with its whole report.
pub fn comparison(found: &Comparison, changes: Option<&Changes>) -> Value {
    let candidates = found.candidates.iter().map(|c| {
        json!({
            "name": c.name,
            "speed": c.speed,
            "report": method(&c.report),
        })
    });
    let mut value = json!({
        "schema_version": SCHEMA_VERSION,
        "mechaudit_version": env!("CARGO_PKG_VERSION"),
        "method": found.method,
        "passed": found.passed(),
        "interrupted": found.interrupted(),
        "candidates": candidates.collect::<Vec<Value>>(),
        "regions": found.regions,
    });
    if let Some(changes) = changes {
        value["baseline"] = json!(changes);
    }
    value
}

/// Returns the sum of a campaign: the same bytes however the campaign was cut, run and added up.
pub fn campaign(plan: &Plan, identity: &Identity, parts: &[PartSum]) -> Value {
    let shown = parts.iter().zip(&plan.parts).map(|(sum, part)| {
        let found = match sum {
            PartSum::Report(report) => method(report),
            PartSum::Hunts(hunts, method) => hunts.json(&**method),
            PartSum::Proof(found) => found.json(),
        };
        json!({ "kind": part.kind, "label": part.label(), "found": found })
    });
    json!({
        "schema_version": SCHEMA_VERSION,
        "mechaudit_version": identity.program,
        "name": plan.name,
        "passed": parts.iter().all(PartSum::passed),
        "digests": {
            "plan": plan.digest(),
            "references": identity.references,
            "solvers": identity.solvers,
        },
        "work": Deal::new(plan, 1).work(),
        "plan": plan.parts,
        "parts": shown.collect::<Vec<Value>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::text::method::tests::{fabricated, passing};

    #[test]
    fn a_case_has_its_exact_numbers_and_its_command() {
        let mut report = fabricated().failures.remove(0);
        (report.case.method, report.case.input) = ("a/study.toml", vec![0.5, -1.0]);
        let layout = fabricated().layout;
        let value = case(&report, &layout, "again");
        assert_eq!(value["input_names"], json!(["a", "b"]));
        assert_eq!(value["input_hexadecimal"], json!(["0x1p-1", "-0x1p+0"]));
        assert_eq!(value["reproduce"], "again");
        assert_eq!(value["share"], 1.75);
        let got = |answer| {
            let mut report = report.clone();
            report.answer = answer;
            case(&report, &layout, "")["got"].clone()
        };
        let values = json!({ "values": [0.75], "hexadecimal": ["0x1.8p-1"] });
        for (answer, due) in [
            (Some(SolverAnswer::Values(vec![0.75])), values),
            (
                Some(SolverAnswer::Fails("a".into())),
                json!({ "fails": "a" }),
            ),
            (
                Some(SolverAnswer::Unanswered("b".into())),
                json!({ "unanswered": "b" }),
            ),
            (Some(SolverAnswer::Refuses("c")), json!({ "refuses": "c" })),
            (Some(SolverAnswer::Declines(None)), json!({ "refuses": "" })),
            (None, Value::Null),
        ] {
            assert_eq!(got(answer), due);
        }
    }

    #[test]
    fn a_method_has_its_cases_in_full() {
        let mut report = fabricated();
        report.wrong = vec![report.failures[0].clone(); 2];
        report.failures = vec![report.failures[0].clone(); 3];
        let value = method(&report);
        assert_eq!(value["passed_all"], false);
        let again = "mechaudit audit a-method --region wide --seed 1 --case 17";
        for (list, n) in [("worst", 1), ("wrong", 2), ("failures", 3)] {
            let all = value[list].as_array().unwrap();
            assert_eq!(all.len(), n, "{list}");
            assert!(all.iter().all(|c| c["reproduce"] == again), "{list}");
        }
        assert_eq!(method(&passing())["passed_all"], true);
        for (interrupted, passed) in [(false, true), (true, false)] {
            let whole = document(&[passing()], interrupted);
            assert_eq!(
                (&whole["passed"], &whole["interrupted"]),
                (&json!(passed), &json!(interrupted))
            );
            assert_eq!(whole["methods"].as_array().unwrap().len(), 1);
        }
    }

    #[test]
    fn a_comparison_has_the_baseline_where_there_is_one() {
        let found = Comparison::new("a-method", vec![(passing(), None)]);
        assert!(comparison(&found, None).get("baseline").is_none());
        let changes = Changes::default();
        let value = comparison(&found, Some(&changes));
        assert_eq!(value["baseline"], json!(changes));
        assert_eq!(
            (&value["passed"], &value["method"]),
            (&json!(true), &json!("a-method"))
        );
    }
}
