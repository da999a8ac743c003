//! The bounds against certified values at points, and with planted faults.

use super::*;
use crate::real::tables::{MOST, errors, exponential_coefficients, near_error};
use crate::real::{Inner, choice};
use crate::truncation::{ErfcRow, exponential_error};
use mechaudit_reference::faddeeva as certified;
use mechaudit_reference::faddeeva::Scaled;
use mechaudit_solvers::faddeeva::proof::real_line::{self as code, OfRows};
use mechaudit_solvers::faddeeva::{dawson_real, erf_real, erfc_real, erfcx_real};
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rug::{Float, Rational};

fn solvers(function: Function) -> Code {
    Code::of_the_solver(function).expect("decided")
}

fn proved(code: &Code, function: Function) -> Certificate {
    real_line(code, function, function.ulps(), &Watch::default()).expect("not stopped")
}

fn computed(function: Function, x: f64) -> f64 {
    match function {
        Function::Erf => erf_real(x),
        Function::Erfc => erfc_real(x),
        Function::Erfcx => erfcx_real(x),
        Function::Dawson => dawson_real(x),
    }
}

/// The error at a point in units in the last place of the value; infinity where the value is above
/// the range counts as none.
fn error(function: Function, x: f64) -> f64 {
    let exact = match function {
        Function::Erf => certified::erf_scaled,
        Function::Erfc => certified::erfc_scaled,
        Function::Erfcx => certified::erfcx_scaled,
        Function::Dawson => certified::dawson_scaled,
    };
    let x_exact = Rational::from_f64(x).expect("finite");
    let [value, _]: [Scaled; 2] = exact(&x_exact, &Rational::new(), 120).expect("decided");
    let value = value.to_ball().mid().clone();
    let got = computed(function, x);
    if !got.is_finite() {
        // e^{x²} > 2¹⁰²⁴ from x² = 710 on.
        return match got > 0.0 && (value > f64::MAX || x * x > 710.0) {
            true => 0.0,
            false => f64::INFINITY,
        };
    }
    let e = value.get_exp().unwrap_or(-2000).max(-1021) - 53;
    ((Float::with_val(200, got) - &value) >> e).abs().to_f64()
}

fn worst(code: &Code, function: Function, at: &Interval) -> f64 {
    let formula = (code.choice)(function, at.negative, at.ends[0]);
    bound(&code.tables, function, formula, at, code.rounding).map_or(f64::INFINITY, |b| b.1)
}

#[test]
fn every_number_is_covered_and_points_are_within_their_bounds() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    for function in Function::ALL {
        let found = proved(&solvers(function), function);
        assert!(
            found.open.is_empty(),
            "{function:?} {:?}",
            found.open.first()
        );
        let all = || found.leaves.iter().map(|l| l.at);
        assert_eq!(hole(function, all()), None);
        for missing in [0, 1, found.leaves.len() / 2, found.leaves.len() - 1] {
            let some = all().enumerate().filter(|(i, _)| *i != missing);
            let x = hole(function, some.map(|(_, at)| at)).expect("a hole");
            let at = found.leaves[missing].at;
            assert!(at.ends.contains(&x.abs()), "{function:?} {x} {at:?}");
        }
        let mut most = 0.0f64;
        for leaf in found.leaves.iter().step_by(5) {
            assert!(leaf.ulps <= function.ulps(), "{function:?} {leaf:?}");
            let [p, q] = leaf.at.ends.map(f64::to_bits);
            for k in 0..3 {
                let x = match k {
                    0 => leaf.at.ends[0],
                    _ => f64::from_bits(p + random.next_u64() % (q - p + 1)),
                };
                let off = error(function, if leaf.at.negative { -x } else { x });
                assert!(off <= leaf.ulps, "{function:?} {x:e} {off} {leaf:?}");
                most = most.max(off);
            }
        }
        // Not idle bounds either.
        assert!(most > 0.49, "{function:?} {most}");
    }
}

/// Where values, or what is added to them, are subnormal.
#[test]
fn points_beside_underflow_are_within_their_bounds() {
    let mut random = ChaCha8Rng::seed_from_u64(10);
    for (function, from, to) in [
        (Function::Erf, 0.0, 1e-300),
        (Function::Erf, 4e-308, 2e-307),
        (Function::Dawson, 0.0, 1e-300),
        (Function::Erfc, 26.5, 27.3),
        (Function::Erfcx, 1e307, f64::MAX),
        (Function::Dawson, 1e307, f64::MAX),
    ] {
        let (p, q) = (f64::to_bits(from), f64::to_bits(to));
        for _ in 0..2000 {
            let x = f64::from_bits(p + random.next_u64() % (q - p));
            let off = error(function, x);
            assert!(off <= function.ulps(), "{function:?} {x:e} {off}");
        }
    }
}

