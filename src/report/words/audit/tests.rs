//! Tests of `audit`.

use super::*;
use crate::report::text::method::tests::{fabricated, passing};

#[test]
fn one_failing_method_or_none_at_all_is_no_pass() {
    let failing = fabricated();
    let passing = passing();
    assert!(all_pass(&[passing.clone(), passing.clone()]));
    assert!(!all_pass(&[passing.clone(), failing.clone()]) && !all_pass(&[]));
    assert_eq!(
        totals(std::slice::from_ref(&passing)),
        "1 method passes, 400 cases"
    );
    assert_eq!(
        totals(&[passing, failing]),
        "1 of 2 methods pass, 1 of 800 cases failed"
    );
}

#[test]
fn a_proved_bound_is_said_with_its_inputs_and_its_proof() {
    let method = crate::methods::find("faddeeva").unwrap();
    let text = proved(&method.proved()[0]);
    let bound = &method.proved()[0];
    for part in [
        bound.error.to_string().as_str(),
        bound.inputs,
        bound.command,
    ] {
        assert!(!part.is_empty() && text.contains(part), "{text}");
    }
}

#[test]
fn a_share_is_plain_up_to_half_and_bad_beyond_the_whole() {
    for (of_budget, tone) in [
        (0.0, Tone::Plain),
        (0.5, Tone::Plain),
        (0.501, Tone::Doubt),
        (1.0, Tone::Doubt),
        (1.001, Tone::Bad),
        (f64::INFINITY, Tone::Bad),
        // Nothing was measured.
        (f64::NAN, Tone::Plain),
    ] {
        assert_eq!(share(of_budget), tone, "{of_budget}");
    }
}

#[test]
fn a_law_holds_up_to_what_is_allowed() {
    let mut law = passing().laws.remove(0);
    for (worst, due) in [
        (0.0, true),
        (1.0, true),
        (1.001, false),
        (f64::INFINITY, false),
        (f64::NAN, false),
    ] {
        law.worst = worst;
        assert_eq!(holds(&law), due, "{worst}");
        let sign = if due {
            ("✓", Tone::Good)
        } else {
            ("✗", Tone::Bad)
        };
        assert_eq!(mark(&law), sign);
    }
}

#[test]
fn a_method_passes_fails_or_was_interrupted() {
    assert_eq!(verdict(&passing()), ("pass", Tone::Good));
    let mut failing = fabricated();
    assert_eq!(verdict(&failing), ("FAIL", Tone::Bad));
    failing.interrupted = true;
    assert_eq!(verdict(&failing), ("interrupted", Tone::Bad));
}

#[test]
fn the_worst_is_that_of_outputs_with_numbers() {
    let mut report = fabricated();
    let worst = Worst::of(&report);
    assert_eq!((&*worst.ulps, &*worst.conditioned), ("7.25", "–"));
    assert_eq!(worst.of_budget, 1.75);
    let mut second = report.total.outputs[0].clone();
    (second.ulps.max, second.ulps.count) = (99.0, 0);
    (second.conditioned.max, second.conditioned.count) = (0.25, 1);
    report.total.outputs.push(second);
    let worst = Worst::of(&report);
    assert_eq!((&*worst.ulps, &*worst.conditioned), ("7.25", "0.250"));
    report.total.outputs[1].ulps.count = 1;
    assert_eq!(Worst::of(&report).ulps, "99.00");
}

#[test]
fn what_is_left_open_is_counted_by_its_reason() {
    let mut region = fabricated().total;
    let mut of = |undecided, failed| {
        (region.undecided, region.reference_failed) = (undecided, failed);
        super::undecided(&region)
    };
    assert_eq!(of(0, 0), "");
    assert_eq!(of(2, 0), "2 cases undecided");
    let both = "1 case undecided, 3 cases at which the reference failed";
    assert_eq!(of(1, 3), both);
    region.kinds[crate::audit::Kind::Nan] = 2;
    region.kinds[crate::audit::Kind::Infinity] = 1;
    let nan = crate::audit::Kind::Nan.name();
    let infinity = crate::audit::Kind::Infinity.name();
    assert_eq!(kinds(&region.kinds), format!("2 {nan}, 1 {infinity}"));
}

#[test]
fn a_candidate_has_its_command_where_that_is_not_its_name() {
    let of = |version: Option<&str>, command: Option<&str>, answered| {
        candidate(&CandidateReport {
            name: "other".into(),
            version: version.map(String::from),
            command: command.map(String::from),
            answered,
            trouble: None,
        })
    };
    assert_eq!(of(None, None, 1), "other, 1 answer");
    assert_eq!(of(Some("1.2"), Some("other"), 2), "other 1.2, 2 answers");
    assert_eq!(
        of(None, Some("./other -x"), 0),
        "other (./other -x), 0 answers"
    );
}

#[test]
fn outputs_with_one_budget_share_it() {
    use crate::audit::{Budget, Format, Limit, NormBudget, OutputBudget};
    let mut report = fabricated();
    let output = |name, k| OutputBudget {
        name,
        unit: "1",
        budget: Budget::new(Limit::Ulps(k), "planted"),
    };
    report.budgets = vec![output("a", 4.0), output("b", 2.0), output("c", 4.0)];
    let double = budgets(&report);
    assert_eq!(double, "a, c: 4 ulp; b: 2 ulp");
    let norm = NormBudget {
        factor: 3.0,
        reason: "planted",
    };
    report.norm_budget = Some(norm);
    let together = format!("{double}; all together: {}", norm.shown(Format::Double));
    assert_eq!(budgets(&report), together);
    (report.norm_budget, report.format) = (None, Format::Single);
    let single = format!("{double}; in single precision, u = 2⁻²⁴");
    assert_eq!(budgets(&report), single);
}

#[test]
fn totals_count_what_is_over_budget_as_recorded() {
    let mut report = passing();
    (report.passed, report.recorded) = (395, 5);
    let both = [report.clone(), report];
    assert_eq!(
        totals(&both),
        "2 methods pass, 800 cases, 10 over budget as recorded"
    );
    assert_eq!(totals(&[]), "0 methods pass, 0 cases");
    let settings = settings(&crate::audit::Settings {
        seed: 7,
        cases_per_region: 9,
        first_bits: 64,
        last_bits: 128,
        ..Default::default()
    });
    let due = "seed 7, 9 random cases per region, references from 64 to 128 bits";
    assert_eq!(settings, due);
}
