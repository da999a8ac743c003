use super::*;
use crate::bounds::rational;
use crate::pinned::units;
use crate::tracked::Result as Tracks;
use mechaudit_solvers::faddeeva::proof::Real;
use rand::rngs::ChaCha8Rng;
use rand::{Rng, SeedableRng};
use rug::Rational;

pub(super) fn setting(rounding: Rounding) -> Setting<'static> {
    Setting {
        sigma: Exact::ZERO,
        constants: &[],
        rounding,
    }
}

pub(super) fn ways<T>(f: impl FnMut() -> T) -> std::result::Result<Vec<T>, &'static str> {
    evaluate(setting(Rounding::default()), f)
}

/// The only way.
pub(super) fn only<T>(f: impl FnMut() -> T) -> T {
    let mut all = ways(f).expect("a bound");
    assert_eq!(all.len(), 1);
    all.remove(0)
}

/// Describes what is due in exact arithmetic, of the same two inputs.
type Due = fn(&Rational, &Rational) -> Rational;
type Program<R> = fn(R, R) -> R;

/// Programs of one to three roundings, in both kinds of numbers, with what is due.
fn programs() -> Vec<(Program<Tracked>, Program<f64>, Due)> {
    macro_rules! program {
        (|$x:ident, $y:ident| $f:expr, $due:expr) => {{
            fn run<R: Real>($x: R, $y: R) -> R {
                $f
            }
            (
                run::<Tracked> as Program<Tracked>,
                run::<f64> as Program<f64>,
                $due as Due,
            )
        }};
    }
    vec![
        program!(|x, y| x + y, |x, y| Rational::from(x + y)),
        program!(|x, y| x - y, |x, y| Rational::from(x - y)),
        program!(|x, y| x * y, |x, y| Rational::from(x * y)),
        program!(|x, y| x / y, |x, y| Rational::from(x / y)),
        program!(|x, y| x.fma(y, y), |x, y| Rational::from(x * y) + y),
        program!(|x, y| x * x + y, |x, y| Rational::from(x * x) + y),
        program!(|x, y| (x + y) * (x - y), |x, y| Rational::from(x + y)
            * Rational::from(x - y)),
        program!(|x, y| (x * y) / (x + y), |x, y| Rational::from(x * y)
            / Rational::from(x + y)),
        program!(
            |x, y| (x * x.like(0.5)).fma(y, x * y),
            |x, y| Rational::from(x * y) * Rational::from((3, 2))
        ),
        program!(
            |x, y| (x * x.like(3.0)) - (y * x.like(-0.25)),
            |x, y| Rational::from(3 * x) + Rational::from(y / 4)
        ),
        program!(
            |x, y| (x * y).magnitude() + (-y).magnitude(),
            |x, y| Rational::from(x * y) + y
        ),
        program!(|x, y| x.two_sum(y).1 + x.two_prod(y).0, |x, y| {
            Rational::from(x * y)
        }),
        program!(|x, y| x.two_sum(y).0 * x.two_sum(y).0, |x, y| {
            Rational::from(x + y).square()
        }),
    ]
}

/// At points of a box each number is within the error of its exact value, and the exact value in
/// its enclosure; the errors come close to their bounds.
#[test]
fn programs_at_points_are_within_their_errors() {
    let mut unit = units(1);
    for (i, (tracked, computed, due)) in programs().into_iter().enumerate() {
        let mut closest = 0.0f64;
        for _ in 0..12 {
            let (x0, y0) = (0.5 + 3.0 * unit(), 0.5 + 3.0 * unit());
            let [a, b] = [[x0, x0 + 1e-3 * unit()], [y0, y0 + 1e-3 * unit()]];
            let found: Tracks =
                only(|| tracked(Tracked::input(0, a), Tracked::input(1, b)).result());
            let mut most = 0.0f64;
            for _ in 0..120 {
                let at = |[lo, hi]: [f64; 2], t: f64| (lo + (hi - lo) * t).clamp(lo, hi);
                let (x, y) = (at(a, unit()), at(b, unit()));
                let exact = due(&rational(x), &rational(y));
                let off = (rational(computed(x, y)) - &exact).abs().to_f64();
                let main = found.exact;
                // The exact value of a sum's lower part is zero.
                assert!(off <= found.error, "{i} {x} {y} {off:e} {found:?}");
                assert!(
                    rational(main.lo) <= exact && exact <= rational(main.hi),
                    "{i}"
                );
                let part = found.relative * exact.abs().to_f64();
                assert!(off <= part * (1.0 + 1e-9), "{i} {x} {y} {off:e} {part:e}");
                most = most.max(off / found.error);
            }
            closest = closest.max(most);
        }
        assert!(closest > 0.45, "{i} {closest}");
    }
}