#[test]
fn infinity_begins_where_the_value_is_above_the_range() {
    let last = 26.628_735_713_751_49;
    assert!(computed(Function::Erfcx, -last).is_finite());
    assert_eq!(
        computed(Function::Erfcx, -f64::next_up(last)),
        f64::INFINITY
    );
    assert!(error(Function::Erfcx, -last) < 1.0);
    assert_eq!(error(Function::Erfcx, -f64::next_up(last)), 0.0);
}

/// An interval of each formula of Taylor series, far from a centre, and last one of an exponential.
const NEAR: [(Function, Interval); 6] = [
    (Function::Erf, at(false, 0.345, 0.346)),
    (Function::Erfc, at(false, 2.027, 2.0271)),
    (Function::Erfc, at(true, 0.5268, 0.5269)),
    (Function::Erfcx, at(true, 0.5345, 0.5346)),
    (Function::Dawson, at(false, 0.845, 0.846)),
    (Function::Erfc, at(false, 9.03, 9.031)),
];

const fn at(negative: bool, lo: f64, hi: f64) -> Interval {
    Interval {
        negative,
        ends: [lo, hi],
    }
}

/// The code with every row changed.
fn with_rows(function: Function, change: impl Fn(&mut [f64])) -> Code {
    let mut code = solvers(function);
    for (centre, (row, found)) in &mut code.tables.rows {
        change(row);
        let of = match function {
            Function::Dawson => OfRows::Dawson,
            _ => OfRows::Erf,
        };
        *found = errors(of, row, f64::from_bits(*centre)).expect("decided");
    }
    for found in code.tables.complement.values_mut() {
        change(&mut found.row);
        *found = ErfcRow::new(found.scaled, found.row, found.centre).expect("decided");
    }
    code
}

fn off_by_eight(x: f64) -> f64 {
    f64::from_bits(x.to_bits() + 8)
}

#[test]
fn a_coefficient_off_by_eight_units_shows() {
    for &(function, at) in &NEAR[..5] {
        let sound = worst(&solvers(function), function, &at);
        let faulty = with_rows(function, |row| row[0] = off_by_eight(row[0]));
        assert!(sound <= 0.875, "{function:?} {sound}");
        assert_eq!(worst(&faulty, function, &at), f64::INFINITY, "{function:?}");
        // Where one unit of it is a sixteenth of one of the value.
        let faulty = with_rows(function, |row| row[2] += row[2] * 2f64.powi(-47));
        let at = match function {
            Function::Dawson => Interval {
                ends: [3.03, 3.031],
                ..at
            },
            _ => Interval {
                ends: [at.ends[0] + 0.1, at.ends[0] + 0.101],
                ..at
            },
        };
        let sound = worst(&solvers(function), function, &at);
        let faulty = worst(&faulty, function, &at);
        assert!(faulty > sound + 0.01, "{function:?} {sound} {faulty}");
    }
}

#[test]
fn a_dropped_term_shows() {
    for &(function, at) in &NEAR[..5] {
        // The slope, where a row has no more than that.
        let faulty = with_rows(function, |row| row[if row.len() > 8 { 8 } else { 2 }] = 0.0);
        let (sound, faulty) = (
            worst(&solvers(function), function, &at),
            worst(&faulty, function, &at),
        );
        assert!(faulty > sound + 0.01, "{function:?} {sound} {faulty}");
    }
    // Of the Maclaurin series, and of the exponential.
    let (c, low) = code::odd_series();
    let sound = near_error((c, low));
    let mut off = c.to_vec();
    off[2] = off_by_eight(off[2]);
    assert!(near_error((&c[..c.len() - 6], low)) > 3.0 * sound);
    assert!(near_error((&off, low)) > 3.0 * sound);
    assert!(near_error((c, 0.0)) > 2.0 * sound);
    let (c, ln_2) = exponential_coefficients();
    let sound = exponential_error(&c, ln_2, MOST);
    for faulty in [
        exponential_error(&c[..11], ln_2, MOST),
        exponential_error(&c, [ln_2[0], 0.0], MOST),
    ] {
        assert!(faulty > 5.0 * sound);
        let mut code = solvers(Function::Erfc);
        code.tables.exponential = faulty;
        let (function, at) = NEAR[5];
        assert!(worst(&code, function, &at) > worst(&solvers(function), function, &at) + 0.1);
    }
}

/// A constant in the row about zero has no part that falls with x: beside zero it is a part of erf
/// that counts.
#[test]
fn a_value_of_erf_at_zero_shows() {
    let at = at(false, 1e-10, 2e-10);
    let sound = solvers(Function::Erf);
    assert!(worst(&sound, Function::Erf, &at) < 0.6);
    let faulty = with_rows(Function::Erf, |row| row[1] += 1e-26);
    assert_eq!(worst(&faulty, Function::Erf, &at), f64::INFINITY);
}

