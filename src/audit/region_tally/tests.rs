//! Counts, largest numbers, samples and merges of one region, as they were planted.

use super::*;
use crate::planted::{Planted, case, off, output};
use crate::{CaseReport, Limit, ReferenceAnswer, SolverAnswer, judge_case_briefly};

const NAMES: [&str; 2] = ["x", "y"];

/// Judges `got` where 1 is expected in both outputs of every row, with the condition numbers given for each value.
fn judged(index: u64, got: &[f64], conditions: Option<&[f64]>) -> CaseReport {
    let rows = got.len();
    let method = Planted {
        outputs: NAMES.map(|name| output(name, Limit::Ulps(4.0))).to_vec(),
        reference: Box::new(move |x, bits| ReferenceAnswer::exact(vec![&x[0]; rows], bits)),
        conditions: Box::new(move |_| conditions.map(<[f64]>::to_vec)),
        ..Planted::default()
    };
    let settings = Settings {
        conditions: true,
        ..Settings::default()
    };
    let answer = SolverAnswer::Values(got.to_vec());
    judge_case_briefly(&method, case(index, &[1.0]), answer, &settings)
}

/// Judges values that are off by `by` ulps each.
fn ulps(index: u64, by: &[u64]) -> CaseReport {
    let got: Vec<f64> = by.iter().map(|k| off(1.0, *k)).collect();
    judged(index, &got, None)
}

fn empty(points: usize) -> RegionTally {
    let settings = Settings {
        points,
        ..Settings::default()
    };
    RegionTally::new(&NAMES, &settings, Keep::WHOLE)
}

fn tally(all: &[CaseReport]) -> RegionTally {
    let mut tally = empty(0);
    all.iter().for_each(|r| tally.add(r, false));
    tally
}

fn report(tally: &RegionTally) -> RegionReport {
    tally.report(("middle", "planted"), true)
}

/// The same, added in one tally, and in two that are merged either way round.
fn every_way(all: &[CaseReport], check: impl Fn(&RegionReport)) {
    check(&report(&tally(all)));
    for cut in 0..=all.len() {
        let (a, b) = all.split_at(cut);
        for (a, b) in [(a, b), (b, a)] {
            let mut sum = tally(a);
            sum.merge(&tally(b));
            check(&report(&sum));
        }
    }
}

fn index(case: &Option<Case>) -> Option<u64> {
    match case.as_ref()?.origin {
        crate::Origin::Random { index, .. } => Some(index),
        _ => None,
    }
}

#[test]
fn nothing_found_is_no_share() {
    let found = report(&empty(0));
    assert_eq!((found.name, found.description), ("middle", "planted"));
    assert_eq!((found.cases, found.failed()), (0, 0));
    assert!(found.max_of_budget.is_nan());
    assert!(found.worst.is_none());
    let names: Vec<&str> = found.outputs.iter().map(|o| o.name).collect();
    assert_eq!(names, NAMES);
    for o in &found.outputs {
        assert_eq!((o.values, o.max_condition), (0, 0.0));
        assert!(o.max_of_budget.is_nan());
        assert!(o.worst.is_none() && o.histogram.is_empty() && o.parts.is_none());
        assert_eq!((o.ulps.count, o.conditioned.count), (0, 0));
    }
    assert_eq!(found.normwise, Some(crate::Spread::default()));
    assert!(empty(0).report(("middle", ""), false).normwise.is_none());
}

