//! Tests of a tally's report: regions, examples, norms, laws, and the parts left out.

use super::*;
use crate::planted::off as shifted;

/// `1` in each of the outputs, off by a number of ulps.
fn at(method: &Planted, region: &'static str, index: u64, ulps: &[u64]) -> CaseReport {
    let got: Vec<f64> = ulps.iter().map(|k| shifted(1.0, *k)).collect();
    given(method, region, index, SolverAnswer::Values(got))
}

fn given(method: &Planted, region: &'static str, index: u64, answer: SolverAnswer) -> CaseReport {
    let case = Case {
        region,
        ..planted::case(index, &[1.0])
    };
    judge_case_briefly(method, case, answer, &Settings::default())
}

fn regions(names: [&'static str; 2]) -> Domain {
    let each = names.map(|name| region(name, |d| vec![d.uniform(1.0, 2.0)]));
    Domain {
        regions: each.to_vec(),
        check_points: Vec::new(),
    }
}

fn tally(method: &Planted, all: &[CaseReport]) -> Tally {
    let mut tally = Tally::new(method, &Settings::default());
    all.iter().for_each(|r| tally.add(r));
    tally
}

fn index(case: &Case) -> u64 {
    match case.origin {
        Origin::Random { index, .. } => index,
        _ => panic!("drawn at random"),
    }
}

/// Regions with their descriptions: named ones first, then those of the domain, then unknown ones
/// by name.
#[test]
fn regions_stand_in_their_order() {
    let method = Planted {
        domain: regions(["second", "first"]),
        ..Planted::default()
    };
    let names = [
        "zeta",
        "first",
        "hard",
        "alpha",
        "second",
        "given",
        "box",
        "near",
        "check-points",
    ];
    let all: Vec<CaseReport> = names
        .iter()
        .map(|name| at(&method, name, 0, &[0]))
        .collect();
    let found = tally(&method, &all).finish(&method);
    let each: Vec<_> = found
        .regions
        .iter()
        .map(|r| (r.name, r.description))
        .collect();
    let expected = [
        ("check-points", "named points of the domain"),
        ("hard", "hard cases that hunts have found"),
        ("given", "inputs given by themselves"),
        ("box", "drawn in a box"),
        ("near", "drawn about an input"),
        ("second", "planted"),
        ("first", "planted"),
        ("alpha", ""),
        ("zeta", ""),
    ];
    assert_eq!(each, expected);
    assert_eq!((found.total.name, found.cases), ("all", 9));
}

/// The norm of all errors means something where there is a budget for it, or one unit.
#[test]
fn a_norm_is_of_one_unit_or_has_a_budget() {
    let found = |units: [&'static str; 3], norm: Option<NormBudget>| {
        let outputs = units.map(|unit| Output {
            unit,
            ..output("x", Limit::Ulps(4.0))
        });
        let method = Planted {
            outputs: outputs.to_vec(),
            norm,
            reference: Box::new(|x, bits| ReferenceAnswer::exact(vec![&x[0]; 3], bits)),
            ..Planted::default()
        };
        let report = tally(&method, &[at(&method, "middle", 0, &[1, 0, 0])]).finish(&method);
        assert_eq!(report.norm_budget, norm);
        let counts = [&report.total, &report.regions[0]].map(|r| r.normwise.map(|n| n.count));
        assert_eq!(counts[0], counts[1]);
        counts[0]
    };
    let norm = Some(NormBudget::new(8.0, "planted"));
    assert_eq!(found(["m", "m", "m"], None), Some(1));
    assert_eq!(found(["m", "m", "rad"], None), None);
    assert_eq!(found(["m", "rad", "rad"], None), None);
    assert_eq!(found(["m", "m", "rad"], norm), Some(1));
    assert_eq!(found(["m", "m", "m"], norm), Some(1));
}

/// A recorded excess is forgiven only while the norm is within its budget, however near.
#[test]
fn a_norm_near_its_budget_is_within_it() {
    let found = |factor| {
        let method = Planted {
            norm: Some(NormBudget::new(factor, "planted")),
            hard: vec![planted::hard(1.25, "x", &[1.0])],
            ..Planted::default()
        };
        // Five ulps of one are ten u of the norm.
        let report = tally(&method, &[at(&method, "middle", 0, &[5])]).finish(&method);
        (report.recorded, report.failed())
    };
    assert_eq!(found(10.5), (1, 0));
    assert_eq!(found(19.0), (1, 0));
    assert_eq!(found(9.5), (0, 1));
}

/// Of each wrong kind three examples: the first of each region, then the rest of the first regions.
#[test]
fn examples_come_from_every_region() {
    let method = Planted {
        domain: regions(["first", "second"]),
        ..Planted::default()
    };
    let nan = || SolverAnswer::Values(vec![f64::NAN]);
    let all = [
        given(&method, "first", 5, nan()),
        given(&method, "first", 6, nan()),
        given(&method, "first", 7, nan()),
        given(&method, "second", 3, SolverAnswer::Fails("planted".into())),
        given(&method, "second", 1, nan()),
        given(&method, "second", 2, nan()),
        given(&method, "first", 9, SolverAnswer::Refuses("planted")),
    ];
    let found = tally(&method, &all).finish(&method);
    let shown = |of: &[CaseReport]| -> Vec<_> {
        let each = of.iter();
        each.map(|c| (c.case.region, index(&c.case), c.judgement.kind))
            .collect()
    };
    let expected = [
        ("first", 5, Some(Kind::Nan)),
        ("second", 1, Some(Kind::Nan)),
        ("first", 6, Some(Kind::Nan)),
        ("first", 9, Some(Kind::Refusal)),
        ("second", 3, Some(Kind::Unreadable)),
    ];
    assert_eq!(shown(&found.wrong), expected);
    // With the reference's digits.
    assert!(found.wrong.iter().all(|c| c.reference.len() == 1));
    // Failures region by region, all of them.
    let places: Vec<_> = shown(&found.failures).iter().map(|f| (f.0, f.1)).collect();
    let expected = [
        ("first", 5),
        ("first", 6),
        ("first", 7),
        ("first", 9),
        ("second", 1),
        ("second", 2),
        ("second", 3),
    ];
    assert_eq!(places, expected);
    assert_eq!(found.failures_left_out, 0);
}

/// Of failures that are not kept the number is told.
#[test]
fn failures_left_out_are_counted() {
    let method = Planted {
        domain: regions(["first", "second"]),
        ..Planted::default()
    };
    let mut lean = Tally::lean(&method, &Settings::default());
    (0..27).for_each(|i| lean.add(&at(&method, "first", i, &[9])));
    (0..3).for_each(|i| lean.add(&at(&method, "second", i, &[9])));
    lean.add(&at(&method, "second", 3, &[1]));
    lean.unanswered("second", 4);
    let found = lean.finish(&method);
    assert_eq!((found.cases, found.passed, found.failed()), (35, 1, 34));
    assert_eq!((found.failures.len(), found.failures_left_out), (23, 11));
}

/// Cases without an answer count in their region; none of them make no region.
#[test]
fn unanswered_cases_are_those_of_their_region() {
    let method = Planted::default();
    let mut tally = tally(&method, &[at(&method, "middle", 0, &[0])]);
    tally.unanswered("middle", 1);
    tally.unanswered("hard", 2);
    tally.unanswered("near", 0);
    let found = tally.finish(&method);
    let each: Vec<_> = found
        .regions
        .iter()
        .map(|r| (r.name, r.cases, r.passed))
        .collect();
    assert_eq!(each, [("hard", 2, 0), ("middle", 2, 1)]);
    assert_eq!(found.total.kinds[Kind::Unanswered], 3);
    assert!(!found.passed());
}

/// The sample of every region, region by region.
#[test]
fn points_of_every_region() {
    let method = Planted {
        domain: regions(["first", "second"]),
        ..Planted::default()
    };
    let settings = Settings {
        points: 2,
        ..Settings::default()
    };
    let mut tally = Tally::new(&method, &settings);
    for (region, i) in [("second", 4), ("first", 3), ("second", 1), ("first", 8)] {
        tally.add(&at(&method, region, i, &[i]));
    }
    let found = tally.finish(&method);
    let each: Vec<_> = (found.points.iter())
        .map(|p| (p.case.region, index(&p.case), p.ulps.clone()))
        .collect();
    let expected = [
        ("first", 3, vec![3.0]),
        ("first", 8, vec![8.0]),
        ("second", 1, vec![1.0]),
        ("second", 4, vec![4.0]),
    ];
    assert_eq!(each, expected);
}

/// The end of a run is no pass, in either half of a sum.
#[test]
fn an_interruption_is_kept() {
    let method = Planted::default();
    let whole = || tally(&method, &[at(&method, "middle", 0, &[0])]);
    assert!(!whole().is_interrupted() && whole().finish(&method).passed());
    let mut half = whole();
    half.interrupt();
    assert!(half.is_interrupted());
    for (mut sum, other) in [(whole(), half.clone()), (half.clone(), whole())] {
        sum.merge(other);
        assert!(sum.is_interrupted());
        let report = sum.finish(&method);
        assert!(report.interrupted && !report.passed());
    }
    let mut sum = whole();
    sum.merge(whole());
    assert!(!sum.is_interrupted());
}

/// The description of the method in a report.
#[test]
fn a_report_names_its_method() {
    let proved = crate::ProvedBound {
        error: crate::ProvedError::Ulps(2.0),
        inputs: "all",
        command: "planted",
    };
    let method = Planted {
        inputs: vec!["x", "y", "a[3]"],
        format: crate::Format::Single,
        proved: vec![proved],
        ..Planted::default()
    };
    let found = tally(&method, &[]).finish(&method);
    let names = (found.method, found.summary, found.source);
    assert_eq!(names, ("planted", "a planted method", "a planted source"));
    assert_eq!(found.inputs, [("x", 0), ("y", 1)]);
    assert_eq!(
        (found.format, found.proved),
        (crate::Format::Single, vec![proved])
    );
    let budget = &found.budgets[0];
    assert_eq!(
        (found.budgets.len(), budget.name, budget.unit),
        (1, "x", "1")
    );
    assert_eq!(budget.budget, method.outputs[0].budget);
    assert_eq!(found.reproduce.head, "mechaudit audit planted ");
    assert!(found.candidate.is_none() && found.map.is_none());
}