/// Beside a small factor down to zero: in units of it, and what underflows.
#[test]
fn programs_beside_a_small_factor() {
    let mut unit = units(2);
    for (i, (tracked, computed, due)) in programs().into_iter().enumerate() {
        // Those with a sum of both or a quotient by the other one.
        if ![2, 3, 4, 8].contains(&i) {
            continue;
        }
        for sigma in [
            [0.0, 1e-3],
            [1e-320, 1e-300],
            [0.5, 0.50001],
            [1e-308, 1e-307],
        ] {
            let y = [1.75, 1.75 + 1e-3];
            let setting = Setting {
                sigma: Exact::coordinate(Interval::new(sigma[0], sigma[1]), 0),
                ..setting(Rounding::default())
            };
            let program = || {
                let t = tracked(Tracked::sigma(), Tracked::input(1, y));
                t.result()
            };
            let found = evaluate(setting, program).expect("a bound").remove(0);
            assert!(found.small || i == 4);
            for k in 0..200 {
                let t = if k == 0 { 0.0 } else { unit() };
                let s = match sigma[1] < 1e-290 {
                    true => {
                        let [p, q] = sigma.map(f64::to_bits);
                        f64::from_bits(p + ((q - p) as f64 * t) as u64)
                    }
                    false => sigma[0] + (sigma[1] - sigma[0]) * t,
                };
                let b = (y[0] + 1e-3 * unit()).min(y[1]);
                let exact = due(&rational(s), &rational(b));
                let off = (rational(computed(s, b)) - &exact).abs();
                let by = if found.small {
                    rational(s)
                } else {
                    Rational::from(1)
                };
                let tiny = rational(found.tiny) * rational(f64::from_bits(1)) / 2;
                assert!(
                    off <= rational(found.error) * by + tiny,
                    "{i} {s:e} {b} {found:?}"
                );
            }
        }
    }
}

/// Multiplied by a power of two nothing is rounded unless it is subnormal; of x and 2ᵏx the
/// products have one error.
#[test]
fn powers_of_two_are_exact() {
    let half = only(|| {
        let x = Tracked::input(0, [1.0, 1.001]);
        let y = x * x;
        let (p, q) = (y * x.like(0.5), x.like(-4.0) * y);
        [y, p, q].map(Tracked::result)
    });
    let parts = [half[1].error / 0.5, half[2].error / 4.0].map(|e| e / half[0].error - 1.0);
    assert!(parts.iter().all(|p| (0.0..1e-15).contains(p)), "{parts:?}");
    assert!(half[2].exact.hi <= -3.99 && half[2].exact.lo >= -4.01);
    let difference = only(|| {
        let (x, y) = (
            Tracked::input(0, [1.0, 1.001]),
            Tracked::input(1, [1.3, 1.301]),
        );
        let doubled = x * x.like(2.0);
        let (p, q) = (x * y, doubled * y);
        let (r, s) = (x.two_prod(y), (y.like(0.25) * y).two_prod(doubled));
        let lost = r.1 * x.like(0.5);
        [q - (p + p), (p * x.like(0.5)) - s.0, lost - s.1].map(Tracked::result)
    });
    for d in difference {
        assert!(d.error < 1e-30, "{d:?}");
    }
    // Below the normal numbers half the smallest number is lost, and the digits are not there any
    // more.
    let below = only(|| {
        let x = Tracked::input(0, [1.0, 1.001]);
        let y = x * x.like(2f64.powi(-600));
        let z = y * x.like(2f64.powi(-450));
        [y, z].map(Tracked::result)
    });
    assert!(below[0].tiny == 0.0 && below[0].error == 0.0);
    assert!(
        below[1].tiny == 1.0 && below[1].error == 0.0,
        "{:?}",
        below[1]
    );
}