/// The largest share of a budget of all and of each output, with the first case that has it.
#[test]
fn the_largest_share_and_its_case() {
    let all = [
        ulps(3, &[0, 2]),
        ulps(4, &[1, 6]),
        ulps(5, &[1, 6]),
        ulps(6, &[3, 0]),
        ulps(7, &[3, 1]),
    ];
    every_way(&all, |found| {
        let rounded = |x: f64| (x * 1024.0).round() / 1024.0;
        assert_eq!(
            (rounded(found.max_of_budget), index(&found.worst)),
            (1.5, Some(4))
        );
        let each: Vec<_> = (found.outputs.iter())
            .map(|o| {
                (
                    rounded(o.max_of_budget),
                    index(&o.worst),
                    o.ulps.max,
                    o.values,
                )
            })
            .collect();
        assert_eq!(each, [(0.75, Some(6), 3.0, 5), (1.5, Some(4), 6.0, 5)]);
        assert_eq!((found.cases, found.passed, found.over), (5, 3, 2));
        // Two rows of the histogram hold one case each, which is the first of the largest.
        let y = &found.outputs[1].histogram;
        let y: Vec<_> = y
            .iter()
            .map(|o| (o.exponent, o.count, index(&Some(o.worst.clone()))))
            .collect();
        assert_eq!(
            y,
            [
                (None, 1, Some(6)),
                (Some(0), 1, Some(7)),
                (Some(1), 1, Some(3)),
                (Some(2), 2, Some(4))
            ]
        );
    });
}

/// Condition numbers: the largest finite one, and the errors in units of them.
#[test]
fn condition_numbers_have_a_largest() {
    let at = |index, conditions: [f64; 2]| judged(index, &[off(1.0, 1), 1.0], Some(&conditions));
    let all = [
        at(0, [3.0, 0.5]),
        at(1, [7.0, f64::INFINITY]),
        at(2, [1.0, f64::NAN]),
    ];
    every_way(&all, |found| {
        let [x, y] = found.outputs.as_slice() else {
            panic!("two outputs")
        };
        assert!(
            (7.0..7.0 + 1e-6).contains(&x.max_condition),
            "{}",
            x.max_condition
        );
        assert!(
            (0.5..0.5 + 1e-6).contains(&y.max_condition),
            "{}",
            y.max_condition
        );
        // An ulp of one is 2 u; of (1 + cond) u a half, a quarter, one.
        assert_eq!((x.conditioned.count, y.conditioned.count), (3, 1));
        assert!((x.conditioned.max - 1.0).abs() < 1e-6 && y.conditioned.max == 0.0);
        assert!((x.conditioned.median - 0.5).abs() < 1e-3);
    });
    // Of a number that cannot be told from zero it is infinite, and not counted.
    let mut zero = at(0, [3.0, 0.5]);
    zero.judgement.components[0].condition = f64::INFINITY;
    let found = report(&tally(&[zero]));
    assert_eq!(found.outputs[0].max_condition, 0.0);
}

/// An error beyond the largest number is counted as such and has no octave.
#[test]
fn errors_beyond_every_number_have_no_octave() {
    let mut far = ulps(0, &[2, 0]);
    far.judgement.components[0].ulps = f64::INFINITY;
    let mut none = ulps(1, &[2, 0]);
    none.judgement.components[0].ulps = f64::NAN;
    let tally = tally(&[far, none]);
    assert!(tally.outputs[0].octaves.iter().next().is_none());
    let x = &report(&tally).outputs[0];
    assert_eq!((x.ulps.beyond, x.ulps.count, x.values), (1, 0, 2));
    assert!(x.histogram.is_empty());
}

/// A refusal that is due passes and has no norm; what has no measured value has no share.
#[test]
fn only_measured_values_are_in_statistics() {
    let mut refused = ulps(0, &[0, 0]);
    refused.judgement.components.clear();
    refused.judgement.normwise = 0.0;
    let nan = judged(1, &[f64::NAN, off(1.0, 2)], None);
    let mut open = ulps(2, &[0, 9]);
    open.judgement.verdict = Verdict::Undecided;
    let mut failed = ulps(3, &[0, 0]);
    failed.judgement.verdict = Verdict::OracleError;
    every_way(&[refused, nan, open, failed, ulps(4, &[1, 0])], |found| {
        assert_eq!((found.cases, found.passed, found.failed()), (5, 2, 3));
        assert_eq!(
            (found.undecided, found.reference_failed, found.over),
            (1, 1, 0)
        );
        assert_eq!((found.kinds[Kind::Nan], found.kinds.total()), (1, 1));
        assert_eq!(found.normwise.unwrap().count, 1);
        assert!((found.max_of_budget - 0.25).abs() < 1e-9);
        assert_eq!(index(&found.worst), Some(4));
    });
}

