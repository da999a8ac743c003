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

#[test]
fn a_mean_is_decided_by_its_interval() {
    let m = Mean {
        mean: 1.0,
        within: 0.25,
        points: 10,
    };
    for (bound, due) in [
        (2.0, Verdict::Holds),
        (1.25, Verdict::Holds),
        (1.24, Verdict::Open),
        (1.0, Verdict::Open),
        (0.75, Verdict::Open),
        (0.74, Verdict::Refuted),
    ] {
        assert_eq!(of_mean(&m, bound), due, "{bound}");
    }
}

/// Checks that what is certainly over comes before what is not, whatever its share.
#[test]
fn the_worst_of_a_search_is_certain() {
    let mut search = Search {
        worst: None,
        ceiling: f64::NEG_INFINITY,
        points: 0,
    };
    let offers = [
        ((0.5, false), [0.0, 9.0], (0.5, 0.0, f64::NEG_INFINITY)),
        ((3.0, false), [1.0, 9.0], (3.0, 1.0, f64::NEG_INFINITY)),
        ((2.0, false), [2.0, 9.0], (3.0, 1.0, f64::NEG_INFINITY)),
        ((1.5, true), [3.0, 4.0], (1.5, 3.0, 4.0)),
        ((9.0, false), [4.0, 9.0], (1.5, 3.0, 4.0)),
        ((1.2, true), [5.0, 7.0], (1.5, 3.0, 7.0)),
        ((1.7, true), [6.0, 2.0], (1.7, 6.0, 7.0)),
        // The first of equals.
        ((1.7, true), [7.0, 2.0], (1.7, 6.0, 7.0)),
    ];
    for (found, z, (share, x, ceiling)) in offers {
        search.offer(found, &z);
        let worst = search.worst.as_ref().unwrap();
        assert_eq!((worst.0, worst.1[0], search.ceiling), (share, x, ceiling));
    }
}

/// An algorithm that is not published, judged over the square.
fn judged(w: fn(num_complex::Complex64) -> num_complex::Complex64, bound: f64) -> Decided {
    let algorithm = Algorithm {
        w,
        ..find_algorithm("humlicek-1982").unwrap()
    };
    let claim = Claim {
        algorithm: "humlicek-1982",
        statement: "",
        source: "",
        reading: "",
        test: None,
    };
    let tested = Tested::new(Subject::W(algorithm), NEAR, Measure::Norm, bound);
    let mut decided = decide(&claim, &EFFORT);
    maximum(&mut decided, &tested, &EFFORT);
    decided
}

/// As often next to the axis as at any height.
const NEAR: Place = Place {
    words: "",
    draw: |d| {
        let y = match d.chance(0.5) {
            true => d.uniform(0.0, 4.0),
            false => d.log_uniform(1e-8, 1.0),
        };
        vec![d.uniform(-4.0, 4.0), y]
    },
    holds: |z| z[0].abs() <= 4.0 && (0.0..=4.0).contains(&z[1]),
};

#[test]
fn what_fails_in_a_strip_alone_holds_in_part() {
    use crate::solvers::faddeeva::faddeeva;
    let strip = judged(|z| faddeeva(z) * if z.im < 0.008 { 1.1 } else { 1.0 }, 1e-3);
    assert_eq!(strip.verdict, Verdict::InPart, "{strip:?}");
    assert_eq!(strip.part, "where Im z >= 1e-2");
    assert!(strip.at.unwrap()[1] < 0.008);
    // One search of the whole and one above, at least.
    assert!(strip.points > 150, "{}", strip.points);
    // Off up to where no strip is left out, and everywhere.
    let high = judged(|z| faddeeva(z) * if z.im < 0.5 { 1.1 } else { 1.0 }, 1e-3);
    assert_eq!((high.verdict, high.part.as_str()), (Verdict::Refuted, ""));
    let good = judged(faddeeva, 1e-3);
    assert_eq!((good.verdict, good.part.as_str()), (Verdict::Holds, ""));
    // Ten cases audited and twenty evaluations of a hunt for each of five.
    assert!((100..=150).contains(&good.points), "{}", good.points);
    assert!(good.found.unwrap() < 1e-14);
}