pub(super) fn x_of(x: f64) -> Tracked {
    Tracked::entry(x)
}

/// Sums and products of constants that are `f64`s are these; others are rounded.
#[test]
fn constants_are_computed_where_that_is_exact() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut exact = [0; 4];
    for _ in 0..3000 {
        let mut short = || {
            let bits = random.next_u64();
            let k = (bits % 40) as i32;
            (bits >> (20 + k)) as f64
                * 2f64.powi((bits >> 6 & 63) as i32 - 50)
                * if bits & 1 << 19 == 0 { 1.0 } else { -1.0 }
        };
        let (a, b) = (short(), short());
        let is: [bool; 2] = [
            rational(a + b) == rational(a) + rational(b),
            rational(a * b) == rational(a) * rational(b),
        ];
        assert_eq!([exact_sum(a, b), exact_product(a, b)], is, "{a} {b}");
        for (i, is) in is.into_iter().enumerate() {
            exact[2 * i + usize::from(is)] += 1;
        }
        let [sum, product] = only(|| {
            let (x, y) = (x_of(a), x_of(b));
            [x + y, x * y].map(|t| (t.result().error + t.result().tiny, t.constant()))
        });
        for (found, is, value) in [(sum, is[0], a + b), (product, is[1], a * b)] {
            match is {
                true => assert_eq!(found, (0.0, Some(value)), "{a} {b}"),
                false => assert!(found.0 > 0.0, "{a} {b}"),
            }
        }
    }
    assert!(exact.into_iter().all(|n| n > 100), "{exact:?}");
    // Beyond the range, and below it where the product of the errors is lost.
    assert!(!exact_sum(f64::MAX, f64::MAX) && !exact_product(1e300, 1e300));
    assert!(!exact_product(2f64.powi(-1000), 3.0 * 2f64.powi(-30)));
    assert!(exact_product(0.0, 3.0) && exact_product(3.0, 0.0) && !exact_product(1e-200, 1e-200));
    assert!(is_power_of_two(0.5) && is_power_of_two(-4.0));
    assert!(
        ![0.0, 3.0, f64::from_bits(1), f64::INFINITY]
            .into_iter()
            .any(is_power_of_two)
    );
}

/// An integer next to a number is each that one of the box, with its error, may be rounded to.
#[test]
fn every_integer_that_may_come_is_taken() {
    let integers = |lo: f64, hi: f64| {
        ways(|| {
            let x = Tracked::input(0, [lo, hi]);
            let n = x.fma(x_of(1.0), x_of(ROUND));
            n.constant().expect("a number") - ROUND
        })
    };
    assert_eq!(integers(2.6, 3.4), Ok(vec![3.0]));
    assert_eq!(integers(2.4, 3.4), Ok(vec![2.0, 3.0]));
    assert_eq!(integers(-1.6, 1.6), Ok(vec![-2.0, -1.0, 0.0, 1.0, 2.0]));
    assert_eq!(integers(2.5, 2.5), Ok(vec![2.0, 3.0]));
    assert_eq!(integers(0.4, 4095.4).map(|all| all.len()), Ok(4096));
    assert!(integers(0.4, 4096.4).is_err());
    assert!(integers(1e9, 1e9).is_err());
    assert_eq!(integers(9e8, 9e8), Ok(vec![9e8]));
}

