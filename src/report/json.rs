//! Reports for programs.

use crate::audit::{Case, CaseReport, MethodReport, SolverAnswer, hex_float};
use serde_json::{Value, json};

/// The case for programs: the report with the answer, exact inputs and the command.
pub fn case(report: &CaseReport, again: &str) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let hex: Vec<String> = report.case.input.iter().map(|x| hex_float(*x)).collect();
    let got = match &report.answer {
        Some(SolverAnswer::Values(v)) => json!({
            "values": v,
            "hexadecimal": v.iter().map(|x| hex_float(*x)).collect::<Vec<_>>(),
        }),
        Some(SolverAnswer::Fails(why)) => json!({ "fails": why }),
        Some(refusal) => json!({ "refuses": refusal.refusal().unwrap_or("") }),
        None => Value::Null,
    };
    if let Some(object) = value.as_object_mut() {
        object.insert("input_hexadecimal".into(), json!(hex));
        object.insert("got".into(), got);
        object.insert("reproduce".into(), json!(again));
    }
    value
}

/// A method's report. `again` gives the command that judges a case again.
pub fn method(report: &MethodReport, again: &dyn Fn(&Case) -> String) -> Value {
    let mut value = serde_json::to_value(report).unwrap_or(Value::Null);
    let failures = report.failures.iter();
    let failures: Vec<Value> = failures.map(|f| case(f, &again(&f.case))).collect();
    value["passed_all"] = json!(report.passed());
    value["failures"] = json!(failures);
    value
}
