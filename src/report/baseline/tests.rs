//! Tests of `baseline`.

use super::*;
use crate::report::json;
use crate::report::text::method::tests::{fabricated, passing};

fn of(report: &MethodReport) -> Baseline {
    let text = json::document(std::slice::from_ref(report), false).to_string();
    Baseline::read(&text).unwrap()
}

#[test]
fn what_has_changed() {
    let (mut before, after) = (fabricated(), fabricated());
    assert_eq!(
        of(&before).changes(std::slice::from_ref(&after)),
        Changes::default()
    );
    // One region was better in one statistic.
    before.regions[0].outputs[0].ulps.max = 5.0;
    let found = of(&before).changes(&[after]);
    let [change] = found.changes.as_slice() else {
        panic!("{found:?}");
    };
    assert_eq!((change.figure, change.better), ("worst ulps", false));
    assert_eq!(
        (change.region.as_str(), change.before, change.now),
        ("wide", 5.0, 7.25)
    );
    // All failures gone: better in each region and in all.
    let found = of(&fabricated()).changes(&[passing()]);
    assert_eq!(found.changes.len(), 3);
    assert!(
        found
            .changes
            .iter()
            .all(|c| c.better && c.figure == "failed")
    );
}

#[test]
fn other_cases_are_not_compared() {
    let mut before = fabricated();
    before.settings.seed = 2;
    let found = of(&before).changes(&[fabricated()]);
    assert!(found.changes.is_empty() && found.not_compared[0].contains("--seed 2"));
    before = fabricated();
    before.method = "another";
    assert!(of(&before).changes(&[fabricated()]).not_compared[0].contains("not in"));
    for (text, part) in [
        ("{", "no report"),
        ("{\"schema_version\": 1}", "is 1, not 2"),
    ] {
        let e = Baseline::read(text).err().unwrap().to_string();
        assert!(e.contains(part), "{e}");
    }
}

/// Every figure of an output is compared.
#[test]
fn figures_that_change_are_named() {
    let changed = |change: fn(&mut crate::audit::OutputStatistics)| {
        let mut before = fabricated();
        change(&mut before.regions[0].outputs[0]);
        let found = of(&before).changes(&[fabricated()]).changes;
        let each = found.iter().map(|c| (c.figure, c.better));
        each.collect::<Vec<_>>()
    };
    assert_eq!(changed(|o| o.ulps.max *= 2.0), [("worst ulps", true)]);
    assert_eq!(changed(|o| o.max_of_budget *= 0.5), [("of budget", false)]);
    assert_eq!(changed(|o| o.ulps.p99 *= 2.0), [("p99 ulps", true)]);
    assert_eq!(changed(|o| o.ulps.rms *= 0.5), [("RMS ulps", false)]);
    // Of other values they mean nothing.
    let other = changed(|o| {
        o.ulps.count += 1;
        o.ulps.p99 *= 2.0;
    });
    assert_eq!(other, []);
}

fn named(report: &MethodReport, name: &str) -> MethodReport {
    let mut report = report.clone();
    report.candidate = Some(crate::audit::CandidateReport {
        name: name.into(),
        ..Default::default()
    });
    report
}

/// Of several of one method that of the same name, or without one; one alone whatever its name is.
#[test]
fn a_report_is_found_by_its_method_and_its_name() {
    let better = passing();
    let read = |reports: &[MethodReport]| {
        Baseline::read(&json::document(reports, false).to_string()).unwrap()
    };
    let changed = |before: &[MethodReport], now: &MethodReport| {
        let found = read(before).changes(std::slice::from_ref(now));
        (found.changes.len(), found.not_compared.len())
    };
    let mut another = fabricated();
    another.method = "another";
    let (own, a, b) = (fabricated(), named(&better, "a"), named(&better, "b"));
    let same = (0, 0);
    assert_eq!(
        changed(&[another.clone(), own.clone()], &fabricated()),
        same
    );
    assert_eq!(
        changed(std::slice::from_ref(&own), &named(&fabricated(), "a")),
        same
    );
    // Three regions have one failure more or less.
    assert_eq!(
        changed(&[own.clone(), a.clone(), b.clone()], &fabricated()),
        same
    );
    assert_eq!(
        changed(&[a.clone(), own.clone(), b.clone()], &named(&better, "b")),
        same
    );
    assert_eq!(
        changed(&[own.clone(), a.clone()], &named(&fabricated(), "a")),
        (3, 0)
    );
    assert_eq!(changed(&[own, a], &named(&better, "c")), (0, 1));
    assert_eq!(changed(&[another], &fabricated()), (0, 1));
}