/// A comparison that is not the same all over the box is taken both ways.
#[test]
fn undecided_comparisons_are_taken_both_ways() {
    let below = |a: [f64; 2], b: [f64; 2]| {
        let mut all = ways(|| Tracked::input(0, a).below(Tracked::input(1, b))).expect("ways");
        all.sort_unstable();
        all
    };
    assert_eq!(below([1.0, 2.0], [2.5, 3.0]), [true]);
    assert_eq!(below([2.5, 3.0], [1.0, 2.0]), [false]);
    // Equal is not below.
    assert_eq!(below([2.0, 3.0], [1.0, 2.0]), [false]);
    assert_eq!(below([2.0, 2.0], [2.0, 2.0]), [false]);
    assert_eq!(below([1.0, 2.0], [2.0, 3.0]), [false, true]);
    assert_eq!(below([1.0, 3.0], [2.0, 2.5]), [false, true]);
    // Each of several decisions, by itself.
    let all = ways(|| {
        let (x, y) = (Tracked::input(0, [1.0, 3.0]), Tracked::input(1, [1.0, 3.0]));
        let two = x_of(2.0);
        [x.below(two), y.below(two), two.below(x_of(1.0))]
    });
    let due = [
        [true, true, false],
        [true, false, false],
        [false, true, false],
        [false, false, false],
    ];
    assert_eq!(all.expect("ways"), due);
    let many = ways(|| {
        for _ in 0..13 {
            let x = Tracked::input(0, [1.0, 3.0]);
            let _ = x.below(x_of(2.0));
        }
    });
    assert!(many.is_err());
}

#[test]
fn what_is_open_has_no_bound() {
    let x = || Tracked::input(0, [-1.0, 1.0]);
    assert!(ways(|| x_of(1.0) / x()).is_err());
    assert!(ways(|| x().power_of_two()).is_err());
    assert!(ways(|| x().is_odd()).is_err());
    assert!(ways(|| x().flip(x_of(1.0))).is_err());
    assert!(ways(|| x_of(ROUND + 1000.0).power_of_two()).is_err());
    // A failure on one way does not stay with the next evaluation.
    assert!(ways(|| x_of(1.0) / x_of(3.0)).is_ok());
}

/// Functions of integers, and of signs.
#[test]
fn integers_and_signs() {
    for k in [-999, -3, -2, -1, 0, 1, 2, 3, 5, 999] {
        let n = ROUND + f64::from(k);
        let (power, odd, flipped) = only(|| {
            let n = x_of(n);
            (
                n.power_of_two().constant(),
                n.is_odd(),
                n.flip(x_of(1.5)).constant(),
            )
        });
        assert_eq!(power, Some(n.power_of_two()));
        assert_eq!((odd, flipped), (n.is_odd(), Some(n.flip(1.5))), "{k}");
    }
    let of = |lo: f64, hi: f64, f: fn(Tracked) -> Tracked| {
        let mut all = ways(|| f(Tracked::input(0, [lo, hi])).result().exact).expect("a bound");
        all.sort_by(|a, b| a.lo.total_cmp(&b.lo));
        all
    };
    let to = Interval::new;
    assert_eq!(of(-3.0, -2.0, Real::magnitude), [to(2.0, 3.0)]);
    assert_eq!(of(2.0, 3.0, Real::magnitude), [to(2.0, 3.0)]);
    assert_eq!(of(-3.0, 2.0, Real::magnitude), [to(0.0, 3.0)]);
    assert_eq!(of(2.0, 3.0, |x| x.at_least(x_of(1.0))), [to(2.0, 3.0)]);
    assert_eq!(of(2.0, 3.0, |x| x.at_least(x_of(4.0))), [to(4.0, 4.0)]);
    assert_eq!(
        of(2.0, 3.0, |x| x.at_least(x_of(2.5))),
        [to(2.0, 3.0), to(2.5, 2.5)]
    );
    assert_eq!(of(2.0, 3.0, |x| x.at_most(x_of(1.0))), [to(1.0, 1.0)]);
    assert_eq!(of(2.0, 3.0, |x| x.at_most(x_of(4.0))), [to(2.0, 3.0)]);
    // The error of a number whose sign is open is that of its absolute value.
    let errors = only(|| {
        let x = Tracked::input(0, [-1.0, 2.0]) / x_of(3.0);
        [x, x.magnitude()].map(|t| t.result())
    });
    assert!(errors[0].error > 0.0 && errors[1].error == errors[0].error);
    assert!(errors[1].relative.is_infinite());
    // Raised, it is more by what is added at most.
    let raised = |lo: f64, least: f64| only(|| Tracked::input(0, [lo, 1.0]).raised(least).result());
    assert_eq!(raised(0.5, 0.25).error, 0.0);
    assert_eq!(raised(0.125, 0.25).error, 0.25);
    assert_eq!(raised(0.125, 0.25).exact, to(0.125, 1.0));
    assert_eq!(raised(-0.5, 0.25).error, 0.75f64.next_up());
    assert!(raised(0.125, 0.25).relative >= 2.0 && raised(0.5, 0.25).relative == 0.0);
}

