//! The largest errors of solvers at the values of `reference/values/`:
//! `tests/solver_values/allowed.csv`.
//!
//! `src/solvers/tests` reads both without GMP or MPFR. `cargo test --release --test library
//! solver_values::write -- --ignored` writes the allowances anew, for the values that `mechaudit
//! regenerate` has written.

use mechaudit::audit::{Case, Cases, Limit, Method, Origin, Settings, Verdict};
use mechaudit::audit::{answer_of, judge_case};
use mechaudit::methods::{find, registry};
use std::collections::HashMap;
use std::fs;
use std::path::Path;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const ALLOWED: &str = "tests/solver_values/allowed.csv";
const SPECIAL: &str = "tests/solver_values/special.csv";

/// The factor of the worst error of its region, at the time of writing, by which a value may be
/// off. It is never more than the budget allows.
const SLACK: f64 = 2.0;

/// A line of `reference/values/`.
struct Held {
    region: String,
    case: String,
    /// The values, or none where the solver has to refuse.
    values: Option<Vec<f64>>,
}

fn read(file: &str) -> csv::Reader<fs::File> {
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_path(Path::new(ROOT).join(file))
        .expect(file)
}

fn held(method: &dyn Method) -> Vec<Held> {
    let mut rows = read(&format!("reference/values/{}.csv", method.name()));
    let row = |row: csv::StringRecord| Held {
        region: row[0].into(),
        case: row[1].into(),
        values: (!row[3].starts_with("refuse")).then(|| {
            let values = row[3].split_whitespace();
            values.map(|t| t.parse().expect("a number")).collect()
        }),
    };
    rows.records().map(|r| row(r.expect("a line"))).collect()
}

/// The methods with values: enclosing the motions of `run-up` takes minutes, `run_up_accuracy`
/// compares some.
fn methods() -> impl Iterator<Item = Box<dyn Method>> {
    let values = registry().into_iter().filter(|m| m.name() != "run-up");
    values.map(|m| m as Box<dyn Method>)
}

fn case_of(cases: &Cases, held: &Held) -> Case {
    let case = match held.region.as_str() {
        "check-points" => cases.at_check_point(&held.case),
        region => cases.in_region(region, held.case.parse().expect("a number")),
    };
    case.expect("a case of the method")
}

fn ulp(x: f64) -> f64 {
    let x = x.abs().min(f64::MAX.next_down());
    x.next_up() - x
}

/// Returns what the budget allows each value.
fn budget(method: &dyn Method, input: &[f64], values: &[f64]) -> Vec<f64> {
    let outputs = method.outputs();
    let needed = outputs.iter().any(|o| o.budget.limit.needs_conditions());
    let finite = input.iter().all(|x| x.is_finite());
    let conditions = (needed && finite)
        .then(|| method.conditions(input))
        .flatten();
    let size = |i: usize| values[i].abs() + conditions.as_ref().map_or(f64::NAN, |c| c[i]);
    let u = f64::EPSILON / 2.0;
    let limit = |i: usize| outputs[i % outputs.len()].budget.limit;
    let all = 0..values.len();
    let one = |i| match limit(i) {
        Limit::Ulps(k) => k * ulp(values[i]),
        Limit::Conditioned(k) => k * u * size(i),
        Limit::Normwise(k) => {
            let others = all
                .clone()
                .filter(|j| matches!(limit(*j), Limit::Normwise(_)));
            k * u * others.map(size).fold(0.0, f64::max)
        }
        other => unreachable!("no method's own limit: {other}"),
    };
    all.clone().map(one).collect()
}

/// The worst share of the budget in each region, by output, over check points and some cases of
/// each region.
fn worst(method: &dyn Method, cases: &Cases) -> HashMap<(String, &'static str), f64> {
    let settings = Settings::default();
    let mut worst = HashMap::new();
    for case in (0..cases.len()).map(|i| cases.get(i)) {
        if matches!(case.origin, Origin::Hard { .. }) {
            continue;
        }
        let answer = answer_of(method, &case.input);
        let region = case.region.to_string();
        let judged = judge_case(method, case, answer, &settings).judgement;
        assert_eq!(judged.verdict, Verdict::Pass, "{} {region}", method.name());
        for c in judged.components {
            let share: &mut f64 = worst.entry((region.clone(), c.output)).or_default();
            *share = share.max(c.of_budget);
        }
    }
    worst
}

/// Few cases of methods whose references take long.
fn per_region(method: &dyn Method) -> u64 {
    match method.name() {
        "planar-linkage" | "planar-reduction" | "planar-reactions" => 6,
        "class-iii" | "class-iii-assembly-modes" => 8,
        _ => 30,
    }
}

