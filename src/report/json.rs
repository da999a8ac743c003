//! Reports for programs, as `schema/audit.schema.json` describes them.

use super::baseline::Changes;
use crate::audit::{CaseReport, Comparison, Layout, MethodReport, SolverAnswer, hex_float};
use crate::methods;
use serde_json::{Value, json};

/// Grows when a member is taken away or changes its meaning.
pub const SCHEMA_VERSION: u32 = 2;

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

/// A case: the judgement with the answer, names and exact values of the inputs, and the command that
/// judges it again.
pub fn case(report: &CaseReport, again: &str) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let input = &report.case.input;
    let hex: Vec<String> = input.iter().map(|x| hex_float(*x)).collect();
    let method = methods::find(report.case.method);
    let names = method.map(|m| Layout::new(&*m).names(input));
    let names = names.unwrap_or_default().into_iter();
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
        all.map(|f| case(f, &report.again(&f.case))).collect()
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
