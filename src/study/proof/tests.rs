use super::*;
use crate::audit::{Method, ProvedError, Settings, audit_method};
use crate::study::Study;

fn study(is: &str, budget: &str, solvers: &str) -> Result<Study, StudyError> {
    let text = format!(
        "[inputs]\nx = {{ from = 1, to = 2 }}\ny = {{ from = -1, to = 3 }}\n\
         [outputs]\nz = {{ is = \"{is}\", budget = \"{budget}\" }}\n{solvers}"
    );
    Study::parse(&text, "squares")
}

const BOTH: &str =
    "[solver.factors]\nz = \"(x - y)*(x + y)\"\n[solver.powers]\nz = \"x*x - y*y\"\n";

/// The budget is the bound of the chosen solver, the worst found is below it, and both are in the
/// report.
#[test]
fn a_proof_is_a_budget() {
    let factors = study("x^2 - y^2", "proved", BOTH).unwrap();
    let powers = factors.clone().with_solver("powers").unwrap();
    // The value may be zero: of both the absolute error alone has a bound.
    let limits = [&factors, &powers].map(|s| s.outputs()[0].budget.limit);
    let [Limit::Absolute(a), Limit::Absolute(b)] = limits else {
        panic!("{limits:?}");
    };
    assert!(a > 1e-16 && b > 1e-16 && a != b, "{a:e} {b:e}");
    let bound = &powers.proved()[0];
    assert_eq!(bound.error, ProvedError::Absolute(b));
    assert!(bound.inputs.starts_with("z at every input"));
    assert_eq!(bound.command, "mechaudit prove squares --solver powers");
    let settings = Settings {
        cases_per_region: 200,
        ..Settings::default()
    };
    let report = audit_method(&powers, &settings, &|| ());
    assert!(report.passed() && report.proved.len() == 1);
    let far = study("x + 2*y", "proved", "[solver.a]\nz = \"x + y + y\"\n").unwrap();
    assert!(matches!(far.outputs()[0].budget.limit, Limit::Absolute(_)));
    let positive = study("x*x + 3", "proved", "[solver.a]\nz = \"x*x + 3\"\n").unwrap();
    let limit = positive.outputs()[0].budget.limit;
    assert!(
        matches!(limit, Limit::Ulps(k) if (0.5..2.0).contains(&k)),
        "{limit:?}"
    );
    // Nothing is rounded, and nothing but the value itself passes.
    let exact = study("2*x", "proved", "[solver.a]\nz = \"x + x\"\n").unwrap();
    let report = audit_method(&exact, &settings, &|| ());
    assert!(report.passed(), "{:?}", exact.outputs()[0].budget.limit);
    // Without it nothing is proved.
    assert!(
        study("x*x", "1 ulp", "[solver.a]\nz = \"x*x\"\n")
            .unwrap()
            .proved()
            .is_empty()
    );
}

/// A solver of another function is over the budget of its own roundings.
#[test]
fn another_function_is_no_pass() {
    let off = study("x*x + 3", "proved", "[solver.a]\nz = \"x*x + 3.000001\"\n").unwrap();
    let settings = Settings {
        cases_per_region: 20,
        ..Settings::default()
    };
    assert!(!audit_method(&off, &settings, &|| ()).passed());
}

#[test]
fn what_is_not_proved_is_no_budget() {
    for (is, solvers, due) in [
        (
            "x/y",
            "[solver.a]\nz = \"x/y\"\n",
            "nothing is proved: a divisor that may be zero",
        ),
        ("x*y", "", "needs a [solver.NAME]"),
        (
            "erf(x)",
            "[solver.a]\nz = \"erf(x)\"\n",
            "nobody states the accuracy",
        ),
    ] {
        let why = study(is, "proved", solvers).err().unwrap().to_string();
        assert!(why.contains(due) && why.contains("line 5"), "{why}");
    }
    let linear = "[inputs]\nA = { shape = [2, 2] }\n[outputs]\nd = { det = \"A\", budget = \"proved\" }\n\
                  [solver.a]\nd = \"1\"\n";
    assert!(Study::parse(linear, "linear").is_err());
}