/// Returns the allowance of each value.
fn allowances(
    method: &dyn Method,
    (region, input, values): (&str, &[f64], &[f64]),
    worst: &HashMap<(String, &'static str), f64>,
) -> Vec<f64> {
    let outputs = method.outputs();
    let allowed = budget(method, input, values).into_iter().enumerate();
    let allowed = allowed.map(|(i, budget)| {
        let o = &outputs[i % outputs.len()];
        let k = o.budget.limit.factor();
        let found = worst.get(&(region.to_string(), o.name));
        let found = found.copied().unwrap_or_default();
        // At least a unit in the last place.
        let least = match o.budget.limit {
            Limit::Ulps(_) => 1.0 / k,
            _ => 2.0 / k,
        };
        let share = (SLACK * found).max(least).min(1.0);
        (1.006 * share * budget).max(5e-324)
    });
    allowed.collect()
}

fn fields(row: &Held, name: &str) -> [String; 3] {
    [name.into(), row.region.clone(), row.case.clone()]
}

/// Every value has an allowance, which is positive and not above its budget.
#[test]
fn each_value_has_an_allowance_within_its_budget() {
    let mut allowed = read(ALLOWED);
    let mut allowed = allowed.records().map(|r| r.expect("a line"));
    for method in methods() {
        let cases = Cases::new(&*method, &Settings::default());
        for (n, row) in held(&*method).iter().enumerate() {
            let own = allowed.next().expect("an allowance");
            let place = fields(row, method.name());
            assert!(own.iter().take(3).eq(&place), "{own:?} for {place:?}");
            let numbers = own[3].split_whitespace();
            let numbers: Vec<f64> = numbers.map(|t| t.parse().expect("a number")).collect();
            let count = row.values.as_ref().map_or(0, Vec::len);
            assert_eq!(numbers.len(), count, "{place:?}");
            assert!(numbers.iter().all(|x| *x > 0.0), "{place:?}");
            // Conditions of references take their time.
            if let (0, Some(values)) = (n % 5, &row.values) {
                let most = budget(&*method, &case_of(&cases, row).input, values);
                for (x, most) in numbers.iter().zip(most) {
                    assert!(*x <= (1.02 * most).max(5e-324), "{place:?}: {x} for {most}");
                }
            }
        }
    }
    assert!(allowed.next().is_none(), "an allowance without a value");
}

/// The digits of the Faddeeva family's own points are certified.
#[test]
fn special_points() {
    let mut rows = read(SPECIAL);
    let mut met = 0;
    for row in rows.records().map(|r| r.expect("a line")).step_by(5) {
        let (name, _) = row[0].rsplit_once('-').expect("a method and a number");
        let method = find(name).expect("a method");
        let input = row[1].split_whitespace();
        let case = Case {
            method: method.name(),
            region: "special",
            input: input.map(|t| t.parse().expect("a number")).collect(),
            origin: Origin::Given,
        };
        let answer = answer_of(&*method, &case.input);
        let report = judge_case(&*method, case, answer, &Settings::default());
        let digits = report.reference.iter().map(|t| match t {
            Some(text) => text.as_str(),
            // Below every number.
            None => "0",
        });
        let due: Vec<&str> = row[2].split_whitespace().collect();
        assert_eq!(due.len(), report.reference.len(), "{}", &row[0]);
        for (due, digits) in due.into_iter().zip(digits) {
            // A zero that is certified may have either sign.
            let zero = |t: &str| ["0", "-0"].contains(&t);
            assert!(due == digits || zero(due) && zero(digits), "{}", &row[0]);
        }
        met += 1;
    }
    assert!(met > 100, "{met}");
}

#[test]
#[ignore = "writes the allowances"]
fn write() {
    let mut out = csv::Writer::from_writer(Vec::new());
    let columns = ["method", "region", "case", "allowed"];
    out.write_record(columns).expect("written");
    for method in methods() {
        let settings = Settings {
            cases_per_region: per_region(&*method),
            ..Settings::default()
        };
        let cases = Cases::new(&*method, &settings);
        let worst = worst(&*method, &cases);
        for row in held(&*method) {
            let allowed = match &row.values {
                Some(values) => {
                    let case = case_of(&cases, &row);
                    let place = (case.region, &case.input[..], &values[..]);
                    let allowed = allowances(&*method, place, &worst);
                    let texts = allowed.iter().map(|x| format!("{x:.2e}"));
                    texts.collect::<Vec<_>>().join(" ")
                }
                None => String::new(),
            };
            let [method, region, case] = fields(&row, method.name());
            let fields = [method, region, case, allowed];
            out.write_record(fields).expect("written");
        }
    }
    let text = out.into_inner().expect("written");
    fs::write(Path::new(ROOT).join(ALLOWED), text).expect("written");
}