#[test]
fn a_comparison_goes_by_names() {
    let found = Comparison::new(
        "a-method",
        vec![(fabricated(), None), (named(&passing(), "other"), None)],
    );
    let text = json::comparison(&found, None).to_string();
    let same = Baseline::read(&text).unwrap().changes_of(&found);
    assert_eq!(same, Changes::default());
    let now = Comparison::new(
        "a-method",
        vec![(passing(), None), (named(&fabricated(), "other"), None)],
    );
    let changes = Baseline::read(&text).unwrap().changes_of(&now);
    assert!(changes.not_compared.is_empty());
    let [own, other] = [0, 1].map(|k| now.candidates[k].name.as_str());
    let seen: Vec<(&str, &str, f64, f64, bool)> = changes
        .changes
        .iter()
        .map(|c| (&*c.of, &*c.region, c.before, c.now, c.better))
        .collect();
    assert_eq!(
        seen,
        [
            (other, "wide", 0.0, 1.0, false),
            (other, "near", 0.0, 1.0, false),
            (other, "all", 0.0, 1.0, false),
            (own, "wide", 1.0, 0.0, true),
            (own, "near", 1.0, 0.0, true),
            (own, "all", 1.0, 0.0, true),
        ]
    );
    // An audit of the own code has no name to go by.
    let audits = [named(&passing(), "other"), fabricated()];
    let audit = json::document(&audits, false).to_string();
    let same = Baseline::read(&audit).unwrap().changes_of(&found);
    assert_eq!(same, Changes::default());
    let mut elsewhere = audits;
    elsewhere.iter_mut().for_each(|r| r.method = "another");
    let audit = json::document(&elsewhere, false).to_string();
    let none = Baseline::read(&audit).unwrap().changes_of(&found);
    let due = [own, other].map(|name| format!("{name}: not in the baseline"));
    assert_eq!(none.not_compared, due);
}

#[test]
fn regions_are_compared_where_they_have_the_same_cases() {
    let mut before = fabricated();
    before.regions[0].cases = 399;
    before.regions[1].name = "nearer";
    let found = of(&before).changes(&[fabricated()]);
    assert_eq!(
        found.not_compared,
        [
            "a-method, wide: another number of cases",
            "a-method, near: not in the baseline"
        ]
    );
    assert!(found.changes.is_empty());
    before = fabricated();
    before.settings.cases_per_region += 1;
    let found = of(&before).changes(&[fabricated()]);
    let cases = before.settings.cases_per_region;
    let due = format!("a-method: the baseline has other cases, --seed 1 --cases {cases}");
    assert_eq!(found.not_compared, [due]);
}

/// A thousandth more or less is the same, either way round.
#[test]
fn small_changes_of_statistics_are_none() {
    let changed = |before: f64, now: f64| {
        let with = |max: f64| {
            let mut report = fabricated();
            report.regions[0].outputs[0].ulps.max = max;
            report
        };
        let found = of(&with(before)).changes(&[with(now)]).changes;
        found.iter().map(|c| c.better).collect::<Vec<_>>()
    };
    assert!(changed(1000.0, 1000.9).is_empty());
    assert!(changed(1000.9, 1000.0).is_empty());
    assert_eq!(changed(1000.0, 1001.1), [false]);
    assert_eq!(changed(1001.1, 1000.0), [true]);
    // Of the larger of the two.
    assert!(changed(1000.0, 1001.0005).is_empty());
    assert!(changed(1001.0005, 1000.0).is_empty());
    assert!(changed(0.0, 0.0).is_empty());
    assert_eq!(changed(0.0, 1e-9), [false]);
    assert!(changed(0.5, 0.5004).is_empty());
    assert!(changed(f64::INFINITY, f64::INFINITY).is_empty());
    assert_eq!(changed(f64::INFINITY, 1.0), [true]);
    assert_eq!(changed(1.0, f64::INFINITY), [false]);
}

#[test]
fn failures_and_wrong_kinds_are_counted() {
    let seen = |change: fn(&mut MethodReport)| {
        let mut before = fabricated();
        change(&mut before);
        let found = of(&before).changes(&[fabricated()]).changes;
        let each = found
            .into_iter()
            .map(|c| (c.region, c.figure, c.before, c.now));
        each.collect::<Vec<_>>()
    };
    // Of 400 cases 390 pass and seven are recorded.
    let failed = seen(|r| (r.regions[0].passed, r.regions[0].recorded) = (390, 7));
    assert_eq!(failed, [("wide".into(), "failed", 3.0, 1.0)]);
    let wrong = seen(|r| {
        r.total.kinds[crate::audit::Kind::Nan] = 2;
        r.total.kinds[crate::audit::Kind::Infinity] = 1;
    });
    assert_eq!(wrong, [("all".into(), "wrong in kind", 3.0, 0.0)]);
    // An output that was not there before has nothing to be compared with.
    assert_eq!(seen(|r| r.regions[0].outputs[0].name = "p"), []);
}
