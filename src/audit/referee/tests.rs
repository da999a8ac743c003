//! Tests of what a referee rounds, computes again and leaves out.

use super::*;
use crate::Rows;
use crate::case_report::decimals;
use crate::judged::complete;
use crate::planted::{Planted, case, off, output};
use crate::{BranchAt, Kind, Limit, Proof, answer_of, audit_case, judge_case, judge_case_briefly};
use mechaudit_reference::{Ball, Mag};
use rug::{Float, Rational};
use std::sync::Mutex;

fn values(x: &[f64]) -> SolverAnswer {
    SolverAnswer::Values(x.to_vec())
}

/// Answers of code in single precision are rounded to it before they are judged, those in double
/// precision are not.
#[test]
fn answers_are_judged_in_their_format() {
    let settings = Settings::default();
    let judged = |format, got: f64, limit| {
        let outputs = vec![output("x", Limit::Ulps(limit))];
        let method = Planted {
            format,
            outputs,
            ..Planted::default()
        };
        let report = judge_case(&method, case(0, &[1.0]), values(&[got]), &settings);
        let c = &report.judgement.components[0];
        (report.judgement.verdict, c.ulps, report.answer.unwrap())
    };
    let ulp = 2f64.powi(-23);
    // Just below and above half an ulp of f32.
    let (below, above) = (1.0 + 0.49 * ulp, 1.0 + 0.51 * ulp);
    let single = |got| judged(Format::Single, got, 0.5);
    assert_eq!(single(below), (Verdict::Pass, 0.0, values(&[1.0])));
    assert_eq!(single(above), (Verdict::Over, 1.0, values(&[1.0 + ulp])));
    // Beyond the largest f32 an answer is infinite.
    let (verdict, _, answer) = single(1e39);
    assert_eq!(verdict, Verdict::WrongKind);
    assert_eq!(answer, values(&[f64::INFINITY]));
    let (verdict, ulps, answer) = judged(Format::Double, off(1.0, 3), 2.0);
    assert_eq!((verdict, ulps), (Verdict::Over, 3.0));
    assert_eq!(answer, values(&[off(1.0, 3)]));
    assert_eq!(judged(Format::Double, below, 4.0).0, Verdict::Over);
}

/// The precision doubles up to the last; what was computed once serves every answer to the case.
#[test]
fn references_are_computed_once_at_doubled_precision() {
    let asked = Mutex::new(Vec::new());
    // A ball that decides the better the more bits it has.
    let method = Planted {
        reference: Box::new(|_, bits| {
            asked.lock().unwrap().push(bits);
            let rad = Mag::power_of_two(-52 - i64::from(bits) / 64);
            ReferenceAnswer::bounded(vec![Ball::new(Float::with_val(64, 1), rad)], "planted")
        }),
        outputs: vec![output("x", Limit::Ulps(1.0))],
        ..Planted::default()
    };
    let settings = Settings {
        first_bits: 64,
        last_bits: 512,
        ..Settings::default()
    };
    let judge = Judge::new(&method, &settings);
    let mut referee = judge.referee(case(0, &[1.0]));
    let judge = |referee: &mut Referee, got| {
        let report = referee.judge(values(&[got]), true);
        (report.judgement.verdict, report.bits, report.radii)
    };
    let rad = |k: i32| vec![2f64.powi(-52 - k)];
    assert_eq!(judge(&mut referee, 1.0), (Verdict::Pass, 128, rad(2)));
    assert_eq!(*asked.lock().unwrap(), [64, 128]);
    // One ulp off: no ball decides.
    let open = (Verdict::Undecided, 512, rad(8));
    assert_eq!(judge(&mut referee, off(1.0, 1)), open);
    assert_eq!(*asked.lock().unwrap(), [64, 128, 256, 512]);
    // Once more, and what the first ball decides.
    assert_eq!(judge(&mut referee, off(1.0, 1)), open);
    assert_eq!(
        judge(&mut referee, off(1.0, 3)),
        (Verdict::Over, 64, rad(1))
    );
    assert_eq!(judge(&mut referee, 1.0), (Verdict::Pass, 128, rad(2)));
    assert_eq!(*asked.lock().unwrap(), [64, 128, 256, 512]);
}

