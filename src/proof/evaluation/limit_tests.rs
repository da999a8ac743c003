//! Evaluations at the ends of the range, beside zero, of one operation, and one after another.

use super::tests::{only, setting, ways, x_of};
use super::*;
use crate::bounds::rational;
use crate::grid::grain_of_point;
use crate::pinned::units;
use mechaudit_solvers::faddeeva::proof::Real;
use rug::Rational;

/// Checks that what a product by a power of two lost below the normal numbers is handed on with
/// what it lost.
#[test]
fn digits_below_the_normal_numbers_are_lost_twice() {
    let [p, lost] = only(|| {
        let x = Tracked::input(0, [1.0, 1.1].map(|x| x * 2f64.powi(-60)));
        let (p, lost) = x.two_prod(x_of(2f64.powi(-1000)));
        [p, lost].map(Tracked::result)
    });
    assert!(p.tiny == 1.0 && lost.tiny >= 1.0 && lost.exact.is_zero());
    // Their products do not share the error of a number that has all its digits.
    let [full, short] = only(|| {
        let x = Tracked::input(0, [1e-305, 1.1e-305]);
        let y = x * x_of(2f64.powi(-20));
        let c = Tracked::input(1, [1e200, 1.1e200]);
        [x * c, y * c].map(Tracked::result)
    });

    assert!(
        full.relative < 1.2e-16 && short.relative > 2e-13,
        "{full:?} {short:?}"
    );
}

/// Checks that underflow of both factors counts also where the numbers computed are zero.
#[test]
fn what_both_factors_lost_is_multiplied() {
    let small = Setting {
        sigma: Exact::within(Interval::new(1e-320, 1e-308)),
        ..setting(Rounding::default())
    };
    let square = evaluate(small, || {
        let lost = Tracked::input(0, [1e-160, 3e-160]) * Tracked::sigma();
        let large = lost / Tracked::input(1, [1e-320, 1e-310]);
        (large * large).result()
    });
    // A square of 1e-297, computed as zero.
    assert!(square.expect("no division by zero")[0].tiny > 1e27);
}

/// Nothing of an evaluation is left to the next one of the thread.
#[test]
fn evaluations_are_apart() {
    let constants = [Constant {
        stored: 0.75,
        exact: Interval::point(0.7),
        error: Interval::point(0.05),
    }];
    let with = Setting {
        constants: &constants,
        ..setting(Rounding::default())
    };
    let program = || x_of(1.0).like(0.75).result().error;
    assert!(evaluate(with, program).expect("a bound")[0] > 0.0);
    assert_eq!(ways(program), Ok(vec![0.0]));
    // A failure in the middle of the ways.
    let undecided = || Tracked::input(0, [1.0, 2.0]).below(x_of(1.5));
    let fails = ways(|| {
        let below = undecided();
        if !below {
            (x_of(1.0) / Tracked::input(1, [-1.0, 1.0])).result();
        }
        below
    });
    assert!(fails.is_err());
    assert_eq!(ways(undecided), Ok(vec![true, false]));
    // Products of what stands where the last evaluation had a multiple of another number.
    let y = only(|| {
        let x = Tracked::input(0, [1.0, 1.1]);
        x * x_of(4.0)
    });
    let found = only(|| {
        let x = Tracked::input(0, [1.0, 1.1]);
        let mut last = x;
        while last.0 < y.0 {
            last = Tracked::input(1, [1.5, 1.6]);
        }
        let c = Tracked::input(0, [3.0, 3.1]);
        [x * c, last * c][1].result()
    });
    assert!(
        found.exact.lo >= 4.49 && found.exact.hi <= 4.97,
        "{found:?}"
    );
}

/// Pairs of operations, in both kinds of numbers; d is not zero.
fn operate<R: Real>(kind: usize, [x, y, z]: [R; 3], d: R) -> [R; 2] {
    match kind {
        // The stored 0.1 stands for 1/10.
        7 => [x * x.like(0.1), x.like(-0.1).fma(y, z)],
        8 => [x / d, (x / d).fma(-d, x)],
        0 => x.two_sum(y).into(),
        1 => x.two_prod(y).into(),
        2 => x.fast_two_sum(y).into(),
        3 => [x.fma(y, z), x.magnitude()],
        4 => [x * x.like(2f64.powi(-30)), x.like(3.0) * y],
        5 => [x - y, -x],
        _ => [x * x, x.like(-4.0) * y],
    }
}

/// The same in exact arithmetic, where nothing is lost.
fn operate_exactly(kind: usize, [x, y, z]: [&Rational; 3], d: &Rational) -> [Rational; 2] {
    let of = |c: f64, x: &Rational| rational(c) * x;
    match kind {
        7 => [Rational::from(x / 10), z - Rational::from(y / 10)],
        8 => [Rational::from(x / d), Rational::new()],
        0 | 2 => [Rational::from(x + y), Rational::new()],
        1 => [Rational::from(x * y), Rational::new()],
        3 => [Rational::from(x * y) + z, x.clone().abs()],
        4 => [of(2f64.powi(-30), x), of(3.0, y)],
        5 => [Rational::from(x - y), of(-1.0, x)],
        _ => [Rational::from(x * x), of(-4.0, y)],
    }
}