/// A recorded failure is counted apart and is no failure; a pass is no recorded failure.
#[test]
fn recorded_cases_are_counted_apart() {
    let half = |n: u64| {
        let mut tally = empty(0);
        (0..n).for_each(|i| tally.add(&ulps(i, &[9, 0]), true));
        tally.add(&ulps(90, &[0, 0]), true);
        tally.add(&ulps(91, &[0, 7]), false);
        tally
    };
    let counts = |tally: &RegionTally| {
        let r = report(tally);
        let kept = tally.failures().len();
        (r.cases, r.passed, r.recorded, r.over, r.failed(), kept)
    };
    assert_eq!(counts(&half(3)), (5, 1, 3, 1, 1, 1));
    let mut sum = half(3);
    sum.merge(&half(2));
    assert_eq!(counts(&sum), (9, 2, 5, 2, 2, 2));
    // An excess is no example of a wrong kind.
    assert_eq!(half(3).wrong().count(), 0);
    // Of the largest share, recorded or not.
    assert!((report(&sum).max_of_budget - 2.25).abs() < 1e-9);
}

/// Cases that got no answer count, and do not pass.
#[test]
fn unanswered_cases_count() {
    let mut tally = tally(&[ulps(0, &[0, 0])]);
    tally.unanswered(3);
    tally.unanswered(4);
    let found = report(&tally);
    assert_eq!((found.cases, found.passed, found.failed()), (8, 1, 7));
    assert_eq!(found.kinds[Kind::Unanswered], 7);
}

/// Values belong to outputs in turn, row by row; where some are missing, by their names.
#[test]
fn values_belong_to_their_outputs() {
    let rows = ulps(0, &[1, 2, 0, 1, 3, 0]);
    let found = report(&tally(&[rows]));
    let of = |o: usize| {
        let o = &found.outputs[o];
        (o.values, o.ulps.count, o.ulps.max)
    };
    assert_eq!((of(0), of(1)), ((3, 3, 3.0), (3, 3, 2.0)));
    // Without the first value, and with one of an output that there is not.
    let mut missing = ulps(0, &[1, 2, 0, 3]);
    missing.judgement.components.remove(0);
    missing.judgement.components[1].output = "z";
    let found = report(&tally(&[missing]));
    assert_eq!(found.outputs[0].values, 0);
    assert_eq!(
        (found.outputs[1].values, found.outputs[1].ulps.max),
        (2, 3.0)
    );
}

/// The sample is that of the smallest hashes, in the order of cases, with the largest error of each
/// output.
#[test]
fn the_sample_is_that_of_the_smallest_hashes() {
    let at = |i: u64| {
        let mut report = match i {
            5 => judged(
                i,
                &[f64::NAN, off(1.0, 1), off(1.0, 2), f64::INFINITY],
                None,
            ),
            6 => judged(i, &[f64::NAN, 1.0, f64::NAN, off(1.0, 3)], None),
            _ => ulps(i, &[i % 4, 1, 2, 9 - i % 4]),
        };
        report.case.input = vec![1.0 + i as f64 / 64.0];
        report
    };
    let all: Vec<CaseReport> = (0..40).map(at).collect();
    let mut hashes: Vec<(u64, u64)> = (all.iter().zip(0..))
        .map(|(r, i)| (r.case.hash(), i))
        .collect();
    hashes.sort_unstable();
    for room in [0, 1, 7, 40, 50] {
        let mut expected: Vec<u64> = hashes.iter().take(room).map(|h| h.1).collect();
        expected.sort_unstable();
        let sampled = |part: &[CaseReport]| {
            let mut tally = empty(room);
            part.iter().for_each(|r| tally.add(r, false));
            tally
        };
        let (mut a, mut b) = (sampled(&all[..13]), sampled(&all[13..]));
        let (c, d) = (a.clone(), b.clone());
        a.merge(&d);
        b.merge(&c);
        for tally in [sampled(&all), a, b] {
            let points = tally.points();
            let found: Vec<u64> = (points.iter())
                .filter_map(|p| index(&Some(p.case.clone())))
                .collect();
            assert_eq!(found, expected);
            for p in &points {
                let i = index(&Some(p.case.clone())).unwrap();
                let bits = |x: &[f64]| x.iter().map(|x| x.to_bits()).collect::<Vec<u64>>();
                let (ulps, share) = match i {
                    5 => (vec![2.0, 1.0], f64::INFINITY),
                    6 => (vec![f64::NAN, 3.0], f64::INFINITY),
                    _ => {
                        let (x, y) = (2.max(i % 4) as f64, (9 - i % 4) as f64);
                        (vec![x, y], y / 4.0)
                    }
                };
                assert_eq!(bits(&p.ulps), bits(&ulps), "{i}");
                assert!(p.of_budget == share || (p.of_budget - share).abs() < 1e-9);
                let verdict = match i {
                    5 | 6 => Verdict::WrongKind,
                    _ => Verdict::Over,
                };
                assert_eq!(p.verdict, verdict);
            }
        }
    }
}

