//! Tests of `decide`.

use super::*;

const EFFORT: Effort = Effort { cases: 5, seed: 1 };

fn planted(algorithm: &'static str, place: Place, test: (Measure, Statistic, f64)) -> Decided {
    let claim = Claim {
        algorithm,
        statement: "planted",
        source: "",
        reading: "why it cannot be tested",
        test: Some((place, test.0, test.1, test.2)),
    };
    let decided = decide(&claim, &EFFORT);
    assert!(!decided.part.contains(claim.reading));
    decided
}

const SQUARE: Place = Place {
    words: "",
    draw: |d| vec![d.uniform(-4.0, 4.0), d.uniform(0.0, 4.0)],
    holds: |z| {
        let (x, y) = (z[0], z[1]);
        x.abs() <= 4.0 && (0.0..=4.0).contains(&y)
    },
};
const FAR_ON_THE_AXIS: Place = Place {
    words: "",
    draw: |d| vec![d.uniform(150.0, 200.0), 0.0],
    holds: |z| {
        let (x, y) = (z[0], z[1]);
        x >= 150.0 && y == 0.0
    },
};

#[test]
fn what_is_too_good_is_refuted_and_what_is_true_holds() {
    use Statistic::{Maximum, Mean};
    for measure in [Measure::Norm, Measure::RelativeParts, Measure::Absolute] {
        let w4 = |statistic, bound| planted("humlicek-1982", SQUARE, (measure, statistic, bound));
        assert_eq!(w4(Maximum, 1e-9).verdict, Verdict::Refuted, "{measure:?}");
        assert_eq!(w4(Maximum, 1e-2).verdict, Verdict::Holds, "{measure:?}");
        assert_eq!(w4(Mean, 1e-12).verdict, Verdict::Refuted, "{measure:?}");
        assert_eq!(w4(Mean, 1e-2).verdict, Verdict::Holds, "{measure:?}");
    }
}

#[test]
fn nan_refutes_whatever_the_bound() {
    let found = planted(
        "wells-1999-r4",
        FAR_ON_THE_AXIS,
        (Measure::RelativeIm, Statistic::Maximum, 1e9),
    );
    assert_eq!(found.verdict, Verdict::Refuted);
    assert!(found.reproduce.unwrap().contains("--at 0x1."));
    let mean = planted(
        "wells-1999-r4",
        FAR_ON_THE_AXIS,
        (Measure::RelativeIm, Statistic::Mean, 1e9),
    );
    assert_eq!(mean.verdict, Verdict::Refuted);
}

/// Above a floor no cases are drawn beside the hunt's.
#[test]
fn a_hunt_alone_finds_what_is_no_number() {
    let subject = Subject::of("wells-1999-r4").expect("an algorithm of the atlas");
    let tested = Tested::new(subject, FAR_ON_THE_AXIS, Measure::RelativeIm, 1e9);
    let search = searched(&tested, -1.0, &EFFORT);
    assert!(search.worst.is_some_and(|(_, _, over)| over));
}

#[test]
fn the_refuting_point_is_of_the_domain_and_certainly_over() {
    let found = planted(
        "weideman-1994-32",
        SQUARE,
        (Measure::RelativeRe, Statistic::Maximum, 1e-14),
    );
    let z = found.at.unwrap();
    assert!((SQUARE.holds)(&z) && found.found.unwrap() > 1e-14);
}

#[test]
fn powers_above() {
    assert_eq!(power_above(1e-9), 1e-8);
    assert_eq!(power_above(3e-9), 1e-8);
    assert_eq!(power_above(0.0), 1e-19);
}