/// A report shows the reference of the next precision where a wide one decides, unless the next one
/// is undecided or missing, or nobody asks for the share.
#[test]
fn errors_are_measured_by_references_that_are_not_wide() {
    // Radii at 64 and 128 bits, in ulps; what is judged, the last bits; what is reported.
    let table = [
        ([0.5, 0.0], 0, 512, (128, 0.0)),
        ([0.3, 0.0], 1, 512, (64, 1.3)),
        ([0.5, 0.25], 0, 512, (128, 0.25)),
        ([0.5, 9.0], 0, 512, (64, 0.5)),
        ([0.5, 0.0], 0, 64, (64, 0.5)),
        // A sixteenth of the budget.
        ([0.24, 0.0], 0, 512, (64, 0.24)),
        ([0.26, 0.0], 0, 512, (128, 0.0)),
    ];
    for (radii, ulps_off, last_bits, expected) in table {
        let method = Planted {
            reference: Box::new(move |_, bits| {
                let rad = Mag::from_f64(radii[usize::from(bits > 64)]).shift(-52);
                ReferenceAnswer::bounded(vec![Ball::new(Float::with_val(64, 1), rad)], "planted")
            }),
            outputs: vec![output("x", Limit::Ulps(4.0))],
            ..Planted::default()
        };
        let settings = Settings {
            first_bits: 64,
            last_bits,
            ..Settings::default()
        };
        let judge = Judge::new(&method, &settings);
        let got = off(1.0, ulps_off);
        let report = judge.judge(case(0, &[1.0]), values(&[got]), true);
        assert_eq!(report.judgement.verdict, Verdict::Pass);
        let found = (report.bits, report.judgement.components[0].ulps);
        assert!(
            found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-9,
            "{radii:?}: {found:?}, not {expected:?}"
        );
    }
}

/// Condition numbers are had where a budget or the settings ask for them, once for a case, and of
/// finite inputs only.
#[test]
fn conditions_are_had_where_they_are_asked_for() {
    use Limit::{Conditioned, Ulps};
    let found = |limits: &[Limit], conditions: bool, input: f64| {
        let calls = Mutex::new(0);
        let names = ["x", "y"];
        let outputs = limits.iter().zip(names);
        let method = Planted {
            outputs: outputs.map(|(limit, name)| output(name, *limit)).collect(),
            reference: Box::new(|x, bits| ReferenceAnswer::exact(vec![&x[0]; limits.len()], bits)),
            not_finite: Box::new(|x| {
                let ball = Ball::integer(64, i64::from(x[0] > 0.0));
                ReferenceAnswer::bounded(vec![ball; limits.len()], "planted")
            }),
            conditions: Box::new(|x| {
                *calls.lock().unwrap() += 1;
                Some(vec![3.0 * x[0]; limits.len()])
            }),
            ..Planted::default()
        };
        let settings = Settings {
            conditions,
            ..Settings::default()
        };
        let judge = Judge::new(&method, &settings);
        let mut referee = judge.referee(case(0, &[input]));
        let expected = if input.is_finite() { input } else { 1.0 };
        for _ in 0..2 {
            let report = referee.judge(values(&vec![expected; limits.len()]), false);
            let each = report.judgement.components.iter();
            let known = each.filter(|c| c.condition.is_finite()).count();
            assert_eq!(known, *calls.lock().unwrap() * limits.len());
            let conditioned = report.judgement.components.iter();
            conditioned
                .filter(|c| !c.condition.is_nan())
                .for_each(|c| assert!((c.condition - 3.0).abs() < 1e-9));
        }
        *calls.lock().unwrap()
    };
    assert_eq!(found(&[Ulps(4.0)], false, 1.5), 0);
    assert_eq!(found(&[Ulps(4.0)], true, 1.5), 1);
    assert_eq!(found(&[Conditioned(4.0)], false, 1.5), 1);
    // One of several is enough.
    assert_eq!(found(&[Ulps(4.0), Conditioned(4.0)], false, 1.5), 1);
    assert_eq!(found(&[Conditioned(4.0)], true, f64::INFINITY), 0);
    assert_eq!(found(&[Ulps(4.0)], true, f64::INFINITY), 0);
}