#[test]
fn a_moved_limit_shows() {
    fn moved(function: Function, negative: bool, x: f64) -> Formula {
        match choice(function, negative, x) {
            Formula::Near if x > 0.4 => choice(function, negative, 0.5),
            Formula::Value(_) if function == Function::Erf && x > 5.5 => Formula::Constant,
            Formula::Value(_) if negative && x > 5.0 => Formula::Exponential,
            Formula::Value(_) if (7.0..9.0).contains(&x) => {
                Formula::Value(Inner::Series { terms: 14 })
            }
            formula => formula,
        }
    }
    // Just beyond where each limit was.
    for (function, at) in [
        (Function::Dawson, at(false, 0.41, 0.42)),
        (Function::Erf, at(false, 5.6, 5.61)),
        (Function::Erfcx, at(false, 7.001, 7.002)),
        (Function::Dawson, at(false, 7.01, 7.02)),
        (Function::Erfcx, at(true, 5.079, 5.08)),
    ] {
        let sound = solvers(function);
        let faulty = Code {
            choice: moved,
            ..sound.clone()
        };
        let [sound, faulty] = [sound, faulty].map(|code| worst(&code, function, &at));
        assert!(
            faulty > sound + 0.02,
            "{function:?} {at:?} {sound} {faulty}"
        );
    }
}

#[test]
fn products_rounded_before_the_sum_show() {
    for (function, at) in NEAR {
        let mut code = solvers(function);
        let sound = worst(&code, function, &at);
        code.rounding.fma_rounds_twice = true;
        let faulty = worst(&code, function, &at);
        assert!(faulty > sound + 0.001, "{function:?} {sound} {faulty}");
    }
}

#[test]
fn one_operation_that_truncates_shows() {
    for (function, at) in NEAR {
        let mut code = solvers(function);
        let sound = worst(&code, function, &at);
        let mut with = |k| {
            code.rounding.truncates = Some(k);
            worst(&code, function, &at)
        };
        assert!(with(Rounding::LAST) >= sound + 0.5);
        let most = (1..200).map(with).fold(0.0, f64::max);
        assert!(most > sound + 2e-6, "{function:?} {sound} {most}");
    }
}

/// The proof of an interval that was halved `depth` times beside an earlier one.
fn refined(
    (function, formula, target): (Function, Formula, f64),
    (at, depth): (Interval, u32),
    mut found: Certificate,
) -> Certificate {
    let code = solvers(function);
    let refined = Refined {
        code: &code,
        function,
        target,
        formula,
    };
    let step = |at: &Interval, depth, parts| refined.step(at, depth, parts);
    let ended = found.refine(at, depth, &Watch::default(), &step);
    ended.expect("not stopped");
    found
}

/// The target is reached by halving; what is not reached comes out with its bound, what has none is
/// open.
#[test]
fn intervals_are_halved_until_the_bound_is_good() {
    let of = |formula, target, at, depth| {
        refined(
            (Function::Erf, formula, target),
            (at, depth),
            Certificate::default(),
        )
    };
    let row = choice(Function::Erf, false, 1.0);
    let covers = |leaves: &[Leaf], whole: Interval| {
        let mut next = whole.ends[0].to_bits();
        for leaf in leaves {
            assert_eq!(leaf.at.ends[0].to_bits(), next);
            next = leaf.at.ends[1].to_bits() + 1;
        }
        assert_eq!(next, whole.ends[1].to_bits() + 1);
    };
    let whole = at(false, 1.0, 1.03);
    let found = of(row, 0.875, whole, 0);
    assert!(found.open.is_empty() && found.leaves.iter().all(|l| l.ulps <= 0.875));
    covers(&found.leaves, whole);
    // A target below any bound ends at its depth.
    let narrow = at(false, 1.0, 1.0f64.next_up());
    let found = of(row, 0.1, narrow, 0);
    assert!(found.leaves.len() == 2 && found.leaves.iter().all(|l| l.ulps > 0.1));
    covers(&found.leaves, narrow);
    for (depth, leaves) in [(DEPTH - 1, 2), (DEPTH, 1)] {
        let found = of(row, 0.1, at(false, 1.0, 1.0 + 1e-10), depth);
        assert_eq!(found.leaves.len(), leaves);
    }
    // A formula that serves nowhere there leaves every number open.
    let eight = at(false, 1.0, f64::from_bits(1f64.to_bits() + 7));
    let found = of(Formula::Far, 0.875, eight, 0);
    assert!(found.leaves.is_empty() && found.open.len() == 8);
    let watch = Watch::default();
    watch.stop.store(true, std::sync::atomic::Ordering::Relaxed);
    assert!(real_line(&solvers(Function::Erf), Function::Erf, 0.875, &watch).is_none());
}