/// Checks that what is found is the error itself, in the measure's words, and a point for each of
/// forty in five cases.
#[test]
fn figures_are_those_of_the_measure() {
    let claim =
        |statistic, bound| planted("humlicek-1982", SQUARE, (Measure::Norm, statistic, bound));
    let most = claim(Statistic::Maximum, 1e-2);
    assert_eq!(most.measure, "relative, of the norm");
    let found = most.found.unwrap();
    assert!((1e-6..1e-3).contains(&found), "{found}");
    assert_eq!((most.bound, most.part.as_str()), (Some(1e-2), ""));
    let z = most.at.unwrap();
    assert_eq!(
        most.reproduce.unwrap(),
        format!("mechaudit {}", code::at("humlicek-1982", &z))
    );
    let mean = claim(Statistic::Mean, 1e-2);
    assert_eq!(
        (mean.measure.as_str(), mean.points),
        ("mean, relative, of the norm", 200)
    );
    let (m, within) = (mean.found.unwrap(), mean.within.unwrap());
    assert!(
        m > 0.0 && m < found && within > 0.0 && within < found,
        "{m} {within}"
    );
    assert!(mean.at.is_none() && mean.reproduce.is_none());
    let none = planted(
        "wells-1999-r4",
        FAR_ON_THE_AXIS,
        (Measure::RelativeIm, Statistic::Mean, 1.0),
    );
    assert_eq!(
        (none.part.as_str(), none.points),
        ("an answer is no number", 0)
    );
}

#[test]
fn what_cannot_be_tested_says_why() {
    for claim in super::super::data::claims()
        .iter()
        .filter(|c| c.test.is_none())
    {
        let decided = decide(claim, &EFFORT);
        assert_eq!(decided.verdict, Verdict::NotTestable);
        assert_eq!((decided.part.as_str(), decided.points), (claim.reading, 0));
    }
}

/// The relative errors of Re w and Im w and the larger, where Re w is off by a thousandth and Im w
/// by two.
#[test]
fn each_measure_is_of_its_parts() {
    let w: fn(num_complex::Complex64) -> num_complex::Complex64 = |z| {
        let w = crate::solvers::faddeeva::faddeeva(z);
        num_complex::Complex::new(w.re * 1.001, w.im * 1.002)
    };
    let algorithm = Algorithm {
        w,
        ..find_algorithm("humlicek-1982").unwrap()
    };
    // w(1 + i).
    let [re, im] = [0.304_744_205_256_912_6, 0.208_218_938_202_831_62];
    let norm = f64::hypot(1e-3 * re, 2e-3 * im) / f64::hypot(re, im);
    for (measure, due) in [
        (Measure::Norm, norm),
        (Measure::RelativeRe, 1e-3),
        (Measure::RelativeIm, 2e-3),
        (Measure::RelativeParts, 2e-3),
        (Measure::Absolute, 2e-3 * im),
        (Measure::AbsoluteRe, 1e-3 * re),
    ] {
        for (bound, over) in [(due * 1.01, false), (due * 0.99, true)] {
            let tested = Tested::new(Subject::W(algorithm), SQUARE, measure, bound);
            let found = tested.over(0.5, |m| tested.share(m, &[1.0, 1.0]));
            assert!(
                (found.0 * bound / due - 1.0).abs() < 1e-6,
                "{measure:?} {found:?}"
            );
            assert_eq!(found.1, over, "{measure:?}");
        }
        let tested = Tested::new(Subject::W(algorithm), SQUARE, measure, 1.0);
        for (floor, z, due) in [
            (1.0, [1.0, 1.0], true),
            (1.0, [1.0, 0.99], false),
            (1.0, [5.0, 1.0], false),
            (f64::NEG_INFINITY, [1.0, 0.0], true),
            (f64::NEG_INFINITY, [1.0, -1.0], false),
        ] {
            assert_eq!(tested.over(floor, |m| m.admits(&z)), due, "{floor} {z:?}");
        }
    }
}

#[test]
fn a_power_above_is_above_also_where_it_is_one() {
    assert_eq!(power_above(1e-20), 1e-19);
    assert_eq!(power_above(1e-25), 1e-19);
    assert_eq!(power_above(0.0099), 0.01);
    // A power of ten that rounding has put just below itself.
    assert_eq!(power_above(1e-3 * (1.0 - 1e-10)), 1e-2);
    assert_eq!(power_above(1e-3 * (1.0 - 1e-8)), 1e-3);
}