/// The reference's digits, radii and proof stand in every report but a brief one of a pass.
#[test]
fn digits_are_left_out_of_brief_passes_alone() {
    let settings = Settings::default();
    let third = Planted {
        reference: Box::new(|x, bits| ReferenceAnswer::exact([&(x[0].clone() / 3)], bits)),
        ..Planted::default()
    };
    let shown = |report: &CaseReport| {
        let proof = report.proof;
        (report.reference.clone(), report.radii.len(), proof)
    };
    let digits = Some("0.33333333333333333333".to_string());
    let full = (vec![digits], 1, Some(Proof::Exact));
    let brief = (Vec::new(), 0, None);
    let (right, wrong) = (values(&[1.0 / 3.0]), values(&[0.5]));
    let at = || case(0, &[1.0]);
    assert_eq!(
        shown(&judge_case(&third, at(), right.clone(), &settings)),
        full
    );
    assert_eq!(
        shown(&judge_case(&third, at(), wrong.clone(), &settings)),
        full
    );
    assert_eq!(
        shown(&judge_case_briefly(&third, at(), right.clone(), &settings)),
        brief
    );
    assert_eq!(
        shown(&judge_case_briefly(&third, at(), wrong.clone(), &settings)),
        full
    );
    let judge = Judge::new(&third, &settings);
    let mut referee = judge.referee(at());
    assert_eq!(shown(&referee.judge(right.clone(), true)), full);
    assert_eq!(shown(&referee.judge(right.clone(), false)), brief);
    // Those of what fails are written when it is kept.
    let failing = referee.judge(wrong.clone(), false);
    assert_eq!(shown(&failing), brief);
    assert_eq!(shown(&failing.written()), full);
    let passing = referee.judge_last(right, false);
    assert_eq!(shown(&passing.written()), brief);
    // The radius is that of a rounding to 128 bits.
    let radius = judge_case(&third, at(), wrong, &settings).radii[0];
    assert_eq!(radius, 2f64.powi(-130));
}

/// Values as they stand in an answer, to 20 digits with their radii.
#[test]
fn values_and_dues_are_written_to_twenty_digits() {
    let third = || Ball::rational(200, &Rational::from((1, 3)));
    let digits = Some("0.33333333333333333333".to_string());
    let written = decimals(&ReferenceAnswer::bounded(vec![third()], "planted"));
    let rad = third().rad().to_f64();
    let proof = Some(Proof::Bounded("planted"));
    assert_eq!(written, (vec![digits.clone()], vec![rad], proof));
    let expected = vec![
        crate::Expected::Number(third()),
        crate::Expected::zero(true),
        crate::Expected::Infinity { negative: false },
    ];
    let written = decimals(&ReferenceAnswer::Expected(expected, Proof::Exact));
    let all = vec![digits, Some("-0".into()), Some("inf".into())];
    assert_eq!(written, (all, vec![rad, 0.0, 0.0], Some(Proof::Exact)));
    let none = (Vec::new(), Vec::new(), None);
    assert_eq!(decimals(&ReferenceAnswer::Refuses("planted")), none);
}

/// Answers with too few or too many values are told which are due; others have nothing to add.
#[test]
fn a_wrong_number_of_values_is_told_which_are_due() {
    let rows = Some(Rows {
        index: "k",
        count: "2",
        meaning: "one for each",
    });
    let method = Planted {
        rows,
        reference: Box::new(|x, bits| ReferenceAnswer::exact([&x[0], &x[0]], bits)),
        ..Planted::default()
    };
    let reason = |answer| {
        let report = judge_case(&method, case(0, &[1.0]), answer, &Settings::default());
        let kind = report.judgement.kind;
        (kind, report.judgement.why().unwrap_or_default())
    };
    let words = Layout::new(&method).answer();
    let expected = |n| {
        format!(
            "{n} value{}, expected 2 values: {words}",
            if n == 1 { "" } else { "s" }
        )
    };
    assert_eq!(reason(values(&[1.0])), (Some(Kind::Missing), expected(1)));
    assert_eq!(
        reason(values(&[1.0; 3])),
        (Some(Kind::Missing), expected(3))
    );
    assert_eq!(reason(values(&[1.0; 2])), (None, String::new()));
    let nan = reason(values(&[1.0, f64::NAN]));
    assert_eq!(
        nan,
        (Some(Kind::Nan), "x (value 1) is NaN, expected 1e0".into())
    );
}