/// Intervals to begin with: all numbers, one formula each.
#[test]
fn the_first_intervals_have_one_formula_each() {
    for function in Function::ALL {
        let code = solvers(function);
        let all = roots(&code, function);
        assert_eq!(hole(function, all.iter().map(|(at, _)| *at)), None);
        let numbers = |at: &Interval| u128::from(at.ends[1].to_bits() - at.ends[0].to_bits()) + 1;
        let sum: u128 = all.iter().map(|(at, _)| numbers(at)).sum();
        let finite = u128::from(f64::MAX.to_bits()) + 1;
        assert_eq!(sum, finite * function.signs().len() as u128);
        for (at, formula) in &all {
            for x in at.ends {
                assert_eq!((code.choice)(function, at.negative, x), *formula);
            }
            let binades = (at.ends[1].to_bits() >> 52) - (at.ends[0].to_bits() >> 52);
            assert!(at.ends[1] < SMALL || binades < 8, "{at:?}");
        }
    }
    // One that is missing is found on its side.
    for negative in [false, true] {
        let some = [
            at(false, 0.0, f64::MAX),
            at(true, 0.0, 1.0),
            at(true, 3.0, f64::MAX),
        ];
        let some = some.map(|at| Interval {
            negative: at.negative == negative,
            ..at
        });
        let x = hole(Function::Erfc, some).expect("a hole");
        // All numbers of the other sign are there.
        assert_eq!(x, if negative { -1.0 } else { 1.0 } * 1f64.next_up());
    }
    assert_eq!(
        hole(Function::Erf, [at(false, 0.0, f64::MAX.next_down())]),
        Some(f64::MAX)
    );
    assert_eq!(hole(Function::Erf, []), Some(0.0));
    assert_eq!(
        hole(Function::Erf, [at(false, f64::from_bits(1), f64::MAX)]),
        Some(0.0)
    );
    assert_eq!(at(true, 1.0, 2.0).signed(), [-2.0, -1.0]);
    assert!(at(true, 1.0, 1.0).is_point() && !at(true, 1.0, 2.0).is_point());
}

/// The worst of each formula, each sign by itself, in the order of x.
#[test]
fn a_summary_has_the_worst_of_each_formula() {
    let leaf = |negative, lo, hi, formula, ulps| Leaf {
        at: at(negative, lo, hi),
        formula,
        ulps,
    };
    let row = Formula::Difference(Inner::Row { centre: 1.0 });
    let found = Certificate {
        leaves: vec![
            leaf(false, 1.0, 2.0, row, 0.6),
            leaf(false, 3.0, 4.0, row, 0.7),
            leaf(false, 2.0, 3.0, row, 0.65),
            leaf(false, 0.0, 1.0, Formula::Near, 0.9),
            leaf(true, 0.0, 1.0, Formula::Near, 0.8),
        ],
        open: Vec::new(),
    };
    let summary = found.summary(Function::Erfc).expect("intervals");
    assert_eq!(
        (summary.ulps, summary.at, summary.intervals),
        (0.9, at(false, 0.0, 1.0), 5)
    );
    let all: Vec<_> = summary
        .formulas
        .iter()
        .map(|f| (f.ends, f.intervals, f.ulps, f.at))
        .collect();
    assert_eq!(
        all,
        [
            ([-1.0, 0.0], 1, 0.8, at(true, 0.0, 1.0)),
            ([0.0, 1.0], 1, 0.9, at(false, 0.0, 1.0)),
            ([1.0, 4.0], 3, 0.7, at(false, 3.0, 4.0)),
        ]
    );
    assert!(Certificate::default().summary(Function::Erf).is_none());
}

/// One interval has a limited number of leaves, open ones included.
#[test]
fn leaves_are_limited_in_number() {
    let ends = [1.0, f64::from_bits(1f64.to_bits() + 40)];
    let at = Interval {
        negative: false,
        ends,
    };
    let formula = choice(Function::Erf, false, 1.0);
    let after = |leaves: usize, open: usize| {
        let (ulps, why) = (0.5, "planted");
        let before = Certificate {
            leaves: vec![Leaf { at, formula, ulps }; leaves],
            open: vec![Open { at, why }; open],
        };
        let found = refined((Function::Erf, formula, 0.0), (at, 0), before);
        (found.leaves.len() - leaves, found.open.len() - open)
    };
    assert_eq!(after(0, 0), (41, 0));
    for (leaves, open) in [(MANY, 0), (MANY - 1, 1), (0, MANY)] {
        assert!(after(leaves, open).0 < 10);
    }
}