/// The number of roundings, each of which may truncate, and products that are rounded before a sum.
#[test]
fn planted_roundings() {
    let run = |rounding: Rounding| {
        let program = || {
            let (x, y) = (
                Tracked::input(0, [1.0, 1.001]),
                Tracked::input(1, [1.3, 1.301]),
            );
            x.fma(y, x.like(0.125) * y).result().error
        };
        evaluate(setting(rounding), program).expect("a bound")[0]
    };
    let u = 2f64.powi(-53);
    let sound = run(Rounding::default());
    assert!(sound >= u && sound < 1.01 * u, "{sound}");
    let twice = run(Rounding {
        fma_rounds_twice: true,
        truncates: None,
    });
    assert!(twice >= 2.0 * u && twice < 2.01 * u);
    let truncates = |k| {
        run(Rounding {
            fma_rounds_twice: false,
            truncates: Some(k),
        })
    };
    assert!(truncates(1) >= 2.0 * u && truncates(1) < 2.01 * u);
    assert_eq!([truncates(0), truncates(2)], [sound; 2]);
}

/// A stored number that stands for another has the difference as an error in common.
#[test]
fn constants_stand_for_others() {
    let third = Constant {
        stored: 0.375,
        exact: Interval::new(0.33, 0.34),
        error: Interval::new(0.035, 0.045),
    };
    let with = Setting {
        constants: &[third],
        ..setting(Rounding::default())
    };
    let found = evaluate(with, || {
        let x = x_of(1.0);
        let (p, q) = (x.like(0.375), x.like(-0.375));
        let other = x.like(0.5);
        [p, q, p + q, other].map(Tracked::result)
    });
    let [p, q, none, other] = found.expect("a bound").remove(0);
    assert_eq!(
        [p.exact, q.exact],
        [Interval::new(0.33, 0.34), Interval::new(-0.34, -0.33)]
    );
    assert_eq!([p.error, q.error], [0.045; 2]);
    // As far as it is known.
    assert!(none.error <= 0.0101 && none.exact.magnitude() <= 0.0101);
    assert_eq!((other.error, other.exact), (0.0, Interval::point(0.5)));
}