fn branch() -> BranchAt {
    BranchAt {
        branch: Some("only".into()),
        seam: "x = 2".into(),
        distance: 0.5,
    }
}

/// A completed report has digits, the solver's formula, and conditions where they cost little or
/// are asked for.
#[test]
fn a_completed_report_has_everything() {
    let completed = |numbers: usize, conditions: bool, limits: &[Limit]| {
        let method = Planted {
            outputs: limits.iter().map(|l| output("x", *l)).collect(),
            reference: Box::new(|x, bits| ReferenceAnswer::exact(vec![&x[0]; limits.len()], bits)),
            conditions: Box::new(|x| Some(vec![2.0 * x[0]; limits.len()])),
            branch: Box::new(|_| Some(branch())),
            ..Planted::default()
        };
        let settings = Settings {
            conditions,
            ..Settings::default()
        };
        let case = || case(7, &vec![1.5; numbers]);
        let answer = || values(&vec![1.5; limits.len()]);
        let brief = Judge::new(&method, &Settings::default()).judge(case(), answer(), false);
        assert!(brief.reference.is_empty() && brief.branch.is_none());
        let report = complete(&method, brief, &settings);
        assert_eq!(report.case.input, case().input);
        assert_eq!(report.answer, Some(answer()));
        let known = report.judgement.components.iter();
        let known = known.filter(|c| !c.condition.is_nan()).count() == limits.len();
        (report.reference.len(), report.branch, known)
    };
    let ulps = [Limit::Ulps(4.0), Limit::Ulps(4.0)];
    assert_eq!(completed(1, false, &ulps), (2, Some(branch()), true));
    assert_eq!(completed(16, false, &ulps), (2, Some(branch()), true));
    assert_eq!(completed(17, false, &ulps), (2, Some(branch()), false));
    assert_eq!(completed(17, true, &ulps), (2, Some(branch()), true));
}

/// Entries of a table are judged as printed, and a report without an answer cannot be judged again.
#[test]
fn what_cannot_be_judged_again_stays_as_it_is() {
    let table = Planted {
        outputs: vec![
            output("x", Limit::LastDigit(0.5)),
            output("y", Limit::Ulps(1.0)),
        ],
        branch: Box::new(|_| Some(branch())),
        ..Planted::default()
    };
    let settings = Settings::default();
    let method = Planted::default();
    let brief = judge_case_briefly(&method, case(0, &[1.0]), values(&[1.0]), &settings);
    let kept = complete(&table, brief.clone(), &settings);
    assert!(kept.reference.is_empty() && kept.branch.is_none());
    assert_eq!(kept.judgement.verdict, Verdict::Pass);
    let silent = CaseReport {
        answer: None,
        ..brief
    };
    let kept = complete(&method, silent, &settings);
    assert!(kept.reference.is_empty() && kept.answer.is_none());
}

/// A panic is an answer that cannot be read, with its message.
#[test]
fn a_panic_is_a_failure_to_answer() {
    let answered = |solve: fn(&[f64]) -> SolverAnswer| {
        let solve = Box::new(solve);
        let method = Planted {
            solve,
            ..Planted::default()
        };
        answer_of(&method, &[1.0])
    };
    let fails = |why: &str| SolverAnswer::Fails(why.into());
    assert_eq!(answered(|_| panic!("plain")), fails("panicked: plain"));
    assert_eq!(answered(|x| panic!("at {}", x[0])), fails("panicked: at 1"));
    assert_eq!(answered(|_| std::panic::panic_any(7)), fails("panicked"));
    assert_eq!(answered(values), values(&[1.0]));
    let one: Case = case(0, &[1.5]);
    let report = audit_case(&Planted::default(), one, &Settings::default());
    assert_eq!(report.judgement.verdict, Verdict::Pass);
    assert_eq!(report.answer, Some(values(&[1.5])));
}