/// A point of a box, most often an end.
fn point_of([lo, hi]: [f64; 2], t: f64) -> f64 {
    match t {
        t if t < 0.2 => lo,
        t if t < 0.4 => hi,
        _ => (lo + (hi - lo) * (t - 0.4) / 0.6).clamp(lo, hi),
    }
}

/// Random programs on numbers of every kind: of few and of many binades, on both sides of zero,
/// small, next to both ends of the range. At points of the box each number is within its bounds.
#[test]
fn random_programs_on_hostile_boxes_are_within_their_bounds() {
    let boxes = [
        [1.0, 1.001],
        [0.5, 1.0],
        [-1.0, 2.0],
        [0.0, 1.0],
        [-2.0, 0.0],
        [1e-320, 1e-310],
        [0.5e-300, 2e-300],
        [1e150, 1e152],
        [1.25, 1.25],
        [1e-160, 3e-160],
    ];
    let sigmas = [
        [1e-9, 1e-3],
        [0.0, 1e-3],
        [1e-300, 1e-290],
        [1e-320, 1e-308],
    ];
    let constants = [0.0, 1.0, 3.0, 0.1, -0.5, 1e-290, f64::MIN_POSITIVE, 5e-324];
    let tenth = [Constant {
        stored: 0.1,
        exact: Interval::new(0.1f64.next_down(), 0.1),
        error: Interval::new(5.55e-18, 5.552e-18),
    }];
    let mut unit = units(4);
    let mut pick = |n: usize| (unit() * n as f64) as usize;
    let mut compared = 0;
    for round in 0..2000 {
        let ends = [boxes[pick(10)], boxes[pick(10)], sigmas[pick(4)]];
        let stored = constants[pick(8)];
        let divides = ends[1][0] > 0.0;
        // Chains of operations: one operand in two is one of the last two numbers.
        let code: Vec<(usize, [usize; 3])> = (0..6)
            .map(|i| {
                let known = 4 + 2 * i;
                let of = [0, 1, 2].map(|_| match pick(2) {
                    0 => known - 1 - pick(2),
                    _ => pick(known),
                });
                (pick(if divides { 9 } else { 8 }), of)
            })
            .collect();
        let sigma = Exact::within(Interval::new(ends[2][0], ends[2][1]));
        let setting = Setting {
            sigma,
            constants: &tenth,
            ..setting(Rounding::default())
        };
        let bounds = evaluate(setting, || {
            let [x, y] = [0, 1].map(|i| Tracked::input(i, ends[i]));
            let mut all = vec![x, y, Tracked::sigma(), x_of(stored)];
            for (kind, of) in &code {
                all.extend(operate(*kind, of.map(|i| all[i]), y));
            }
            let floats = all
                .iter()
                .map(|x| here(|e| (e.range(*x), e.pass.grain[x.place()])));
            let floats: Vec<_> = floats.collect();
            all.into_iter()
                .map(Tracked::result)
                .zip(floats)
                .collect::<Vec<_>>()
        });
        let Ok(mut bounds) = bounds else {
            continue;
        };
        let bounds = bounds.remove(0);
        for _ in 0..12 {
            let [x, y, s] = ends.map(|e| point_of(e, pick(1 << 20) as f64 / (1 << 20) as f64));
            let mut computed = vec![x, y, s, stored];
            let mut exact: Vec<Rational> = computed.iter().map(|x| rational(*x)).collect();
            for (kind, of) in &code {
                let next = operate(*kind, of.map(|i| computed[i]), y);
                computed.extend(next);
                exact.extend(operate_exactly(*kind, of.map(|i| &exact[i]), &exact[1]));
            }
            for ((c, v), (bound, (range, grain))) in computed.iter().zip(&exact).zip(&bounds) {
                let note = || {
                    format!(
                        "{round} {ends:?} {stored:e} {code:?} at {x:e} {y:e} {s:e}: {c:e} {bound:?}"
                    )
                };
                let one = if bound.small {
                    rational(s)
                } else {
                    Rational::from(1)
                };
                if bound.tiny.is_infinite() {
                    continue;
                }
                assert!(c.is_finite(), "{}", note());
                let tiny = rational(bound.tiny) >> 1075;
                let off = (rational(*c) - v).abs();
                compared += 1;
                assert!(range.lo <= *c && *c <= range.hi, "{range:?} {}", note());
                assert!(
                    *c == 0.0 || grain_of_point(*c) >= *grain,
                    "{grain} {}",
                    note()
                );
                if bound.error.is_finite() {
                    let most = rational(bound.error) * &one + &tiny;
                    assert!(off <= most, "{:e} {}", off.to_f64(), note());
                }
                if bound.relative.is_finite() {
                    let most = rational(bound.relative) * v.clone().abs() + tiny;
                    assert!(off <= most, "a part: {:e} {}", off.to_f64(), note());
                }
                let holds = |lo: f64, hi: f64| {
                    (!lo.is_finite() || rational(lo) * &one <= *v)
                        && (!hi.is_finite() || *v <= rational(hi) * &one)
                };
                assert!(
                    holds(bound.exact.lo, bound.exact.hi),
                    "{:e} {}",
                    v.to_f64(),
                    note()
                );
            }
        }
    }
    assert!(compared > 150_000, "{compared}");
}