/// A number's grid is that of the least it may be: from 4 on quarters of a unit of ½ are lost.
#[test]
fn grids_are_those_of_the_least_numbers() {
    let errors = only(|| {
        let x = Tracked::input(0, [0.5, 4.0]);
        let y = Tracked::input_on_grid(1, [1.0, 4.0], 0);
        let raised = y.raised(1.25);
        [x + x_of(4.0), y + x_of(8.0), raised + x_of(8.0)].map(|t| t.result().error)
    });
    assert!(errors[0] >= 2f64.powi(-51) && errors[1] == 0.0);
    assert!(errors[2] >= 1.25 + 2f64.powi(-50), "{errors:?}");
    let [offset, raised] = only(|| {
        let x = Tracked::input(0, [1.5, 1.75]);
        [x.offset(1.0, -52), (x * x).raised(2.5)].map(Tracked::result)
    });
    assert_eq!(
        (offset.exact, offset.error),
        (Interval::new(0.5f64.next_down(), 0.75f64.next_up()), 0.0)
    );
    assert!(raised.relative > 0.5);
    // From 2 on the last bit of numbers from 1 on is lost.
    let error = only(|| (Tracked::input(0, [1.0, 1.9]) + x_of(1.0)).result().error);
    assert_eq!(error, 2f64.powi(-52));
}

/// The error of one operand meets what the other one is with its own.
#[test]
fn errors_of_second_order_count() {
    let constant = |stored: f64, exact: f64| Constant {
        stored,
        exact: Interval::point(exact),
        error: Interval::point(stored - exact),
    };
    let constants = [constant(1.25, 1.0), constant(0.75, 0.875)];
    let with = Setting {
        constants: &constants,
        ..setting(Rounding::default())
    };
    let found = evaluate(with, || {
        let x = x_of(1.0);
        let (p, q) = (x.like(1.25), x.like(0.75));
        [p * p, p / q].map(Tracked::result)
    });
    let found = found.expect("a bound")[0];
    let off = [1.25 * 1.25 - 1.0, 1.25 / 0.75 - 1.0 / 0.875];
    for (found, off) in found.into_iter().zip(off) {
        assert!((off..1.2 * off).contains(&found.error), "{found:?} {off}");
    }
}

/// Checks an error that is in five products, more than are kept apart.
#[test]
fn all_uses_of_an_error_count() {
    let error = only(|| {
        let x = Tracked::input(0, [1.0, 1.001]);
        let (_, lost) = x.two_sum(Tracked::input(1, [1.5, 1.501]));
        let beside = [1.0, 2.0, 3.0, 4.0, 5.0].map(|k| x_of(k * 1e-12));
        let products = beside.map(|c| (lost + c) * x_of(3.0));
        products
            .into_iter()
            .reduce(|a, b| a + b)
            .expect("five")
            .result()
            .error
    });
    let due = 15.0 * 2f64.powi(-52);
    assert!((due..1.001 * due).contains(&error), "{error:e} {due:e}");
}

/// The sum of two numbers and what is lost of it is exact only if the first one is the larger one
/// for sure.
#[test]
fn a_fast_sum_is_exact_only_in_order() {
    let of = |a: [f64; 2], b: [f64; 2]| {
        only(|| {
            let (s, e) = Tracked::input(0, a).fast_two_sum(Tracked::input(1, b));
            s.exact_sum(e)
        })
    };
    let exact = |r: &Tracks| r.error < 1e-25;
    assert!(exact(&of([2.0, 2.5], [1.0, 1.5])) && exact(&of([2.0, 2.5], [1.0, 2.0])));
    for (a, b) in [([0.5, 2.0], [1.0, 1.5]), ([0.3, 0.301], [1.0, 1.001])] {
        let found = of(a, b);
        assert!(!exact(&found), "{a:?} {b:?}");
        assert!(found.exact.lo <= a[0] + b[0] && found.exact.lo > a[0] + b[0] - 3.0);
        assert!(found.exact.hi >= a[1] + b[1]);
    }
    assert!(exact(&of([0.0, 0.0], [1.0, 1.001])));
}

