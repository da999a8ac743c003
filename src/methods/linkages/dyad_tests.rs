//! Audits and refusals of both dyads.

use crate::audit::{ReferenceAnswer, Settings, SolverAnswer, audit_method};
use crate::methods::find;
use rug::Rational;

fn passes_with_another_seed(name: &str) {
    let settings = Settings {
        seed: 20_240_607,
        cases_per_region: 40,
        ..Settings::default()
    };
    let report = audit_method(&*find(name).unwrap(), &settings, &|| ());
    let failed = report
        .failures
        .first()
        .map(|f| (&f.case, &f.judgement.reason));
    assert!(report.passed(), "{failed:?} {:?}", report.laws);
    assert!(report.laws.iter().all(|l| l.cases > 100));
}

#[test]
fn four_bar_passes_with_another_seed() {
    passes_with_another_seed("four-bar");
}

#[test]
fn slider_crank_passes_with_another_seed() {
    passes_with_another_seed("slider-crank");
}

/// Solver and reference in one word.
#[test]
fn what_is_no_linkage_is_refused_by_its_name() {
    for (name, input, due) in [
        ("four-bar", [0.0, 3.0, 4.0, 6.0, 0.0, 1.0], "not positive"),
        ("four-bar", [1.0, 3.0, 4.0, -6.0, 0.0, 1.0], "not positive"),
        ("four-bar", [1.0, 2.0, 3.0, 7.0, 0.0, 1.0], "cannot close"),
        ("four-bar", [2.0, 8.0, 3.0, 6.0, 0.0, 1.0], "unreachable"),
        ("four-bar", [2.0, 7.0, 3.0, 6.0, 0.0, 1.0], "singular"),
        (
            "slider-crank",
            [1.0, 0.0, 0.0, 0.0, 0.0, 1.0],
            "not positive",
        ),
        (
            "slider-crank",
            [1.0, 5.0, 7.0, 0.0, 0.0, 1.0],
            "cannot close",
        ),
        (
            "slider-crank",
            [1.0, 5.0, 5.5, 0.0, 0.0, 1.0],
            "unreachable",
        ),
        ("slider-crank", [1.0, 5.0, 5.0, 0.0, 0.0, 1.0], "singular"),
    ] {
        let method = find(name).unwrap();
        let answer = method.solve(&input);
        assert_eq!(answer, SolverAnswer::Refuses(due), "{name} {input:?}");
        let exact = input.map(|x| Rational::from_f64(x).unwrap());
        match method.reference(&exact, 128) {
            ReferenceAnswer::Refuses(word) => assert_eq!(word, due, "{name} {input:?}"),
            other => panic!("{name} {input:?}: {other:?}"),
        }
    }
}

#[test]
fn a_side_is_1_or_minus_1() {
    for name in ["four-bar", "slider-crank"] {
        let method = find(name).unwrap();
        let mut input = method.domain().check_points[0].input.clone();
        for (side, due) in [
            (1.0, true),
            (-1.0, true),
            (0.0, false),
            (0.5, false),
            (2.0, false),
        ] {
            input[5] = side;
            assert_eq!(method.admits(&input), due, "{name} {side}");
        }
        // Of what is neither both make the same.
        let of = |side: f64| {
            let mut input = input.clone();
            input[5] = side;
            let exact: Vec<_> = input
                .iter()
                .map(|x| Rational::from_f64(*x).unwrap())
                .collect();
            let reference = method.reference(&exact, 64);
            (method.solve(&input), format!("{reference:?}"))
        };
        assert_eq!(of(0.0), of(-1.0), "{name}");
        assert_ne!(of(0.0), of(1.0), "{name}");
    }
}

#[test]
fn laws_of_dyads_apply_to_positions_alone() {
    for (name, good, bad) in [
        (
            "four-bar",
            [1.0, 3.0, 4.0, 6.0, 0.0, 1.0],
            [1.0, 2.0, 3.0, 7.0, 0.0, 1.0],
        ),
        (
            "slider-crank",
            [3.0, 5.0, 0.0, 0.0, 1.0, 1.0],
            [1.0, 5.0, 7.0, 0.0, 0.0, 1.0],
        ),
    ] {
        for law in find(name).unwrap().laws() {
            let found = (law.residual)(&good);
            assert!(
                found.is_some_and(|r| r <= 1.0),
                "{name} {}: {found:?}",
                law.name
            );
            assert_eq!((law.residual)(&bad), None, "{name} {}", law.name);
            assert_eq!((law.residual)(&good[1..]), None, "{name} {}", law.name);
        }
    }
}
