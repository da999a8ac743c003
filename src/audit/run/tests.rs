use super::*;
use crate::planted::{Planted, case, hard, off, output, point, region};
use crate::{Limit, MethodReport, ReferenceAnswer, Verdict};
use mechaudit_reference::Ball;
use std::collections::BTreeSet;
use std::sync::Mutex;
use std::sync::atomic::AtomicUsize;

fn settings(cases_per_region: u64) -> Settings {
    Settings {
        cases_per_region,
        ..Settings::default()
    }
}

/// Each case once, whichever part it is in: more than a thousand, and a last block that is not
/// full.
#[test]
fn every_case_is_judged_once() {
    let seen = Mutex::new(Vec::new());
    let mut method = Planted {
        solve: Box::new(|x| {
            seen.lock().unwrap().push(x[0].to_bits());
            SolverAnswer::Values(x.to_vec())
        }),
        laws: vec![crate::Law {
            name: "law",
            statement: "planted",
            residual: |x| Some(x[0] / 4.0),
        }],
        ..Planted::default()
    };
    let domain = &mut method.domain;
    domain
        .regions
        .push(region("next", |d| vec![d.uniform(2.0, 3.0)]));
    domain.check_points = vec![point("five", &[5.0])];
    for per_region in [512, 1031] {
        seen.lock().unwrap().clear();
        let ticks = AtomicUsize::new(0);
        let tick = || {
            ticks.fetch_add(1, Ordering::Relaxed);
        };
        let report = audit_method(&method, &settings(per_region), &tick);
        let all = 2 * per_region + 1;
        assert_eq!((report.cases, report.passed), (all, all));
        let each: Vec<_> = report.regions.iter().map(|r| (r.name, r.cases)).collect();
        let expected = [
            ("check-points", 1),
            ("middle", per_region),
            ("next", per_region),
        ];
        assert_eq!(each, expected);
        assert_eq!(report.laws[0].cases as u64, all);
        assert_eq!(report.laws[0].worst, 1.25);
        assert_eq!(ticks.load(Ordering::Relaxed) as u64, all);
        let seen = seen.lock().unwrap();
        assert_eq!(seen.len() as u64, all);
        assert_eq!(seen.iter().collect::<BTreeSet<_>>().len() as u64, all);
    }
}

/// A method of one complex variable that refuses, as is due.
fn plane<'a>() -> Planted<'a> {
    Planted {
        inputs: vec!["Re z", "Im z"],
        solve: Box::new(|_| SolverAnswer::Declines(None)),
        reference: Box::new(|_, _| ReferenceAnswer::Refuses("planted")),
        ..Planted::default()
    }
}

/// A map is drawn where one is asked for and the method has one; that it has none interrupts
/// nothing.
#[test]
fn a_map_is_drawn_where_it_is_asked_for() {
    let maps = Settings {
        maps: true,
        ..settings(3)
    };
    let drawn = audit_method(&plane(), &maps, &|| ());
    let map = drawn.map.as_ref().unwrap();
    assert_eq!((map.points(), map.not_passed), (144 * 104, 0));
    assert!(!drawn.interrupted && drawn.passed());
    let unasked = audit_method(&plane(), &settings(3), &|| ());
    assert!(unasked.map.is_none() && unasked.passed());
    let real = audit_method(&Planted::default(), &maps, &|| ());
    assert!(real.map.is_none() && real.passed());
}

/// A run that is stopped in its map is interrupted, and one that is stopped before has no map; one
/// that is stopped at the last point of all has everything.
#[test]
fn a_stop_within_the_map_interrupts_the_run() {
    let maps = Settings {
        maps: true,
        ..settings(3)
    };
    let stopped_at = |last: usize| {
        let (stop, ticks) = (AtomicBool::new(false), AtomicUsize::new(0));
        let tick = || {
            if ticks.fetch_add(1, Ordering::Relaxed) + 1 == last {
                stop.store(true, Ordering::Relaxed);
            }
        };
        audit_method_until(&plane(), &maps, &tick, &stop)
    };
    let within = stopped_at(4);
    assert!(within.interrupted && within.map.is_none() && !within.passed());
    assert_eq!((within.cases, within.passed), (3, 3));
    let before = stopped_at(3);
    assert!(before.interrupted && before.map.is_none() && !before.passed());
    let after = stopped_at(3 + 144 * 104);
    assert!(after.map.is_some() && !after.interrupted && after.passed());
}

/// Of two outputs the worst case of each is taken apart.
#[test]
fn worst_cases_are_taken_apart() {
    let method = || Planted {
        outputs: vec![output("x", Limit::Ulps(4.0)), output("y", Limit::Ulps(4.0))],
        reference: Box::new(|x, bits| ReferenceAnswer::exact([&x[0], &x[0]], bits)),
        // Wrong by three ulps in the first and one in the second output, of which the method has
        // one.
        solve: Box::new(|x| SolverAnswer::Values(vec![off(x[0], 3), off(x[0], 1)])),
        twin: Box::new(|x| Some(vec![Ball::exact(64, off(x[0], 1)); 2])),
        ..Planted::default()
    };
    let report = audit_method(&method(), &settings(5), &|| ());
    let parts = |report: &MethodReport| -> Vec<_> {
        let each = report.total.outputs.iter();
        let rounded = |x: f64| (x * 1024.0).round() / 1024.0;
        each.map(|o| o.parts.map(|p| (rounded(p.method), rounded(p.rounding))))
            .collect()
    };
    assert_eq!(parts(&report), [Some((1.0, 2.0)), Some((1.0, 0.0))]);
    let stop = AtomicBool::new(false);
    let tick = || stop.store(true, Ordering::Relaxed);
    let half = audit_method_until(&method(), &settings(5), &tick, &stop);
    assert!(half.interrupted && half.cases > 0);
    assert_eq!(parts(&half), [None, None]);
}

/// One case has a report of its own, of the method's answer or another, with the laws.
#[test]
fn one_case_is_a_report() {
    let mut method = Planted {
        laws: vec![crate::Law {
            name: "law",
            statement: "planted",
            residual: |x| Some(x[0]),
        }],
        ..Planted::default()
    };
    let one = |method: &Planted, x: f64, answer| {
        let report = audit_one(method, case(3, &[x]), answer, &Settings::default());
        let law = &report.laws[0];
        assert_eq!((law.cases, law.worst), (1, x));
        assert_eq!((report.cases, report.total.cases), (1, 1));
        assert_eq!(report.regions[0].name, "middle");
        report
    };
    let right = one(&method, 1.0, None);
    assert!(right.passed() && right.failed() == 0 && right.worst.len() == 1);
    let given = |ulps| Some(SolverAnswer::Values(vec![off(1.0, ulps)]));
    assert!(one(&method, 1.0, given(4)).passed());
    let wrong = one(&method, 1.0, given(5));
    assert_eq!((wrong.passed(), wrong.failed()), (false, 1));
    assert_eq!(wrong.failures[0].judgement.verdict, Verdict::Over);
    assert_eq!(wrong.total.outputs[0].ulps.max, 5.0);
    // A law that is broken fails the case.
    assert!(!one(&method, 1.5, None).passed());
    // As far as is recorded.
    method.hard = vec![hard(1.25, "x", &[1.0])];
    let known = one(&method, 1.0, given(5));
    assert_eq!((known.passed(), known.recorded), (true, 1));
}