/// Checks that what a product loses is rounded itself where it may be below the normal numbers;
/// with products that are rounded before a sum it is lost.
#[test]
fn what_a_product_loses() {
    let of = |a: f64, b: f64, rounding: Rounding| {
        let program = || {
            let x = Tracked::input(0, [a, 1.1 * a]);
            let (p, f) = x.two_prod(Tracked::input(1, [b, 1.1 * b]));
            (p.exact_sum(f), f.result())
        };
        evaluate(setting(rounding), program).expect("a bound")[0]
    };
    let (sum, _) = of(1.0, 0.3, Rounding::default());
    assert!(sum.tiny == 0.0 && sum.error < 1e-30);
    let (sum, lost) = of(1e-150, 1e-150, Rounding::default());
    assert!(
        (1.0..1.01).contains(&sum.tiny) && (1.0..1.01).contains(&lost.tiny),
        "{sum:?} {lost:?}"
    );
    let twice = Rounding {
        fma_rounds_twice: true,
        truncates: None,
    };
    let (sum, lost) = of(1.0, 0.3, twice);
    assert!(
        sum.error > 1e-17 && lost.exact.magnitude() < 0.1,
        "{lost:?}"
    );
    // Beside the small factor what is lost has it too, and what underflows.
    let with = Setting {
        sigma: Exact::coordinate(Interval::new(0.0, 1.0), 0),
        ..setting(Rounding::default())
    };
    let lost = evaluate(with, || {
        let x = Tracked::sigma();
        x.two_prod(Tracked::input(1, [1.1, 1.2])).1.result()
    });
    let lost = lost.expect("a bound")[0];
    assert!(
        lost.small && lost.tiny >= 1.0 && lost.error > 1e-17,
        "{lost:?}"
    );
}

/// Checks that what a stored number is off has no error in common with an operation.
#[test]
fn constants_and_operations_are_apart() {
    let u = 2f64.powi(-53);
    let third = Constant {
        stored: 0.375,
        exact: Interval::new(0.3, 0.4),
        error: Interval::point(u),
    };
    let with = Setting {
        constants: &[third],
        ..setting(Rounding::default())
    };
    let errors = evaluate(with, || {
        let x = Tracked::input(0, [1.0, 1.001]) * Tracked::input(1, [1.3, 1.301]);
        (x.result().error, x.exact_sum(-x.like(0.375)).error)
    });
    let (one, both) = errors.expect("a bound")[0];
    assert!(both >= one + u);
}

#[test]
fn truth_values_and_vectors() {
    use crate::tracked::Tracking;
    use mechaudit_solvers::faddeeva::proof::Vectors;
    let (x, y, picked) = only(|| {
        let (x, y) = (x_of(1.0), x_of(2.0));
        let table = [[false, false], [false, true], [true, false], [true, true]];
        for [a, b] in table {
            assert_eq!(x.or(a, b), a || b);
            assert_eq!(x.all(a), a);
        }
        (x, y, [x.pick(true, x, y), x.pick(false, x, y)])
    });
    assert_eq!(picked, [x, y]);
    let found = only(|| {
        let four = |x: [f64; 4]| Tracking.entries(x);
        let (a, b, c) = (
            four([1.0, 2.0, 4.0, 8.0]),
            four([3.0, 5.0, 7.0, 11.0]),
            four([1.0, 0.5, 2.0, 4.0]),
        );
        [
            Tracking.mul(a, b),
            Tracking.mul_add(a, b, c),
            Tracking.neg_mul_add(a, b, c),
            Tracking.load(a),
            Tracking.parts(b),
            Tracking.splat(Tracking.sum(b)),
        ]
        .map(|v| {
            v.map(|x| {
                let Interval { lo, hi } = x.result().exact;
                assert!(hi - lo < 1e-12);
                (0.5 * (lo + hi) * 16.0).round() / 16.0
            })
        })
    });
    assert_eq!(found[0], [3.0, 10.0, 28.0, 88.0]);
    assert_eq!(found[1], [4.0, 10.5, 30.0, 92.0]);
    assert_eq!(found[2], [-2.0, -9.5, -26.0, -84.0]);
    assert_eq!(
        (found[3], found[4]),
        ([1.0, 2.0, 4.0, 8.0], [3.0, 5.0, 7.0, 11.0])
    );
    assert_eq!(found[5], [26.0; 4]);
}