/// The first three examples of each wrong kind are kept, and the first failures for which there is room.
#[test]
fn first_failures_and_examples_are_kept() {
    let nan = |i| judged(i, &[f64::NAN, 1.0], None);
    let infinite = |i| judged(i, &[1.0, f64::INFINITY], None);
    let keep = Keep {
        failures: 6,
        ..Keep::WHOLE
    };
    let all: Vec<CaseReport> = [
        nan(9),
        nan(2),
        infinite(4),
        nan(7),
        nan(5),
        infinite(8),
        ulps(1, &[9, 0]),
        ulps(3, &[0, 9]),
    ]
    .to_vec();
    let sum = |a: &[CaseReport], b: &[CaseReport]| {
        let part = |part: &[CaseReport]| {
            let mut tally = RegionTally::new(&NAMES, &Settings::default(), keep);
            part.iter().for_each(|r| tally.add(r, false));
            tally
        };
        let mut sum = part(a);
        sum.merge(&part(b));
        sum
    };
    for cut in 0..=all.len() {
        let (a, b) = all.split_at(cut);
        for tally in [sum(a, b), sum(b, a)] {
            let places = |kept: &[Kept]| -> Vec<u64> {
                let cases = kept.iter().map(|k| Some(k.case().clone()));
                cases.filter_map(|c| index(&c)).collect()
            };
            assert_eq!(places(tally.failures()), [1, 2, 3, 4, 5, 7]);
            let wrong: Vec<_> = tally.wrong().map(|(k, kept)| (*k, places(kept))).collect();
            let expected = [
                ((Verdict::WrongKind, Some(Kind::Nan)), vec![2, 5, 7]),
                ((Verdict::WrongKind, Some(Kind::Infinity)), vec![4, 8]),
            ];
            assert_eq!(wrong, expected);
        }
    }
}

/// The ten cases with the largest shares, the largest first and of equal ones the first.
#[test]
fn the_ten_worst_are_kept() {
    let all: Vec<CaseReport> = (0..30).map(|i| ulps(i, &[i / 2, 0])).collect();
    let (a, b) = all.split_at(11);
    for (a, b) in [(a, b), (b, a)] {
        let mut sum = tally(a);
        sum.merge(&tally(b));
        let found: Vec<_> = (sum.worst().iter())
            .map(|(share, kept)| ((4.0 * share).round(), index(&Some(kept.case().clone()))))
            .collect();
        let expected = [(14.0, 28), (14.0, 29), (13.0, 26), (13.0, 27), (12.0, 24)];
        assert_eq!(found.len(), WORST);
        assert_eq!(found[..5], expected.map(|(share, i)| (share, Some(i))));
    }
}

/// Of the largest numbers one case is kept each, in one tally and in a sum.
#[test]
fn one_case_is_kept_of_the_largest() {
    let all = [ulps(0, &[1, 1]), ulps(1, &[1, 1]), ulps(2, &[1, 1])];
    let mut sum = empty(0);
    all.iter()
        .for_each(|r| sum.merge(&tally(std::slice::from_ref(r))));
    for t in [tally(&all), sum] {
        assert_eq!(t.share.room(), 1);
        for output in &t.outputs {
            assert_eq!(output.worst.room(), 1);
            assert!(
                output
                    .octaves
                    .iter()
                    .all(|(_, largest)| largest.room() == 1)
            );
        }
    }
}
